// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <algorithm>
#include <array>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using joints = ph::joint_space<double, 2>;
constexpr double T = 1e-3;

template <class Damping>
std::string refused(const Damping& damping) {
  const auto fault = damping.check();
  return fault ? fault.parameter : "";
}

}  // namespace

TEST_CASE("isotropic_damping is b|Δx|²/dt, and what f can cost is f²/(4B)", "[damping]") {
  const auto damping = at<d3>(ph::isotropic_damping{0.03});
  const d3::vector dx(1e-3, 2e-3, -2e-3), f(2, -1, 2);
  CHECK_THAT(damping.dissipated(dx, 2e-3), WithinRel(0.03 * 9e-6 / 2e-3, 1e-12));
  CHECK_THAT(damping.worst_outflow(f, T), WithinRel(9.0 / (4 * 30), 1e-12));
  CHECK_THAT(damping.per_tick(f, T), WithinRel(30.0, 1e-12));
  CHECK_THAT(damping.affordable(f, 0.01, T), WithinRel(std::sqrt(0.01 * 120 / 9), 1e-9));
  CHECK(damping.affordable(f, 1.0, T) == 1.0);
  CHECK(damping.affordable(f, -1.0, T) == 0.0);
  CHECK((damping.force(dx, T) - 30 * dx).norm() < 1e-15);
  CHECK(damping.along_axis(2) == 0.03);
  static_assert(!decltype(damping)::rubs);
  static_assert(at<d1>(ph::isotropic_damping{0.03}).dissipated(1e-3, 1e-3) < 3.1e-5);
}

TEST_CASE("diagonal_damping is isotropic where all axes are alike, and its own on each",
          "[damping]") {
  const auto same = at<d2>(ph::isotropic_damping{0.03});
  const auto alike = at<d2>(ph::diagonal_damping<2>{{0.03, 0.03}});
  const auto own = at<d2>(ph::diagonal_damping<2>{{0.01, 0.04}});
  const d2::vector dx(1e-3, -2e-3), f(3, 4);
  CHECK_THAT(alike.dissipated(dx, T), WithinRel(same.dissipated(dx, T), 1e-12));
  CHECK_THAT(alike.worst_outflow(f, T), WithinRel(same.worst_outflow(f, T), 1e-12));
  CHECK_THAT(alike.per_tick(f, T), WithinRel(same.per_tick(f, T), 1e-12));
  CHECK_THAT(alike.affordable(f, 0.01, T), WithinRel(same.affordable(f, 0.01, T), 1e-12));
  CHECK((alike.force(dx, T) - same.force(dx, T)).norm() < 1e-15);

  CHECK_THAT(own.dissipated(dx, T), WithinRel(0.01 * 1e-3 + 0.04 * 4e-3, 1e-12));
  CHECK_THAT(own.worst_outflow(f, T), WithinRel(T / 4 * (9 / 0.01 + 16 / 0.04), 1e-12));
  CHECK_THAT(own.per_tick(d2::vector(5, 0), T), WithinRel(10.0, 1e-12));
  CHECK_THAT(own.per_tick(d2::vector(0, 5), T), WithinRel(40.0, 1e-12));
  CHECK(own.force(dx, T)(1) == -2e-3 * (0.04 / T));
  // the worst motion for f is Bᵢ Δxᵢ = fᵢ/2: it costs exactly worst_outflow
  const d2::vector worst(3 * T / (2 * 0.01), 4 * T / (2 * 0.04));
  CHECK_THAT(f.dot(worst) - own.dissipated(worst, T), WithinRel(own.worst_outflow(f, T), 1e-12));

  const auto turning = at<joints>(ph::diagonal_damping<2>{{0.01, 0.04}});
  CHECK(turning.worst_outflow(f, T) == own.worst_outflow(f, T));
}

TEST_CASE("the least and the most b are those of any axis", "[damping]") {
  std::array<double, 3> b{0.01, 0.03, 0.2};
  do {
    const auto own = at<d3>(ph::diagonal_damping<3>{b});
    CHECK(ph::detail::least_damping<d3>(own) == 0.01);
    CHECK(ph::detail::most_damping<d3>(own) == 0.2);
  } while (std::next_permutation(b.begin(), b.end()));
  const auto one = at<d1>(ph::diagonal_damping<1>{{0.05}});
  CHECK(ph::detail::least_damping<d1>(one) == 0.05);
  CHECK(ph::detail::most_damping<d1>(one) == 0.05);
}

TEST_CASE("a damping is refused with its name", "[damping]") {
  const double nan = std::nan("");
  CHECK(refused(ph::isotropic_damping{0.03}).empty());
  CHECK(refused(ph::diagonal_damping<2>{{0.01, 0.02}}).empty());
  for (const double bad : {0.0, -1.0, nan, HUGE_VAL}) {
    CHECK(refused(ph::isotropic_damping{bad}) == "damping");
    CHECK(refused(ph::diagonal_damping<2>{{0.01, bad}}) == "damping");
    CHECK(refused(ph::diagonal_damping<2>{{bad, 0.01}}) == "damping");
  }
  CHECK(refused(ph::isotropic_damping{}) == "damping");  // nothing is assumed
}

TEST_CASE("a damping gives its parameters back", "[damping]") {
  CHECK(at<d2>(ph::isotropic_damping{0.25}).parameters().coefficient == 0.25);
  CHECK(at<f2>(ph::diagonal_damping<2>{{0.25, 0.5}}).parameters().coefficients[1] == 0.5);
}
