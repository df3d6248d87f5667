// SPDX-License-Identifier: BSD-3-Clause
// Limits that need no ledger: actuator_limit, motor_limits, no_bound.
#include "force_bound/upkeep.hpp"
#include <passive_haptics/device/joint_space.hpp>

TEST_CASE("actuator_limit and no_bound obey the laws of bounds that reduce", "[bound][law]") {
  CHECK(broken_laws<d1, f3>(ph::actuator_limit{.most = 5.0}).empty());
  CHECK(broken_laws<d1>(ph::no_bound{}).empty());
}

TEST_CASE("actuator_limit keeps the direction", "[bound]") {
  const auto limit = at<d3>(ph::actuator_limit{.most = 5.0});
  const situation<d3> now;
  CHECK((allowed(limit, d3::vector(6, 0, 8), now) - d3::vector(3, 0, 4)).norm() < 1e-15);
  CHECK(allowed(limit, d3::vector(3, 0, 4), now) == d3::vector(3, 0, 4));
}

TEST_CASE("motor_limits keep the direction, and the weakest motor decides", "[bound]") {
  using arm = ph::joint_space<double, 4>;
  const auto limit = at<arm>(ph::motor_limits<4>{{1.0, 2.0, 4.0, 0.0}});
  situation<arm, ph::diagonal_damping<4>> now{
      .damping = at<arm>(ph::diagonal_damping<4>{{0.1, 0.1, 0.1, 0.1}})};
  CHECK((allowed(limit, {2.0, -8.0, 4.0, 0.0}, now) - arm::vector(0.5, -2.0, 1.0, 0.0)).norm() <
        1e-15);
  CHECK((allowed(limit, {-1.0, 2.0, 4.0, 0.0}, now) == arm::vector(-1.0, 2.0, 4.0, 0.0)));
  CHECK((allowed(limit, {0.1, 0.1, 0.1, 1e-3}, now) == arm::zero()));  // there is no fourth motor
}

TEST_CASE("limits take new parameters and refuse bad ones by name", "[bound]") {
  const ph::actuator_limit first{.most = 0.5}, weaker{.most = 0.1}, none{.most = -1.0};
  const ph::bound_chain chain{ph::strict_bound{}, first};
  check_upkeep(following_half_space<d1>(ph::spring{}, thesis_ledger(), chain), first, weaker, none);
  CHECK(refused(ph::motor_limits<2>{{1.0, 0.0}}).empty());
  CHECK(refused(ph::motor_limits<2>{{1.0, std::nan("")}}) == "most");
  CHECK(refused(ph::motor_limits<2>{{-1.0, 1.0}}) == "most");
}
