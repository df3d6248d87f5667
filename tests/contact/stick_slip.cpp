// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/stick_slip.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

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

TEST_CASE("a bristle that is bent just as far as it holds sticks, and heals", "[friction]") {
  const ph::stick_slip::on<d3> law{ph::stick_slip{
      .static_coefficient = 0.5, .kinetic_coefficient = 0.25, .weakening = 1.0 / 1024}};
  ph::stick_slip::bristle<d3> bristle{};
  const d3::vector n = d3::vector::UnitZ(), along = d3::vector::UnitX();
  const auto pull = [&](double way) {  // in exact numbers: a spring of 1 N for D, under 1 N
    return bristle.rub(law, 1.0, n, along * (way / 1024), d3::zero(), 1024.0, 0.0, T).x();
  };
  (void)pull(0.0);
  CHECK(pull(1.5) == -0.375);  // which slips by D, and loses half of 0.5 − 0.25
  CHECK(bristle.coefficient() == 0.375);
  CHECK(pull(0.0) == -0.375);
  CHECK_THAT(bristle.coefficient(), WithinAbs(0.375 + 0.125 / 21, 1e-12));
}

TEST_CASE("a stick_slip out of range is refused by name", "[friction]") {
  CHECK_FALSE(ph::stick_slip{}.check());
  CHECK_FALSE(ph::stick_slip{.kinetic_coefficient = 0.0}.check());
  CHECK_FALSE(ph::stick_slip{.static_coefficient = 0.5, .kinetic_coefficient = 0.5}.check());
  CHECK(std::string(ph::stick_slip{.static_coefficient = -1.0}.check().parameter) ==
        "static_coefficient");
  CHECK(std::string(ph::stick_slip{.kinetic_coefficient = 0.7}.check().parameter) ==
        "kinetic_coefficient");
  CHECK(std::string(ph::stick_slip{.weakening = 0.0}.check().parameter) == "weakening");
  CHECK(std::string(ph::stick_slip{.healing = std::nan("")}.check().parameter) == "healing");
}

namespace {

/// The bristle a second time, its normal turned about the axis across both.
struct told_bristle {
  d3::vector z = d3::zero(), last = d3::zero();
  double mu = 0.0;
  bool touches = false;
  int slips = 0, sticks = 0, cut = 0;

  d3::vector rub(const ph::stick_slip& rule, double pressed, const d3::vector& n,
                 const d3::vector& travel, const d3::vector& velocity, double K, double B,
                 double dt) {
    if (pressed <= 0.0) {
      touches = false;
      return d3::zero();
    }
    if (std::exchange(touches, true)) {
      z += travel;
      z -= last * last.dot(z);
      const d3::vector axis = last.cross(n);
      z = Eigen::AngleAxisd(std::atan2(axis.norm(), last.dot(n)), axis.normalized()) * z;
    } else {
      z = d3::zero();
      mu = rule.static_coefficient;
    }
    last = n;
    const double slip = z.norm() - mu * pressed / K;
    if (slip > 0.0) {
      ++slips;
      mu = rule.kinetic_coefficient +
           (mu - rule.kinetic_coefficient) / (1.0 + slip / rule.weakening);
      z *= mu * pressed / K / z.norm();
    } else {
      ++sticks;
      mu += (rule.static_coefficient - mu) * dt / (dt + rule.healing);
    }
    const d3::vector wanted = -K * z - B * (velocity - n * n.dot(velocity));
    const double share = std::min(1.0, mu * pressed / wanted.norm());
    cut += share < 1.0 ? 1 : 0;
    return wanted.norm() > 0.0 ? d3::vector(wanted * share) : d3::zero();
  }
};

}  // namespace

TEST_CASE("a bristle bends, slips, heals and is let go tick by tick as its formulas say",
          "[friction]") {
  const ph::stick_slip rule{
      .static_coefficient = 0.9, .kinetic_coefficient = 0.2, .weakening = 7e-4, .healing = 0.03};
  const ph::stick_slip::on<d3> law{rule};
  CHECK(law.parameters().static_coefficient == 0.9);
  CHECK(law.parameters().kinetic_coefficient == 0.2);
  CHECK(law.parameters().weakening == 7e-4);
  CHECK(law.parameters().healing == 0.03);
  ph::stick_slip::bristle<d3> bristle{};
  told_bristle told;
  ph::laws::samples random(7);
  d3::vector n = random.direction<d3>();
  for (int i = 0; i < 4000; ++i) {
    const double pressed = i % 50 == 49 ? 0.0 : 1.0 + 0.9 * random.number<double>();
    if (i % 3 == 0) n = (n + 0.2 * random.vector<d3>()).normalized();
    const d3::vector travel = random.vector<d3>() * (i % 20 < 10 ? 2e-4 : 1e-3);
    const d3::vector velocity = random.vector<d3>() * 0.3;
    const double K = 800.0 + 300.0 * random.number<double>(), B = i % 2 == 0 ? 0.5 : 0.0;
    const double dt = 1e-3 * (2.0 + random.number<double>());
    if (i % 77 == 76) {
      bristle.let_go();
      told.touches = false;
    }
    if (i % 211 == 210) {
      bristle.reset();
      told.touches = false;
    }
    const d3::vector f = bristle.rub(law, pressed, n, travel, velocity, K, B, dt);
    REQUIRE((f - told.rub(rule, pressed, n, travel, velocity, K, B, dt)).norm() < 1e-9);
    if (told.touches) REQUIRE_THAT(bristle.coefficient(), WithinAbs(told.mu, 1e-9));
  }
  CHECK(told.slips > 500);
  CHECK(told.sticks > 500);
  CHECK(told.cut > 500);
  bristle.reset();
  CHECK(bristle.coefficient() == 0.0);
}
