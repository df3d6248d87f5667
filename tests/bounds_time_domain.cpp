// SPDX-License-Identifier: BSD-3-Clause
// Passivity controllers, energy tanks and set-position modulation: their formulas, and what they
// keep and lose, judged by the exact port-energy meter.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/bounds/energy_tank.hpp>
#include <passive_haptics/bounds/passivity_controller.hpp>
#include <passive_haptics/bounds/set_position.hpp>
#include <passive_haptics/laws.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double B = 30.0;  // of the thesis' device [N/m]
constexpr double T = 1e-3;

const ph::isotropic_damping<d1> b1{0.03};

/// In contact 1 mm deep in a wall of 1 kN/m that pushes along −1; nothing moves, nothing is held.
ph::tick_state<d1> pressing() {
  return {.damping = b1,
          .energy = 0,
          .in_flight = 0,
          .dt = T,
          .longest_tick = T,
          .held = 0,
          .displacement = 0,
          .motion_known = true,
          .normal = -1,
          .stiffness = 1000,
          .depth = 1e-3,
          .target_depth = 1e-3,
          .local_force = 1,
          .target_changed = false};
}

/// The thesis' device against a wall that may do anything.
struct scene {
  bool jumping = true;       ///< by up to ±2 mm, the normal anywhere
  double low = 2e3;          ///< the stiffness switches between the two [N/m]
  double high = 22e3;        ///<
  bool jitter = false;       ///< periods of 0.5 to 1 ms: the longest is the nominal one
  double lost = 0.0;         ///< share of samples that are lost
  double late = 0.0;         ///< share of ticks that last three: a watchdog drops the force
  double force_limit = 1e9;  ///< of the motors [N]
  int ticks = 600;
};

/// The least true port energy [J] of one prescribed motion against one model.
template <class Space, class Model, class Motion>
double attack(Model model, Motion motion, const scene& when, std::uint64_t seed) {
  using state = typename sim::physical<Space>::vector;
  using scalar = typename Space::scalar;
  sim::random_source random(seed);
  sim::prescribed_motion<Space> device({.damping = 0.03, .force_limit = when.force_limit});
  sim::jumping_surface jumps(2e-3, seed);
  sim::switching_stiffness stiffness(when.low, when.high, seed + 1);
  state normal = random.direction<Space>();
  double offset = 0.0, K = stiffness.stiffness(0.0);
  const auto publish = [&] {
    model.retarget({sim::to_port<Space>(state(normal * offset)), sim::to_port<Space>(normal),
                    static_cast<scalar>(K)});
  };
  publish();
  auto sample = device.exchange(Space::zero());
  for (int n = 0; n < when.ticks; ++n) {
    if (when.jitter) device.set_period(random.uniform(0.5 * T, T));
    if (when.jumping) {
      const double moved = jumps.offset(device.time());
      const double switched = stiffness.stiffness(device.time());
      if (moved != offset || switched != K) {
        offset = moved;
        K = switched;
        normal = random.direction<Space>();
        publish();
      }
    }
    if (random.chance(when.lost)) sample.valid = false;
    const auto out = model.tick(sample);
    const auto move = [&](const state& force) {
      const double depth =
          sim::physical<Space>::dot(state(normal * offset - device.position()), normal);
      device.move_to(motion.next({.position = device.position(),
                                  .normal = normal,
                                  .depth = depth,
                                  .force = force,
                                  .dt = T,
                                  .damping = 0.03},
                                 random));
    };
    move(sim::to_physical<Space>(out.force));
    sample = device.exchange(out.force);
    if (random.chance(when.late)) {
      for (int more = 0; more < 2; ++more) {
        move(sim::physical<Space>::zero());
        const auto dropped = device.exchange(Space::zero());
        sample.position = dropped.position;
        sample.dt += dropped.dt;
      }
    }
  }
  return device.meter().minimum();
}

/// The least over four motions and `seeds` seeds each.
template <class Space, class Model>
double worst_of(const Model& model, const scene& when = {}, int seeds = 40) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(seeds); ++seed) {
    for (const double least :
         {attack<Space>(model, sim::nyquist_motion<Space>{}, when, seed),
          attack<Space>(model, sim::random_walk<Space>{}, when, seed),
          attack<Space>(model, sim::random_walk<Space>{.speed = 0.02}, when, seed),
          attack<Space>(model, sim::greedy_motion<Space>{}, when, seed)}) {
      worst = std::min(worst, least);
    }
  }
  return worst;
}

template <class Space, class Bound>
auto model_of(const Bound& bound) {
  return following_half_space<Space>(ph::spring<Space>{}, thesis_ledger<Space>(), bound);
}

/// A hand of 5 N that taps a wall of 10 kN/m for 10 s while its surface jumps by up to ±1 mm: the
/// least energy at the port.
template <class Bound>
double tapped(const Bound& bound) {
  auto model = model_of<d1>(bound);
  model.retarget(wall<d1>(1e4));
  sim::jumping_surface jumps(1e-3, 1);
  double offset = 0.0;
  sim::device<d1, sim::tapping_hand<d1>> device({.mass = 0.1, .start = -1e-3},
                                                {.surface = 0.0, .normal = -1.0, .limit = 5.0});
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 10000; ++n) {
    const double moved = jumps.offset(device.time());
    if (moved != offset) model.retarget({moved, -1.0, 1e4});
    offset = moved;
    sample = device.exchange(model.tick(sample).force);
  }
  return device.meter().minimum();
}

/// S0 of docs/design/mathematics.md § 5: 0.1 kg falls 61 mm onto 10 kN/m, for 10 s.
struct fall {
  double swing = 0.0;    ///< peak to peak after 2 s [m]
  double energy = 0.0;   ///< least at the port [J]
  double deepest = 0.0;  ///< [m]
  std::vector<double> forces;
};
template <class Observer, class Bound>
fall drop(const Observer& observer, const Bound& bound) {
  auto model = following_half_space<d1>(ph::spring<d1>{}, observer, bound);
  model.retarget(wall<d1>(1e4));
  sim::device<d1> device({.lower = -0.061, .load = 0.981, .start = -0.061});
  fall result;
  double low = 1.0, high = -1.0;
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 10000; ++n) {
    result.forces.push_back(model.tick(sample).force);
    sample = device.exchange(result.forces.back());
    result.deepest = std::max(result.deepest, device.position());
    if (n < 2000) continue;
    low = std::min(low, device.position());
    high = std::max(high, device.position());
  }
  result.swing = high - low;
  result.energy = device.meter().minimum();
  return result;
}

using series = ph::series_passivity_controller<d1>;
using crediting = ph::series_passivity_controller<d1, ph::damping_credit::counted>;
using parallel = ph::parallel_passivity_controller<d1>;
using predicted_tank = ph::energy_tank<d1, ph::tank_outflow::predicted>;
using gate = ph::set_position_modulation<d1>;
using published_gate = ph::set_position_modulation<d1, ph::hold_leak::ignored>;

/// The books of 2002: the NEW force with the LAST displacement. For comparison only.
struct same_sample_controller {
  static constexpr ph::guarantee passivity = ph::guarantee::none;
  static constexpr ph::bound_traits traits{};
  double max_damping = 50.0;
  double energy = 0.0;
  [[nodiscard]] double limit(double desired, const auto& state) noexcept {
    const double dx = state.displacement;
    const double would_be = energy - desired * dx;
    const double damping =
        would_be < 0.0 && dx != 0.0 ? std::min(-would_be * state.dt / (dx * dx), max_damping) : 0.0;
    const double force = desired - damping * dx / state.dt;
    energy -= force * dx;
    return force;
  }
  [[nodiscard]] ph::parameter_fault<double> check() const noexcept { return {}; }
};

}  // namespace

// ---- series passivity controller ----------------------------------------------------------------

TEST_CASE("the series controller repays a deficit with a damper and carries what it may not take",
          "[time domain]") {
  series controller{.max_damping = 10.0};
  auto state = pressing();
  state.held = -2.0;
  SECTION("pressing in is income: nothing to do") {
    state.displacement = 1e-4;
    CHECK(controller.limit(-3.0, state) == -3.0);
    CHECK_THAT(controller.energy, WithinRel(2e-4, 1e-12));
  }
  SECTION("leaving: α = −E T/Δx², f = f* − α v, which pushes inwards") {
    state.displacement = -1e-3;  // pushed out with 2 N: E = −2 mJ, α would be 2 N·s/m
    CHECK_THAT(controller.limit(-1.0, state), WithinRel(-1.0 + 2.0, 1e-12));
  }
  SECTION("capped; the rest is still owed in the next tick") {
    state.displacement = -1e-4;  // E = −0.2 mJ, α would be 20
    CHECK_THAT(controller.limit(-1.0, state), WithinAbs(-1.0 + 10.0 * 0.1, 1e-12));
    state.held = 0.0;
    state.displacement = -1e-3;
    CHECK_THAT(controller.limit(0.0, state), WithinRel(0.2, 1e-12));  // −E/|Δx|
  }
  SECTION("no action below a speed or below a quantum") {
    controller.least_travel = 60e-6;
    controller.least_speed = 0.02;
    state.displacement = -59e-6;
    CHECK(controller.limit(-1.0, state) == -1.0);
    state.displacement = -61e-6;
    CHECK(controller.limit(-1.0, state) > -1.0);
    state.dt = state.longest_tick = 4e-3;  // 61 µm in 4 ms is 15 mm/s
    CHECK(controller.limit(-1.0, state) == -1.0);
    state.displacement = 0.0;
    CHECK(controller.limit(-1.0, state) == -1.0);
  }
  SECTION("a threshold below zero is a loan") {
    controller.threshold = -1e-3;
    state.displacement = -4e-4;
    CHECK(controller.limit(-1.0, state) == -1.0);
    CHECK(controller.limit(-1.0, state) > -1.0);
  }
  SECTION("the reference is the energy of the spring, in contact only") {
    controller.reference = 1.0;
    state.held = 0.0;
    state.displacement = 1e-4;  // K d²/2 = 0.5 mJ is wanted, nothing is there: α is at its cap
    CHECK_THAT(controller.limit(-1.0, state), WithinAbs(-1.0 - 1.0, 1e-12));
    CHECK(controller.limit(0.0, state) == 0.0);
    controller.energy = 0.51e-3;
    CHECK(controller.limit(-1.0, state) == -1.0);
  }
  SECTION("positive energy is voided after a force-free time, a debt is not") {
    controller.reset_after = 2e-3;
    controller.energy = 1e-3;
    state.held = 0.0;
    static_cast<void>(controller.limit(0.0, state));
    CHECK(controller.energy == 1e-3);
    static_cast<void>(controller.limit(0.0, state));
    CHECK(controller.energy == 0.0);
    controller.energy = -1e-3;
    static_cast<void>(controller.limit(0.0, state));
    CHECK(controller.energy == -1e-3);
  }
  SECTION("a lost motion voids credit once it has started, and never a debt") {
    controller.energy = 1e-3;
    state.motion_known = false;
    static_cast<void>(controller.limit(0.0, state));  // the very first tick: nothing was held yet
    CHECK(controller.energy == 1e-3);
    static_cast<void>(controller.limit(0.0, state));
    CHECK(controller.energy == 0.0);
    controller.energy = -1e-3;
    static_cast<void>(controller.limit(0.0, state));
    CHECK(controller.energy == -1e-3);
  }
  SECTION("a late tick is the worse of held and dropped") {
    state.dt = 2e-3;
    state.displacement = 1e-3;
    controller.energy = 1e-3;
    static_cast<void>(controller.limit(0.0, state));
    CHECK(controller.energy == 0.0);
    state.displacement = -1e-3;
    static_cast<void>(controller.limit(0.0, state));
    CHECK_THAT(controller.energy, WithinRel(-2e-3, 1e-12));
  }
}

TEST_CASE("the series controller damps along the motion in three dimensions, without an observer",
          "[time domain]") {
  using controller = ph::series_passivity_controller<d3>;
  auto model = following_half_space<d3>(ph::spring<d3>{}, ph::no_observer<d3>{},
                                        controller{.max_damping = 5.0});
  model.retarget({{0, 0, 0}, {0, 0, 1}, 1000.0});
  const d3::vector inside(0, 0, -1e-3), outside(1e-4, 0, 1e-3);
  static_cast<void>(model.tick(inside, T));
  static_cast<void>(model.tick(outside, T));  // pressed out by K d over 2 mm
  const d3::vector step(2e-4, 3e-4, 0);
  const d3::vector force = model.tick(outside + step, T).force;
  CHECK((force + 5.0 * step / T).norm() < 1e-12);
}

TEST_CASE("the damping credit makes the books of the series controller the true port energy",
          "[time domain]") {
  crediting controller{.max_damping = 50.0};
  sim::prescribed_motion<d1> device;
  sim::random_source random(3);
  auto sample = device.exchange(0.0);
  double x = 0.0, last = 0.0;
  for (int n = 0; n < 1000; ++n) {
    auto state = pressing();
    state.displacement = x - last;
    state.held = sample.held;
    last = x;
    const double force = controller.limit(-1000.0 * std::max(x, 0.0), state);
    x = random.uniform(-1e-3, 1e-3);
    device.move_to(x);
    sample = device.exchange(force);
  }
  auto state = pressing();
  state.displacement = x - last;
  state.held = sample.held;
  static_cast<void>(controller.limit(0.0, state));
  CHECK_THAT(controller.energy, WithinRel(device.meter().value(), 1e-10));
}

TEST_CASE("with the pairing of 2002 the controller never acts while the wall feeds the device",
          "[time domain]") {
  const fall bare = drop(ph::no_observer<d1>{}, ph::no_bound<d1>{});
  const fall blind = drop(ph::no_observer<d1>{}, same_sample_controller{});
  CHECK(blind.forces == bare.forces);
  CHECK(blind.energy < -1.0);
  const fall held = drop(ph::no_observer<d1>{}, series{.max_damping = 50.0});  // the control
  CHECK(held.energy > -0.02);
}

TEST_CASE("the series controller reproduces its rows of S0 (docs/design/mathematics.md § 5)",
          "[time domain]") {
  const fall plain = drop(ph::no_observer<d1>{}, series{.max_damping = 50.0});
  CHECK_THAT(plain.swing, WithinRel(42.6e-3, 0.01));
  CHECK_THAT(plain.energy, WithinRel(-18e-3, 0.02));
  const fall smooth = drop(thesis_ledger<d1>(), crediting{.max_damping = 50.0, .reference = 1.0});
  CHECK_THAT(smooth.swing, WithinRel(63.3e-3, 0.01));
  CHECK_THAT(smooth.energy, WithinRel(-5.7e-3, 0.02));
}

TEST_CASE("a deficit is repaid if the motion goes on and doubles if it turns round",
          "[time domain]") {
  const auto after = [](double next) {
    series controller{.max_damping = 1e9};
    auto state = pressing();
    state.held = -2.0;
    state.displacement = -1e-3;
    const double force = controller.limit(0.0, state);
    REQUIRE_THAT(controller.energy, WithinRel(-2e-3, 1e-12));
    state.held = force;
    state.displacement = next;
    static_cast<void>(controller.limit(0.0, state));
    return controller.energy;
  };
  CHECK_THAT(after(-1e-3), WithinAbs(0.0, 1e-15));
  CHECK_THAT(after(1e-3), WithinRel(-4e-3, 1e-12));
}

TEST_CASE("the series controller is not passive: a hand turns round and is fed", "[time domain]") {
  CHECK(worst_of<d1>(model_of<d1>(series{.max_damping = 50.0})) < -0.1);
  CHECK(tapped(series{.max_damping = 50.0}) < -1e-3);
  CHECK(tapped(crediting{.max_damping = 50.0, .reference = 1.0}) < -1e-3);
  CHECK(tapped(ph::strict_bound<d1>{}) >= -1e-12);  // the control
}

TEST_CASE("an α of half m/T stops a free mass and one of 2.1 m/T throws it", "[time domain]") {
  const auto speed_after_a_second = [](double share) {
    const double m = 0.1;
    auto model =
        model_of<d1>(series{.max_damping = share * m / T, .threshold = 1e12});  // α at its cap
    sim::device<d1> device({.mass = m, .damping = 0.0, .start_velocity = 0.1});
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 1000; ++n) sample = device.exchange(model.tick(sample).force);
    return std::abs(device.velocity());
  };
  CHECK(speed_after_a_second(0.35) < 1e-6);
  CHECK(speed_after_a_second(0.5) < 1e-6);
  CHECK(speed_after_a_second(2.1) > 1.0);
}

// ---- parallel passivity controller --------------------------------------------------------------

namespace {

/// A hand on a device that goes at the velocity it is told: a spring to the origin and a damper,
/// both passive. Held velocity, so the force falls linearly within a tick.
struct springy_hand {
  double stiffness = 2000.0, damping = 0.2;  ///< [N/m], [N·s/m]
  double x = 0.0;                            ///< [m]
  double energy = 0.0;                       ///< true, of the port [J]
  double first = 0.0, last = 0.0;            ///< force at the start and end of the tick [N]

  /// Goes at v for one tick; the mean force on the device over it.
  double move(double v) {
    first = -stiffness * x - damping * v;
    x += v * T;
    last = -stiffness * x - damping * v;
    energy += T * v * (first + last) / 2.0;
    return (first + last) / 2.0;
  }
};

/// A virtual mass of 50 g, displayed by velocity: the dual of a stiff wall.
struct virtual_mass {
  double mass = 0.05;  ///< [kg]
  double velocity(double held, double force) const { return held + T * force / mass; }
};

struct outcome {
  double energy = 0.0;  ///< least true port energy [J]
  double swing = 0.0;   ///< farthest from the origin in the last tenth [m]
  bool acted = false;
};
template <class Display>
outcome hold_a_virtual_mass(Display display) {
  springy_hand hand{.x = 1e-3};
  outcome result;
  double v = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double force = hand.move(v);
    const double wish = virtual_mass{}.velocity(v, force);
    v = display(wish, force);
    result.acted = result.acted || v != wish;
    result.energy = std::min(result.energy, hand.energy);
    if (n >= 900) result.swing = std::max(result.swing, std::abs(hand.x));
  }
  return result;
}

}  // namespace

TEST_CASE("the parallel controller leaks velocity along the force", "[time domain]") {
  parallel controller{.max_mobility = 0.1};
  CHECK(controller.velocity(0.2, 3.0, T) == 0.2);  // 3 N that follows gives energy
  SECTION("β = −(E + T v f)/(T f²), the predicted loss included") {
    // E = T 0.2 (−4) = −0.8 mJ; v* = 0.1: W = −1.2 mJ, β = 0.075
    CHECK_THAT(controller.velocity(0.1, -4.0, T), WithinRel(0.1 - 0.075 * 4.0, 1e-12));
    CHECK_THAT(controller.energy, WithinRel(-0.8e-3, 1e-12));
    CHECK_THAT(controller.velocity_held, WithinRel(-0.2, 1e-12));
  }
  SECTION("capped, and the rest is carried") {
    controller.max_mobility = 0.01;
    CHECK_THAT(controller.velocity(0.1, -4.0, T), WithinRel(0.1 - 0.04, 1e-12));
    controller.max_mobility = 10.0;
    // E = −0.8 mJ − 0.24 mJ, nothing desired
    CHECK_THAT(controller.velocity(0.0, -4.0, T), WithinRel(-0.26, 1e-12));
  }
  SECTION("no action below the noise of the sensor") {
    controller.least_force = 5.0;
    CHECK(controller.velocity(0.1, -4.0, T) == 0.1);
    CHECK(controller.velocity(0.1, 0.0, T) == 0.1);
  }
  SECTION("the velocity really held counts") {
    static_cast<void>(controller.velocity(0.0, -4.0, T, 0.05));
    CHECK_THAT(controller.energy, WithinRel(-0.2e-3, 1e-12));
  }
  SECTION("a bad sample stops the device and voids credit, not debt") {
    const double nan = std::nan("");
    controller.energy = 1.0;
    CHECK(controller.velocity(0.1, nan, T) == 0.0);
    CHECK(controller.energy == 0.0);
    controller.energy = -1.0;
    CHECK(controller.velocity(nan, 1.0, T) == 0.0);
    CHECK(controller.velocity(0.1, 1.0, 0.0) == 0.0);
    CHECK(controller.velocity(0.1, 1e300, T) == 0.0);
    CHECK(controller.energy == -1.0);
  }
  SECTION("in three dimensions, along the force") {
    ph::parallel_passivity_controller<f3> wide{.max_mobility = 0.01F};
    static_cast<void>(wide.velocity(f3::vector(1, 0, 0), f3::vector(0, 0, 0), 1e-3F));
    const f3::vector v = wide.velocity(f3::zero(), f3::vector(-1, 2, 0), 1e-3F);
    CHECK((v - f3::vector(-0.01F, 0.02F, 0)).norm() < 1e-7F);
  }
}

TEST_CASE("velocity held and mean force are the port energy; the end sample understates it",
          "[time domain]") {
  springy_hand hand{.stiffness = 2000.0, .damping = 0.2, .x = 1e-3};
  parallel controller{.max_mobility = 1e-9};
  sim::random_source random(5);
  double from_end = 0.0, from_start = 0.0, spring = 0.0, v = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double force = hand.move(v);
    from_end += T * v * hand.last;
    from_start += T * v * hand.first;
    spring += hand.stiffness * v * v * T * T / 2.0;
    v = controller.velocity(random.uniform(-0.1, 0.1), force, T);
  }
  CHECK_THAT(controller.energy, WithinRel(hand.energy, 1e-10));
  CHECK_THAT(from_end, WithinRel(hand.energy - spring, 1e-10));
  CHECK_THAT(from_start, WithinRel(hand.energy + spring, 1e-10));
}

TEST_CASE("the parallel controller calms a virtual mass that feeds a stiff hand", "[time domain]") {
  const outcome bare = hold_a_virtual_mass([](double wish, double) { return wish; });
  CHECK(bare.energy < -1.0);
  CHECK(bare.swing > 0.1);

  parallel controller{.max_mobility = 1.0};
  const outcome calm = hold_a_virtual_mass(
      [&](double wish, double force) { return controller.velocity(wish, force, T); });
  CHECK(calm.swing < 1e-3);
  CHECK(calm.energy > -1e-3);

  double energy = 0.0;  // the published pairing: the new velocity with the last force
  const outcome blind = hold_a_virtual_mass([&](double wish, double force) {
    const double would_be = energy + T * wish * force;
    const double mobility = would_be < 0.0 ? -would_be / (T * force * force) : 0.0;
    energy += T * (wish + mobility * force) * force;
    return wish + mobility * force;
  });
  CHECK_FALSE(blind.acted);
  CHECK(blind.energy < -1.0);
}

TEST_CASE("the parallel controller loses only what the force changes in a tick", "[time domain]") {
  parallel controller{.max_mobility = 1e12};
  sim::random_source random(7);
  double energy = 0.0, last = 0.0, v = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const double force = random.chance(0.2) ? random.uniform(-5.0, 5.0) : last;
    energy += T * v * force;
    if (n > 0) REQUIRE(energy >= T * v * (force - last) - 1e-12);
    v = controller.velocity(random.uniform(-0.2, 0.2), force, T);
    last = force;
  }
}

TEST_CASE("the parallel controller is not passive: a force that turns round each tick is fed",
          "[time domain]") {
  parallel controller{.max_mobility = 0.05};
  double energy = 0.0, v = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double force = n % 2 == 0 ? 5.0 : -5.0;
    energy += T * v * force;
    v = controller.velocity(virtual_mass{}.velocity(v, force), force, T);
  }
  CHECK(energy < -0.1);
}

// ---- energy tanks -------------------------------------------------------------------------------

TEMPLATE_TEST_CASE("a tank that counts the worst outflow is strict_bound to the bit",
                   "[time domain]", d1, f1, d2, f2, d3, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  ph::laws::samples random(11);
  const ph::isotropic_damping<TestType> damping{scalar(0.03)};
  const ph::energy_tank<TestType> tank, kept{.reserve = scalar(0.01)};
  const ph::strict_bound<TestType> strict;
  int bound = 0;
  for (int i = 0; i < 1000; ++i) {
    const vector normal = random.direction<TestType>();
    const vector held = random.vector<TestType>();
    const vector displacement = random.vector<TestType>() * scalar(1e-3);
    const scalar energy = random.number<scalar>() * scalar(0.1);
    const ph::tick_state<TestType> state{.damping = damping,
                                         .energy = energy,
                                         .in_flight = scalar(0),
                                         .dt = scalar(T),
                                         .longest_tick = scalar(T),
                                         .held = held,
                                         .displacement = displacement,
                                         .motion_known = true,
                                         .normal = normal,
                                         .stiffness = scalar(1000),
                                         .depth = scalar(0),
                                         .target_depth = scalar(1e-3),
                                         .local_force = scalar(0),
                                         .target_changed = false};
    const vector desired = normal * (scalar(5) * random.number<scalar>());
    REQUIRE(tank.limit(desired, state) == strict.limit(desired, state));
    auto less = state;
    less.energy = state.energy - scalar(0.01);
    REQUIRE(kept.limit(desired, state) == strict.limit(desired, less));
    bound += tank.limit(desired, state) == desired ? 0 : 1;
  }
  CHECK(bound > 100);
  CHECK(bound < 900);
}

TEST_CASE("a tank that counts the worst outflow never loses energy", "[time domain]") {
  const scene anything[] = {{}, {.jitter = true}, {.lost = 0.05}, {.late = 0.05}};
  for (const scene& when : anything) {
    CHECK(worst_of<d1>(model_of<d1>(ph::energy_tank<d1>{}), when) >= -1e-12);
    CHECK(worst_of<d2>(model_of<d2>(ph::energy_tank<d2>{}), when, 20) >= -1e-12);
    CHECK(worst_of<d3>(model_of<d3>(ph::energy_tank<d3>{}), when, 20) >= -1e-12);
    CHECK(worst_of<d1>(model_of<d1>(predicted_tank{}), when) < -1e-3);  // the control
  }
}

TEST_CASE("a tank never spends its reserve", "[time domain]") {
  const auto least_after_filling = [](double reserve) {
    auto model = model_of<d1>(ph::energy_tank<d1>{.reserve = reserve});
    model.retarget(wall<d1>(1e4));
    sim::prescribed_motion<d1> device;
    sim::greedy_motion<d1> motion;
    sim::random_source random(2);
    auto sample = device.exchange(0.0);
    double least = 1.0;
    for (int n = 0; n < 20000; ++n) {
      const auto out = model.tick(sample);
      if (n > 10000) least = std::min(least, device.meter().value());  // the ledger rounds down
      device.move_to(motion.next({device.position(), -1.0, device.position(), out.force}, random));
      sample = device.exchange(out.force);
    }
    return least;
  };
  CHECK(least_after_filling(1e-3) >= 1e-3);
  CHECK(least_after_filling(0.0) < 1e-3);
}

TEST_CASE("a tank that predicts its outflow passes all but what the last motion would take",
          "[time domain]") {
  const predicted_tank tank{.reserve = 1e-3};
  auto state = pressing();
  state.energy = 3e-3;
  state.displacement = 1e-3;  // going in
  CHECK(tank.limit(-100.0, state) == -100.0);
  state.displacement = -1e-3;
  CHECK(tank.limit(-1.5, state) == -1.5);
  CHECK_THAT(tank.limit(-8.0, state), WithinRel(-2.0, 1e-12));
  state.longest_tick = 2e-3;
  CHECK_THAT(tank.limit(-8.0, state), WithinRel(-1.0, 1e-12));
  state.energy = 0.5e-3;
  CHECK(tank.limit(-8.0, state) == 0.0);
  state.motion_known = false;  // nothing to predict from: the worst case
  state.energy = 3e-3;
  CHECK_THAT(tank.limit(-80.0, state), WithinRel(-std::sqrt(4.0 * 2e-3 * 0.03 / 2e-3), 1e-12));
}

TEST_CASE("a tank that predicts its outflow feeds a hand of 5 N, one that does not, does not",
          "[time domain]") {
  CHECK(tapped(predicted_tank{}) < -1e-3);
  CHECK(tapped(ph::energy_tank<d1>{}) >= -1e-12);
}

namespace {

const ph::two_layer_tank<d1> level_tank{.wanted = 0.015, .refill = 3000.0, .max_damping = 50.0};

}  // namespace

TEST_CASE("the two-layer tank lets out at most what it holds and takes all that comes in",
          "[time domain]") {
  ph::two_layer_tank<d1> tank{.energy = 2e-3};
  auto state = pressing();
  SECTION("on the way out T f·v ≤ H") {
    state.displacement = -1e-3;  // 0.03 mJ of damping is credited
    CHECK_THAT(tank.limit(-8.0, state), WithinRel(-2.03, 1e-12));
    CHECK(tank.limit(-1.0, state) == -1.0);
  }
  SECTION("on the way in anything") {
    state.displacement = 1e-3;
    CHECK(tank.limit(-8.0, state) == -8.0);
    tank.energy = 0.0;
    CHECK(tank.limit(-8.0, state) == -8.0);
  }
  SECTION("the map holds on the way out") {
    tank.force_per_joule = 100.0;
    state.displacement = -1e-6;
    CHECK_THAT(tank.limit(-8.0, state), WithinRel(-0.2, 1e-6));
    state.displacement = 1e-6;
    CHECK(tank.limit(-8.0, state) == -8.0);
  }
  SECTION("the level controller drags until the level is there") {
    tank.wanted = 3e-3;
    tank.refill = 1e4;
    tank.max_damping = 50.0;
    state.displacement = 1e-4;  // H = 2.0003 mJ: d = 9.997 N·s/m
    CHECK_THAT(tank.limit(0.0, state), WithinRel(-9.997 * 0.1, 1e-12));
    tank.refill = 1e6;
    CHECK_THAT(tank.limit(0.0, state), WithinRel(-50.0 * 0.1, 1e-12));
    tank.energy = 3e-3;
    CHECK(tank.limit(0.0, state) == 0.0);
  }
  SECTION("the ledger: held force, damping, cap, lost and late ticks") {
    tank.cap = 4e-3;
    state.held = -1.0;
    state.displacement = 1e-3;
    static_cast<void>(tank.limit(0.0, state));
    CHECK_THAT(tank.energy, WithinRel(3.03e-3, 1e-12));
    static_cast<void>(tank.limit(0.0, state));
    CHECK(tank.energy == 4e-3);
    state.dt = 2e-3;
    static_cast<void>(tank.limit(0.0, state));
    CHECK(tank.energy == 0.0);
    tank.energy = 1e-3;
    state.motion_known = false;
    CHECK(tank.limit(-1.0, state) == 0.0);
    CHECK(tank.energy == 0.0);
  }
  SECTION("its first tick keeps the loan") {
    state.motion_known = false;
    static_cast<void>(tank.limit(0.0, state));
    CHECK(tank.energy == 2e-3);
  }
}

TEST_CASE("the two-layer tank reproduces the swing of S0 (docs/design/mathematics.md § 5)",
          "[time domain]") {
  CHECK_THAT(drop(thesis_ledger<d1>(), level_tank).swing, WithinRel(47.7e-3, 0.1));
}

TEST_CASE("the two-layer tank is not passive, with strict_bound behind it it is", "[time domain]") {
  CHECK(tapped(level_tank) < -1e-4);
  CHECK(worst_of<d1>(model_of<d1>(level_tank)) < -1e-3);
  const ph::bound_chain chain{level_tank, ph::strict_bound<d1>{}};
  static_assert(decltype(chain)::passivity == ph::guarantee::strict);
  CHECK(tapped(chain) >= -1e-12);
  CHECK(worst_of<d1>(model_of<d1>(chain)) >= -1e-12);
}

// ---- passive set-position modulation ------------------------------------------------------------

TEST_CASE("the gate lets an update add only what its tank holds", "[time domain]") {
  gate pspm{.energy = 1e-3};
  auto state = pressing();
  state.stiffness = 50.0;
  state.target_depth = 0.0;
  state.target_changed = true;
  CHECK(pspm.limit(0.0, state) == 0.0);
  state.target_depth = 2e-3;  // K d²/2 = 0.1 mJ: covered
  CHECK(pspm.limit(-0.1, state) == -0.1);
  CHECK_THAT(pspm.energy, WithinRel(0.9e-3, 1e-12));
  SECTION("too far: K d²/2 = U_old + E") {
    state.target_depth = 10e-3;  // 2.5 mJ are asked, 1 mJ is there
    CHECK_THAT(pspm.limit(-0.5, state), WithinRel(-50.0 * std::sqrt(2e-3 / 50.0), 1e-12));
    CHECK_THAT(pspm.energy, WithinAbs(0.0, 1e-15));
    SECTION("the gap stays while the spring is left alone") {
      const double gap = pspm.spring.gap;
      state.target_changed = false;
      state.held = -50.0 * pspm.spring.depth;
      state.displacement = 1e-3;
      state.target_depth = 11e-3;
      CHECK_THAT(pspm.limit(-0.55, state), WithinRel(-50.0 * (11e-3 - gap), 1e-9));
      CHECK_THAT(pspm.spring.gap, WithinRel(gap, 1e-9));
    }
    SECTION("the surface follows the device out") {
      state.target_changed = false;
      state.held = -50.0 * pspm.spring.depth;
      state.displacement = -8e-3;
      state.target_depth = 2e-3;
      CHECK(pspm.limit(-0.1, state) == 0.0);
      CHECK(pspm.spring.gap == 2e-3);
    }
    SECTION("the target is asked for again") {
      pspm.energy = 5e-3;
      state.target_changed = false;
      state.held = -50.0 * pspm.spring.depth;
      for (int n = 0; n < 19; ++n) REQUIRE(pspm.limit(-0.5, state) > -0.5);
      CHECK(pspm.limit(-0.5, state) == -0.5);
    }
  }
  SECTION("a retreating surface refills the tank, up to its cap") {
    pspm.cap = 0.95e-3;
    state.held = -0.1;
    state.target_depth = 1e-3;  // 0.075 mJ come back
    static_cast<void>(pspm.limit(-0.05, state));
    CHECK(pspm.energy == 0.95e-3);
  }
  SECTION("the damper refills it: (b − KT/2) range²/time") {
    state.held = -0.1;
    state.target_changed = false;
    for (const double travel : {3e-4, 3e-4, -1e-4}) {
      state.displacement = travel;
      state.target_depth += travel;
      state.held = -50.0 * pspm.spring.depth;
      static_cast<void>(pspm.limit(-50.0 * state.target_depth, state));
    }
    CHECK_THAT(pspm.energy, WithinRel(0.9e-3, 1e-9));
    state.displacement = 0.0;
    state.held = -50.0 * pspm.spring.depth;
    state.target_changed = true;  // four ticks after the last one
    static_cast<void>(pspm.limit(-50.0 * state.target_depth, state));
    CHECK_THAT(pspm.energy, WithinRel(0.9e-3 + (0.03 - 0.025) * 36e-8 / 4e-3, 1e-9));
  }
  SECTION("what was not held is booked") {
    state.target_changed = false;
    state.displacement = 1e-3;
    state.target_depth = 3e-3;
    state.held = -0.04;  // 0.06 N less than the spring had
    static_cast<void>(pspm.limit(-0.15, state));
    CHECK_THAT(pspm.energy, WithinRel(0.9e-3 - 0.06e-3, 1e-9));
  }
  SECTION("a lost or late tick leaves neither spring nor credit") {
    state.target_changed = false;
    SECTION("lost") {
      state.motion_known = false;
    }
    SECTION("late") {
      state.dt = 1.1e-3;
    }
    CHECK(pspm.limit(-0.1, state) == 0.0);
    CHECK(pspm.energy == 0.0);
  }
}

TEST_CASE("on a static wall stiffer than 2b/T the gate is the same as no bound", "[time domain]") {
  const fall bare = drop(thesis_ledger<d1>(), ph::no_bound<d1>{});
  const fall gated = drop(thesis_ledger<d1>(), published_gate{});
  CHECK(bare.energy < -1.0);
  CHECK_THAT(gated.energy, WithinRel(bare.energy, 1e-6));
  CHECK_THAT(gated.swing, WithinRel(bare.swing, 1e-6));
  CHECK(tapped(gate{}) < -1.0);
}

TEST_CASE("with K ≤ 2b/T the gate loses nothing to an environment that jumps, a bare spring does",
          "[time domain]") {
  const scene anything[] = {{.low = 20, .high = 2 * B},
                            {.low = 20, .high = 2 * B, .jitter = true},
                            {.low = 20, .high = 2 * B, .lost = 0.05},
                            {.low = 20, .high = 2 * B, .late = 0.05},
                            {.low = 20, .high = 2 * B, .force_limit = 0.03},
                            {.low = 2 * B, .high = 2 * B}};
  const auto turning = [](auto bound) {
    return ph::local_model{d3{},
                           ph::following<ph::half_space<d3>>{},
                           ph::rotate_limited<d3>{.rate = 4.0},
                           ph::spring<d3>{},
                           thesis_ledger<d3>(),
                           bound};
  };
  using gate3 = ph::set_position_modulation<d3>;
  for (const scene& when : anything) {
    CHECK(worst_of<d1>(model_of<d1>(gate{}), when) >= -1e-12);
    CHECK(worst_of<d2>(model_of<d2>(ph::set_position_modulation<d2>{}), when, 20) >= -1e-12);
    CHECK(worst_of<d3>(model_of<d3>(gate3{}), when, 20) >= -1e-12);
    CHECK(worst_of<d3>(turning(gate3{}), when, 20) >= -1e-12);
    CHECK(worst_of<d1>(model_of<d1>(ph::no_bound<d1>{}), when) < -1e-5);  // the controls
    CHECK(worst_of<d3>(turning(ph::no_bound<d3>{}), when, 20) < -1e-6);
  }
  const scene stiff{.low = 4 * B, .high = 4 * B};
  CHECK(worst_of<d1>(model_of<d1>(gate{}), stiff) < -1e-6);  // outside its assumption
}

TEST_CASE("the gate as published spends the damper twice: once on the hold, once on the update",
          "[time domain]") {
  const auto press_jump_leave = [](auto bound) {
    auto model = model_of<d1>(bound);
    model.retarget(wall<d1>(2 * B));
    sim::prescribed_motion<d1> device;
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 40; ++n) {
      if (n == 8) model.retarget({-4e-3, -1.0, 2 * B});
      const double force = model.tick(sample).force;
      device.move_to(device.position() + (n < 8 ? 0.5e-3 : -0.25e-3));
      sample = device.exchange(force);
    }
    return device.meter().minimum();
  };
  CHECK_THAT(press_jump_leave(published_gate{.ask_again = 1.0}), WithinRel(-8 * B * 0.25e-6, 0.05));
  CHECK(press_jump_leave(gate{.ask_again = 1.0}) >= -1e-12);
}

TEST_CASE("the gate covers what comes in over an edge and what fades out", "[time domain]") {
  const auto wander = [](auto bound, const ph::freshness<double>& rule, std::uint64_t seed) {
    ph::local_model model{d2{},
                          ph::following<ph::segment<d2>>{rule},
                          ph::snap<d2>{},
                          ph::spring<d2>{},
                          thesis_ledger<d2>(),
                          bound};
    sim::prescribed_motion<d2> device({.damping = 0.03});
    sim::random_source random(seed);
    sim::jumping_surface jumps(1e-3, seed);
    auto sample = device.exchange(d2::zero());
    double offset = 1.0;
    for (int n = 0; n < 3000; ++n) {
      const double moved = jumps.offset(device.time());
      if (moved != offset) {
        offset = moved;
        model.retarget({.a = {1e-3, moved}, .b = {-1e-3, moved}, .stiffness = 2 * B});
      }
      const d2::vector force = model.tick(sample).force;
      device.move_to(
          d2::vector(device.position() + random.direction<d2>() * random.uniform(0.0, 0.3e-3)) *
          0.98);
      sample = device.exchange(force);
    }
    return device.meter().minimum();
  };
  const ph::freshness<double> never{}, soon{.stale_after = 0.01, .fade = 0.02};
  for (const auto& rule : {never, soon}) {
    double worst = 0.0, control = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      worst = std::min(worst, wander(ph::set_position_modulation<d2>{}, rule, seed));
      control = std::min(control, wander(ph::no_bound<d2>{}, rule, seed));
    }
    CHECK(worst >= -1e-12);
    CHECK(control < -1e-5);
  }
}

TEST_CASE("the gate gives no spring for a way in that was not paid", "[time domain]") {
  // 4 mm in without a force, then into a full contact at once, then slowly out again
  const double step = 0.25e-3;
  const auto beside_then_under = [step](auto bound) {
    auto model = ph::local_model{d2{},
                                 ph::following<ph::segment<d2>>{},
                                 ph::snap<d2>{},
                                 ph::spring<d2>{},
                                 thesis_ledger<d2>(),
                                 bound};
    model.retarget({.a = {1e-3, 0}, .b = {-1e-3, 0}, .stiffness = 2 * B});
    sim::prescribed_motion<d2> device({.damping = 0.03, .start = {1.5e-3, 0}});
    auto sample = device.exchange(d2::zero());
    for (int n = 0; n < 60; ++n) {
      const d2::vector force = model.tick(sample).force;
      const d2::vector way = n < 16   ? d2::vector(0, -step)
                             : n < 20 ? d2::vector(-step, 0)
                                      : d2::vector(0, step / 2);
      device.move_to(device.position() + way);
      sample = device.exchange(force);
    }
    return device.meter().value();
  };
  const auto faded_then_back = [step](auto bound) {
    auto model =
        ph::local_model{d1{},
                        ph::following<ph::half_space<d1>>{{.stale_after = 2e-3, .fade = T}},
                        ph::snap<d1>{},
                        ph::spring<d1>{},
                        thesis_ledger<d1>(),
                        bound};
    sim::prescribed_motion<d1> device;
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 60; ++n) {
      if (n == 0 || n >= 20) model.retarget(wall<d1>(2 * B));
      const double force = model.tick(sample).force;
      device.move_to(device.position() + (n < 4 ? 0.0 : n < 20 ? step : -step / 2));
      sample = device.exchange(force);
    }
    return device.meter().value();
  };
  CHECK(beside_then_under(ph::set_position_modulation<d2>{}) >= -1e-12);
  CHECK(beside_then_under(ph::no_bound<d2>{}) < -1e-4);
  CHECK(faded_then_back(gate{}) >= -1e-12);
  CHECK(faded_then_back(ph::no_bound<d1>{}) < -1e-4);
}

TEST_CASE("the gate in front of strict_bound is strict at any stiffness", "[time domain]") {
  const ph::bound_chain chain{gate{}, ph::strict_bound<d1>{}};
  static_assert(decltype(chain)::passivity == ph::guarantee::strict);
  static_assert(gate::passivity == ph::guarantee::conditional);
  static_assert(published_gate::passivity == ph::guarantee::none);
  CHECK(worst_of<d1>(model_of<d1>(chain)) >= -1e-12);
  CHECK(worst_of<d1>(model_of<d1>(chain), {.lost = 0.05, .late = 0.05}) >= -1e-12);
  CHECK(tapped(chain) >= -1e-12);
  CHECK(worst_of<d1>(model_of<d1>(gate{})) < -1e-3);  // without it, at 2 to 22 kN/m
}

// ---- all of them --------------------------------------------------------------------------------

namespace {

/// Something of everything, evaluated by the compiler.
template <class Space>
constexpr bool runs_at_compile_time() {
  using scalar = typename Space::scalar;
  const ph::isotropic_damping<Space> damping{scalar(0.03)};
  ph::tick_state<Space> state{.damping = damping,
                              .energy = scalar(0.001),
                              .in_flight = scalar(0),
                              .dt = scalar(0.001),
                              .longest_tick = scalar(0.001),
                              .held = scalar(-2),
                              .displacement = scalar(-0.001),
                              .motion_known = true,
                              .normal = scalar(-1),
                              .stiffness = scalar(50),
                              .depth = scalar(0),
                              .target_depth = scalar(0.02),
                              .local_force = scalar(0),
                              .target_changed = true};
  const scalar f = scalar(-1);
  ph::series_passivity_controller<Space, ph::damping_credit::counted> damper{.max_damping =
                                                                                 scalar(5)};
  ph::parallel_passivity_controller<Space> leak{.max_mobility = scalar(1)};
  ph::two_layer_tank<Space> layers{
      .wanted = scalar(0.001), .refill = scalar(10), .max_damping = scalar(5)};
  ph::set_position_modulation<Space> pspm{};
  return damper.limit(f, state) > f && leak.velocity(scalar(1), scalar(-1), state.dt) < scalar(1) &&
         ph::energy_tank<Space>{}.limit(f, state) > f && layers.limit(f, state) > f &&
         pspm.limit(f, state) == scalar(0);
}
static_assert(runs_at_compile_time<d1>() && runs_at_compile_time<f1>());

}  // namespace

TEMPLATE_TEST_CASE("they run in one to three dimensions and in float", "[time domain]", d1, f1, d2,
                   f2, d3, f3) {
  using scalar = typename TestType::scalar;
  const double slack = sizeof(scalar) == 4 ? 1e-6 : 1e-12;  // positions in float are rounded
  const scene weak{.low = 20, .high = 2 * B};
  using tank = ph::energy_tank<TestType>;
  CHECK(worst_of<TestType>(model_of<TestType>(tank{}), {}, 5) >= -slack);
  CHECK(worst_of<TestType>(model_of<TestType>(ph::set_position_modulation<TestType>{}), weak, 5) >=
        -slack);
  const ph::series_passivity_controller<TestType> damper{.max_damping = scalar(50)};
  const ph::two_layer_tank<TestType> layers{
      .wanted = scalar(0.015), .refill = scalar(3000), .max_damping = scalar(50)};
  CHECK(worst_of<TestType>(model_of<TestType>(damper), {}, 5) < -1e-3);
  CHECK(worst_of<TestType>(model_of<TestType>(layers), {}, 5) < -1e-4);
}

TEST_CASE("parameters of the time-domain controllers are refused with their name",
          "[time domain]") {
  const double nan = std::nan("");
  const auto fault = [](const auto& policy) { return std::string(policy.check().parameter); };
  CHECK_FALSE(series{.max_damping = 50}.check());
  CHECK(fault(series{}) == "max_damping");
  CHECK(fault(series{.max_damping = 50, .threshold = nan}) == "threshold");
  CHECK(fault(series{.max_damping = 50, .reference = 1.1}) == "reference");
  CHECK(fault(series{.max_damping = 50, .least_speed = -1}) == "least_speed");
  CHECK(fault(series{.max_damping = 50, .least_travel = nan}) == "least_travel");
  CHECK(fault(series{.max_damping = 50, .reset_after = nan}) == "reset_after");
  CHECK(fault(series{.max_damping = 50, .energy = -1}) == "energy");
  CHECK_FALSE(parallel{.max_mobility = 1}.check());
  CHECK(fault(parallel{}) == "max_mobility");
  CHECK(fault(parallel{.max_mobility = 1, .threshold = nan}) == "threshold");
  CHECK(fault(parallel{.max_mobility = 1, .least_force = -1}) == "least_force");
  CHECK(fault(parallel{.max_mobility = 1, .energy = -1}) == "energy");
  CHECK_FALSE(ph::energy_tank<d1>{}.check());
  CHECK(fault(ph::energy_tank<d1>{.reserve = -1}) == "reserve");
  CHECK_FALSE(level_tank.check());
  using layers = ph::two_layer_tank<d1>;
  CHECK(fault(layers{.wanted = nan}) == "wanted");
  CHECK(fault(layers{.refill = -1}) == "refill");
  CHECK(fault(layers{.max_damping = -1}) == "max_damping");
  CHECK(fault(layers{.force_per_joule = 0}) == "force_per_joule");
  CHECK(fault(layers{.wanted = 1, .cap = 0.5}) == "cap");
  CHECK(fault(layers{.energy = nan}) == "energy");
  CHECK_FALSE(gate{}.check());
  CHECK(fault(gate{.energy = -1}) == "energy");
  CHECK(fault(gate{.cap = -1}) == "cap");
  CHECK(fault(gate{.ask_again = 0}) == "ask_again");
  CHECK(fault(gate{.spring = {.stiffness = 1}}) == "spring.stiffness");
}
