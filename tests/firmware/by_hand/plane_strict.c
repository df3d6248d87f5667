/* SPDX-License-Identifier: BSD-3-Clause */
#include "by_hand.h"

struct answer2 by_hand_plane_strict_tick(struct plane_strict* w, const vec2* x, real dt) {
  return plane_strict_tick(w, x, dt);
}
