/* SPDX-License-Identifier: BSD-3-Clause */
/* One degree of freedom, a wall that the environment moves, a damped spring; only what the next
   tick can reach must be covered by the ledger. */
#include "scenes.h"

void by_hand_wall_reachable_start(struct wall_reachable* w, struct freshness rule, real damping,
                                  struct reach reach, struct loop loop) {
  *w = (struct wall_reachable){
      .news = {.rule = rule, .together = true},
      .spring = {reach.mass, (real)0.1, 1, (real)0.5, REAL_MAX, 0, 0},
      .ledger = {.damping = damping, .cap = REAL_MAX, .reset_after = REAL_MAX},
      .reach = reach,
      .loop = loop,
      .device = {.sound = true}};
}

bool by_hand_wall_reachable_retarget(struct wall_reachable* w, struct plane1 next) {
  struct news* n = &w->news;
  const real length = next.normal < 0 ? -next.normal : next.normal;
  if (!(length > 0) || !finite_number(length) || !finite_number(next.point) ||
      !(next.stiffness > 0) || !finite_number(next.stiffness)) {
    n->refused = true;
    return false;
  }
  next.normal /= length;
  w->newest = next;
  if (!n->published) w->own = next;
  n->together = !n->published;
  n->published = n->changed = true;
  n->age = 0;
  return true;
}

static struct answer1 refuse(struct wall_reachable* w, real dt) {
  const real T = w->loop.longest_tick;
  struct device1* d = &w->device;
  const real passed = dt > 0 && dt <= REAL_MAX ? dt : T;
  uint8_t what = rejected_parameters;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, d->held * d->held, T);
    what = rejected_sample;
  }
  d->blind += passed;
  w->news.age += passed;
  d->held = 0;
  return (struct answer1){0, 0, w->ledger.energy, what, false};
}

/* The force that the ledger covers of the one desired. */
static real limited(const struct wall_reachable* w, real desired, real travel, bool known,
                    real dt) {
  const real T = w->loop.longest_tick;
  const struct ledger* l = &w->ledger;
  if (outflow(l, desired * desired, T) <= spendable(l->energy)) return desired;
  const real asked = desired < 0 ? -desired : desired;
  if (!(asked > 0)) return desired;
  const real held = w->device.held;
  const real most =
      reachable_force(&w->reach, l->damping, l->energy, travel * desired / asked,
                      travel < 0 ? -travel : travel, held < 0 ? -held : held, asked, known, dt, T);
  return most < asked ? desired * (most / asked) : desired;
}

struct answer1 by_hand_wall_reachable_tick(struct wall_reachable* w, real x, real dt) {
  struct ledger* l = &w->ledger;
  struct device1* d = &w->device;
  struct news* n = &w->news;
  const real T = w->loop.longest_tick;
  real travel = x - d->position;
  const real square = travel * travel;
  const real farthest = w->loop.top_speed * (d->blind + dt);
  if (!d->sound || !(dt > 0) ||
      !(d->seen ? square + dt <= REAL_MAX && square <= farthest * farthest
                : dt <= REAL_MAX && finite_number(x))) {
    return refuse(w, dt);
  }
  const bool known = d->seen && !(d->blind > 0);
  if (known) {
    const real work = d->held * travel;
    if (!book(l, square, work, magnitude(work), d->held * d->held, dt, T)) return refuse(w, dt);
  } else {
    travel = 0;
    l->energy = written_off(l, d->held * d->held, T);
    d->seen = true;
    d->blind = 0;
  }
  d->position = x;
  uint8_t what = dt > T ? late_tick : l->energy < 0 ? debt : nominal;

  if (n->refused) what = worse(what, rejected_target);
  if (!n->published) what = worse(what, no_target);
  if (!n->changed) n->age += dt;
  if (n->published && n->age > n->rule.stale_after) what = worse(what, stale_target);
  const real weight = n->published ? presence(&n->rule, n->age) : 0;

  const real normal = w->newest.normal;
  const real target_depth = (w->newest.point - x) * normal;
  const bool in_target = weight > 0 && target_depth > 0;
  if (n->changed) adopt_stiffness(&w->spring, w->newest.stiffness, T);
  if (!in_target) { /* nothing is asked, nothing is given */
    if (!n->together) w->own = w->newest;
    n->together = true;
    n->changed = n->refused = false;
    n->last_weight = weight;
    d->held = 0;
    return (struct answer1){0, 0, l->energy, what, false};
  }

  const real speed = travel * normal / dt;
  real depth = target_depth;
  real asked = weight * damped_force(&w->spring, depth, speed);
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const real desired = normal * asked;
  real force = limited(w, desired, travel, known, dt);
  const bool cut = !(force == desired);
  if (cut && !finite_number(force)) {
    force = 0;
    what = worse(what, rejected_sample);
  }
  if (cut) {
    depth = damped_depth(&w->spring, force * normal, speed);
    w->own = (struct plane1){x + normal * depth, normal, w->newest.stiffness};
    n->together = false;
  } else if (!n->together) {
    w->own = w->newest;
    n->together = true;
  }
  n->changed = n->refused = false;
  n->last_weight = weight;
  d->held = force;
  return (struct answer1){force, depth, l->energy, what, cut};
}
