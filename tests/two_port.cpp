// SPDX-License-Identifier: BSD-3-Clause
// The two-port against hands, environments and networks that try to draw energy out of it. Judged
// by the true energy of both ports: the device's meter and the environment's own account.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/channel.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/two_port.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

template <class Space>
using vector_of = typename Space::vector;

// ---- environments: force() on the tool; move() returns the true work done on the tool ----------

/// In discrete time: a force held over the step, and any force after it. It pushes along the motion
/// of the tool (negative damping), at random, or not at all.
template <class Space>
struct wild_environment {
  double strength = 10.0;  ///< [N]
  double damping = -20.0;  ///< [N·s/m]
  vector_of<Space> now = Space::zero();

  vector_of<Space> force() const { return now; }
  double move(const vector_of<Space>& step, double dt, sim::random_source& random) {
    const double work = static_cast<double>(Space::dot(now, step));
    using scalar = typename Space::scalar;
    const double kind = random.uniform();
    if (kind < 0.4) {
      now = step * static_cast<scalar>(-damping / dt);
    } else if (kind < 0.8) {
      const vector_of<Space> push = sim::to_port<Space>(random.direction<Space>());
      now = push * static_cast<scalar>(random.uniform() * strength);
    } else {
      now = Space::zero();
    }
    return work;
  }
};

/// In continuous time: a linear wall whose surface jumps between steps.
template <class Space>
struct moving_wall {
  double stiffness = 2e3;  ///< [N/m]
  double jump = 2e-3;      ///< [m]
  double restless = 0.1;   ///< probability of a jump after a step
  vector_of<Space> normal = Space::zero();
  vector_of<Space> tool = Space::zero();
  double surface = 0.0;

  double depth() const { return surface - static_cast<double>(Space::dot(tool, normal)); }
  double stored() const { return stiffness * std::pow(std::max(depth(), 0.0), 2) / 2; }
  vector_of<Space> force() const {
    return normal * static_cast<typename Space::scalar>(stiffness * std::max(depth(), 0.0));
  }
  double move(const vector_of<Space>& step, double /*dt*/, sim::random_source& random) {
    const double before = stored();
    tool += step;
    const double work = before - stored();
    if (random.chance(restless)) surface = random.uniform(-jump, jump);
    return work;
  }
};

// ---- sides that control nothing, or only what was published --------------------------------------

template <class Space>
using packet_of = ph::port_packet<typename Space::scalar, typename Space::coordinates>;

template <class Space>
struct bare_master {
  vector_of<Space> desired = Space::zero();
  typename Space::coordinates position{};
  std::uint64_t newest = 0, number = 0;

  void receive(const packet_of<Space>& p) {
    if (p.number <= newest) return;
    newest = p.number;
    desired = p.payload;
  }
  ph::impedance_result<Space> tick(const ph::device_sample<Space>& sample) {
    position = sample.position;
    return {desired, 0, ph::event::nominal, false};
  }
  packet_of<Space> packet() { return {0, ++number, position}; }
};

template <class Space>
struct bare_remote {
  vector_of<Space> target = Space::zero(), tool = Space::zero();
  std::uint64_t newest = 0, number = 0;

  void receive(const packet_of<Space>& p) {
    if (p.number <= newest) return;
    newest = p.number;
    target = p.payload;
  }
  ph::admittance_result<Space> step(const vector_of<Space>& /*force*/, double /*dt*/) {
    const vector_of<Space> moved = target - tool;
    tool = target;
    return {moved, Space::zero(), 0, ph::event::nominal, false};
  }
  void settle(double /*work*/) {}
  packet_of<Space> packet(const vector_of<Space>& force) { return {0, ++number, force}; }
};

/// The published series controller, same-sample pairing.
template <class Space>
struct published_master : bare_master<Space> {
  ph::two_port_series_controller<Space> controller{};
  bool seen = false;

  void receive(const packet_of<Space>& p) {
    controller.receive(p.energy);
    bare_master<Space>::receive(p);
  }
  ph::impedance_result<Space> tick(const ph::device_sample<Space>& sample) {
    const vector_of<Space> last = this->position, now = sample.position;
    this->position = sample.position;
    const vector_of<Space> moved = seen ? vector_of<Space>(now - last) : Space::zero();
    seen = true;
    return {controller.force(this->desired, moved, sample.dt), 0, ph::event::nominal, false};
  }
  packet_of<Space> packet() { return {controller.in, ++this->number, this->position}; }
};

// ---- one run -----------------------------------------------------------------------------------

enum class motion : int { nyquist, random, greedy };

struct conditions {
  sim::channel_parameters up{}, down{};
  motion by = motion::greedy;
  double damping = 0.03;    ///< of the device [N·s/m]
  double speed = 0.5;       ///< of the hand, at most [m/s]
  double slowest = 1e-3;    ///< longest period of the environment [s]
  double lost_samples = 0;  ///< probability
  double overruns = 0;      ///< probability of a tick of 2 to 20 ms; a watchdog acts after 1 ms
  bool settles = false;     ///< the environment reports the work it did
  bool jitter = true;       ///< periods of the device of 0.5 to 1 ms
  int ticks = 600;
};

struct outcome {
  double least = 0.0;           ///< of the sum of both ports' true energy so far [J]
  double to_hand = 0.0;         ///< what the device's motors gave to the hand [J]
  double to_environment = 0.0;  ///< what the tool gave to the environment [J]
  double least_ledger = 0.0;    ///< of the two [J], if they have one and no tick was late
};

template <class Space, class Master, class Remote, class Environment>
outcome run(Master master, Remote remote, Environment world, const vector_of<Space>& normal,
            const conditions& when, std::uint64_t seed) {
  using scalar = typename Space::scalar;
  sim::random_source random(seed);
  sim::channel<packet_of<Space>> up(when.up, seed + 1), down(when.down, seed + 2);
  sim::prescribed_motion<Space> device({.damping = when.damping, .watchdog = 1e-3});
  sim::nyquist_motion<Space> nyquist{};
  outcome result;
  double at_environment = 0.0, next_step = 0.0, last_step = 0.0;
  auto sample = device.exchange(Space::zero());
  for (int n = 0; n < when.ticks; ++n) {
    const double now = device.time();
    const bool late = random.chance(when.overruns);
    const double period = when.jitter ? random.uniform(0.5e-3, 1e-3) : 1e-3;
    device.set_period(late ? random.uniform(2e-3, 20e-3) : period);
    while (const auto* packet = up.take(now)) master.receive(*packet);
    const bool lost = random.chance(when.lost_samples);
    const auto out = master.tick(lost ? ph::device_sample<Space>{} : sample);
    down.send(master.packet(), now);

    if (now >= next_step) {
      const double dt = next_step > 0.0 ? now - last_step : 1e-3;
      while (const auto* packet = down.take(now)) remote.receive(*packet);
      const auto step = remote.step(world.force(), static_cast<scalar>(dt));
      const double work = world.move(step.displacement, dt, random);
      if (when.settles) remote.settle(static_cast<scalar>(work));
      at_environment += work;
      result.to_environment += std::max(-work, 0.0);
      up.send(remote.packet(world.force()), now);
      last_step = now;
      next_step = now + random.uniform(1e-3, when.slowest);
      if constexpr (requires { remote.energy(); }) {
        result.least_ledger = std::min(result.least_ledger, static_cast<double>(remote.energy()));
      }
    }

    const auto n_true = sim::to_physical<Space>(normal);
    const sim::adversary_view<Space> view{
        .position = device.position(),
        .normal = n_true,
        .depth = -sim::physical<Space>::dot(device.position(), n_true),
        .force = sim::to_physical<Space>(out.force),
        .dt = 0.75e-3,
        .damping = when.damping};
    switch (when.by) {
      case motion::nyquist:
        device.move_to(nyquist.next(view, random));
        break;
      case motion::random:
        device.move_to(
            sim::random_walk<Space>{.speed = when.speed, .range = 1e-2}.next(view, random));
        break;
      case motion::greedy:
        device.move_to(sim::greedy_motion<Space>{.speed = when.speed}.next(view, random));
        break;
    }
    const double before = device.meter().total().actuator;
    sample = device.exchange(out.force);
    result.to_hand += std::max(device.meter().total().actuator - before, 0.0);
    result.least = std::min(result.least, device.meter().value() + at_environment);
    if (!(when.overruns > 0.0)) {  // a late tick may leave a debt: the worse of two stories
      result.least_ledger = std::min(result.least_ledger, static_cast<double>(out.energy));
    }
  }
  return result;
}

/// 0 to 300 ms, up to 100 ms of jitter, 0 to 90 % loss, duplication, in order or not.
sim::channel_parameters any_channel(sim::random_source& random) {
  return {.delay = random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.3),
          .jitter = random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.1),
          .loss = random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.9),
          .duplication = random.chance(0.5) ? 0.0 : random.uniform(),
          .in_order = random.chance(0.3)};
}

enum class world : int { wild, wall };

/// One random run: all of it drawn from the seed.
template <class Space, bool Controlled>
outcome attack(world kind, std::uint64_t seed, int ticks = 600) {
  using scalar = typename Space::scalar;
  sim::random_source random(seed * 77);
  const vector_of<Space> normal = sim::to_port<Space>(random.direction<Space>());
  conditions when{.up = any_channel(random), .down = any_channel(random)};
  when.by = static_cast<motion>(random.bits() % 3);
  when.damping = random.chance(0.5) ? 0.03 : random.uniform(0.03, 3.0);
  when.slowest = random.chance(0.3) ? 1e-3 : random.uniform(1e-3, 0.05);
  when.speed = random.chance(0.5) ? 0.5 : 10.0;
  when.lost_samples = random.chance(0.3) ? 0.05 : 0.0;
  when.overruns = random.chance(0.3) ? 0.05 : 0.0;
  when.ticks = ticks;
  constexpr std::array shares{1.0, 0.5, 0.0};
  const double share = shares[random.bits() % 3];
  const double K = random.uniform(100.0, 20000.0);
  when.settles = kind == world::wall && random.chance(0.5);
  const auto with = [&](auto environment) {
    if constexpr (Controlled) {
      ph::two_port_energy<Space> observer{.damping = static_cast<scalar>(when.damping)};
      observer.share = static_cast<scalar>(share);
      ph::impedance_side master{Space{}, observer, ph::strict_bound<Space>{}};
      ph::admittance_parameters<Space> p;
      p.stiffness = static_cast<scalar>(kind == world::wall ? K : 0.0);
      p.drift_rate = static_cast<scalar>(random.chance(0.5) ? 0.0 : 20.0);
      return run<Space>(master, ph::admittance_side<Space>{p}, environment, normal, when, seed);
    } else {
      return run<Space>(bare_master<Space>{}, bare_remote<Space>{}, environment, normal, when,
                        seed);
    }
  };
  if (kind == world::wild) return with(wild_environment<Space>{});
  moving_wall<Space> wall{.stiffness = K};
  wall.normal = normal;
  return with(wall);
}

struct tally {
  double least = 0.0, to_hand = 0.0, to_environment = 0.0, least_ledger = 0.0;
  int losing = 0, hands = 0, environments = 0;

  void count(const outcome& o) {
    least = std::min(least, o.least);
    least_ledger = std::min(least_ledger, o.least_ledger);
    to_hand += o.to_hand;
    to_environment += o.to_environment;
    losing += o.least < -1e-3 ? 1 : 0;
    hands += o.to_hand > 1e-6 ? 1 : 0;
    environments += o.to_environment > 1e-6 ? 1 : 0;
  }
};

}  // namespace

TEMPLATE_TEST_CASE("the two-port never creates energy, whatever hand, environment and channel do",
                   "[two_port][passivity]", d1, d2, d3) {
  for (const auto kind : {world::wild, world::wall}) {
    tally controlled, bare;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      controlled.count(attack<TestType, true>(kind, seed));
      bare.count(attack<TestType, false>(kind, seed));
    }
    INFO("world " << static_cast<int>(kind));
    CHECK(controlled.least >= -1e-12);
    CHECK(controlled.least_ledger >= -1e-12);
    CHECK(controlled.hands >= 100);         // energy did flow, both ways:
    CHECK(controlled.environments >= 100);  // silence would be passive too
    CHECK(bare.losing >= 100);              // and without the controllers it is created
    CHECK(bare.least < -1.0);
  }
}

namespace {

/// A hand that presses 2 cm into a remote spring for a second and lets go, over 25 ms each way.
struct contact {
  double farthest = 0.0;  ///< tool or hand from the surface [m]
  double swing = 0.0;     ///< peak to peak of the hand over the last half second of the press [m]
  double force = 0.0;     ///< mean of the force on the hand over the same time [N]
  double pressed = 0.0;   ///< mean force of the tool on the environment over the same time [N]
  double least = 0.0;     ///< of the sum of both ports [J]
  double drift = 0.0;     ///< hand less tool at the end, in free space [m]
};

template <class Master, class Remote>
contact press(Master master, Remote remote, double K, double damping, double delay = 0.025) {
  sim::device<d1, sim::impedance_hand<d1>> device({.damping = damping, .start = -0.01},
                                                  {.stiffness = 500.0, .damping = 5.0});
  sim::channel<packet_of<d1>> up({.delay = delay}, 1), down({.delay = delay}, 2);
  sim::random_source random(1);
  moving_wall<d1> world{.stiffness = K, .restless = 0.0};
  world.normal = -1.0;
  world.tool = -0.01;
  contact result;
  double at_environment = 0.0, low = 1.0, high = -1.0, tool = -0.01;
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 3000; ++n) {
    const double now = device.time();
    const auto goal = now < 1.5 ? 0.02 * std::min(now / 0.3, 1.0) : -0.03;
    device.hand().aim(goal, 0.0, now);
    while (const auto* packet = up.take(now)) master.receive(*packet);
    const auto out = master.tick(sample);
    down.send(master.packet(), now);
    while (const auto* packet = down.take(now)) remote.receive(*packet);
    const auto step = remote.step(world.force(), 1e-3);
    const double work = world.move(step.displacement, 1e-3, random);
    remote.settle(work);
    at_environment += work;
    tool += step.displacement;
    up.send(remote.packet(world.force()), now);
    sample = device.exchange(out.force);
    const double x = device.position();
    result.farthest = std::max({result.farthest, std::abs(x), std::abs(tool)});
    result.least = std::min(result.least, device.meter().value() + at_environment);
    result.drift = x - tool;
    if (now >= 1.0 && now < 1.5) {
      low = std::min(low, x);
      high = std::max(high, x);
      result.force -= out.force / 500.0;
      result.pressed -= world.force() / 500.0;
    }
  }
  result.swing = high - low;
  return result;
}

/// Both sides as they are meant to be used: half of the energy kept, drift made up for.
auto press_controlled(double share, double drift_rate, double K, double loan) {
  const ph::two_port_energy<d1> observer{.damping = 1.0, .share = share};
  const ph::impedance_side master{d1{}, observer, ph::strict_bound<d1>{}};
  const ph::admittance_side<d1> remote(
      {.stiffness = loan > 0.0 ? K : 0.0, .drift_rate = drift_rate, .energy = loan}, -0.01);
  return press(master, remote, K, 1.0);
}

contact press_bare(double K) {
  return press(bare_master<d1>{.position = -0.01}, bare_remote<d1>{-0.01, -0.01}, K, 1.0);
}

}  // namespace

TEST_CASE("the two-port keeps a hand-held contact with a stiff spring 50 ms away bounded",
          "[two_port][passivity]") {
  for (const double K : {500.0, 2000.0, 10000.0}) {
    const contact held = press_controlled(0.5, 20.0, K, 1e-3);
    CHECK(held.farthest < 0.05);  // the hand pulls back to 0.03
    CHECK(held.swing < 1e-6);     // it settles,
    CHECK(held.force > 3.0);      // and the hand feels it
    CHECK(held.pressed > 3.0);
    CHECK(held.least >= -1e-3 - 1e-12);  // no more than the loan
    CHECK(std::abs(held.drift) < 1e-6);
    const contact bare = press_bare(K);
    CHECK(bare.swing > 0.02);
    CHECK(bare.least < -1.0);
    if (K > 1000.0) CHECK(bare.farthest > 0.2);
  }
}

TEST_CASE("what the admittance side cut is missing for good, or made up for with drift_rate",
          "[two_port]") {
  for (const double K : {500.0, 2000.0, 10000.0}) {
    CHECK(std::abs(press_controlled(0.5, 0.0, K, 1e-3).drift) > 0.02);
    CHECK(std::abs(press_controlled(0.5, 20.0, K, 1e-3).drift) < 1e-6);
    CHECK(std::abs(press_controlled(1.0, 0.0, K, 0.0).drift) > 0.01);
    CHECK(std::abs(press_controlled(1.0, 20.0, K, 0.0).drift) < 1e-6);
  }
}

TEST_CASE("impedance_side survives actuator latency with a bound that knows it (§ 3)",
          "[two_port][passivity]") {
  // 10 mJ have come over the channel; the hand gives way as it pays best, two ticks late.
  const auto least = [](auto bound) {
    const double b = 0.03, T = 1e-3;
    ph::impedance_side master{d1{}, ph::two_port_energy<d1>{.damping = b}, bound};
    sim::prescribed_motion<d1> device({.damping = b, .latency = 2});
    master.receive({0.01, 1, 10.0});
    std::array<double, 3> commands{};
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 100; ++n) {
      commands = {master.tick(sample).force, commands[0], commands[1]};
      device.move_to(device.position() + commands[2] * T / (2 * b));
      sample = device.exchange(commands[0]);
    }
    return device.meter().minimum();
  };
  CHECK(least(ph::strict_bound<d1, 2>{}) >= -0.01 - 1e-12);
  CHECK(least(ph::strict_bound<d1, 2>{}) < -0.009);  // it was there to be spent
  CHECK(least(ph::strict_bound<d1>{}) < -0.02);      // the control
}

TEST_CASE("the published same-sample series form loses on a stiff wall, impedance_side does not",
          "[two_port][passivity]") {
  // No delay at all: the wall answers x(n) with f(n) before the tick is over.
  const double K = 1e4, loan = 0.01;
  const auto least_of = [&](auto master) {
    ph::admittance_side<d1> remote({.stiffness = K, .energy = loan});
    moving_wall<d1> world{.stiffness = K, .restless = 0.0};
    world.normal = -1.0;
    sim::random_source random(1);
    sim::prescribed_motion<d1> device({.damping = 0.03});
    double at_environment = 0.0, least = 0.0, force = 0.0;
    for (std::uint64_t n = 1; n <= 2000; ++n) {
      device.move_to(n % 2 == 0 ? 0.0 : 1e-3);  // in and out
      const auto sample = device.exchange(force);
      remote.receive({master.packet().energy, n, sample.position});
      const double work = world.move(remote.step(world.force(), 1e-3).displacement, 1e-3, random);
      remote.settle(work);
      at_environment += work;
      master.receive(remote.packet(world.force()));
      force = master.tick(sample).force;
      least = std::min(least, device.meter().value() + at_environment);
    }
    return least;
  };
  // (K − 2B) δ² in each of 1000 cycles, what no controller at all would lose (A5): it never acts.
  CHECK_THAT(least_of(published_master<d1>{}), WithinRel(-1000 * (K - 2 * 30) * 1e-6, 1e-3));
  CHECK(least_of(ph::impedance_side{d1{}, ph::two_port_energy<d1>{.damping = 0.03},
                                    ph::strict_bound<d1>{}}) >= -loan - 1e-12);
}

TEST_CASE("an environment that moves by itself cannot set a resting device in motion",
          "[two_port][passivity]") {
  const auto energy_given = [](auto master, auto remote) {
    sim::device<d1> device;
    moving_wall<d1> world{.stiffness = 5e3, .restless = 0.05};
    world.normal = -1.0;
    sim::random_source random(3);
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 2000; ++n) {
      const auto out = master.tick(sample);
      remote.receive(master.packet());
      world.move(remote.step(world.force(), 1e-3).displacement, 1e-3, random);
      master.receive(remote.packet(world.force()));
      sample = device.exchange(out.force);
    }
    return device.meter().total().actuator;
  };
  const ph::impedance_side master{d1{}, ph::two_port_energy<d1>{.damping = 0.03},
                                  ph::strict_bound<d1>{}};
  CHECK(energy_given(master, ph::admittance_side<d1>{}) <= 0.0);
  CHECK(energy_given(bare_master<d1>{}, bare_remote<d1>{}) > 1e-4);
}

// ---- the observer ------------------------------------------------------------------------------

namespace {

using energy1 = ph::two_port_energy<d1>;
static_assert(ph::energy_observer_for<ph::two_port_energy<d3>, d3>);
static_assert(ph::energy_observer_for<ph::two_port_energy<f2>, f2>);
static_assert(ph::laws::never_overstates<d1>(energy1{.damping = 0.03}));
static_assert(ph::laws::never_overstates<d1>(energy1{.damping = 0.03, .share = 0.0}));
static_assert(ph::laws::forfeit_never_credits<d1>(energy1{.damping = 0.03}));

constexpr double after(energy1 observer, double dx, double held) {
  observer.update(dx, held, 1e-3);
  return observer.value();
}
constexpr bool is_rounded_down(double value, double exact) {
  return value <= exact && value > exact - 1e-14;
}
// b dx²/dt = 0.03 J for dx = 1 m; the hand puts in 2 J, or takes out 2 J.
static_assert(is_rounded_down(after({.damping = 3e-5}, -1.0, 2.0), 0.03));
static_assert(is_rounded_down(after({.damping = 3e-5, .share = 0.25}, -1.0, 2.0), 1.53));
static_assert(is_rounded_down(after({.damping = 3e-5}, 1.0, 2.0), -1.97));

}  // namespace

TEST_CASE("two_port_energy is D + E_in_rx − E_out: what the hand puts in is promised, not kept",
          "[two_port]") {
  sim::random_source random(5);
  ph::two_port_energy<d3> observer{.damping = 0.5};
  double damped = 0.0, in = 0.0, out = 0.0, other = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double length = random.uniform(0.0, 1e-3), strength = random.uniform(0.0, 5.0);
    const d3::vector dx = random.direction<d3>() * length;
    const d3::vector held = random.direction<d3>() * strength;
    observer.update(dx, held, 1e-3);
    damped += 0.5 * dx.squaredNorm() / 1e-3;
    in += std::max(-held.dot(dx), 0.0);
    out += std::max(held.dot(dx), 0.0);
    other += random.uniform(0.0, 1e-3);
    observer.receive(other);
  }
  CHECK_THAT(observer.outgoing(), WithinRel(in, 1e-12));
  CHECK_THAT(observer.value(), WithinAbs(damped + other - out, 1e-12));
}

TEST_CASE("a promise counts once, in whatever order and number its packets come", "[two_port]") {
  energy1 observer{.damping = 0.03, .energy = 1.0};
  for (const double promised : {0.2, 0.5, 0.3, 0.5, 0.2, std::nan(""), -1.0,
                                std::numeric_limits<double>::infinity(), 0.4}) {
    observer.receive(promised);
  }
  CHECK_THAT(observer.value(), WithinAbs(1.5, 1e-15));
  observer.receive(0.75);
  CHECK_THAT(observer.value(), WithinAbs(1.75, 1e-15));
  CHECK(observer.outgoing() == 0.0);

  energy1 capped{.damping = 0.03, .cap = 0.1};
  capped.receive(5.0);
  CHECK(capped.value() == 0.1);
}

TEST_CASE("pressed slowly, strict_bound over two_port_energy shows 2B(1 − share) (L4)",
          "[two_port]") {
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    const double b = 0.03, T = 1e-3, step = 1e-7;
    ph::impedance_side master{d1{}, energy1{.damping = b, .share = share}, ph::strict_bound<d1>{}};
    master.receive({0.0, 1, 100.0});
    double x = 0.0, force = 0.0;
    for (int n = 0; n < 100000; ++n) {
      force = master.tick(x, T).force;
      x -= step;
    }
    CHECK_THAT(force / -x, WithinAbs(2 * b / T * (1 - share), 0.7));
  }
}

// ---- the impedance side ------------------------------------------------------------------------

TEST_CASE("impedance_side displays the newest force, up to what the ledger covers", "[two_port]") {
  ph::impedance_side master{d1{}, energy1{.damping = 0.03, .energy = 1.0}, ph::strict_bound<d1>{}};
  static_assert(decltype(master)::passivity == ph::guarantee::strict);
  static_assert(std::is_trivially_copyable_v<decltype(master)>);
  CHECK(master.packet().number == 0);  // no position to send yet
  CHECK(master.tick(0.0, 1e-3).what == ph::event::no_target);
  master.receive({0.0, 7, 2.0});
  master.receive({0.0, 3, 5.0});           // late
  master.receive({0.0, 8, std::nan("")});  // broken
  const auto free = master.tick(0.0, 1e-3);
  CHECK(free.force == 2.0);
  CHECK(!free.limited);
  CHECK(free.what == ph::event::nominal);
  master.receive({0.0, 9, 200.0});
  const auto limited = master.tick(0.0, 1e-3);
  CHECK_THAT(limited.force, WithinRel(std::sqrt(4 * 30 * 1.0), 1e-12));
  CHECK(limited.limited);
  CHECK(master.packet().number == 1);
}

TEST_CASE("a tick that is late, lost or impossible promises nothing to the other side",
          "[two_port]") {
  ph::impedance_side master{d1{}, energy1{.damping = 0.03, .energy = 1.0}, ph::strict_bound<d1>{}};
  master.receive({0.0, 1, 2.0});
  const double cost = 2.0 * 2.0 / (4 * 30);
  (void)master.tick(0.0, 1e-3);
  (void)master.tick(-1e-3, 1e-3);  // the control: a good one does
  CHECK_THAT(master.packet().energy, WithinAbs(2e-3, 1e-15));
  const double before = master.energy();

  CHECK(master.tick(-2e-3, 5e-3).what == ph::event::late_tick);
  CHECK_THAT(master.energy(), WithinAbs(before - cost, 1e-15));
  CHECK(master.tick(std::nan(""), 1e-3).what == ph::event::rejected_sample);
  CHECK_THAT(master.energy(), WithinAbs(before - 2 * cost, 1e-15));
  CHECK(master.tick(-4e-3, 1e-3).what == ph::event::nominal);  // motion unknown, force was zero
  CHECK_THAT(master.energy(), WithinAbs(before - 2 * cost, 1e-15));
  CHECK(master.tick(1e3, 1e-3).what == ph::event::rejected_sample);
  CHECK_THAT(master.packet().energy, WithinAbs(2e-3, 1e-15));

  // With latency a command outlives the tick that was refused.
  ph::impedance_side slow{d1{}, energy1{.damping = 0.03, .energy = 1.0}, ph::strict_bound<d1, 1>{}};
  slow.receive({0.0, 1, 2.0});
  (void)slow.tick(0.0, 1e-3);                                             // commands 2 N
  (void)slow.tick(std::nan(""), 1e-3);                                    // while 0 N were held
  CHECK_THAT(slow.tick(0.0, 1e-3).energy, WithinAbs(1.0 - cost, 1e-14));  // while the 2 N were
}

TEST_CASE("both sides refuse parameters that are out of range, and then do nothing", "[two_port]") {
  const auto broken = [](energy1 observer) {
    ph::impedance_side side{d1{}, observer, ph::strict_bound<d1>{}};
    side.receive({0.0, 1, 2.0});
    CHECK(side.check());
    return side.tick(0.0, 1e-3);
  };
  CHECK(broken({.damping = 0.0}).what == ph::event::rejected_parameters);
  CHECK(broken({.damping = 1.0, .share = 1.1, .energy = 1.0}).force == 0.0);
  CHECK(broken({.damping = 1.0, .cap = -1.0}).force == 0.0);
  CHECK(broken({.damping = 1.0, .energy = -1.0}).force == 0.0);

  const double nan = std::nan(""), far = std::numeric_limits<double>::infinity();
  for (const ph::admittance_parameters<d1> p : {ph::admittance_parameters<d1>{.stiffness = -1.0},
                                                {.drift_rate = nan},
                                                {.top_speed = 0.0},
                                                {.energy = far},
                                                {.cap = -1.0}}) {
    ph::admittance_side<d1> side(p);
    CHECK(side.check());
    side.receive({1.0, 1, 0.1});
    const auto out = side.step(0.0, 1e-3);
    CHECK(out.displacement == 0.0);
    CHECK(out.what == ph::event::rejected_parameters);
  }
  CHECK_FALSE(ph::admittance_side<d1>{}.check());
  CHECK(ph::two_port_series_controller<d1>{.min_speed = -1.0}.check());
  CHECK(ph::two_port_series_controller<d1>{.max_gain = -1.0}.check());
  CHECK_FALSE(ph::two_port_series_controller<d1>{}.check());
}

TEST_CASE("two_port_series_controller repays the excess of the sample in the sample (§ 2(d))",
          "[two_port]") {
  ph::two_port_series_controller<d1> controller;
  controller.receive(1e-3);
  // 2 N along 1 mm: 2 mJ out, 1 mJ received. α = 1e-3/(1e-3 · 1²) = 1 N·s/m.
  CHECK_THAT(controller.force(2.0, 1e-3, 1e-3), WithinAbs(1.0, 1e-12));
  CHECK_THAT(controller.out, WithinAbs(1e-3, 1e-15));
  CHECK(controller.force(2.0, -1e-3, 1e-3) == 2.0);
  CHECK_THAT(controller.in, WithinAbs(2e-3, 1e-15));
  CHECK(controller.force(2.0, 5e-7, 1e-3) == 2.0);  // too slow: carried on
  controller.max_gain = 0.25;
  CHECK_THAT(controller.force(2.0, 1e-3, 1e-3), WithinAbs(1.75, 1e-12));
}

// ---- the admittance side -----------------------------------------------------------------------

namespace {

/// What a step makes of a motion wanted under a force.
template <class Space>
constexpr auto step_of(const ph::admittance_parameters<Space>& p, const vector_of<Space>& wanted,
                       const vector_of<Space>& force) {
  ph::admittance_side<Space> side(p);
  side.receive({0.0, 1, wanted});
  return side.step(force, 1e-3);
}
static_assert(step_of<d1>({}, 1e-3, 0.0).displacement == 1e-3);             // free
static_assert(step_of<d1>({}, 1e-3, 5.0).displacement == 1e-3);             // with the force
static_assert(std::abs(step_of<d1>({}, 1e-3, -5.0).displacement) < 1e-17);  // against it: unpaid
static_assert(std::abs(step_of<d1>({.energy = 2e-3}, 1e-3, -5.0).displacement - 4e-4) < 1e-17);
static_assert(step_of<d1>({.top_speed = 0.5}, 1e-3, 0.0).displacement == 5e-4);

}  // namespace

TEST_CASE("admittance_side lets in exactly what was promised, and cuts only along the force",
          "[two_port]") {
  sim::random_source random(9);
  int cut = 0;
  for (int n = 0; n < 10000; ++n) {
    const double length = random.uniform(0.0, 1e-2), exponent = random.uniform(-140.0, 3.0);
    const d3::vector wanted = random.direction<d3>() * length;
    const d3::vector force = random.direction<d3>() * std::pow(10.0, exponent);
    const double credit = random.chance(0.3) ? 0.0 : random.uniform(0.0, 1e-2);
    const auto out = step_of<d3>({.energy = credit}, wanted, force);
    const double outflow = -force.dot(out.displacement);
    REQUIRE(outflow <= credit);
    REQUIRE(out.energy >= 0.0);
    const double asked = -force.dot(wanted);
    if (asked > credit) {
      ++cut;
      REQUIRE_THAT(outflow, WithinAbs(credit, 1e-14 * force.norm()));
      REQUIRE(out.limited);
      const d3::vector u = force.normalized(), change = out.displacement - wanted;
      REQUIRE((change - u * u.dot(change)).norm() <= 1e-17);
    } else {
      REQUIRE(out.displacement == wanted);
    }
  }
  CHECK(cut > 1000);
  CHECK(step_of<d1>({}, 1e-3, -1e-200).displacement == 0.0);  // its square is zero
}

TEST_CASE("admittance_side told no stiffness leaks K Δp²/2 a step into a continuous wall",
          "[two_port][passivity]") {
  const double K = 1e4, step = 1e-4;
  const int steps = 10;
  const auto sum_of_ports = [&](const ph::admittance_parameters<d1>& p) {
    ph::admittance_side<d1> side(p);
    sim::random_source random(1);
    moving_wall<d1> world{.stiffness = K, .restless = 0.0};
    world.normal = -1.0;
    double paid = 0.0, sum = 0.0;
    for (int n = 1; n <= steps; ++n) {  // a hand that pays f(n)·Δx(n) for each step it makes
      paid += world.force() * -step;
      side.receive({paid, static_cast<std::uint64_t>(n), step * n});
      sum += world.move(side.step(world.force(), 1e-3).displacement, 1e-3, random);
    }
    return sum + paid;
  };
  CHECK_THAT(sum_of_ports({}), WithinAbs(-steps * K * step * step / 2, 1e-12));
  CHECK(sum_of_ports({.stiffness = K}) >= -1e-12);
  CHECK(sum_of_ports({.stiffness = K, .energy = 1e-4}) < -1e-5);           // the loan is spent,
  CHECK(sum_of_ports({.stiffness = K, .energy = 1e-4}) >= -1e-4 - 1e-12);  // and no more
}

TEST_CASE("a stiffness makes free motion cost K Δp²/2, which settle() gives back", "[two_port]") {
  const auto way = [](bool settles) {
    ph::admittance_side<d1> side({.stiffness = 1e3, .energy = 1e-3});
    for (std::uint64_t n = 1; n <= 1000; ++n) {
      side.receive({0.0, n, 1e-3 * static_cast<double>(n)});
      (void)side.step(0.0, 1e-3);
      if (settles) side.settle(0.0);
    }
    return std::array{side.position(), side.energy()};
  };
  CHECK_THAT(way(true)[0], WithinRel(1.0, 1e-12));
  CHECK_THAT(way(true)[1], WithinRel(1e-3, 1e-12));
  CHECK(way(false)[0] < 0.1);
  CHECK(way(false)[1] < 1e-5);
}

TEST_CASE("a force that is no number, or no time, moves nothing, and the next step makes up for it",
          "[two_port]") {
  ph::admittance_side<d1> side;
  CHECK(side.step(0.0, 1e-3).what == ph::event::no_target);
  side.receive({0.0, 1, 1e-3});
  side.receive({0.0, 2, std::nan("")});
  side.receive({0.0, 1, 5e-3});  // there already
  CHECK(side.step(std::nan(""), 1e-3).what == ph::event::rejected_sample);
  CHECK(side.step(0.0, 0.0).displacement == 0.0);
  const auto out = side.step(0.0, 1e-3);
  CHECK(out.what == ph::event::nominal);
  CHECK(out.displacement == 1e-3);
  CHECK(side.packet(4.0).payload == 4.0);
  CHECK(side.packet(4.0).number == 2);
}

// ---- any space ---------------------------------------------------------------------------------

TEMPLATE_TEST_CASE("both sides work in every space, as values that can be stored as bytes",
                   "[two_port]", d1, d2, d3, f1, f2, f3) {
  using scalar = typename TestType::scalar;
  static_assert(std::is_trivially_copyable_v<packet_of<TestType>>);
  static_assert(std::is_trivially_copyable_v<ph::admittance_side<TestType>>);
  static_assert(std::is_trivially_copyable_v<ph::two_port_series_controller<TestType>>);
  tally wild;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    wild.count(attack<TestType, true>(world::wild, seed));
  }
  // In float the sums are rounded, and the positions measured are not the true ones.
  UNSCOPED_INFO(wild.least_ledger);
  CHECK(wild.least >= (std::is_same_v<scalar, float> ? -1e-5 : -1e-12));
  CHECK(wild.hands > 0);
}

// ---- the channel -------------------------------------------------------------------------------

namespace {

struct traffic {
  int arrived = 0, overtaken = 0, twice = 0;
  double earliest = 1.0, latest = 0.0;
};

traffic send_many(const sim::channel_parameters& p, int packets = 10000) {
  struct stamped {
    int number = 0;
    double sent = 0.0;
  };
  sim::channel<stamped> link(p, 4);
  std::vector<int> seen(static_cast<std::size_t>(packets) + 1);
  traffic t;
  int newest = 0;
  for (int n = 1; n <= packets + 1000; ++n) {
    const double now = n * 1e-3;
    if (n <= packets) link.send({n, now}, now);
    while (const auto* got = link.take(now)) {
      ++t.arrived;
      t.overtaken += got->number < newest ? 1 : 0;
      newest = std::max(newest, got->number);
      t.twice += ++seen[static_cast<std::size_t>(got->number)] == 2 ? 1 : 0;
      t.earliest = std::min(t.earliest, now - got->sent);
      t.latest = std::max(t.latest, now - got->sent);
    }
  }
  return t;
}

constexpr bool constant_delay() {
  sim::channel<int, 4> link({.delay = 2.0});
  link.send(1, 0.0);
  link.send(2, 1.0);
  if (link.take(1.5) != nullptr) return false;
  const int* first = link.take(2.5);
  return first != nullptr && *first == 1 && link.take(2.5) == nullptr && *link.take(3.0) == 2;
}
static_assert(constant_delay());

}  // namespace

TEST_CASE("channel delays, loses, duplicates and reorders as it is told", "[two_port]") {
  const auto perfect = send_many({.delay = 0.1});
  CHECK(perfect.arrived == 10000);
  CHECK(perfect.overtaken + perfect.twice == 0);
  CHECK_THAT(perfect.earliest, WithinAbs(0.1, 1.1e-3));  // polled every millisecond
  CHECK_THAT(perfect.latest, WithinAbs(0.1, 1.1e-3));

  const auto shaken = send_many({.delay = 0.1, .jitter = 0.2});
  CHECK(shaken.arrived == 10000);
  CHECK(shaken.overtaken > 5000);
  CHECK(shaken.earliest < 0.102);
  CHECK(shaken.latest > 0.298);
  CHECK(shaken.latest < 0.302);
  CHECK(send_many({.delay = 0.1, .jitter = 0.2, .in_order = true}).overtaken == 0);

  CHECK_THAT(send_many({.loss = 0.3}).arrived, WithinAbs(7000, 200));
  CHECK(send_many({.loss = 1.0}).arrived == 0);
  CHECK_THAT(send_many({.duplication = 0.3}).twice, WithinAbs(3000, 200));
}

TEST_CASE("channel loses what does not fit, and everything with parameters out of range",
          "[two_port]") {
  sim::channel<int, 4> full({.delay = 1.0});
  for (int i = 0; i < 6; ++i) full.send(i, 0.0);
  CHECK(full.in_flight() == 4);
  CHECK(full.lost() == 2);
  const double nan = std::nan("");
  for (const sim::channel_parameters& p : {sim::channel_parameters{.delay = -1.0},
                                           {.delay = nan},
                                           {.jitter = nan},
                                           {.loss = 1.1},
                                           {.loss = nan},
                                           {.duplication = -0.1}}) {
    CHECK(p.check());
    sim::channel<int, 4> broken(p);
    broken.send(1, 0.0);
    CHECK(broken.take(1e9) == nullptr);
  }
  CHECK_FALSE(sim::channel_parameters{}.check());
}
