// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/device/rigid_body.hpp>
#include <passive_haptics/device/rigid_inertia.hpp>

#include <array>
#include <cmath>
#include <string>

using Catch::Matchers::WithinRel;

TEST_CASE("an inertia measures an effort by what it can accelerate", "[inertia]") {
  const auto one = at<d3>(ph::isotropic_inertia{0.25});
  const ph::diagonal_inertia<3> three{{0.25, 1.0, 4.0}};
  const auto own = at<d3>(three);
  const auto alike = at<d3>(ph::diagonal_inertia<3>{{0.25, 0.25, 0.25}});
  const d3::vector f(1, 2, 2);
  CHECK_THAT(one.norm(f), WithinRel(6.0, 1e-12));  // |f|/√m
  CHECK_THAT(alike.norm(f), WithinRel(6.0, 1e-12));
  CHECK_THAT(own.norm(f), WithinRel(3.0, 1e-12));  // √(4 + 4 + 1)
  CHECK(one.norm(d3::zero()) == 0.0);
  CHECK(at<ph::joint_space<double, 3>>(three).norm(f) == own.norm(f));
  CHECK(at<f1>(ph::isotropic_inertia{0.25}).norm(-3.0F) == 6.0F);
}

TEST_CASE("an inertia is refused with its name, and gives its parameters back", "[inertia]") {
  const auto refused = [](const auto& inertia) {
    const auto fault = inertia.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(ph::isotropic_inertia{0.1}).empty());
  CHECK(refused(ph::diagonal_inertia<2>{{0.1, 0.2}}).empty());
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK(refused(ph::isotropic_inertia{bad}) == "mass");
    CHECK(refused(ph::diagonal_inertia<2>{{0.1, bad}}) == "masses");
  }
  CHECK(at<f1>(ph::isotropic_inertia{0.25}).parameters().mass == 0.25);
  CHECK(at<f2>(ph::diagonal_inertia<2>{{0.25, 0.5}}).parameters().masses[1] == 0.5);
}

TEST_CASE("M₁₁ − |M₁₂| on the diagonal is nowhere above a coupled inertia, its own diagonal is",
          "[inertia]") {
  Eigen::Matrix2d M;
  M << 0.2, 0.08, 0.08, 0.15;
  const auto below = at<d2>(ph::diagonal_inertia<2>{{0.12, 0.07}});
  const auto diagonal = at<d2>(ph::diagonal_inertia<2>{{0.2, 0.15}});
  bool above = false;
  for (int i = 0; i < 360; ++i) {
    const double angle = 0.01745329251994 * i;
    const d2::vector f(std::cos(angle), std::sin(angle));
    const double det = M(0, 0) * M(1, 1) - M(0, 1) * M(1, 0);
    const double square =
        (M(1, 1) * f(0) * f(0) - 2 * M(0, 1) * f(0) * f(1) + M(0, 0) * f(1) * f(1)) / det;
    CHECK(below.norm(f) >= std::sqrt(square));  // never says that it accelerates less than it does
    above = above || diagonal.norm(f) < std::sqrt(square);
  }
  CHECK(above);
}

TEST_CASE("a handle off the centre of mass has the least share of mass and moment", "[inertia]") {
  CHECK(ph::rigid_inertia{.mass = 0.15, .least = 1e-4}.at_handle() == 1.0);
  for (const double offset : {0.005, 0.02, 0.1}) {
    const double r = ph::rigid_inertia{.mass = 0.15, .least = 1e-4, .offset = offset}.at_handle();
    CHECK(r < 1.0);
    // m and I + m|c|² with m|c| beside them, less r times m and I, have a determinant of 0: (1 − r)² = r q.
    CHECK_THAT((1.0 - r) * (1.0 - r), WithinRel(r * 0.15 * offset * offset / 1e-4, 1e-12));
  }
}

TEST_CASE("an inertia of a rigid body is what its formulas say", "[inertia]") {
  using body = ph::rigid_body<double>;
  const auto of =
      at<body>(ph::rigid_inertia{.mass = 0.25, .least = 0.0625, .spread = 0.1875, .offset = 0.5});
  body::effort w = body::zero();
  for (int i = 0; i < 6; ++i)
    body::component(w, i) = std::array{1.0, 2.0, 2.0, 2.0, 3.0, 6.0}[std::size_t(i)];
  CHECK(of.length<0>(w) == 3.0);
  CHECK(of.length<3>(w) == 7.0);
  CHECK(of.squared<3>(w) == 49.0);
  const double about = 7.0 + 0.5 * 3.0;  // N·m, about the centre of mass
  CHECK_THAT(of.norm(w), WithinRel(std::sqrt(9.0 / 0.25 + about * about / 0.0625), 1e-14));
  CHECK_THAT(of.norm(3.0, 7.0), WithinRel(of.norm(w), 1e-14));
  const auto centred = at<body>(ph::rigid_inertia{.mass = 0.25, .least = 0.0625});
  CHECK_THAT(centred.norm(w), WithinRel(std::sqrt(9.0 / 0.25 + 49.0 / 0.0625), 1e-14));
  CHECK_THAT(of.of_turning(3.0),
             WithinRel(9.0 * std::sqrt(0.25 * 0.25 + 0.1875 * 0.1875 / 0.25), 1e-14));
  CHECK(of.turning_by(3.0) == 12.0);
  CHECK_THAT(of.moving_by(3.0), WithinRel(3.0 * std::sqrt(8.0), 1e-14));
  CHECK(of.offset() == 0.5);
  CHECK(of.swing() == 2.0);
}

TEST_CASE("an inertia of a rigid body is refused with the name of what is none", "[inertia]") {
  const auto refused = [](double mass, double least, double spread, double offset) {
    const auto fault = ph::rigid_inertia{mass, least, spread, offset}.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(0.1, 1e-4, 0.0, 0.0).empty());
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    CHECK(refused(bad, 1e-4, 0.0, 0.0) == "mass");
    CHECK(refused(0.1, bad, 0.0, 0.0) == "least");
    CHECK(refused(0.1, 1e-4, bad, 0.0) == "spread");
    CHECK(refused(0.1, 1e-4, 0.0, bad) == "offset");
  }
  CHECK(refused(0.0, 1e-4, 0.0, 0.0) == "mass");
  CHECK(refused(0.1, 0.0, 0.0, 0.0) == "least");
}
