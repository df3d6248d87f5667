// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/stick_slip.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3;

/// A bristle of k_t = 1000 N/m under a normal force, moved along a surface.
template <class Space>
struct rubbed {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  ph::stick_slip::on<Space> rule{ph::stick_slip{}};
  ph::stick_slip::bristle<Space> bristle{};
  scalar damping{};

  vector move(const vector& travel, scalar normal_force, const vector& n) {
    const vector velocity = travel / scalar(T);
    return bristle.rub(rule, normal_force, n, travel, velocity, scalar(1000), damping, scalar(T));
  }
};

}  // namespace

TEST_CASE(
    "a bristle holds like a spring, slips at the static coefficient and slides at the kinetic",
    "[friction]") {
  rubbed<d3> surface;
  const d3::vector n = d3::vector::UnitZ(), along = d3::vector::UnitX();
  surface.move(d3::vector::Zero(), 2.0, n);
  double most = 0.0;
  for (int i = 1; i <= 100; ++i) {
    const d3::vector f = surface.move(along * 1e-5, 2.0, n);
    CHECK_THAT(f.x(), WithinAbs(-1000.0 * 1e-5 * i, 1e-12));  // 1 mm: 1 N, below 0.6 · 2 N
  }
  d3::vector f;
  for (int i = 0; i < 5000; ++i) {
    f = surface.move(along * 1e-5, 2.0, n);
    most = std::max(most, f.norm());
  }
  CHECK_THAT(most, WithinRel(0.6 * 2.0, 1e-2));
  CHECK_THAT(f.x(), WithinRel(-0.4 * 2.0, 1e-2));
  for (int i = 0; i < 1000; ++i) f = surface.move(d3::vector::Zero(), 2.0, n);
  CHECK_THAT(surface.bristle.coefficient(), WithinRel(0.6, 1e-6));  // it heals
  CHECK(f.norm() > 0.7);                                            // and holds what it held
}

TEST_CASE("a bristle that heals holds by as much as it has healed", "[friction]") {
  rubbed<d3> surface;
  const d3::vector n = d3::vector::UnitZ(), along = d3::vector::UnitX();
  surface.move(d3::vector::Zero(), 2.0, n);
  const d3::vector damped =
      surface.bristle.rub(surface.rule, 2.0, n, d3::vector::Zero(), along, 1e3, 0.5, T);
  CHECK((damped + along * 0.5).norm() < 1e-12);
  const double weak = ph::stick_slip{}.weakening * 1e3;  // 2 N is pulled where 1.2 N are held
  const double held = surface.move(along * 2e-3, 2.0, n).norm();
  CHECK_THAT(held, WithinRel(2.0 * (0.4 + 0.2 * weak / (weak + 0.8)), 1e-9));
  for (int i = 0; i < 200; ++i) surface.move(along * 1e-4, 2.0, n);
  const double slid = surface.bristle.coefficient();
  // A damper that asks for more than the cone.
  const d3::vector f =
      surface.bristle.rub(surface.rule, 2.0, n, along * -1e-5, along, 1e3, 1e3, 0.1);
  CHECK(surface.bristle.coefficient() > 1.05 * slid);
  CHECK_THAT(f.norm(), WithinRel(2.0 * surface.bristle.coefficient(), 1e-12));
}

TEMPLATE_TEST_CASE("friction stays inside its cone and pushes across the normal only", "[friction]",
                   d2, d3, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  rubbed<TestType> surface;
  surface.damping = scalar(5);
  ph::laws::samples random(1);
  const scalar ulps = scalar(8) * std::numeric_limits<scalar>::epsilon();
  vector n = random.direction<TestType>();
  double closest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const scalar normal_force = std::max(scalar(0), scalar(2) * random.number<scalar>());
    n = n + random.vector<TestType>() * scalar(0.05);
    n = n / n.norm();
    const vector f = surface.move(random.vector<TestType>() * scalar(3e-4), normal_force, n);
    const scalar most = scalar(0.6) * normal_force;
    CHECK(f.norm() <= most * (scalar(1) + ulps));
    CHECK(std::abs(f.dot(n)) <= scalar(64) * ulps);
    if (normal_force > scalar(0)) closest = std::max(closest, double(f.norm() / most));
  }
  CHECK(closest > 0.99);
}

TEST_CASE("a finger that returns finds the bristle as it was", "[friction]") {
  rubbed<d3> surface;
  const d3::vector n = d3::vector::UnitZ();
  ph::laws::samples random(2);
  surface.move(d3::vector::Zero(), 2.0, n);
  const d3::vector held = surface.move(d3::vector(5e-4, 0.0, 0.0), 2.0, n);
  d3::vector travelled = d3::vector::Zero();
  for (int i = 0; i < 10000; ++i) {
    const d3::vector step = random.vector<d3>() * 2e-4 - travelled;  // it trembles about a place
    travelled += step;
    surface.move(step, 2.0, n);
  }
  const d3::vector back = surface.move(-travelled, 2.0, n);
  CHECK((back - held).norm() < 1e-10);
}

TEST_CASE("friction keeps its size when the normal turns, and lets go with the contact",
          "[friction]") {
  rubbed<d3> surface;
  d3::vector n = d3::vector::UnitZ();
  surface.move(d3::vector::Zero(), 2.0, n);
  const double before = surface.move(d3::vector(5e-4, 2e-4, 0.0), 2.0, n).norm();
  for (int i = 1; i <= 60; ++i) {
    const double a = i * 3.14159265358979 / 180.0;
    n = d3::vector(std::sin(a), 0.0, std::cos(a));
    CHECK_THAT(surface.move(d3::vector::Zero(), 2.0, n).norm(), WithinRel(before, 1e-12));
  }
  CHECK(surface.move(d3::vector(1e-4, 0.0, 0.0), 0.0, n) == d3::vector::Zero());
  CHECK(surface.move(d3::vector::Zero(), 2.0, n).norm() == 0.0);  // a new contact is not bent
}

TEST_CASE("a stick_slip out of range is refused by name", "[friction]") {
  CHECK_FALSE(ph::stick_slip{}.check());
  CHECK(std::string(ph::stick_slip{.static_coefficient = -1.0}.check().parameter) ==
        "static_coefficient");
  CHECK(std::string(ph::stick_slip{.kinetic_coefficient = 0.7}.check().parameter) ==
        "kinetic_coefficient");
  CHECK(std::string(ph::stick_slip{.weakening = 0.0}.check().parameter) == "weakening");
  CHECK(std::string(ph::stick_slip{.healing = std::nan("")}.check().parameter) == "healing");
}
