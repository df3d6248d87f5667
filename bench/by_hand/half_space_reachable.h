/* SPDX-License-Identifier: BSD-3-Clause */
/* Three degrees of freedom, a half-space that never moves, a damped spring; only what the next tick
   can reach must be covered by the ledger. */

struct half_space_reachable {
  struct plane3 plane; /* its normal has length 1 */
  struct damped_spring spring;
  struct ledger ledger;
  struct reach reach;
  struct loop loop;
  struct device3 device;
};

static inline void half_space_reachable_start(struct half_space_reachable* w,
                                              const struct plane3* plane, real contact_mass,
                                              real force_limit, real damping, struct reach reach,
                                              struct loop loop) {
  memset(w, 0, sizeof *w);
  w->plane = *plane;
  w->plane.normal = div3(plane->normal, root(square3(plane->normal)));
  start_spring(&w->spring, contact_mass, force_limit);
  adopt_stiffness(&w->spring, plane->stiffness, loop.longest_tick);
  w->ledger.damping = damping;
  w->reach = reach;
  w->loop = loop;
  w->device.sound = true;
}

__attribute__((cold, noinline)) static struct answer3 half_space_reachable_refuse(
    struct half_space_reachable* w, real dt, uint8_t what) {
  const real lost = time_lost(dt, w->loop.longest_tick);
  struct device3* d = &w->device;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, square3(d->held), held_for(&w->loop, lost));
  } else {
    what = rejected_parameters;
  }
  d->blind += lost;
  d->held.x = d->held.y = d->held.z = 0;
  return no_force3(w->ledger.energy, what);
}

__attribute__((flatten)) static inline struct answer3 half_space_reachable_tick(
    struct half_space_reachable* w, const vec3* at, real dt) {
  struct ledger* l = &w->ledger;
  struct device3* d = &w->device;
  const real T = w->loop.longest_tick;
  const vec3 x = *at;
  vec3 travel = sub3(x, d->position);
  const real square = square3(travel);
  if (!d->sound ||
      !(d->seen ? near_enough(&w->loop, d->blind, square, dt) : positive(dt) && finite3(x))) {
    return half_space_reachable_refuse(w, dt, rejected_sample);
  }
  if (!within(&w->loop, square3(x))) return half_space_reachable_refuse(w, dt, outside_workspace);
  const bool known = d->seen && !(d->blind > 0);
  if (known) {
    const real work = dot3(d->held, travel), passed = passed3(d->held, travel);
    const bool booked =
        dt > w->loop.watchdog
            ? book_cut_short(l, square, work, passed, square3(d->held), dt, w->loop.watchdog)
            : book(l, square, work, passed, dt);
    if (!booked) return half_space_reachable_refuse(w, dt, rejected_sample);
  } else {
    travel = sub3(x, x);
    l->energy = written_off(l, square3(d->held), held_for(&w->loop, dt));
    d->seen = true;
    d->blind = 0;
  }
  d->position = x;
  uint8_t what = dt > T ? late_tick : l->energy < 0 ? debt : nominal;

  const vec3 normal = w->plane.normal;
  real depth = dot3(sub3(w->plane.point, x), normal);
  if (!(depth > 0)) { /* nothing is asked, nothing is given */
    d->held.x = d->held.y = d->held.z = 0;
    return no_force3(l->energy, what);
  }
  real asked = damped_force(&w->spring, depth, dot3(travel, normal) / dt);
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const vec3 desired = mul3(normal, asked);
  const real share = reachable_share3(&w->reach, l, desired, travel, d, known, dt, T);
  if (!(share < 1)) {
    w->reach.recent = 0;
    d->held = desired;
    return reply3(desired, depth, l->energy, what, false);
  }
  const vec3 force = mul3(desired, share);
  const bool cut = !same3(force, desired);
  keep_longest(&w->reach, cut, dt, T);
  d->held = force;
  return reply3(force, depth, l->energy, what, cut);
}
