/* SPDX-License-Identifier: BSD-3-Clause */
/* Two degrees of freedom, a plane that the environment moves, normals that turn no faster than
   `rate`, a spring: |f| <= sqrt(4 (b/T) E1), every tick. */

struct plane_strict {
  struct news news;
  struct plane2 newest, own;
  real rate; /* rad/s */
  struct ledger ledger;
  struct loop loop;
  struct device2 device;
};

static inline void plane_strict_start(struct plane_strict* w, real stale_after, real fade,
                                      real rate, real damping, struct loop loop) {
  memset(w, 0, sizeof *w);
  start_news(&w->news, stale_after, fade);
  w->rate = rate;
  w->ledger.damping = damping;
  w->loop = loop;
  w->device.sound = true;
}

static inline bool plane_strict_update(struct plane_strict* w, const struct plane2* next) {
  const real length = root(dot2(next->normal, next->normal));
  const vec2 normal = div2(next->normal, length);
  if (!(length > 0) || !finite_number(length) || !finite2(next->point) || !finite2(normal) ||
      !(next->stiffness > 0) || !finite_number(next->stiffness)) {
    w->news.refused = true;
    return false;
  }
  w->newest = *next;
  w->newest.normal = normal;
  if (!w->news.published) w->own = w->newest;
  take_news(&w->news);
  return true;
}

__attribute__((cold, noinline)) static struct answer2 plane_strict_refuse(struct plane_strict* w,
                                                                          real dt, uint8_t what) {
  const real lost = time_lost(dt, w->loop.longest_tick);
  struct device2* d = &w->device;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, dot2(d->held, d->held), held_for(&w->loop, lost));
  } else {
    what = rejected_parameters;
  }
  d->blind += lost;
  w->news.age += lost;
  d->held.x = d->held.y = 0;
  return no_force2(w->ledger.energy, what);
}

__attribute__((flatten)) static inline struct answer2 plane_strict_tick(struct plane_strict* w,
                                                                        const vec2* at, real dt) {
  struct ledger* l = &w->ledger;
  struct device2* d = &w->device;
  struct news* n = &w->news;
  const real T = w->loop.longest_tick;
  const vec2 x = *at;
  const vec2 travel = sub2(x, d->position);
  const real square = dot2(travel, travel);
  if (!d->sound ||
      !(d->seen ? near_enough(&w->loop, d->blind, square, dt) : positive(dt) && finite2(x))) {
    return plane_strict_refuse(w, dt, rejected_sample);
  }
  if (!within(&w->loop, dot2(x, x))) return plane_strict_refuse(w, dt, outside_workspace);
  if (d->seen && !(d->blind > 0)) {
    const real work = dot2(d->held, travel), passed = passed2(d->held, travel);
    const bool booked =
        dt > w->loop.watchdog
            ? book_cut_short(l, square, work, passed, dot2(d->held, d->held), dt, w->loop.watchdog)
            : book(l, square, work, passed, dt);
    if (!booked) return plane_strict_refuse(w, dt, rejected_sample);
  } else {
    l->energy = written_off(l, dot2(d->held, d->held), held_for(&w->loop, dt));
    d->seen = true;
    d->blind = 0;
  }
  d->position = x;
  uint8_t what = dt > T ? late_tick : l->energy < 0 ? debt : nominal;

  const real last_weight = n->last_weight;
  const real weight = presence(n, dt, &what);
  const vec2 goal = w->newest.normal;
  const real target_depth = dot2(sub2(w->newest.point, x), goal);
  n->changed = n->refused = false;
  n->last_weight = weight;
  if (!(weight > 0 && target_depth > 0)) { /* nothing is asked, nothing is given */
    if (!n->together) w->own = w->newest;
    n->together = true;
    d->held.x = d->held.y = 0;
    return no_force2(l->energy, what);
  }

  vec2 normal = goal;
  if (!n->together && last_weight > 0 && dot2(sub2(w->own.point, x), w->own.normal) > 0) {
    normal = turned2(w->own.normal, goal, w->rate * dt);
  }
  real depth = target_depth;
  real asked = weight * (w->newest.stiffness * depth);
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const vec2 desired = mul2(normal, asked);
  const vec2 force = mul2(desired, affordable(l->energy, outflow(l, dot2(desired, desired), T)));
  const bool cut = !same2(force, desired);
  if (cut) depth = w->newest.stiffness > 0 ? dot2(force, normal) / w->newest.stiffness : 0;
  if (cut || !same2(normal, goal)) {
    w->own.point = add2(x, mul2(normal, depth));
    w->own.normal = normal;
    w->own.stiffness = w->newest.stiffness;
    n->together = false;
  } else if (!n->together) {
    w->own = w->newest;
    n->together = true;
  }
  if (cut) what = cut_short(what, depth > 0 || dot2(force, force) > 0, l->energy);
  d->held = force;
  return reply2(force, depth, l->energy, what, cut);
}
