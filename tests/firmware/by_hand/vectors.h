/* SPDX-License-Identifier: BSD-3-Clause */
/* Two and three dimensions, as plain numbers. */
#ifndef PASSIVE_HAPTICS_BY_HAND_VECTORS_H
#define PASSIVE_HAPTICS_BY_HAND_VECTORS_H

#include "scenes.h"

static inline vec2 sub2(vec2 a, vec2 b) {
  return (vec2){a.x - b.x, a.y - b.y};
}
static inline vec2 add2(vec2 a, vec2 b) {
  return (vec2){a.x + b.x, a.y + b.y};
}
static inline vec2 mul2(vec2 a, real s) {
  return (vec2){a.x * s, a.y * s};
}
static inline vec2 div2(vec2 a, real s) {
  return (vec2){a.x / s, a.y / s};
}
static inline real dot2(vec2 a, vec2 b) {
  return a.x * b.x + a.y * b.y;
}
static inline bool same2(vec2 a, vec2 b) {
  return a.x == b.x && a.y == b.y;
}
static inline bool finite2(vec2 a) {
  return finite_number(a.x) && finite_number(a.y);
}

static inline vec3 sub3(vec3 a, vec3 b) {
  return (vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline vec3 add3(vec3 a, vec3 b) {
  return (vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline vec3 mul3(vec3 a, real s) {
  return (vec3){a.x * s, a.y * s, a.z * s};
}
static inline vec3 div3(vec3 a, real s) {
  return (vec3){a.x / s, a.y / s, a.z / s};
}
static inline real dot3(vec3 a, vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline bool same3(vec3 a, vec3 b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
static inline bool finite3(vec3 a) {
  return finite_number(a.x) && finite_number(a.y) && finite_number(a.z);
}
/* The sum of |a_i b_i|. */
static inline real passed2(vec2 a, vec2 b) {
  return magnitude(a.x * b.x) + magnitude(a.y * b.y);
}
static inline real passed3(vec3 a, vec3 b) {
  return magnitude(a.x * b.x) + magnitude(a.y * b.y) + magnitude(a.z * b.z);
}
static inline vec3 cross3(vec3 a, vec3 b) {
  return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* The turn by 2 atan(angle/2) that one tick allows. */
struct turn {
  real cosine, sine, chord_squared;
};
static inline struct turn half_angle_turn(real angle) {
  const real t = angle / 2, d = 1 + t * t;
  return (struct turn){(1 - t * t) / d, 2 * t / d, 4 * t * t / d};
}

/* From one unit normal towards another, no further than the turn. */
static inline vec2 turned2(vec2 from, vec2 to, real angle) {
  const struct turn turn = half_angle_turn(angle);
  const vec2 chord = sub2(to, from);
  if (dot2(chord, chord) <= turn.chord_squared) return to;
  const vec2 across = sub2(chord, mul2(from, dot2(chord, from)));
  const real length = root(dot2(across, across));
  vec2 tangent;
  if (length < (real)1 / 1024) { /* antiparallel: any direction across will do */
    if ((from.y < 0 ? -from.y : from.y) < (from.x < 0 ? -from.x : from.x)) {
      tangent = (vec2){-from.y * from.x, -from.y * from.y + 1};
    } else {
      tangent = (vec2){-from.x * from.x + 1, -from.x * from.y};
    }
    tangent = div2(tangent, root(dot2(tangent, tangent)));
  } else {
    tangent = div2(across, length);
  }
  const vec2 turned = add2(mul2(from, turn.cosine), mul2(tangent, turn.sine));
  return div2(turned, root(dot2(turned, turned)));
}

static inline vec3 turned3(vec3 from, vec3 to, real angle) {
  const struct turn turn = half_angle_turn(angle);
  const vec3 chord = sub3(to, from);
  if (dot3(chord, chord) <= turn.chord_squared) return to;
  const vec3 across = sub3(chord, mul3(from, dot3(chord, from)));
  const real length = root(dot3(across, across));
  vec3 tangent;
  if (length < (real)1 / 1024) { /* antiparallel: any direction across will do */
    const real x = from.x < 0 ? -from.x : from.x, y = from.y < 0 ? -from.y : from.y,
               z = from.z < 0 ? -from.z : from.z;
    if (z < x && z < y) {
      tangent = mul3(from, -from.z);
      tangent.z += 1;
    } else if (y < x) {
      tangent = mul3(from, -from.y);
      tangent.y += 1;
    } else {
      tangent = mul3(from, -from.x);
      tangent.x += 1;
    }
    tangent = div3(tangent, root(dot3(tangent, tangent)));
  } else {
    tangent = div3(across, length);
  }
  const vec3 turned = add3(mul3(from, turn.cosine), mul3(tangent, turn.sine));
  return div3(turned, root(dot3(turned, turned)));
}

#endif
