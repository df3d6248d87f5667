// SPDX-License-Identifier: BSD-3-Clause
// Tanks, passivity controllers and set-position modulation against adversaries in 1, 2 and 3
// dimensions, in loops where ticks jitter, are late and are lost.
#include "force_bound/attacks.hpp"
#include "published/tanks.hpp"
#include "support/catch.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/published/energy_tank.hpp>
#include <passive_haptics/published/passivity_controller.hpp>
#include <passive_haptics/published/set_position_modulation.hpp>

using attacks::conditions, attacks::least_of, attacks::worst_of;

namespace {

constexpr double B = 30.0;  // of the thesis' device [N/m]

/// Behind nothing but the spring, the normal at once or 4 rad/s on its way.
template <class Space, class Law>
auto at_once(const Law& law) {
  return following_half_space<Space>(law, thesis_ledger(), ph::no_bound{});
}
template <class Space, class Law>
auto turning(const Law& law) {
  return attacks::model_of<Space>(ph::no_bound{}, thesis_loop, law);
}

const ph::shaped gate{ph::spring{}, ph::set_position_modulation{}};

}  // namespace

TEMPLATE_TEST_CASE("a tank that counts the worst outflow is strict_bound to the bit, here too",
                   "[time domain]", d2, f2, f3) {
  check_tank_is_strict<TestType>();
}

TEST_CASE("a tank that counts the worst outflow never loses energy", "[time domain]") {
  for (const conditions& when : {conditions{}, conditions{.jitter = true, .slowest = 1e-3},
                                 conditions{.lost = 0.05}, conditions{.late = 0.05}}) {
    CHECK(least_of<d1>(ph::energy_tank{}, when, 40) >= -1e-12);
    CHECK(least_of<d2>(ph::energy_tank{}, when, 20) >= -1e-12);
    CHECK(least_of<d3>(ph::energy_tank{}, when, 20) >= -1e-12);
    CHECK(least_of<d1>(ph::predicting_tank{}, when, 40) < -1e-3);  // the control
  }
}

TEST_CASE("with K ≤ 2b/T the gate loses nothing to an environment that jumps, a bare spring does",
          "[time domain]") {
  for (const conditions& when :
       {conditions{.low = 20, .high = 2 * B},
        conditions{.jitter = true, .slowest = 1e-3, .low = 20, .high = 2 * B},
        conditions{.lost = 0.05, .low = 20, .high = 2 * B},
        conditions{.late = 0.05, .low = 20, .high = 2 * B},
        conditions{.force_limit = 0.03, .low = 20, .high = 2 * B},
        conditions{.low = 2 * B, .high = 2 * B}}) {
    CHECK(worst_of<d1>(at_once<d1>(gate), when, 40).least >= -1e-12);
    CHECK(worst_of<d2>(at_once<d2>(gate), when, 20).least >= -1e-12);
    CHECK(worst_of<d3>(at_once<d3>(gate), when, 20).least >= -1e-12);
    CHECK(worst_of<d3>(turning<d3>(gate), when, 20).least >= -1e-12);
    CHECK(worst_of<d1>(at_once<d1>(ph::spring{}), when, 40).least < -1e-5);  // the controls
    CHECK(worst_of<d3>(turning<d3>(ph::spring{}), when, 20).least < -1e-6);
  }
  const conditions stiff{.low = 4 * B, .high = 4 * B};
  CHECK(worst_of<d1>(at_once<d1>(gate), stiff, 40).least < -1e-6);  // outside its assumption
}

TEMPLATE_TEST_CASE("they run in one to three dimensions and in float", "[time domain]", d1, f1, d2,
                   f2, d3, f3) {
  using scalar = typename TestType::scalar;
  const double slack = sizeof(scalar) == 4 ? 1e-6 : 1e-12;  // positions in float are rounded
  const conditions weak{.low = 20, .high = 2 * B};
  CHECK(least_of<TestType>(ph::energy_tank{}, {}, 5) >= -slack);
  CHECK(worst_of<TestType>(at_once<TestType>(gate), weak, 5).least >= -slack);
  const ph::series_passivity_controller damper{.max_damping = 50};
  const ph::two_layer_tank layers{.wanted = 0.015, .refill = 3000, .max_damping = 50};
  CHECK(least_of<TestType>(damper, {}, 5) < -1e-3);
  CHECK(least_of<TestType>(layers, {}, 5) < -1e-4);
}
