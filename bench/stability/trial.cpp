// SPDX-License-Identifier: BSD-3-Clause
#include "trial.hpp"

#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <cmath>

namespace stability {

namespace {

namespace sim = passive_haptics::simulation;
using controllers::controller;

// Of devices for controllers that credit it [N]; a float, too, or the device had less than they know.
constexpr double dry_friction = 0.3125;

/// How far apart numbers are at x, in Scalar.
template <class Scalar>
double spacing(double x) {
  return std::abs(x) * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
}

/// True energy, and what rounding can explain, tick by tick.
///
/// Arithmetic: every sum and product of a tick is off by at most u = ε/2 of what goes into it, and
/// no tick has more than sixteen in a row: 16 u (b‖Δx‖²/dt + ‖f‖‖Δx‖ + |E1|).
/// Where dry friction is booked too, it rounds as the rest does, and so does its sum with the truth.
/// Positions off by e ≤ q/2 an axis: Σ f·(e(k+1) − e(k)), summed by parts, and the square of a Δx
/// off by q (docs/design/mathematics.md § 3); and a reach that is off by q. The device may fly far
/// from where it began, and q grows with the distance.
template <class Space>
class accounts {
 public:
  using physical = sim::physical<Space>;
  using state = typename physical::vector;
  using scalar = typename Space::scalar;

  accounts(const world& w, double quantum, const state& start)
      : last_(start), b_(w.damping), q_(quantum) {}

  /// A tick of length dt [s]: the device has come to `at`, and `out` is answered.
  void book(const sim::port_energy_meter& meter, const state& at, double dt,
            const ph::tick_result<Space>& out) {
    const state next = sim::to_physical<Space>(out.force);
    if (q_ > 0.0) q_ = std::fmax(q_, spacing<scalar>(physical::norm(at)));
    const double way = physical::norm(state(at - last_));
    const double force = physical::norm(next), before = physical::norm(held_);
    const double damped = b_ * way * way / dt;
    const double rubbed = meter.friction();  // zero where there is none
    const double ledger = std::abs(static_cast<double>(out.energy));
    const double u = static_cast<double>(std::numeric_limits<scalar>::epsilon()) / 2.0;
    result.slack += 16.0 * u * (damped + (force + before) * way + ledger + rubbed - rubbed_);

    double change = 0.0;
    for (int i = 0; i < Space::dof; ++i) {
      change += std::abs(sim::component(next, i) - sim::component(held_, i));
    }
    summed_ += q_ / 2.0 * change + b_ / dt * Space::dof * (2.0 * way * q_ + q_ * q_);
    result.largest_force = std::fmax(result.largest_force, force);
    result.blurred = summed_ + 2.0 * Space::dof * q_ * result.largest_force;

    result.exchanged += before * way + damped;
    result.events |= 1U << static_cast<unsigned>(out.what);
    result.finite =
        result.finite && ph::kernels::is_finite(out.depth) && ph::kernels::is_finite(out.energy);
    const double energy = rubbed > 0.0 ? meter.value() + rubbed : meter.minimum();
    if (!(energy >= result.least_energy)) result.least_energy = energy;
    const double truth = rubbed * 4.0 * std::numeric_limits<double>::epsilon();
    const double explained = energy + result.slack + result.blurred + truth;
    if (!(explained >= result.margin)) result.margin = explained;
    last_ = at;
    held_ = next;
    rubbed_ = rubbed;
  }

  outcome result;

 private:
  state last_, held_ = physical::zero();
  double b_, q_;
  double summed_ = 0.0, rubbed_ = 0.0;
};

/// The scene far from the origin: the model sees offset + local, rounded to its scalar; the physics
/// stays local and exact.
template <class Space>
struct frame {
  double offset;
  typename Space::vector seen(const typename sim::physical<Space>::vector& local) const {
    auto there = local;
    for (int i = 0; i < Space::dof; ++i) sim::component(there, i) += offset;
    return sim::to_port<Space>(there);
  }
  /// The local point that is shown exactly, at the origin; elsewhere the point itself.
  auto shown_exactly(const typename sim::physical<Space>::vector& local) const {
    return offset == 0.0 ? sim::to_physical<Space>(seen(local)) : local;
  }
};

/// The length of a tick, by the clock of the cell [s].
double next_period(const world& w, int tick, sim::random_source& random) {
  if (w.clock == clockwork::switching && tick / 50 % 2 != 0) return w.tick / 100.0;
  const bool misses = w.clock == clockwork::missed || w.clock == clockwork::missed_and_held;
  return sim::erratic_clock{w.tick, w.clock == clockwork::jitter, misses}.next(random);
}

template <class Space>
sim::device_parameters<Space> device_of(const controller& c, const world& w) {
  sim::device_parameters<Space> p;
  p.mass = w.mass;
  p.damping = w.damping;
  p.friction = c.credits_friction ? dry_friction : 0.0;
  p.period = w.tick;
  p.latency = c.latency;
  if (w.clock != clockwork::missed_and_held) p.watchdog = w.tick;
  return p;
}

/// One run; move(surface, command, period, random) is the hand.
template <class Space, class Device, class Move>
outcome play(controllers::model<Space> model, Device& device, const world& w, double quantum,
             std::uint64_t seed, int ticks, bool updates, Move move) {
  const frame<Space> here{w.offset};
  sim::random_source random(seed);
  sim::surface_state<Space> surface{sim::physical<Space>::zero(), random.direction<Space>(),
                                    w.stiffness};
  const auto publish = [&] {
    model.update({here.seen(surface.point), sim::to_port<Space>(surface.normal),
                  static_cast<typename Space::scalar>(surface.stiffness)});
  };
  publish();
  sim::erratic_sensor sensor{w.clock == clockwork::lost_samples};
  accounts<Space> books(w, quantum, device.position());
  double dt = 0.0;
  const auto show = [&](auto& now) {
    if (updates && now.tick % 25 == 24) {
      if (random.chance(0.5)) surface.normal = random.direction<Space>();
      surface.point = surface.normal * random.uniform(-w.size, w.size);
      surface.stiffness = random.chance(0.5) ? w.stiffness : w.stiffness / 10.0;
      publish();
    }
    dt = static_cast<double>(now.sample.dt);
    now.sample.position = here.seen(now.position);
    if (sensor.loses_one(random)) now.sample = {};
  };
  const auto act = [&](const auto& now) {
    books.book(device.meter(), now.position, dt, now.out);
    const double period = next_period(w, now.tick, random);
    device.set_period(period);
    move(surface, now.force, period, random);
  };
  const auto seen = sim::run(device, model, ticks, show, act);
  if (seen.ticks < ticks) books.result.finite = false;  // the last force was no number
  return books.result;
}

/// Velocity sources: nyquist, greedy, a walk; each step shown exactly at the origin.
template <class Space>
outcome attack_by_motion(const controllers::model<Space>& model, const controller& c,
                         const world& w, double quantum, std::uint64_t seed, int ticks) {
  using state = typename sim::physical<Space>::vector;
  const frame<Space> here{w.offset};
  sim::prescribed_motion<Space> device(device_of<Space>(c, w));
  sim::nyquist_motion<Space> nyquist;
  const auto move = [&](const sim::surface_state<Space>& surface,
                        const typename Space::vector& command, double period,
                        sim::random_source& random) {
    const state x = device.position();
    const double farthest = std::fmin(w.size, 20.0 * period);  // slower than a sensor fault
    const double speed = farthest / period;
    const state force = sim::to_physical<Space>(device.upcoming(command));
    const sim::adversary_view<Space> view{x,     surface.normal, surface.depth(x),
                                          force, period,         w.damping};
    nyquist.amplitude = farthest;
    const sim::greedy_motion<Space> greedy{.speed = speed};
    const sim::random_walk<Space> walk{.speed = speed, .range = 2.0 * w.size};
    const state next = here.shown_exactly(seed % 3U == 0   ? nyquist.next(view, random)
                                          : seed % 3U == 1 ? greedy.next(view, random)
                                                           : walk.next(view, random));
    if (!(period > device.parameters().watchdog)) return device.move_to(next);
    const double b = std::fmax(w.damping, 1e-9);
    const state best =
        sim::clamp_norm<Space>(state(force * (device.parameters().watchdog / (2.0 * b))), farthest);
    device.move_via(here.shown_exactly(state(x + best)), random.chance(0.5) ? x : next);
  };
  return play<Space>(model, device, w, quantum, seed, ticks, true, move);
}

/// The largest force of the hand [N]: it crosses the scene in a tick or two, and is no stronger
/// than a hand.
double hand_force(const world& w) {
  return std::fmin(5.0, w.mass * w.size / (w.tick * w.tick));
}

/// The weight of the falling mass [N]: it falls its own height in thirty ticks.
double weight(const world& w) {
  return 2.0 * w.mass * w.size / (900.0 * w.tick * w.tick);
}

template <class Space>
outcome attack_by_hand(const controllers::model<Space>& model, const controller& c, const world& w,
                       double quantum, std::uint64_t seed, int ticks) {
  auto parameters = device_of<Space>(c, w);
  sim::striking_hand<Space> hand;
  hand.taps.normal = sim::random_source(seed).direction<Space>();
  hand.taps.limit = hand_force(w);
  sim::device<Space, sim::striking_hand<Space>> device(parameters, hand);
  int ticks_left = 0;
  const auto move = [&](const sim::surface_state<Space>& surface,
                        const typename Space::vector& /*command*/, double /*period*/,
                        sim::random_source& random) {
    auto& striking = device.hand();
    striking.taps.surface = surface.point;
    striking.taps.normal = surface.normal;
    if (seed % 2U == 0 || ticks_left-- > 0) return;
    ticks_left = static_cast<int>(random.uniform(0.0, 40.0));
    striking.tapping = random.chance(0.3);
    striking.push =
        typename sim::physical<Space>::vector(random.direction<Space>() * striking.taps.limit);
  };
  return play<Space>(model, device, w, quantum, seed, ticks, true, move);
}

/// A mass under a constant load, falling onto the wall and left alone: its mechanical energy cannot
/// grow unless the controller feeds it.
template <class Space>
outcome fall(const controllers::model<Space>& model, const controller& c, const world& w,
             double quantum, std::uint64_t seed, int ticks) {
  using state = typename sim::physical<Space>::vector;
  const state up = sim::random_source(seed).direction<Space>();  // the surface's normal, too
  const double load = weight(w);
  auto parameters = device_of<Space>(c, w);
  parameters.start = state(up * w.size);
  parameters.load = state(up * -load);
  sim::device<Space> device(parameters);
  const double first = load * w.size;
  double most = 0.0;
  int tick = 0;
  const auto watch = [&](const auto&, const auto&, double, sim::random_source&) {
    if (++tick < ticks / 2) return;
    const double height = sim::physical<Space>::dot(device.position(), up);
    const double energy = device.kinetic() + load * height;
    if (!(energy <= most)) most = energy;
  };
  outcome result = play<Space>(model, device, w, quantum, seed, ticks, false, watch);
  result.swing = most / first;
  const double explained = (result.slack + result.blurred) / first;
  result.stable = result.swing <= 1.001 + explained;
  return result;
}

/// The worst of both.
outcome worse(const outcome& a, const outcome& b) noexcept {
  outcome w =
      b.margin < a.margin || (b.margin == a.margin && b.least_energy < a.least_energy) ? b : a;
  w.largest_force = std::fmax(a.largest_force, b.largest_force);
  w.exchanged = std::fmax(a.exchanged, b.exchanged);
  w.swing = std::fmax(a.swing, b.swing);
  w.events = a.events | b.events;
  w.finite = a.finite && b.finite;
  w.stable = a.stable && b.stable;
  w.refused = a.refused || b.refused;
  return w;
}

}  // namespace

template <class Space>
outcome judge(const controller& c, const world& w, const effort& how) {
  const double sensed = spacing<typename Space::scalar>(w.offset + 10.0 * w.size);
  const double quantum = w.offset == 0.0 ? 0.0 : sensed;  // hands feel it at the origin, too
  const double friction = c.credits_friction ? dry_friction : 0.0;
  const auto model =
      c.in<Space>()({.mass = w.mass,
                     .damping = w.damping,
                     .friction = friction,
                     .hand_force = 1.001 * (std::fmax(hand_force(w), weight(w)) + friction),
                     .quantum = 1.001 * (c.knows_steps ? sensed : 0.0),
                     .longest_tick = w.tick});
  outcome all = fall<Space>(model, c, w, sensed, 1, how.ticks);
  for (int run = 0; run < how.runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run) + 1;
    all = worse(all, c.needs_known_hands()
                         ? attack_by_hand<Space>(model, c, w, sensed, seed, how.ticks)
                         : attack_by_motion<Space>(model, c, w, quantum, seed, how.ticks));
  }
  all.refused = static_cast<bool>(model.check());
  return all;
}

template outcome judge<controllers::f1>(const controller&, const world&, const effort&);
template outcome judge<controllers::d1>(const controller&, const world&, const effort&);
template outcome judge<controllers::f3>(const controller&, const world&, const effort&);
template outcome judge<controllers::d3>(const controller&, const world&, const effort&);

}  // namespace stability
