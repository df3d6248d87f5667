// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinRel;

TEST_CASE("damped_spring keeps the static stiffness up to the cap of the sampled mass (§ 9)",
          "[contact]") {
  ph::damped_spring::on<d1> law({.mass = 0.1});
  law.adopt(5000.0, 1e-3);
  CHECK(law.stiffness() == 5000.0);
  law.adopt(1e9, 1e-3);
  CHECK_THAT(law.stiffness(), WithinRel(1e4, 1e-12));  // κ m/T² = 0.1·0.1/1e-6
  CHECK_THAT(law.damping(), WithinRel(50.0, 1e-12));   // β m/T = 0.5·0.1/1e-3 < 2√(Km)
  law.adopt(100.0, 1e-3);
  CHECK_THAT(law.damping(), WithinRel(2 * std::sqrt(100 * 0.1), 1e-12));
}

TEST_CASE("damped_spring damps only outward motion, so it never adds force", "[contact]") {
  ph::damped_spring::on<d1> law({.mass = 0.1});
  law.adopt(5000.0, 1e-3);
  const double still = law.force(1e-3, 0.0);
  CHECK(law.force(1e-3, -1.0) == still);
  CHECK(law.force(1e-3, 0.02) < still);
  CHECK(law.force(1e-3, 10.0) == 0.0);
  CHECK_THAT(law.depth(law.force(1e-3, 0.02), 0.02), WithinRel(1e-3, 1e-12));
}

TEST_CASE("damped_spring deeper than the motors can answer for is a secant to their limit",
          "[contact]") {
  ph::damped_spring::on<d1> law({.mass = 0.1, .force_limit = 9.0});
  law.adopt(1e4, 1e-3);
  const double edge = 9.0 / 1e4;
  CHECK_THAT(law.force(0.999 * edge, 0.0), WithinRel(9.0 * 0.999, 1e-12));
  for (const double depth : {1.001 * edge, 0.01, 0.1}) {
    CHECK(law.force(depth, 0.0) == 9.0);
    CHECK(law.force(depth, -3.0) == 9.0);
    const double damping = std::min(law.damping(), 2 * std::sqrt(9.0 * 0.1 / depth));
    CHECK_THAT(law.force(depth, 0.05), WithinRel(9.0 - damping * 0.05, 1e-12));
    CHECK(law.force(depth, 1e3) == 0.0);
  }
  CHECK(law.force(0.1, 0.05) > law.force(0.01, 0.05));  // it lets go more gently
}

TEST_CASE("parameters of damped_spring are refused with their name", "[contact]") {
  const auto refused = [](const ph::damped_spring& law) {
    const auto fault = law.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({.mass = 0.1}).empty());
  CHECK(refused({.mass = 0.1, .stiffness_fraction = 1.0, .damping_fraction = 1.0}).empty());
  CHECK(refused({.mass = 0.1, .damping_ratio = 0.0, .damping_fraction = 0.0}).empty());
  CHECK(refused({.mass = 0.0}) == "mass");
  CHECK(refused({.mass = -1.0}) == "mass");
  CHECK(refused({.mass = std::nan("")}) == "mass");
  CHECK(refused({.mass = 0.1, .stiffness_fraction = 0.0}) == "stiffness_fraction");
  CHECK(refused({.mass = 0.1, .stiffness_fraction = 1.5}) == "stiffness_fraction");
  CHECK(refused({.mass = 0.1, .damping_ratio = -1.0}) == "damping_ratio");
  CHECK(refused({.mass = 0.1, .damping_fraction = 2.0}) == "damping_fraction");
  CHECK(refused({.mass = 0.1, .force_limit = 0.0}) == "force_limit");
  CHECK(refused({.mass = 0.1, .force_limit = std::nan("")}) == "force_limit");
}
