/* SPDX-License-Identifier: BSD-3-Clause */
/* Three degrees of freedom, a plane that the environment moves, normals that turn no faster than
   `rate`, a damped spring; only what the next tick can reach must be covered by the ledger. */
#include "vectors.h"

void by_hand_plane_reachable_start(struct plane_reachable* w, struct freshness rule, real rate,
                                   real damping, struct reach reach, struct loop loop) {
  *w = (struct plane_reachable){
      .news = {.rule = rule, .together = true},
      .rate = rate,
      .spring = {reach.mass, (real)0.1, 1, (real)0.5, REAL_MAX, 0, 0},
      .ledger = {.damping = damping, .cap = REAL_MAX, .reset_after = REAL_MAX},
      .reach = reach,
      .loop = loop,
      .device = {.sound = true}};
}

bool by_hand_plane_reachable_retarget(struct plane_reachable* w, const struct plane3* next) {
  struct news* n = &w->news;
  const real length = root(dot3(next->normal, next->normal));
  const vec3 normal = div3(next->normal, length);
  if (!(length > 0) || !finite_number(length) || !finite3(next->point) || !finite3(normal) ||
      !(next->stiffness > 0) || !finite_number(next->stiffness)) {
    n->refused = true;
    return false;
  }
  w->newest = (struct plane3){next->point, normal, next->stiffness};
  if (!n->published) w->own = w->newest;
  n->together = !n->published;
  n->published = n->changed = true;
  n->age = 0;
  return true;
}

static struct answer3 refuse(struct plane_reachable* w, real dt) {
  const real T = w->loop.longest_tick;
  struct device3* d = &w->device;
  const real passed = dt > 0 && dt <= REAL_MAX ? dt : T;
  uint8_t what = rejected_parameters;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, dot3(d->held, d->held), T);
    what = rejected_sample;
  }
  d->blind += passed;
  w->news.age += passed;
  d->held = (vec3){0};
  return (struct answer3){{0}, 0, w->ledger.energy, what, false};
}

/* The force that the ledger covers of the one desired. */
static vec3 limited(const struct plane_reachable* w, vec3 desired, vec3 travel, bool known,
                    real dt) {
  const real T = w->loop.longest_tick;
  const struct ledger* l = &w->ledger;
  const real square = dot3(desired, desired);
  if (outflow(l, square, T) <= spendable(l->energy)) return desired;
  const real asked = root(square);
  if (!(asked > 0)) return desired;
  const vec3 held = w->device.held;
  const real most =
      reachable_force(&w->reach, l->damping, l->energy, dot3(travel, desired) / asked,
                      root(dot3(travel, travel)), root(dot3(held, held)), asked, known, dt, T);
  return most < asked ? mul3(desired, most / asked) : desired;
}

struct answer3 by_hand_plane_reachable_tick(struct plane_reachable* w, const vec3* at, real dt) {
  struct ledger* l = &w->ledger;
  struct device3* d = &w->device;
  struct news* n = &w->news;
  const real T = w->loop.longest_tick;
  const vec3 x = *at;
  vec3 travel = sub3(x, d->position);
  const real square = dot3(travel, travel);
  const real farthest = w->loop.top_speed * (d->blind + dt);
  if (!d->sound || !(dt > 0) ||
      !(d->seen ? square + dt <= REAL_MAX && square <= farthest * farthest
                : dt <= REAL_MAX && finite3(x))) {
    return refuse(w, dt);
  }
  const bool known = d->seen && !(d->blind > 0);
  const real held_squared = dot3(d->held, d->held);
  if (known) {
    const real work = dot3(d->held, travel), passed = passed3(d->held, travel);
    if (!book(l, square, work, passed, held_squared, dt, T)) return refuse(w, dt);
  } else {
    travel = (vec3){0};
    l->energy = written_off(l, held_squared, T);
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

  const vec3 goal = w->newest.normal;
  const real target_depth = dot3(sub3(w->newest.point, x), goal);
  const bool in_target = weight > 0 && target_depth > 0;
  if (n->changed) adopt_stiffness(&w->spring, w->newest.stiffness, T);
  if (!in_target) { /* nothing is asked, nothing is given */
    if (!n->together) w->own = w->newest;
    n->together = true;
    n->changed = n->refused = false;
    n->last_weight = weight;
    d->held = (vec3){0};
    return (struct answer3){{0}, 0, l->energy, what, false};
  }

  vec3 normal = goal;
  if (!n->together && n->last_weight > 0 && dot3(sub3(w->own.point, x), w->own.normal) > 0) {
    normal = turned3(w->own.normal, goal, w->rate * dt);
  }
  const real speed = dot3(travel, normal) / dt;
  real depth = target_depth;
  real asked = weight * damped_force(&w->spring, depth, speed);
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const vec3 desired = mul3(normal, asked);
  vec3 force = limited(w, desired, travel, known, dt);
  const bool cut = !same3(force, desired);
  if (cut && !finite3(force)) {
    force = (vec3){0};
    what = worse(what, rejected_sample);
  }
  if (cut) depth = damped_depth(&w->spring, dot3(force, normal), speed);
  if (cut || !same3(normal, goal)) {
    w->own = (struct plane3){add3(x, mul3(normal, depth)), normal, w->newest.stiffness};
    n->together = false;
  } else if (!n->together) {
    w->own = w->newest;
    n->together = true;
  }
  n->changed = n->refused = false;
  n->last_weight = weight;
  d->held = force;
  return (struct answer3){force, depth, l->energy, what, cut};
}
