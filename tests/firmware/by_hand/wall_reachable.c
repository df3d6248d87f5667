/* SPDX-License-Identifier: BSD-3-Clause */
#include "by_hand.h"

struct answer1 by_hand_wall_reachable_tick(struct wall_reachable* w, real x, real dt) {
  return wall_reachable_tick(w, x, dt);
}
