/* SPDX-License-Identifier: BSD-3-Clause */
/* One degree of freedom, a wall that the environment moves, a damped spring; only what the next
   tick can reach must be covered by the ledger. */

struct wall_reachable {
  struct news news;
  struct plane1 newest, own;
  struct damped_spring spring;
  struct ledger ledger;
  struct reach reach;
  struct loop loop;
  struct device1 device;
};

static inline void wall_reachable_start(struct wall_reachable* w, real stale_after, real fade,
                                        real damping, struct reach reach, struct loop loop) {
  memset(w, 0, sizeof *w);
  start_news(&w->news, stale_after, fade);
  start_spring(&w->spring, reach.mass, real_max);
  w->ledger.damping = damping;
  w->reach = reach;
  w->loop = loop;
  w->device.sound = true;
}

/* Takes a new wall; false: it is unusable and the last good one stays. */
static inline bool wall_reachable_update(struct wall_reachable* w, struct plane1 next) {
  const real length = magnitude(next.normal);
  if (!(length > 0) || !finite_number(length) || !finite_number(next.point) ||
      !(next.stiffness > 0) || !finite_number(next.stiffness)) {
    w->news.refused = true;
    return false;
  }
  next.normal /= length;
  w->newest = next;
  if (!w->news.published) w->own = next;
  take_news(&w->news);
  return true;
}

__attribute__((cold, noinline)) static struct answer1 wall_reachable_refuse(
    struct wall_reachable* w, real dt, uint8_t what) {
  const real lost = time_lost(dt, w->loop.longest_tick);
  struct device1* d = &w->device;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, d->held * d->held, held_for(&w->loop, lost));
  } else {
    what = rejected_parameters;
  }
  d->blind += lost;
  w->news.age += lost;
  d->held = 0;
  return reply1(0, 0, w->ledger.energy, what, false);
}

/* The force that the ledger covers of the one desired. */
static inline real wall_reachable_limited(const struct wall_reachable* w, real desired, real travel,
                                          bool known, real dt) {
  const real T = w->loop.longest_tick;
  const struct ledger* l = &w->ledger;
  if (outflow(l, desired * desired, T) <= spendable(l->energy)) return desired;
  const real asked = magnitude(desired);
  if (!(asked > 0)) return desired;
  const real most = reachable_force(&w->reach, l, travel * desired / asked, magnitude(travel),
                                    magnitude(w->device.held), asked, known, dt, T);
  return most < asked ? desired * (most / asked) : desired;
}

__attribute__((flatten)) static inline struct answer1 wall_reachable_tick(struct wall_reachable* w,
                                                                          real x, real dt) {
  struct ledger* l = &w->ledger;
  struct device1* d = &w->device;
  struct news* n = &w->news;
  const real T = w->loop.longest_tick;
  real travel = x - d->position;
  const real square = travel * travel;
  if (!d->sound ||
      !(d->seen ? near_enough(&w->loop, d->blind, square, dt) : positive(dt) && finite_number(x))) {
    return wall_reachable_refuse(w, dt, rejected_sample);
  }
  if (!within(&w->loop, x * x)) return wall_reachable_refuse(w, dt, outside_workspace);
  const bool known = d->seen && !(d->blind > 0);
  if (known) {
    const real work = d->held * travel;
    const bool booked = dt > w->loop.watchdog
                            ? book_cut_short(l, square, work, magnitude(work), d->held * d->held,
                                             dt, w->loop.watchdog)
                            : book(l, square, work, magnitude(work), dt);
    if (!booked) return wall_reachable_refuse(w, dt, rejected_sample);
  } else {
    travel = 0;
    l->energy = written_off(l, d->held * d->held, held_for(&w->loop, dt));
    d->seen = true;
    d->blind = 0;
  }
  d->position = x;
  uint8_t what = dt > T ? late_tick : l->energy < 0 ? debt : nominal;

  const real weight = presence(n, dt, &what);
  const real normal = w->newest.normal;
  const real target_depth = (w->newest.point - x) * normal;
  if (n->changed) adopt_stiffness(&w->spring, w->newest.stiffness, T);
  n->changed = n->refused = false;
  n->last_weight = weight;
  if (!(weight > 0 && target_depth > 0)) { /* nothing is asked, nothing is given */
    if (!n->together) w->own = w->newest;
    n->together = true;
    d->held = 0;
    return reply1(0, 0, l->energy, what, false);
  }

  const real speed = travel * normal / dt;
  real depth = target_depth;
  real asked = weight * damped_force(&w->spring, depth, speed);
  if (!finite_number(2 * asked) || !finite_number(depth)) {
    depth = asked = 0;
    what = worse(what, rejected_target);
  }
  const real desired = normal * asked;
  const real force = wall_reachable_limited(w, desired, travel, known, dt);
  const bool cut = !(force == desired);
  if (cut) {
    depth = damped_depth(&w->spring, force * normal, speed);
    w->own.point = x + normal * depth;
    w->own.normal = normal;
    w->own.stiffness = w->newest.stiffness;
    n->together = false;
  } else if (!n->together) {
    w->own = w->newest;
    n->together = true;
  }
  keep_longest(&w->reach, cut, dt, T);
  if (cut) what = cut_short(what, depth > 0 || force != 0, l->energy);
  d->held = force;
  return reply1(force, depth, l->energy, what, cut);
}
