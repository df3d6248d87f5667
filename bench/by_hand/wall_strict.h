/* SPDX-License-Identifier: BSD-3-Clause */
/* One degree of freedom, a wall that never moves: |f| <= sqrt(4 (b/T) E1), every tick. */

struct wall_strict {
  struct plane1 wall; /* its normal is 1 or -1 */
  struct ledger ledger;
  struct loop loop;
  struct device1 device;
};

static inline void wall_strict_start(struct wall_strict* w, struct plane1 wall, real damping,
                                     struct loop loop) {
  memset(w, 0, sizeof *w);
  w->wall = wall;
  w->ledger.damping = damping;
  w->loop = loop;
  w->device.sound = true;
}

/* A sample that cannot be: no force, and the motion since the last good one is written off. */
__attribute__((cold, noinline)) static struct answer1 wall_strict_refuse(struct wall_strict* w,
                                                                         real dt, uint8_t what) {
  const real lost = time_lost(dt, w->loop.longest_tick);
  struct device1* d = &w->device;
  if (d->sound) {
    w->ledger.energy = written_off(&w->ledger, d->held * d->held, held_for(&w->loop, lost));
  } else {
    what = rejected_parameters;
  }
  d->blind += lost;
  d->held = 0;
  return reply1(0, 0, w->ledger.energy, what, false);
}

__attribute__((flatten)) static inline struct answer1 wall_strict_tick(struct wall_strict* w,
                                                                       real x, real dt) {
  struct ledger* l = &w->ledger;
  struct device1* d = &w->device;
  const real T = w->loop.longest_tick;
  const real travel = x - d->position;
  const real square = travel * travel;
  if (!d->sound ||
      !(d->seen ? near_enough(&w->loop, d->blind, square, dt) : positive(dt) && finite_number(x))) {
    return wall_strict_refuse(w, dt, rejected_sample);
  }
  if (!within(&w->loop, x * x)) return wall_strict_refuse(w, dt, outside_workspace);
  if (d->seen && !(d->blind > 0)) {
    const real work = d->held * travel;
    const bool booked = dt > w->loop.watchdog
                            ? book_cut_short(l, square, work, magnitude(work), d->held * d->held,
                                             dt, w->loop.watchdog)
                            : book(l, square, work, magnitude(work), dt);
    if (!booked) return wall_strict_refuse(w, dt, rejected_sample);
  } else {
    l->energy = written_off(l, d->held * d->held, held_for(&w->loop, dt));
    d->seen = true;
    d->blind = 0;
  }
  d->position = x;
  uint8_t what = dt > T ? late_tick : l->energy < 0 ? debt : nominal;

  const real depth = (w->wall.point - x) * w->wall.normal;
  if (!(depth > 0)) { /* nothing is asked, nothing is given */
    d->held = 0;
    return reply1(0, 0, l->energy, what, false);
  }
  const real asked = w->wall.stiffness * depth;
  if (!finite_number(2 * asked)) {
    d->held = w->wall.normal * 0;
    return reply1(d->held, 0, l->energy, worse(what, rejected_target), false);
  }
  const real desired = w->wall.normal * asked;
  const real force = desired * affordable(l->energy, outflow(l, desired * desired, T));
  d->held = force;
  return reply1(force, depth, l->energy, what, force != desired);
}
