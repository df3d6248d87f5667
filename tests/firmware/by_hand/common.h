/* SPDX-License-Identifier: BSD-3-Clause */
/* The scenes of the firmware report written by hand, in C: what all five share. The same equations,
   the same guards, the same order of operations as the composed tick, so the same bits; nothing
   that a scene does not use. Units: m, N, J, s, kg. */
#ifndef PASSIVE_HAPTICS_BY_HAND_COMMON_H
#define PASSIVE_HAPTICS_BY_HAND_COMMON_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef FIRMWARE_DOUBLE
typedef double real;
#define REAL_EPSILON 0x1p-52
#define REAL_MAX 0x1.fffffffffffffp1023
#define REAL_MIN 0x1p-1022
static inline real root(real x) {
  return sqrt(x);
}
static inline real magnitude(real x) {
  return fabs(x);
}
#else
typedef float real;
#define REAL_EPSILON 0x1p-23F
#define REAL_MAX 0x1.fffffep127F
#define REAL_MIN 0x1p-126F
static inline real root(real x) {
  return sqrtf(x);
}
static inline real magnitude(real x) {
  return fabsf(x);
}
#endif

enum what { /* rising severity */
            nominal,
            debt,
            late_tick,
            no_target,
            rejected_target,
            stale_target,
            rejected_sample,
            rejected_parameters
};

static inline bool finite_number(real x) {
  return magnitude(x) <= REAL_MAX;
}
static inline real larger(real a, real b) {
  return a < b ? b : a;
}
static inline real smaller(real a, real b) {
  return b < a ? b : a;
}
static inline uint8_t worse(uint8_t a, uint8_t b) {
  return a < b ? b : a;
}

struct loop {
  real longest_tick, top_speed;
};

/* E1 += dx'(b/dt)dx - f_held'dx, kept below `cap`, void after `reset_after` without force. */
struct ledger {
  real damping, cap, reset_after, energy, idle;
};

/* The most energy that a force f can hand out in a tick: T f^2/(4b). */
static inline real outflow(const struct ledger* l, real f_squared, real T) {
  return T * f_squared / (4 * l->damping);
}

/* A margin for a dozen roundings in any direction. */
static const real rounding = 16 * REAL_EPSILON;

/* a + b, rounded down. */
static inline real sum_rounded_down(real a, real b) {
  const real sum = a + b;
  const real ulp = magnitude(sum) * REAL_EPSILON;
  return sum - (sum - a > b ? ulp : 0);
}

/* Nobody saw the motion: write off the worst, down to an empty ledger. */
static inline real written_off(const struct ledger* l, real held_squared, real T) {
  const real left = sum_rounded_down(l->energy, -outflow(l, held_squared, T) * (1 + rounding));
  return larger(smaller(l->energy, 0), left);
}

/* One tick into the ledger, rounded down; a late one counts as the worse of the two stories. `passed`
   is the sum of |held_i travel_i|. False, and nothing is booked, when that is no number. */
static inline bool book(struct ledger* l, real travel_squared, real work, real passed,
                        real held_squared, real dt, real longest_tick) {
  const bool late = !(dt <= longest_tick);
  const real dropped = late ? written_off(l, held_squared, longest_tick) : REAL_MAX;
  const real dissipated = l->damping * travel_squared / dt;
  const real gain = dissipated - work - rounding * (dissipated + passed);
  if (!finite_number(l->energy + gain)) return false;
  real energy = sum_rounded_down(l->energy, gain);
  const real idle = held_squared > 0 ? 0 : l->idle + dt;
  const real most = idle >= l->reset_after ? 0 : l->cap;
  if (energy > most) energy = most;
  if (dropped < energy) {
    l->energy = dropped;
  } else {
    l->energy = energy;
    l->idle = idle;
  }
  return true;
}

/* The part of a credit that may be spent, whichever way each step rounds. */
static inline real spendable(real credit) {
  return credit * (1 - 4 * rounding) - REAL_MIN / REAL_EPSILON;
}

/* The factor that brings an outflow down to what the ledger covers. */
static inline real affordable(real E, real outflow) {
  const real credit = spendable(E);
  if (outflow <= credit) return 1;
  if (!(credit > 0)) return 0;
  const real share = credit / outflow;
  return share >= REAL_MIN ? root(share) : 0;
}

/* A silent environment fades out. */
struct freshness {
  real stale_after, fade;
};
static inline real presence(const struct freshness* f, real age) {
  if (!(age > f->stale_after)) return 1;
  return larger(1 - (age - f->stale_after) / f->fade, 0);
}

/* f* = max(0, K_s d - B_s max(0, v_out)); beyond the force limit F the spring is the secant F/d. */
struct damped_spring {
  real mass, stiffness_fraction, damping_ratio, damping_fraction, force_limit, stiffness, damping;
};
static inline void adopt_stiffness(struct damped_spring* s, real K, real T) {
  s->stiffness = smaller(K, s->stiffness_fraction * s->mass / (T * T));
  s->damping = smaller(2 * s->damping_ratio * root(s->stiffness * s->mass),
                       s->damping_fraction * s->mass / T);
}
static inline real damped_force(const struct damped_spring* s, real depth, real speed) {
  if (!(depth > 0)) return 0;
  const real pressed = s->stiffness * depth;
  real damping = s->damping, from = pressed;
  if (pressed > s->force_limit) {
    damping = smaller(damping, 2 * s->damping_ratio * root(s->force_limit * s->mass / depth));
    from = s->force_limit;
  }
  return larger(from - damping * larger(speed, 0), 0);
}
static inline real damped_depth(const struct damped_spring* s, real force, real speed) {
  if (!(force > 0) || !(s->stiffness > 0)) return 0;
  return (force + s->damping * larger(speed, 0)) / s->stiffness;
}

/* The largest force whose work over the outward travel the next tick can reach is covered. */
struct reach {
  real mass, hand_force;
};
static inline real reachable_force(const struct reach* r, real b, real credit, real outward,
                                   real travel, real held, real asked, bool known, real dt,
                                   real T) {
  const real B = b / T;
  real way = REAL_MAX;
  if (known) {
    const real other = r->hand_force + 2 * B * travel;
    const real last = (held + other) * dt * T / (2 * r->mass);
    const real coming = (asked + other) * T * T / (2 * r->mass);
    way = (outward + rounding * travel) * T / dt + (last + coming) * (1 + rounding);
  }
  if (!(way > 0)) return REAL_MAX;
  const real E = spendable(credit);
  if (B * way * way < E) return (E / way + B * way) * (1 - rounding);
  return E > 0 ? root(smaller(4 * B * E, REAL_MAX)) : 0;
}

#endif
