/* SPDX-License-Identifier: BSD-3-Clause */
/* One degree of freedom, a wall that never moves: |f| <= sqrt(4 (b/T) E1), every tick. */
#include "scenes.h"

void by_hand_wall_strict_start(struct wall_strict* w, struct plane1 wall, real damping,
                               struct loop loop) {
  *w =
      (struct wall_strict){.wall = wall,
                           .ledger = {.damping = damping, .cap = REAL_MAX, .reset_after = REAL_MAX},
                           .loop = loop,
                           .device = {.sound = true}};
}

/* A sample that cannot be: no force, and the motion since the last good one is written off. */
static struct answer1 refuse(struct wall_strict* w, real dt) {
  const real T = w->loop.longest_tick;
  struct device1* d = &w->device;
  uint8_t what = rejected_parameters;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, d->held * d->held, T);
    what = rejected_sample;
  }
  d->blind += dt > 0 && dt <= REAL_MAX ? dt : T;
  d->held = 0;
  return (struct answer1){0, 0, w->ledger.energy, what, false};
}

struct answer1 by_hand_wall_strict_tick(struct wall_strict* w, real x, real dt) {
  struct ledger* l = &w->ledger;
  struct device1* d = &w->device;
  const real T = w->loop.longest_tick;
  const real travel = x - d->position;
  const real square = travel * travel;
  const real farthest = w->loop.top_speed * (d->blind + dt);
  if (!d->sound || !(dt > 0) ||
      !(d->seen ? square + dt <= REAL_MAX && square <= farthest * farthest
                : dt <= REAL_MAX && finite_number(x))) {
    return refuse(w, dt);
  }
  const real held_squared = d->held * d->held;
  if (d->seen && !(d->blind > 0)) {
    const real work = d->held * travel;
    if (!book(l, square, work, magnitude(work), held_squared, dt, T)) return refuse(w, dt);
  } else {
    l->energy = written_off(l, held_squared, T);
    d->seen = true;
    d->blind = 0;
  }
  d->position = x;
  uint8_t what = dt > T ? late_tick : l->energy < 0 ? debt : nominal;

  real depth = (w->wall.point - x) * w->wall.normal;
  if (!(depth > 0)) { /* nothing is asked, nothing is given */
    d->held = 0;
    return (struct answer1){0, 0, l->energy, what, false};
  }
  real asked = w->wall.stiffness * depth;
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const real desired = w->wall.normal * asked;
  real force = desired * affordable(l->energy, outflow(l, desired * desired, T));
  const bool cut = !(force == desired);
  if (cut && !finite_number(force)) {
    force = 0;
    what = worse(what, rejected_sample);
  }
  d->held = force;
  return (struct answer1){force, depth, l->energy, what, cut};
}
