/* SPDX-License-Identifier: BSD-3-Clause */
#include "by_hand.h"

struct answer3 by_hand_plane_reachable_tick(struct plane_reachable* w, const vec3* x, real dt) {
  return plane_reachable_tick(w, x, dt);
}
