// SPDX-License-Identifier: BSD-3-Clause
// A device that rests inside a wall when the loop begins has paid for nothing yet.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/contact/damped_spring.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/simulation/device.hpp>

namespace sim = ph::simulation;

namespace {

struct outcome {
  double largest_force = 0.0, position = 0.0, least_energy = 0.0;  ///< [N], [m], [J]
};

/// One second, 2 mm deep in a wall of 10 kN/m at the start, at rest; nobody touches the device.
template <class Law, class Bound>
outcome left_inside(const Law& law, const Bound& bound, double loan) {
  ph::local_model wall{d1{},
                       ph::fixed{ph::half_space<d1>{0.0, 1.0, 1e4}},
                       ph::turn_at_once{},
                       law,
                       ph::reduced_energy{.damping = 0.03, .loan = loan},
                       bound,
                       ph::loop_limits{.longest_tick = 1e-3}};
  sim::device<d1> device({.start = -2e-3});
  outcome seen;
  auto sample = device.exchange(0.0);
  for (int tick = 0; tick < 1000; ++tick) {
    const auto out = wall.tick(sample);
    CHECK(out.what == ph::event::nominal);  // it does as it promised, and has nothing to report
    seen.largest_force = std::max(seen.largest_force, out.force);
    sample = device.exchange(out.force);
  }
  seen.position = device.position();
  seen.least_energy = device.meter().minimum();
  return seen;
}

void rests_until_lent(const auto& law, const auto& bound) {
  const outcome empty = left_inside(law, bound, 0.0);
  CHECK(empty.largest_force == 0.0);
  CHECK(empty.position == -2e-3);
  const outcome lent = left_inside(law, bound, 1e-4);
  CHECK(lent.largest_force > 0.1);
  CHECK(lent.position > 0.0);
  CHECK(lent.least_energy < -0.9e-4);  // spent, and no more than that (A8)
  CHECK(lent.least_energy >= -1e-4 - 1e-12);
}

}  // namespace

TEST_CASE("a device that rests inside a wall is never pushed out, unless a loan pays for it",
          "[bound]") {
  rests_until_lent(ph::spring{}, ph::strict_bound{});
  rests_until_lent(ph::damped_spring{.mass = 0.1},
                   ph::reachable_bound{.mass = 0.1, .hand_force = 5.0});
}
