// SPDX-License-Identifier: BSD-3-Clause
// The meter that users add to their own loop, against the simulator's exact one.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/port_meter.hpp>

#include <cmath>
#include <limits>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;

namespace {

struct metered {
  double exact = 0.0, exact_least = 0.0, shown = 0.0, shown_least = 0.0, bare_least = 0.0;
};
/// A hand taps on 8 kN/m for ten seconds.
template <class Force>
metered tapped(Force force, double b) {
  sim::device<d1, sim::impedance_hand<d1>> device(
      {.mass = 0.1, .damping = b, .start = 0.01},
      {.stiffness = 300.0, .damping = 1.0, .limit = 5.0, .target = 0.0});
  sim::port_meter<d1> meter{b}, without_damper{0.0};
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 10000; ++n) {
    device.hand().target = 0.01 * std::cos(0.05 * n);
    meter.add(sample);
    without_damper.add(sample);
    sample = device.exchange(force(sample));
  }
  meter.add(sample);
  return {device.meter().value(), device.meter().minimum(), meter.value(), meter.least(),
          without_damper.least()};
}

}  // namespace

TEST_CASE("port_meter sees what the simulator's meter sees, and never more", "[simulation]") {
  const auto spring = [](const auto& s) { return s.position < 0.0 ? -8000.0 * s.position : 0.0; };
  ph::passive_port port{d1{}, ph::given_force{}, ph::reduced_energy{.damping = 0.2},
                        ph::strict_bound{}, ph::loop_limits{.longest_tick = 1e-3}};
  const auto kept = tapped([&](const auto& s) { return port.tick(s, spring(s)).force; }, 0.2);
  CHECK(kept.exact_least >= 0.0);
  CHECK(kept.shown_least >= -1e-12);
  CHECK(kept.shown <= kept.exact + 1e-12);
  CHECK_THAT(kept.shown, WithinAbs(kept.exact, 0.01 * kept.exact));  // what a tick hides
  CHECK(kept.bare_least < -1e-4);  // −Σ f·Δx alone, of a port that keeps its promise

  const auto lost = tapped(spring, 0.2);
  CHECK(lost.exact_least < -1e-3);
  CHECK(lost.shown_least < -1e-3);
}

TEST_CASE("port_meter passes over what is no sample", "[simulation]") {
  sim::port_meter<d1> meter{1.0};
  meter.add({.position = 0.0, .held = 0.0, .dt = 1e-3, .valid = true});
  meter.add({.position = 1e-3, .held = 2.0, .dt = 1e-3, .valid = true});
  CHECK_THAT(meter.value(), WithinAbs(1e-3 - 2e-3, 1e-15));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  meter.add({.position = nan, .held = 2.0, .dt = 1e-3, .valid = true});
  meter.add(
      {.position = 5.0, .held = 2.0, .dt = 1e-3, .valid = true});  // nobody knows the way there
  meter.add({.position = 5.0, .held = 2.0, .dt = 0.0, .valid = true});
  meter.add({.position = 9.0, .held = nan, .dt = 1e-3, .valid = true});
  meter.add({.position = 9.0, .held = 2.0, .dt = 1e-3, .valid = false});
  CHECK_THAT(meter.value(), WithinAbs(-1e-3, 1e-15));
  CHECK_THAT(meter.least(), WithinAbs(-1e-3, 1e-15));
}
