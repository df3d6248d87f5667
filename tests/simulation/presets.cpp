// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/presets.hpp>

#include <set>
#include <string>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinRel;

TEST_CASE("every preset is a device, with rigid friction and with elastic", "[simulation]") {
  std::set<std::string> names;
  for (const auto& preset : sim::all_presets) {
    CAPTURE(preset.name);
    names.insert(preset.name);
    const sim::device<line> rigid(preset.parameters<line>());
    CHECK_FALSE(rigid.check());
    CHECK(rigid.parameters().friction == preset.friction);
    CHECK(rigid.parameters().force_limit == preset.force_limit);
    using elastic = sim::device<room, sim::no_hand<room>, sim::slider_and_spring>;
    CHECK_FALSE(elastic(preset.without_friction<room>(), {}, preset.friction_of(5e-6)).check());
    CHECK(elastic(preset.without_friction<room>(), {}, preset.friction_of(0.0)).check());
  }
  CHECK(names.size() == sim::all_presets.size());
}

TEST_CASE("a wheel at its rim stores and takes what the wheel does", "[simulation]") {
  constexpr sim::wheel_preset wheel{};
  constexpr auto rim = wheel.at_rim();
  constexpr double turning = 3.0, speed = turning * wheel.radius;  // [rad/s], [m/s]
  CHECK_THAT(rim.mass * speed * speed, WithinRel(wheel.inertia * turning * turning, 1e-12));
  CHECK_THAT(rim.damping * speed * speed, WithinRel(wheel.damping * turning * turning, 1e-12));
  CHECK_THAT(rim.friction * speed, WithinRel(wheel.friction * turning, 1e-12));
  CHECK_THAT(rim.force_limit * speed, WithinRel(wheel.torque_limit * turning, 1e-12));
  CHECK_THAT(rim.quantum * 16384.0, WithinRel(2 * 3.14159265358979 * wheel.radius, 1e-6));
}
