/* SPDX-License-Identifier: BSD-3-Clause */
/* wall_strict where every sample is trusted: what is no number is refused, nothing else is asked. */

struct wall_trusted {
  struct plane1 wall; /* its normal is 1 or -1 */
  struct ledger ledger;
  real longest_tick, held, position;
  bool seen, sound;
};

static inline void wall_trusted_start(struct wall_trusted* w, struct plane1 wall, real damping,
                                      real longest_tick) {
  memset(w, 0, sizeof *w);
  w->wall = wall;
  w->ledger.damping = damping;
  w->longest_tick = longest_tick;
  w->sound = true;
}

__attribute__((cold, noinline)) static struct answer1 wall_trusted_refuse(struct wall_trusted* w) {
  w->held = 0;
  return reply1(0, 0, w->ledger.energy, w->sound ? rejected_sample : rejected_parameters, false);
}

__attribute__((flatten)) static inline struct answer1 wall_trusted_tick(struct wall_trusted* w,
                                                                        real x, real dt) {
  struct ledger* l = &w->ledger;
  if (!w->sound) return wall_trusted_refuse(w);
  if (w->seen) {
    const real travel = x - w->position;
    const real work = w->held * travel;
    if (!book(l, travel * travel, work, magnitude(work), dt)) return wall_trusted_refuse(w);
  }
  w->seen = true;
  w->position = x;
  uint8_t what = l->energy < 0 ? debt : nominal;

  const real depth = (w->wall.point - x) * w->wall.normal;
  if (!(depth > 0)) { /* nothing is asked, nothing is given */
    w->held = 0;
    return reply1(0, 0, l->energy, what, false);
  }
  const real asked = w->wall.stiffness * depth;
  if (!finite_number(2 * asked)) {
    w->held = w->wall.normal * 0;
    return reply1(w->held, 0, l->energy, worse(what, rejected_target), false);
  }
  const real desired = w->wall.normal * asked;
  const real force =
      desired * affordable(l->energy, outflow(l, desired * desired, w->longest_tick));
  w->held = force;
  return reply1(force, depth, l->energy, what, force != desired);
}
