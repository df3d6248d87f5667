/* SPDX-License-Identifier: BSD-3-Clause */
/* Three degrees of freedom, a triangle with edges that the environment moves, normals that turn no
   faster than `rate`, a spring, the rule of the thesis: strict when leaving and on updates only. */
#include "vectors.h"

void by_hand_triangle_thesis_start(struct triangle_thesis* w, struct freshness rule, real rate,
                                   real damping, struct loop loop) {
  *w = (struct triangle_thesis){
      .news = {.rule = rule, .together = true},
      .newest = {.thickness = REAL_MAX},
      .own = {.thickness = REAL_MAX},
      .rate = rate,
      .ledger = {.damping = damping, .cap = REAL_MAX, .reset_after = REAL_MAX},
      .loop = loop,
      .device = {.sound = true}};
}

static real square3(vec3 v) {
  return dot3(v, v);
}

bool by_hand_triangle_thesis_retarget(struct triangle_thesis* w, const struct triangle3* next) {
  struct news* n = &w->news;
  const vec3 ab = sub3(next->b, next->a), ac = sub3(next->c, next->a);
  const vec3 across = cross3(ab, ac);
  const real twice_area = root(square3(across));
  const real longest = larger(larger(square3(ab), square3(ac)), square3(sub3(next->c, next->b)));
  const vec3 normal = div3(across, twice_area);
  if (!(twice_area > 16 * REAL_EPSILON * longest) || !finite_number(twice_area) ||
      !finite3(normal) || !(next->thickness > 0) || !(next->stiffness > 0) ||
      !finite_number(next->stiffness)) {
    n->refused = true;
    return false;
  }
  w->newest = *next;
  w->newest.normal = normal;
  if (!n->published) w->own = w->newest;
  n->together = !n->published;
  n->published = n->changed = true;
  n->age = 0;
  return true;
}

static struct answer3 refuse(struct triangle_thesis* w, real dt) {
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

static real depth_in(const struct triangle3* t, vec3 x) {
  return dot3(sub3(t->a, x), t->normal);
}

/* On the inner side of all three edges, and not deeper than the triangle is thick. */
static bool inner(vec3 from, vec3 to, vec3 normal, vec3 x) {
  return dot3(cross3(sub3(to, from), sub3(x, from)), normal) >= 0;
}
static bool covers(const struct triangle3* t, vec3 x, real depth) {
  return inner(t->a, t->b, t->normal, x) && inner(t->b, t->c, t->normal, x) &&
         inner(t->c, t->a, t->normal, x) && depth <= t->thickness;
}

/* A node on its way to the environment's, as far as the plane through p, then onto that plane. */
static vec3 follow(vec3 from, vec3 to, vec3 p, vec3 n) {
  const vec3 line = sub3(to, from);
  const real across = dot3(line, n);
  const real smallest = REAL_EPSILON * root(square3(line));
  real t = 0;
  if (across > smallest || across < -smallest) {
    t = smaller(larger(dot3(sub3(p, from), n) / across, 0), 1);
  }
  const vec3 node = add3(from, mul3(line, t));
  return add3(node, mul3(n, dot3(sub3(p, node), n)));
}

/* x is to lie `depth` deep under the normal n. */
static void approach(struct triangle_thesis* w, bool from_own, vec3 x, vec3 n, real depth) {
  const struct triangle3* to = &w->newest;
  const struct triangle3* from = from_own ? &w->own : to;
  const vec3 p = add3(x, mul3(n, depth));
  w->own = (struct triangle3){follow(from->a, to->a, p, n),
                              follow(from->b, to->b, p, n),
                              follow(from->c, to->c, p, n),
                              to->stiffness,
                              to->thickness,
                              n};
  w->news.together = false;
}

/* Leaving: what the ledger covers. Otherwise what the local model gives, if that is more. */
static vec3 limited(const struct ledger* l, vec3 desired, vec3 normal, vec3 travel,
                    real local_force, real T) {
  real scale = affordable(l->energy, outflow(l, square3(desired), T));
  if (scale < 1 && !(dot3(travel, normal) > 0)) {
    const real asked = dot3(desired, normal);
    if (asked > 0) scale = larger(scale, smaller(local_force / asked, 1));
  }
  return mul3(desired, scale);
}

struct answer3 by_hand_triangle_thesis_tick(struct triangle_thesis* w, const vec3* at, real dt) {
  struct ledger* l = &w->ledger;
  struct device3* d = &w->device;
  struct news* n = &w->news;
  const real T = w->loop.longest_tick;
  const vec3 x = *at;
  vec3 travel = sub3(x, d->position);
  const real square = square3(travel);
  const real farthest = w->loop.top_speed * (d->blind + dt);
  if (!d->sound || !(dt > 0) ||
      !(d->seen ? square + dt <= REAL_MAX && square <= farthest * farthest
                : dt <= REAL_MAX && finite3(x))) {
    return refuse(w, dt);
  }
  if (d->seen && !(d->blind > 0)) {
    const real work = dot3(d->held, travel), passed = passed3(d->held, travel);
    if (!book(l, square, work, passed, square3(d->held), dt, T)) return refuse(w, dt);
  } else {
    travel = (vec3){0};
    l->energy = written_off(l, square3(d->held), T);
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

  const real target_depth = depth_in(&w->newest, x);
  const bool behind = weight > 0 && target_depth > 0;
  const bool in_target = behind && covers(&w->newest, x, target_depth);
  real local_depth = target_depth;
  bool in_local = in_target && !w->beside;
  if (!n->together) {
    local_depth = depth_in(&w->own, x);
    in_local = local_depth > 0 && covers(&w->own, x, local_depth);
  }
  if (!(n->last_weight > 0)) in_local = false;
  w->beside = behind && !in_target;

  const real stiffness_before = w->stiffness;
  if (n->changed) w->stiffness = w->newest.stiffness;
  if (!in_target) { /* nothing is asked, nothing is given */
    if (!n->together) w->own = w->newest;
    n->together = true;
    n->changed = n->refused = false;
    n->last_weight = weight;
    d->held = (vec3){0};
    return (struct answer3){{0}, 0, l->energy, what, false};
  }

  const vec3 goal = w->newest.normal;
  vec3 normal = goal;
  if (in_local && !n->together) normal = turned3(w->own.normal, goal, w->rate * dt);
  real depth = target_depth;
  real asked = weight * (w->stiffness * depth);
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const vec3 desired = mul3(normal, asked);
  const real local_force =
      in_local && local_depth > 0 ? n->last_weight * (stiffness_before * local_depth) : 0;
  vec3 force = limited(l, desired, normal, travel, local_force, T);
  const bool cut = !same3(force, desired);
  if (cut && !finite3(force)) {
    force = (vec3){0};
    what = worse(what, rejected_sample);
  }
  if (cut) depth = w->stiffness > 0 ? dot3(force, normal) / w->stiffness : 0;
  if (cut || !same3(normal, goal)) {
    approach(w, in_local, x, normal, depth);
  } else if (!n->together) {
    w->own = w->newest;
    n->together = true;
  }
  n->changed = n->refused = false;
  n->last_weight = weight;
  d->held = force;
  return (struct answer3){force, depth, l->energy, what, cut};
}
