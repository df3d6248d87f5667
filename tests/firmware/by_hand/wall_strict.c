/* SPDX-License-Identifier: BSD-3-Clause */
#include "by_hand.h"

struct answer1 by_hand_wall_strict_tick(struct wall_strict* w, real x, real dt) {
  return wall_strict_tick(w, x, dt);
}
