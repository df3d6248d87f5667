/* SPDX-License-Identifier: BSD-3-Clause */
/* Three degrees of freedom, a plane that the environment moves, normals that turn no faster than
   `rate`, a damped spring; only what the next tick can reach must be covered by the ledger. */

struct plane_reachable {
  struct news news;
  struct plane3 newest, own;
  real rate; /* rad/s */
  struct damped_spring spring;
  struct ledger ledger;
  struct reach reach;
  struct loop loop;
  struct device3 device;
};

static inline void plane_reachable_start(struct plane_reachable* w, real stale_after, real fade,
                                         real rate, real damping, struct reach reach,
                                         struct loop loop) {
  memset(w, 0, sizeof *w);
  start_news(&w->news, stale_after, fade);
  start_spring(&w->spring, reach.mass, real_max);
  w->rate = rate;
  w->ledger.damping = damping;
  w->reach = reach;
  w->loop = loop;
  w->device.sound = true;
}

static inline bool plane_reachable_update(struct plane_reachable* w, const struct plane3* next) {
  if (!usable3(next)) {
    w->news.refused = true;
    return false;
  }
  w->newest = *next;
  w->newest.normal = div3(next->normal, root(square3(next->normal)));
  if (!w->news.published) w->own = w->newest;
  take_news(&w->news);
  return true;
}

__attribute__((cold, noinline)) static struct answer3 plane_reachable_refuse(
    struct plane_reachable* w, real dt, uint8_t what) {
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

__attribute__((flatten)) static inline struct answer3 plane_reachable_tick(
    struct plane_reachable* w, const vec3* at, real dt) {
  struct ledger* l = &w->ledger;
  struct device3* d = &w->device;
  struct news* n = &w->news;
  const real T = w->loop.longest_tick;
  const vec3 x = *at;
  vec3 travel = sub3(x, d->position);
  const real square = square3(travel);
  if (!d->sound ||
      !(d->seen ? near_enough(&w->loop, d->blind, square, dt) : positive(dt) && finite3(x))) {
    return plane_reachable_refuse(w, dt, rejected_sample);
  }
  if (!within(&w->loop, square3(x))) return plane_reachable_refuse(w, dt, outside_workspace);
  const bool known = d->seen && !(d->blind > 0);
  if (known) {
    const real work = dot3(d->held, travel), passed = passed3(d->held, travel);
    const bool booked =
        dt > w->loop.watchdog
            ? book_cut_short(l, square, work, passed, square3(d->held), dt, w->loop.watchdog)
            : book(l, square, work, passed, dt);
    if (!booked) return plane_reachable_refuse(w, dt, rejected_sample);
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
  const vec3 goal = w->newest.normal;
  const real target_depth = dot3(sub3(w->newest.point, x), goal);
  if (n->changed) adopt_stiffness(&w->spring, w->newest.stiffness, T);
  n->changed = n->refused = false;
  n->last_weight = weight;
  if (!(weight > 0 && target_depth > 0)) { /* nothing is asked, nothing is given */
    if (!n->together) w->own = w->newest;
    n->together = true;
    d->held.x = d->held.y = d->held.z = 0;
    return no_force3(l->energy, what);
  }

  vec3 normal = goal;
  if (!n->together && last_weight > 0 && dot3(sub3(w->own.point, x), w->own.normal) > 0) {
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
  const real share = reachable_share3(&w->reach, l, desired, travel, d, known, dt, T);
  const vec3 force = share < 1 ? mul3(desired, share) : desired;
  const bool cut = share < 1 && !same3(force, desired);
  if (cut) depth = damped_depth(&w->spring, dot3(force, normal), speed);
  if (cut || !same3(normal, goal)) {
    w->own.point = add3(x, mul3(normal, depth));
    w->own.normal = normal;
    w->own.stiffness = w->newest.stiffness;
    n->together = false;
  } else if (!n->together) {
    w->own = w->newest;
    n->together = true;
  }
  keep_longest(&w->reach, cut, dt, T);
  if (cut) what = cut_short(what, depth > 0 || dot3(force, force) > 0, l->energy);
  d->held = force;
  return reply3(force, depth, l->energy, what, cut);
}
