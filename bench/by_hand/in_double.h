/* SPDX-License-Identifier: BSD-3-Clause */
/* The scenes by hand, in double. <math.h>, <stdbool.h>, <stdint.h> and <string.h> come before. */
typedef double real;
static const real real_epsilon = 0x1p-52, real_max = 0x1.fffffffffffffp1023, real_min = 0x1p-1022;

static inline real root(real x) {
  return sqrt(x);
}
static inline real magnitude(real x) {
  return fabs(x);
}

#include "scenes.h"
