// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/force_bound/energy_tank.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/laws.hpp>
#include <passive_haptics/port/reported_work.hpp>
#include <passive_haptics/port/rigid_damping.hpp>

namespace ph = passive_haptics;

namespace {
using body = ph::rigid_body<double>;
using ledger = ph::basic_reduced_energy<ph::rigid_damping>;
constexpr ph::rigid_damping b{.linear = 0.03, .angular = 1e-4};
constexpr double T = 1e-3;
const ph::part_at<ph::rigid_damping, body> damping(b);
}  // namespace

TEMPLATE_TEST_CASE("a rigid body's damping, ledger and bounds obey the laws", "[rigid_damping]",
                   ph::rigid_body<double>, ph::rigid_body<float>,
                   ph::reported_work<ph::rigid_body<double>>) {
  CHECK(ph::laws::all<ph::rigid_damping, TestType>(b));
  CHECK(ph::laws::all<ledger, TestType>({.damping = b}));
  CHECK(ph::laws::all<ph::basic_capped_energy<ph::rigid_damping>, TestType>(
      {.damping = b, .loan = 0.1, .cap = 0.5}));
  CHECK(ph::laws::all<ph::strict_bound, TestType>());
  CHECK(ph::laws::spends_at_most_the_ledger<TestType>(ph::strict_bound{}));
  CHECK(ph::laws::all<ph::energy_tank, TestType>({.reserve = 1e-3}));
  if constexpr (!ph::detail::reports_work<TestType>()) {
    CHECK(ph::laws::all<ph::memoryless_bound, TestType>());
  }
}
