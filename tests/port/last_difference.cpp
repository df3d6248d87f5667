// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinRel;

TEST_CASE("last_difference is the position shown and the displacement over the tick", "[motion]") {
  const ph::last_difference::on<d3> plain({});
  const d3::vector x(1, 2, 3), dx(0.001, 0.002, 0);
  const auto seen = plain.estimate(x, dx, d3::zero(), 2e-3, true);
  CHECK(seen.position == x);
  CHECK_THAT(seen.along(d3::vector(0, 1, 0)), WithinRel(1.0, 1e-12));
  static_assert(ph::last_difference::on<d1>({}).estimate(2.0, 3e-3, 0.0, 1e-3, true).along(-1.0) <
                -2.99);
}

namespace {

/// The estimate of an observer that knows speeds along directions only.
struct speeds_along {
  d3::vector v;
  [[nodiscard]] double along(const d3::vector& n) const noexcept { return v.dot(n); }
};

}  // namespace

TEST_CASE("a velocity is the speeds along the axes, where an estimate knows no way", "[motion]") {
  const d3::vector v(0.1, -0.2, 0.3);
  CHECK(ph::detail::velocity_of<d3>(speeds_along{v}) == v);
  const ph::last_difference::on<d3> plain({});
  const d3::vector x = d3::zero(), dx = v * 2e-3;
  const auto seen = plain.estimate(x, dx, x, 2e-3, true);
  CHECK((ph::detail::velocity_of<d3>(seen) - v).norm() < 1e-15);
}
