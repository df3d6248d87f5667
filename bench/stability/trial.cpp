// SPDX-License-Identifier: BSD-3-Clause
#include "trial.hpp"

#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
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
  using scalar = typename Space::scalar;
  using state = typename sim::physical<Space>::vector;

  accounts(const world& w, double quantum) : b_(w.damping), q_(quantum) {}

  void book(double energy, double rubbed, const state& at, const state& travel, const state& held,
            const state& next, double dt, const ph::tick_result<Space>& out) {
    using physical = sim::physical<Space>;
    if (q_ > 0.0) q_ = std::fmax(q_, spacing<scalar>(physical::norm(at)));
    const double way = physical::norm(travel);
    const double force = physical::norm(next);
    const double before = physical::norm(held);
    const double damped = b_ * way * way / dt;
    const double ledger = std::abs(static_cast<double>(out.energy));
    const double u = static_cast<double>(std::numeric_limits<scalar>::epsilon()) / 2.0;
    result.slack += 16.0 * u * (damped + (force + before) * way + ledger + rubbed - rubbed_);
    rubbed_ = rubbed;

    double change = 0.0;
    for (int i = 0; i < Space::dof; ++i) {
      change += std::abs(sim::component(next, i) - sim::component(held, i));
    }
    summed_ += q_ / 2.0 * change + b_ / dt * Space::dof * (2.0 * way * q_ + q_ * q_);
    strongest_ = std::fmax(strongest_, force);
    result.blurred = summed_ + 2.0 * Space::dof * q_ * strongest_;

    result.exchanged += before * way + damped;
    result.largest_force = std::fmax(result.largest_force, force);
    result.events |= 1U << static_cast<unsigned>(out.what);
    result.finite = result.finite && Space::is_finite(out.force) &&
                    ph::kernels::is_finite(out.depth) && ph::kernels::is_finite(out.energy);
    if (!(energy >= result.least_energy)) result.least_energy = energy;
    const double truth = rubbed * 4.0 * std::numeric_limits<double>::epsilon();
    const double explained = energy + result.slack + result.blurred + truth;
    if (!(explained >= result.margin)) result.margin = explained;
  }

  outcome result;

 private:
  double b_, q_;
  double summed_ = 0.0, strongest_ = 0.0, rubbed_ = 0.0;
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

double next_period(const world& w, int tick, sim::random_source& random) {
  switch (w.clock) {
    case clockwork::jitter:
      return w.tick * random.uniform(0.5, 1.0);
    case clockwork::missed:
    case clockwork::missed_and_held:
      return random.chance(0.02) ? w.tick * random.uniform(2.0, 20.0) : w.tick;
    case clockwork::switching:
      return tick / 50 % 2 == 0 ? w.tick : w.tick / 100.0;
    default:
      return w.tick;
  }
}

template <class Space>
sim::device_parameters<Space> device_of(const controller& c, const world& w) {
  sim::device_parameters<Space> p;
  p.mass = w.mass;
  p.damping = w.damping;
  p.friction = c.credits_friction ? dry_friction : 0.0;
  p.period = w.tick;
  p.latency = c.covers.latency;
  if (w.clock != clockwork::missed_and_held) p.watchdog = w.tick;
  return p;
}

/// The loop: world, sample, model, device. move(position, surface, command, period) is the hand.
template <class Space, class Device, class Move>
outcome play(controllers::model<Space> model, Device& device, const world& w, double quantum,
             std::uint64_t seed, int ticks, bool updates, Move move) {
  using state = typename sim::physical<Space>::vector;
  using scalar = typename Space::scalar;
  const frame<Space> here{w.offset};
  sim::random_source random(seed);
  sim::surface_state<Space> surface{sim::physical<Space>::zero(), random.direction<Space>(),
                                    w.stiffness};
  const auto publish = [&] {
    model.retarget({here.seen(surface.point), sim::to_port<Space>(surface.normal),
                    static_cast<scalar>(surface.stiffness)});
  };
  publish();
  sim::erratic_sensor sensor{w.clock == clockwork::lost_samples};
  accounts<Space> books(w, quantum);
  state last = device.position(), held = sim::physical<Space>::zero();
  auto sample = device.exchange(Space::zero());
  for (int tick = 0; tick < ticks; ++tick) {
    if (updates && tick % 25 == 24) {
      if (random.chance(0.5)) surface.normal = random.direction<Space>();
      surface.point = surface.normal * random.uniform(-w.size, w.size);
      surface.stiffness = random.chance(0.5) ? w.stiffness : w.stiffness / 10.0;
      publish();
    }
    sample.position = here.seen(device.position());
    const bool lost = sensor.loses_one(random);
    const auto out = model.tick(lost ? ph::device_sample<Space>{} : sample);
    const state force = sim::to_physical<Space>(out.force);
    const double rubbed = device.meter().total().friction;  // zero where there is none
    const double energy = rubbed > 0.0 ? device.meter().value() + rubbed : device.meter().minimum();
    books.book(energy, rubbed, device.position(), state(device.position() - last), held, force,
               static_cast<double>(sample.dt), out);
    last = device.position();
    held = force;
    const double period = next_period(w, tick, random);
    device.set_period(period);
    move(surface, out.force, period, random);
    sample = device.exchange(out.force);
  }
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
    const state force = sim::to_physical<Space>(device.upcoming(command));
    const sim::adversary_view<Space> view{x,     surface.normal, surface.depth(x),
                                          force, period,         w.damping};
    state next = x;
    nyquist.amplitude = farthest;
    switch (seed % 3U) {
      case 0:
        next = nyquist.next(view, random);
        break;
      case 1:
        next = sim::greedy_motion<Space>{.speed = farthest / period}.next(view, random);
        break;
      default:
        next = sim::random_walk<Space>{.speed = farthest / period, .range = 2.0 * w.size}.next(
            view, random);
    }
    next = here.shown_exactly(next);
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

}  // namespace

bool has(unsigned events, ph::event e) noexcept {
  return (events >> static_cast<unsigned>(e) & 1U) != 0;
}

bool reported(unsigned events) noexcept {
  for (const auto e : {ph::event::debt, ph::event::late_tick, ph::event::rejected_target,
                       ph::event::rejected_sample, ph::event::rejected_parameters}) {
    if (has(events, e)) return true;
  }
  return false;
}

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

template <class Space>
outcome judge(const controller& c, const world& w, const effort& how) {
  using scalar = typename Space::scalar;
  const double quantum = w.offset == 0.0 ? 0.0 : spacing<scalar>(w.offset + 10.0 * w.size);
  const double sensed = spacing<scalar>(w.offset + 10.0 * w.size);  // for hands, also at the origin
  const double friction = c.credits_friction ? dry_friction : 0.0;
  const controllers::premises known{
      .mass = w.mass,
      .damping = w.damping,
      .friction = friction,
      .hand_force = 1.001 * (std::fmax(hand_force(w), weight(w)) + friction),
      .quantum = 1.001 * (c.covers.rounding ? sensed : 0.0),
      .longest_tick = w.tick,
      .latency = c.covers.latency};
  const auto model = c.maker<Space>()(known);
  outcome all = fall<Space>(model, c, w, sensed, 1, how.ticks);
  for (int run = 0; run < how.runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run) + 1;
    all = worse(all, c.covers.any_motion
                         ? attack_by_motion<Space>(model, c, w, quantum, seed, how.ticks)
                         : attack_by_hand<Space>(model, c, w, sensed, seed, how.ticks));
  }
  all.refused = static_cast<bool>(model.check());
  return all;
}

template outcome judge<controllers::f1>(const controller&, const world&, const effort&);
template outcome judge<controllers::d1>(const controller&, const world&, const effort&);
template outcome judge<controllers::f3>(const controller&, const world&, const effort&);
template outcome judge<controllers::d3>(const controller&, const world&, const effort&);

}  // namespace stability
