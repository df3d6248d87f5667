// SPDX-License-Identifier: BSD-3-Clause
// Encoders with steps: what quantised_energy is sure of, against the true port energy.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double step = 6e-5;  // [m]

template <class Space>
constexpr ph::quantised_energy<Space> sure(double quantum = step) {
  using scalar = typename Space::scalar;
  return {.damping = scalar(0.03), .quantum = static_cast<scalar>(quantum)};
}

/// A random hand on random forces: the most by which the observer exceeds the truth [J].
template <class Space, class Observer>
double worst_overstatement(const Observer& start, double amplitude, std::uint64_t seed) {
  using state = typename sim::physical<Space>::vector;
  Observer observer = start;
  sim::random_source random(seed);
  sim::prescribed_motion<Space> device({.damping = 0.03, .quantum = step});
  auto sample = device.exchange(Space::zero());
  typename Space::vector last = sample.position;
  state force = Space::zero();
  double worst = -1.0;
  for (int n = 0; n < 3000; ++n) {
    // A force that changes with the true position within the step: what hurts most.
    if (random.chance(0.5)) force = state(random.direction<Space>() * 5.0);
    const double toward = random.chance(0.5) ? 1.0 : -1.0;
    device.move_to(device.position() + force * (toward * amplitude * random.uniform() / 5.0));
    sample = device.exchange(force);
    observer.update(typename Space::vector(sample.position) - last, sample.held, sample.dt);
    last = sample.position;
    worst = std::max(worst, observer.value() - device.meter().value());
  }
  return worst;
}

/// Taps with 5 N on a device whose encoders have steps, the surface jumping; least port energy.
template <class Observer, class Bound>
double tapped(const Observer& observer, const Bound& bound, std::uint64_t seed) {
  auto model = following_half_space<d1>(ph::spring<d1>{}, observer, bound);
  model.retarget(wall<d1>(1e4));
  sim::device<d1, sim::tapping_hand<d1>> device(
      {.mass = 0.1, .quantum = step, .start = -1e-5 * static_cast<double>(seed)},
      {.surface = 0.0, .normal = -1.0, .limit = 5.0});
  sim::random_source random(seed);
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 3000; ++n) {
    if (seed > 10 && n % 40 == 0) model.retarget({random.uniform(-1e-3, 1e-3), -1.0, 1e4});
    sample = device.exchange(model.tick(sample).force);
  }
  return device.meter().minimum();
}

template <class Space, class Observer, class Motion>
double attacked(const Observer& observer, Motion motion, std::uint64_t seed) {
  using state = typename sim::physical<Space>::vector;
  auto model =
      following_half_space<Space>(ph::spring<Space>{}, observer, ph::strict_bound<Space>{});
  sim::random_source random(seed);
  const state normal = random.direction<Space>();
  sim::jumping_surface jumps(5e-4, seed);
  sim::prescribed_motion<Space> device({.damping = 0.03, .quantum = step});
  auto sample = device.exchange(Space::zero());
  double offset = 1.0;
  for (int n = 0; n < 2000; ++n) {
    const double moved = jumps.offset(device.time());
    if (moved != offset) {
      offset = moved;
      model.retarget({state(normal * offset), normal, 2e4});
    }
    const auto out = model.tick(sample);
    const double depth = offset - sim::physical<Space>::dot(device.position(), normal);
    device.move_to(motion.next(
        {.position = device.position(), .normal = normal, .depth = depth, .force = out.force},
        random));
    sample = device.exchange(out.force);
  }
  return device.meter().minimum();
}

template <class Space, class Observer>
double worst_attack(const Observer& observer) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    for (const double speed : {0.5, 0.06, 0.03}) {
      worst =
          std::min(worst, attacked<Space>(observer, sim::random_walk<Space>{.speed = speed}, seed));
      worst = std::min(worst,
                       attacked<Space>(observer, sim::greedy_motion<Space>{.speed = speed}, seed));
    }
    worst = std::min(
        worst, attacked<Space>(observer, sim::nyquist_motion<Space>{.amplitude = 2.9e-5}, seed));
  }
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE("quantised_energy never exceeds the true port energy, whatever the motion",
                   "[quantised]", d1, d2, d3) {
  double plain = -1.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double amplitude : {1e-5, 1e-4, 1e-3}) {
      CHECK(worst_overstatement<TestType>(sure<TestType>(), amplitude, seed) <= 1e-12);
      plain = std::max(plain,
                       worst_overstatement<TestType>(thesis_ledger<TestType>(), amplitude, seed));
    }
  }
  CHECK(plain > 1e-4);  // the control: the ledger that takes the positions for exact
}

TEST_CASE("quantised_energy without steps is reduced_energy", "[quantised]") {
  auto quantised = sure<d3>(0.0);
  auto reduced = thesis_ledger<d3>();
  ph::laws::samples random(1);
  for (int n = 0; n < 1000; ++n) {
    const d3::vector dx = random.vector<d3>() * 1e-4;
    const d3::vector held = random.vector<d3>();
    quantised.update(dx, held, 1e-3);
    reduced.update(dx, held, 1e-3);
    CHECK_THAT(quantised.value(), WithinAbs(reduced.value(), 1e-13));
  }
  CHECK(quantised.displacement_error() == 0.0);
  CHECK_THAT(sure<d3>().displacement_error(), WithinRel(step * std::sqrt(3.0), 1e-12));
}

TEST_CASE("the window sees slow motions that no single tick can show (L1)", "[quantised]") {
  const auto credit = [](double window) {
    auto observer = sure<d1>();
    observer.window = window;
    for (int n = 0; n < 1000; ++n) observer.update(n % 3 == 0 ? step : 0.0, 0.0, 1e-3);
    return observer.value();
  };
  CHECK(credit(1e-3) == 0.0);  // 20 mm/s: a step every third tick, each within the doubt
  const double exact = 0.03 * 0.02 * 0.02;
  CHECK(credit(0.032) > 0.6 * exact);
  CHECK(credit(0.128) > 0.85 * exact);
  CHECK(credit(0.128) < exact);
}

TEST_CASE("quantised_energy keeps the laws of an observer", "[quantised]") {
  static_assert(ph::laws::never_overstates<d1>(sure<d1>(1e-5)));
  static_assert(ph::laws::forfeit_never_credits<f1>(sure<f1>(1e-5)));
  CHECK(ph::laws::never_overstates<d3>(sure<d3>(1e-5)));
  CHECK(ph::laws::forfeit_never_credits<d3>(sure<d3>(1e-5)));
}

TEST_CASE("strict_bound on quantised_energy never loses, on the plain ledger it does (§ 3)",
          "[quantised]") {
  CHECK(worst_attack<d1>(sure<d1>()) >= -1e-12);
  CHECK(worst_attack<d2>(sure<d2>()) >= -1e-12);
  CHECK(worst_attack<d3>(sure<d3>()) >= -1e-12);
  CHECK(worst_attack<d1>(thesis_ledger<d1>()) < -1e-5);  // the controls
  CHECK(worst_attack<d1>(sure<d1>(step / 3)) < -1e-7);   // a step stated too fine
}

TEST_CASE("reachable_bound on quantised_energy survives a tapping hand, not on the plain ledger",
          "[quantised]") {
  const ph::reachable_bound<d1> bound{.mass = 0.1, .hand_force = 5.0};
  double control = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CHECK(tapped(sure<d1>(), bound, seed) >= -1e-12);
    control = std::min(control, tapped(thesis_ledger<d1>(), bound, seed));
  }
  CHECK(control < -1e-6);
}

TEST_CASE("the loan of quantised_energy is what it may lose, and no more", "[quantised]") {
  auto lent = sure<d1>();
  lent.energy = 2e-3;
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    worst = std::min(worst, attacked<d1>(lent, sim::greedy_motion<d1>{.speed = 0.5}, seed));
  }
  CHECK(worst >= -2e-3 - 1e-12);
  CHECK(worst < -1e-3);
}

TEST_CASE("a bad parameter of quantised_energy is refused with its name", "[quantised]") {
  const auto refused = [](const ph::quantised_energy<d1>& ledger) {
    const auto fault = ledger.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({.damping = 0.03, .quantum = step}).empty());
  CHECK(refused({.damping = 0.0, .quantum = step}) == "damping");
  CHECK(refused({.damping = 0.03, .quantum = -1.0}) == "quantum");
  CHECK(refused({.damping = 0.03, .quantum = std::nan("")}) == "quantum");
  CHECK(refused({.damping = 0.03, .cap = -1.0}) == "cap");
  CHECK(refused({.damping = 0.03, .window = 0.0}) == "window");
  CHECK(refused({.damping = 0.03, .energy = -1.0}) == "energy");
}
