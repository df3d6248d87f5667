/* SPDX-License-Identifier: BSD-3-Clause */
/* Two and three dimensions, as plain numbers; the pieces of a surface; what a tick answers. */

typedef struct {
  real x, y;
} vec2;
typedef struct {
  real x, y, z;
} vec3;

static inline vec2 sub2(vec2 a, vec2 b) {
  const vec2 r = {a.x - b.x, a.y - b.y};
  return r;
}
static inline vec2 add2(vec2 a, vec2 b) {
  const vec2 r = {a.x + b.x, a.y + b.y};
  return r;
}
static inline vec2 mul2(vec2 a, real s) {
  const vec2 r = {a.x * s, a.y * s};
  return r;
}
static inline vec2 div2(vec2 a, real s) {
  const vec2 r = {a.x / s, a.y / s};
  return r;
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
  const vec3 r = {a.x - b.x, a.y - b.y, a.z - b.z};
  return r;
}
static inline vec3 add3(vec3 a, vec3 b) {
  const vec3 r = {a.x + b.x, a.y + b.y, a.z + b.z};
  return r;
}
static inline vec3 mul3(vec3 a, real s) {
  const vec3 r = {a.x * s, a.y * s, a.z * s};
  return r;
}
static inline vec3 div3(vec3 a, real s) {
  const vec3 r = {a.x / s, a.y / s, a.z / s};
  return r;
}
static inline real dot3(vec3 a, vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline real square3(vec3 a) {
  return dot3(a, a);
}
static inline bool same3(vec3 a, vec3 b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
static inline bool finite3(vec3 a) {
  return finite_number(a.x) && finite_number(a.y) && finite_number(a.z);
}
static inline vec3 cross3(vec3 a, vec3 b) {
  const vec3 r = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return r;
}

/* The sum of |a_i b_i|. */
static inline real passed2(vec2 a, vec2 b) {
  return magnitude(a.x * b.x) + magnitude(a.y * b.y);
}
static inline real passed3(vec3 a, vec3 b) {
  return magnitude(a.x * b.x) + magnitude(a.y * b.y) + magnitude(a.z * b.z);
}

/* The turn by 2 atan(angle/2) that one tick allows. */
struct turn {
  real cosine, sine, chord_squared;
};
static inline struct turn half_angle_turn(real angle) {
  const real t = smaller(angle / 2, 1 << 20), d = 1 + t * t;
  const struct turn r = {(1 - t * t) / d, 2 * t / d, 4 * t * t / d};
  return r;
}

/* From one unit normal towards another, no further than the turn. */
static inline vec2 turned2(vec2 from, vec2 to, real angle) {
  const struct turn turn = half_angle_turn(angle);
  const vec2 chord = sub2(to, from);
  if (dot2(chord, chord) <= turn.chord_squared) return to;
  const vec2 across = sub2(chord, mul2(from, dot2(chord, from)));
  const real length = root(dot2(across, across));
  vec2 tangent = across;
  if (length < (real)1 / 1024) { /* antiparallel: any direction across will do */
    if (magnitude(from.y) < magnitude(from.x)) {
      tangent = mul2(from, -from.y);
      tangent.y += 1;
    } else {
      tangent = mul2(from, -from.x);
      tangent.x += 1;
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
  if (square3(chord) <= turn.chord_squared) return to;
  const vec3 across = sub3(chord, mul3(from, dot3(chord, from)));
  const real length = root(square3(across));
  vec3 tangent = across;
  if (length < (real)1 / 1024) { /* antiparallel: any direction across will do */
    const real x = magnitude(from.x), y = magnitude(from.y), z = magnitude(from.z);
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
    tangent = div3(tangent, root(square3(tangent)));
  } else {
    tangent = div3(across, length);
  }
  const vec3 turned = add3(mul3(from, turn.cosine), mul3(tangent, turn.sine));
  return div3(turned, root(square3(turned)));
}

struct plane1 {
  real point, normal, stiffness;
};
struct plane2 {
  vec2 point, normal;
  real stiffness;
};
struct plane3 {
  vec3 point, normal;
  real stiffness;
};
static inline bool usable3(const struct plane3* p) {
  const real length = root(square3(p->normal));
  return length > 0 && finite_number(length) && finite3(p->point) &&
         finite3(div3(p->normal, length)) && p->stiffness > 0 && finite_number(p->stiffness);
}
struct triangle3 {
  vec3 a, b, c;
  real stiffness, thickness;
  vec3 normal;
};

/* What every scene remembers of its device. */
struct device1 {
  real held, position, blind; /* blind: time that bad samples took */
  bool seen, sound;           /* sound: the parameters are in their ranges */
};
struct device2 {
  vec2 held, position;
  real blind;
  bool seen, sound;
};
struct device3 {
  vec3 held, position;
  real blind;
  bool seen, sound;
};

struct answer1 {
  real force, depth, energy;
  uint8_t what;
  bool limited;
};
struct answer2 {
  vec2 force;
  real depth, energy;
  uint8_t what;
  bool limited;
};
struct answer3 {
  vec3 force;
  real depth, energy;
  uint8_t what;
  bool limited;
};
static inline struct answer1 reply1(real force, real depth, real energy, uint8_t what,
                                    bool limited) {
  const struct answer1 r = {force, depth, energy, what, limited};
  return r;
}
static inline struct answer2 reply2(vec2 force, real depth, real energy, uint8_t what,
                                    bool limited) {
  const struct answer2 r = {force, depth, energy, what, limited};
  return r;
}
static inline struct answer3 reply3(vec3 force, real depth, real energy, uint8_t what,
                                    bool limited) {
  const struct answer3 r = {force, depth, energy, what, limited};
  return r;
}
/* Nothing is asked, or nothing may be given. */
static inline struct answer2 no_force2(real energy, uint8_t what) {
  const vec2 none = {0, 0};
  return reply2(none, 0, energy, what, false);
}
static inline struct answer3 no_force3(real energy, uint8_t what) {
  const vec3 none = {0, 0, 0};
  return reply3(none, 0, energy, what, false);
}

/* The share of a force in space that the ledger covers within what can be reached. */
static inline real reachable_share3(const struct reach* r, const struct ledger* l, vec3 desired,
                                    vec3 travel, const struct device3* d, bool known, real dt,
                                    real T) {
  const real square = square3(desired);
  if (outflow(l, square, T) <= spendable(l->energy)) return 1;
  const real asked = root(square);
  if (!(asked > 0)) return 1;
  const real most = reachable_force(r, l, dot3(travel, desired) / asked, root(square3(travel)),
                                    root(square3(d->held)), asked, known, dt, T);
  return most < asked ? most / asked : 1;
}
