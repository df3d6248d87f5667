/* SPDX-License-Identifier: BSD-3-Clause */
/* Two degrees of freedom, a plane that the environment moves, normals that turn no faster than
   `rate`, a spring: |f| <= sqrt(4 (b/T) E1), every tick. */
#include "vectors.h"

void by_hand_plane_strict_start(struct plane_strict* w, struct freshness rule, real rate,
                                real damping, struct loop loop) {
  *w = (struct plane_strict){
      .news = {.rule = rule, .together = true},
      .rate = rate,
      .ledger = {.damping = damping, .cap = REAL_MAX, .reset_after = REAL_MAX},
      .loop = loop,
      .device = {.sound = true}};
}

bool by_hand_plane_strict_retarget(struct plane_strict* w, const struct plane2* next) {
  struct news* n = &w->news;
  const real length = root(dot2(next->normal, next->normal));
  const vec2 normal = div2(next->normal, length);
  if (!(length > 0) || !finite_number(length) || !finite2(next->point) || !finite2(normal) ||
      !(next->stiffness > 0) || !finite_number(next->stiffness)) {
    n->refused = true;
    return false;
  }
  w->newest = (struct plane2){next->point, normal, next->stiffness};
  if (!n->published) w->own = w->newest;
  n->together = !n->published;
  n->published = n->changed = true;
  n->age = 0;
  return true;
}

static struct answer2 refuse(struct plane_strict* w, real dt) {
  const real T = w->loop.longest_tick;
  struct device2* d = &w->device;
  const real passed = dt > 0 && dt <= REAL_MAX ? dt : T;
  uint8_t what = rejected_parameters;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, dot2(d->held, d->held), T);
    what = rejected_sample;
  }
  d->blind += passed;
  w->news.age += passed;
  d->held = (vec2){0};
  return (struct answer2){{0}, 0, w->ledger.energy, what, false};
}

struct answer2 by_hand_plane_strict_tick(struct plane_strict* w, const vec2* at, real dt) {
  struct ledger* l = &w->ledger;
  struct device2* d = &w->device;
  struct news* n = &w->news;
  const real T = w->loop.longest_tick;
  const vec2 x = *at;
  vec2 travel = sub2(x, d->position);
  const real square = dot2(travel, travel);
  const real farthest = w->loop.top_speed * (d->blind + dt);
  if (!d->sound || !(dt > 0) ||
      !(d->seen ? square + dt <= REAL_MAX && square <= farthest * farthest
                : dt <= REAL_MAX && finite2(x))) {
    return refuse(w, dt);
  }
  const bool known = d->seen && !(d->blind > 0);
  const real held_squared = dot2(d->held, d->held);
  if (known) {
    const real work = dot2(d->held, travel), passed = passed2(d->held, travel);
    if (!book(l, square, work, passed, held_squared, dt, T)) return refuse(w, dt);
  } else {
    travel = (vec2){0};
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

  const vec2 goal = w->newest.normal;
  const real target_depth = dot2(sub2(w->newest.point, x), goal);
  const bool in_target = weight > 0 && target_depth > 0;
  if (!in_target) { /* nothing is asked, nothing is given */
    if (!n->together) w->own = w->newest;
    n->together = true;
    n->changed = n->refused = false;
    n->last_weight = weight;
    d->held = (vec2){0};
    return (struct answer2){{0}, 0, l->energy, what, false};
  }

  vec2 normal = goal;
  if (!n->together && n->last_weight > 0 && dot2(sub2(w->own.point, x), w->own.normal) > 0) {
    normal = turned2(w->own.normal, goal, w->rate * dt);
  }
  real depth = target_depth;
  real asked = weight * (w->newest.stiffness * depth);
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const vec2 desired = mul2(normal, asked);
  vec2 force = mul2(desired, affordable(l->energy, outflow(l, dot2(desired, desired), T)));
  const bool cut = !same2(force, desired);
  if (cut && !finite2(force)) {
    force = (vec2){0};
    what = worse(what, rejected_sample);
  }
  if (cut) {
    depth = w->newest.stiffness > 0 ? dot2(force, normal) / w->newest.stiffness : 0;
  }
  if (cut || !same2(normal, goal)) {
    w->own = (struct plane2){add2(x, mul2(normal, depth)), normal, w->newest.stiffness};
    n->together = false;
  } else if (!n->together) {
    w->own = w->newest;
    n->together = true;
  }
  n->changed = n->refused = false;
  n->last_weight = weight;
  d->held = force;
  return (struct answer2){force, depth, l->energy, what, cut};
}
