// SPDX-License-Identifier: BSD-3-Clause
#include "../bench/common/spring_wall.hpp"

#include "environment/shapes.hpp"

#include <span>
#include <stdexcept>

using experiments::spring_wall;

TEST_CASE("spring_wall is its springs in series", "[environment][wall]") {
  const spring_wall thesis;
  CHECK_THAT(thesis.stiffness(), WithinRel(10e3, 1e-12));
  CHECK_THAT(thesis.surface(5.0), WithinRel(0.5e-3, 1e-12));
  const spring_wall wall{1e3, 4e3, 2e2, 1e6};
  const double compliance = 1 / 1e3 + 1 / 4e3 + 1 / 2e2 + 1 / 1e6;
  CHECK_THAT(wall.stiffness(), WithinRel(1.0 / compliance, 1e-12));
  const Eigen::VectorXd x = wall.displacements(2.0);
  REQUIRE(x.size() == 4);
  const std::array<double, 4> springs{1e3, 4e3, 2e2, 1e6};
  for (Eigen::Index i = 0; i < 4; ++i) {  // every spring carries the whole force
    const double next = i < 3 ? x[i + 1] : 0.0;
    CHECK_THAT(springs[std::size_t(i)] * (x[i] - next), WithinRel(2.0, 1e-9));
  }
  CHECK(wall.surface(2.0) == x[0]);
  CHECK_THAT(spring_wall{7.0}.stiffness(), WithinRel(7.0, 1e-12));
  CHECK_THROWS_AS(spring_wall(std::span<const double>{}), std::invalid_argument);
  for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
    CHECK_THROWS_AS((spring_wall{1e3, bad}), std::invalid_argument);
  }
}
