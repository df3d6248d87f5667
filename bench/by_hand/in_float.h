/* SPDX-License-Identifier: BSD-3-Clause */
/* The scenes by hand, in float. <math.h>, <stdbool.h>, <stdint.h> and <string.h> come before. */
typedef float real;
static const real real_epsilon = 0x1p-23F, real_max = 0x1.fffffep127F, real_min = 0x1p-126F;

static inline real root(real x) {
  return sqrtf(x);
}
static inline real magnitude(real x) {
  return fabsf(x);
}

#include "scenes.h"
