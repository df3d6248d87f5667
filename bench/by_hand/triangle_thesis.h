/* SPDX-License-Identifier: BSD-3-Clause */
/* Three degrees of freedom, a triangle with edges that the environment moves, normals that turn no
   faster than `rate`, a spring, the rule of the thesis: strict when leaving and on updates only. */

struct triangle_thesis {
  struct news news;
  struct triangle3 newest, own;
  real rate, stiffness; /* rad/s; what the spring knows, N/m */
  struct ledger ledger;
  struct loop loop;
  struct device3 device;
  bool beside; /* behind the surface, but outside its edges */
};

static inline void triangle_thesis_start(struct triangle_thesis* w, real stale_after, real fade,
                                         real rate, real damping, struct loop loop) {
  memset(w, 0, sizeof *w);
  start_news(&w->news, stale_after, fade);
  w->newest.thickness = w->own.thickness = real_max;
  w->rate = rate;
  w->ledger.damping = damping;
  w->loop = loop;
  w->device.sound = true;
}

static inline bool triangle_thesis_update(struct triangle_thesis* w, const struct triangle3* next) {
  const vec3 ab = sub3(next->b, next->a), ac = sub3(next->c, next->a);
  const vec3 across = cross3(ab, ac);
  const real twice_area = root(square3(across));
  const real longest = larger(larger(square3(ab), square3(ac)), square3(sub3(next->c, next->b)));
  const vec3 normal = div3(across, twice_area);
  if (!(twice_area > 16 * real_epsilon * longest) || !finite_number(twice_area) ||
      !finite3(normal) || !(next->thickness > 0) || !(next->stiffness > 0) ||
      !finite_number(next->stiffness)) {
    w->news.refused = true;
    return false;
  }
  w->newest = *next;
  w->newest.normal = normal;
  if (!w->news.published) w->own = w->newest;
  take_news(&w->news);
  return true;
}

__attribute__((cold, noinline)) static struct answer3 triangle_thesis_refuse(
    struct triangle_thesis* w, real dt, uint8_t what) {
  const real lost = time_lost(dt, w->loop.longest_tick);
  struct device3* d = &w->device;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, square3(d->held), held_for(&w->loop, lost));
  } else {
    what = rejected_parameters;
  }
  d->blind += lost;
  w->news.age += lost;
  d->held.x = d->held.y = d->held.z = 0;
  return no_force3(w->ledger.energy, what);
}

static inline real depth_in(const struct triangle3* t, vec3 x) {
  return dot3(sub3(t->a, x), t->normal);
}

/* On the inner side of all three edges, and not deeper than the triangle is thick. */
static inline bool inner(vec3 from, vec3 to, vec3 normal, vec3 x) {
  return dot3(cross3(sub3(to, from), sub3(x, from)), normal) >= 0;
}
static inline bool covers(const struct triangle3* t, vec3 x, real depth) {
  return depth <= t->thickness && inner(t->a, t->b, t->normal, x) &&
         inner(t->b, t->c, t->normal, x) && inner(t->c, t->a, t->normal, x);
}

/* A node on its way to the environment's, as far as the plane through p, then onto that plane. */
static inline vec3 follow_node(vec3 from, vec3 to, vec3 p, vec3 n) {
  const vec3 line = sub3(to, from);
  const real across = dot3(line, n);
  const real smallest = real_epsilon * root(square3(line));
  real t = 0;
  if (across > smallest || across < -smallest) {
    t = smaller(larger(dot3(sub3(p, from), n) / across, 0), 1);
  }
  const vec3 node = add3(from, mul3(line, t));
  return add3(node, mul3(n, dot3(sub3(p, node), n)));
}

/* x is to lie `depth` deep under the normal n. */
static inline void triangle_thesis_approach(struct triangle_thesis* w, bool from_own, vec3 x,
                                            vec3 n, real depth) {
  const struct triangle3* to = &w->newest;
  const struct triangle3* from = from_own ? &w->own : to;
  const vec3 p = add3(x, mul3(n, depth));
  const struct triangle3 moved = {follow_node(from->a, to->a, p, n),
                                  follow_node(from->b, to->b, p, n),
                                  follow_node(from->c, to->c, p, n),
                                  to->stiffness,
                                  to->thickness,
                                  n};
  w->own = moved;
  w->news.together = false;
}

/* The share that is left: when leaving, what the ledger covers; otherwise what the local model
   gives, if that is more. */
static inline real thesis_share(const struct ledger* l, vec3 desired, vec3 normal, vec3 travel,
                                real local_force, real T) {
  const real covered = affordable(l->energy, outflow(l, square3(desired), T));
  if (!(covered < 1) || dot3(travel, normal) > 0) return covered;
  const real asked = dot3(desired, normal);
  return asked > 0 ? larger(covered, smaller(local_force / asked, 1)) : covered;
}

__attribute__((flatten)) static inline struct answer3 triangle_thesis_tick(
    struct triangle_thesis* w, const vec3* at, real dt) {
  struct ledger* l = &w->ledger;
  struct device3* d = &w->device;
  struct news* n = &w->news;
  const real T = w->loop.longest_tick;
  const vec3 x = *at;
  vec3 travel = sub3(x, d->position);
  const real square = square3(travel);
  if (!d->sound ||
      !(d->seen ? near_enough(&w->loop, d->blind, square, dt) : positive(dt) && finite3(x))) {
    return triangle_thesis_refuse(w, dt, rejected_sample);
  }
  if (!within(&w->loop, square3(x))) return triangle_thesis_refuse(w, dt, outside_workspace);
  if (d->seen && !(d->blind > 0)) {
    const real work = dot3(d->held, travel), passed = passed3(d->held, travel);
    const bool booked =
        dt > w->loop.watchdog
            ? book_cut_short(l, square, work, passed, square3(d->held), dt, w->loop.watchdog)
            : book(l, square, work, passed, dt);
    if (!booked) return triangle_thesis_refuse(w, dt, rejected_sample);
  } else {
    travel = sub3(x, x);
    l->energy = written_off(l, square3(d->held), held_for(&w->loop, dt));
    d->seen = true;
    d->blind = 0;
  }
  d->position = x;
  uint8_t what = dt > T ? late_tick : l->energy < 0 ? debt : nominal;

  const real last_weight = n->last_weight;
  const real weight = presence(n, dt, &what);
  const real target_depth = depth_in(&w->newest, x);
  const bool behind = weight > 0 && target_depth > 0;
  const bool in_target = behind && covers(&w->newest, x, target_depth);
  const bool from_the_side = w->beside;
  w->beside = behind && !in_target;
  const real stiffness_before = w->stiffness;
  if (n->changed) w->stiffness = w->newest.stiffness;
  n->changed = n->refused = false;
  n->last_weight = weight;
  if (!in_target) { /* nothing is asked, nothing is given */
    if (!n->together) w->own = w->newest;
    n->together = true;
    d->held.x = d->held.y = d->held.z = 0;
    return no_force3(l->energy, what);
  }

  const vec3 goal = w->newest.normal;
  vec3 normal = goal;
  real local_depth = target_depth;
  bool in_local = !from_the_side;
  if (!n->together) {
    local_depth = depth_in(&w->own, x);
    in_local = local_depth > 0 && covers(&w->own, x, local_depth);
    if (in_local && last_weight > 0) normal = turned3(w->own.normal, goal, w->rate * dt);
  }
  in_local = in_local && last_weight > 0;
  real depth = target_depth;
  real asked = weight * (w->stiffness * depth);
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const vec3 desired = mul3(normal, asked);
  const real local_force = in_local ? last_weight * (stiffness_before * local_depth) : 0;
  const vec3 force = mul3(desired, thesis_share(l, desired, normal, travel, local_force, T));
  const bool cut = !same3(force, desired);
  if (cut) depth = w->stiffness > 0 ? dot3(force, normal) / w->stiffness : 0;
  if (cut || !same3(normal, goal)) {
    triangle_thesis_approach(w, in_local, x, normal, depth);
  } else if (!n->together) {
    w->own = w->newest;
    n->together = true;
  }
  if (cut) what = cut_short(what, depth > 0 || dot3(force, force) > 0, l->energy);
  d->held = force;
  return reply3(force, depth, l->energy, what, cut);
}
