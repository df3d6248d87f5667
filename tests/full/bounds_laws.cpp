// SPDX-License-Identifier: BSD-3-Clause
// The bounds that are for comparison, and the observers' rarer parameters, under the laws of their
// roles at the ports they are made for: one line each. The others: laws.cpp.
#include "force_bound/upkeep.hpp"
#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/published/energy_bounding.hpp>
#include <passive_haptics/published/energy_tank.hpp>
#include <passive_haptics/published/passivity_controller.hpp>
#include <passive_haptics/published/sector_bound.hpp>

namespace {

using j4 = ph::joint_space<double, 4>;

/// In a space of any dimension, and in joint coordinates as well.
std::string in_space(const auto& policy) {
  return broken_laws<d1, f3, d2>(policy);
}
std::string anywhere(const auto& policy) {
  return broken_laws<d1, f3, d2, j4>(policy);
}

}  // namespace

TEST_CASE("the bounds for comparison obey the laws of their role at every port they are made for",
          "[bound][law]") {
  CHECK(in_space(ph::energy_bounding{}).empty());
  CHECK(in_space(ph::energy_bounding{.slope = 20.0, .storage = 5.0}).empty());
  CHECK(in_space(ph::tight_energy_bounding{}).empty());
  CHECK(broken_laws<d1, f1>(ph::sector_bound{}).empty());
  CHECK(broken_laws<d1, f1>(ph::sector_bound{.slope = 40.0}).empty());
  CHECK(
      in_space(ph::two_layer_tank{.wanted = 0.015, .refill = 3000.0, .max_damping = 50.0}).empty());
  CHECK(in_space(ph::series_passivity_controller{.max_damping = 50.0}).empty());
  CHECK(in_space(ph::series_controller_with_damping{.max_damping = 50.0}).empty());
  CHECK(anywhere(ph::energy_tank{.reserve = 1e-3}).empty());
  CHECK(anywhere(ph::per_axis_bound{.cap = 1e-4}).empty());
}

TEST_CASE("observers with a compensated sum or friction obey the laws of their role",
          "[observer][law]") {
  using enum ph::ledger_sum;
  using ph::isotropic_damping, ph::damping_and_friction;
  CHECK(in_space(ph::basic_capped_energy<isotropic_damping, compensated>{
                     .damping = 0.03, .cap = 1e-5, .reset_after = 2e-3})
            .empty());
  const damping_and_friction rubbing{0.03, 0.2, 1e-5};
  CHECK(in_space(ph::dual_ledger{.damping = rubbing, .quantum = 0.0, .cap = 1e-5}).empty());
  CHECK(in_space(ph::basic_quantised_energy<isotropic_damping, compensated>{.damping = 0.03,
                                                                            .quantum = 1e-5})
            .empty());
  CHECK(in_space(ph::basic_dual_ledger<damping_and_friction, ph::encoder_step, compensated>{
                     .damping = rubbing, .quantum = 1e-5})
            .empty());
}
