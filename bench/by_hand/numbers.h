/* SPDX-License-Identifier: BSD-3-Clause */
/* What all scenes share: the guard, the ledger, the laws of the contact and of the bounds. */

enum what { /* rising severity, as passive_haptics::event */
            nominal,
            debt,
            late_tick,
            repeated_sample,
            no_target,
            rejected_target,
            stale_target,
            outside_workspace,
            rejected_sample,
            rejected_parameters,
            started_inside = 13 /* the least of what is not nominal */
};

static inline bool finite_number(real x) {
  return magnitude(x) <= real_max;
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
/* A contact that was cut to nothing: nothing has been paid in yet. */
static inline uint8_t cut_short(uint8_t what, bool pushes, real energy) {
  if (what == nominal && !pushes && !(energy > 0)) return started_inside;
  return what;
}

/* A margin for a dozen roundings in any direction. */
static const real rounding = 16 * real_epsilon;

/* a + b, rounded down. */
static inline real sum_rounded_down(real a, real b) {
  const real sum = a + b;
  const real ulp = magnitude(sum) * real_epsilon;
  return sum - (sum - a > b ? ulp : 0);
}

struct loop {
  real longest_tick, top_speed, workspace, watchdog;
};

/* Is the sample no farther from the last good one than the device can have gone? NaN is not. */
static inline bool near_enough(const struct loop* l, real blind, real travel_squared, real dt) {
  const real farthest = l->top_speed * (blind + dt);
  return dt > 0 && travel_squared + dt <= real_max && travel_squared <= farthest * farthest;
}
static inline bool positive(real dt) {
  return dt > 0 && dt <= real_max;
}
static inline bool within(const struct loop* l, real distance_squared) {
  return distance_squared <= l->workspace * l->workspace;
}
/* How long a force may have been held in a tick that took dt. */
static inline real held_for(const struct loop* l, real dt) {
  return smaller(larger(dt, l->longest_tick), l->watchdog);
}

/* E1 += dx'(b/dt)dx - f_held'dx. */
struct ledger {
  real damping, energy;
};

/* The most energy that a force f can hand out in a tick: T f^2/(4b). */
static inline real outflow(const struct ledger* l, real f_squared, real T) {
  return T * f_squared / (4 * l->damping);
}

/* Nobody saw the motion: the worst is written off, down to an empty ledger. */
static inline real written_off(const struct ledger* l, real held_squared, real T) {
  const real left = sum_rounded_down(l->energy, -outflow(l, held_squared, T) * (1 + rounding));
  return larger(smaller(l->energy, 0), left);
}

/* One tick into the ledger, rounded down. `passed` is the sum of |held_i travel_i|. False, and
   nothing is booked, when that is no number. */
static inline bool book(struct ledger* l, real travel_squared, real work, real passed, real dt) {
  const real dissipated = l->damping * travel_squared / dt;
  const real gain = dissipated - work - rounding * (dissipated + passed);
  if (!finite_number(l->energy + gain)) return false;
  l->energy = sum_rounded_down(l->energy, gain);
  return true;
}

/* Longer than the watchdog waits: the worse of two stories, held to its end, or dropped on the way. */
__attribute__((cold, noinline)) static bool book_cut_short(struct ledger* l, real travel_squared,
                                                           real work, real passed,
                                                           real held_squared, real dt,
                                                           real watchdog) {
  const real dropped = written_off(l, held_squared, watchdog);
  if (!book(l, travel_squared, work, passed, dt)) return false;
  l->energy = smaller(l->energy, dropped);
  return true;
}

/* The part of a credit that may be spent, whichever way each step rounds. */
static inline real spendable(real credit) {
  return credit * (1 - 4 * rounding) - real_min / real_epsilon;
}

/* The factor that brings an outflow down to what the ledger covers. */
static inline real affordable(real E, real worst) {
  const real credit = spendable(E);
  if (worst <= credit) return 1;
  if (!(credit > 0)) return 0;
  const real share = credit / worst;
  return share >= real_min ? root(share) : 0;
}

/* The time that a bad sample took. */
static inline real time_lost(real dt, real T) {
  return positive(dt) ? dt : T;
}

/* What a surface that the environment moves remembers of it. */
struct news {
  real stale_after, fade; /* silence before the contact fades, and how long that takes */
  real age, last_weight;
  bool published, changed, refused, together;
};
static inline void start_news(struct news* n, real stale_after, real fade) {
  n->stale_after = stale_after;
  n->fade = fade;
  n->together = true;
}

static inline void take_news(struct news* n) {
  n->together = !n->published;
  n->published = n->changed = true;
  n->age = 0;
}

/* What is new, into `what`; returns how far the contact counts. */
static inline real presence(struct news* n, real dt, uint8_t* what) {
  if (n->refused) *what = worse(*what, rejected_target);
  if (!n->published) {
    *what = worse(*what, no_target);
    return 0;
  }
  if (!n->changed) n->age += dt;
  if (!(n->age > n->stale_after)) return 1;
  *what = worse(*what, stale_target);
  return larger(1 - (n->age - n->stale_after) / n->fade, 0);
}

/* f* = max(0, K_s d - D_s max(0, v_out)); beyond the force limit F the spring is the secant F/d. */
struct damped_spring {
  real mass, stiffness_fraction, damping_ratio, damping_fraction, force_limit, stiffness, damping;
};
static inline void start_spring(struct damped_spring* s, real mass, real force_limit) {
  s->mass = mass;
  s->stiffness_fraction = (real)0.1;
  s->damping_ratio = 1;
  s->damping_fraction = (real)0.5;
  s->force_limit = force_limit;
}
static inline void adopt_stiffness(struct damped_spring* s, real K, real T) {
  s->stiffness = smaller(K, s->stiffness_fraction * s->mass / (T * T));
  s->damping = smaller(2 * s->damping_ratio * root(s->stiffness * s->mass),
                       s->damping_fraction * s->mass / T);
}
static inline real damped_force(const struct damped_spring* s, real depth, real speed) {
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

/* The largest force whose work over the outward travel that the next tick can reach is covered. */
struct reach {
  real mass, hand_force, recent;
};
/* Keeps the longest tick, T at most, since the force was last not cut. */
static inline void keep_longest(struct reach* r, bool cut, real dt, real T) {
  r->recent = cut ? larger(r->recent, smaller(dt, T)) : 0;
}
static inline real reachable_force(const struct reach* r, const struct ledger* l, real outward,
                                   real travel, real held, real asked, bool known, real dt,
                                   real T) {
  const real B = l->damping / T;
  const real E = spendable(l->energy);
  if (known) {
    const real other = r->hand_force + 2 * B * travel;
    const real last = (held + other) * larger(dt, r->recent) * T / (2 * r->mass);
    const real coming = (asked + other) * T * T / (2 * r->mass);
    const real way = (outward + rounding * travel) * T / dt + (last + coming) * (1 + rounding);
    if (!(way > 0)) return real_max;
    if (B * way * way < E) return (E / way + B * way) * (1 - rounding);
  }
  return E > 0 ? root(smaller(4 * B * E, real_max)) : 0;
}
