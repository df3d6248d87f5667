// SPDX-License-Identifier: BSD-3-Clause
// What is known of a position that is off by half a step at most.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/device/encoder_steps.hpp>
#include <passive_haptics/laws.hpp>

#include <cmath>
#include <limits>
#include <string>

using Catch::Matchers::WithinRel;

namespace {

constexpr ph::encoder_steps<3> unequal{{50e-6, 10e-6, 0.0}};

template <class Steps>
std::string refused(const Steps& steps) {
  const auto fault = steps.check();
  return fault ? fault.parameter : "";
}

}  // namespace

TEST_CASE("the work of a force is known to ½ Σ q|f| at each end of a way", "[steps]") {
  const d3::vector f(3, -4, 12);
  CHECK_THAT(at<d3>(unequal).doubt(f), WithinRel(0.5 * (150e-6 + 40e-6), 1e-14));
  CHECK_THAT(at<d3>(ph::encoder_step(50e-6)).doubt(f), WithinRel(0.5 * 50e-6 * 19, 1e-14));
  CHECK(at<d3>(ph::encoder_step(0.0)).doubt(f) == 0.0);

  const auto floats = at<f3>(unequal);
  const auto alike = at<f3>(ph::encoder_step(50e-6));
  const double almost = 1 + 40 * static_cast<double>(std::numeric_limits<float>::epsilon());
  ph::laws::samples random(1);
  for (int n = 0; n < 1000; ++n) {  // rounded up: products of floats are exact in double
    const f3::vector force = random.vector<f3>();
    const auto sum = [&](const auto& steps) {
      double all = 0.0;
      for (int i = 0; i < 3; ++i) {
        all += static_cast<double>(steps.along_axis(i)) * std::abs(static_cast<double>(force(i)));
      }
      return all / 2;
    };
    REQUIRE(static_cast<double>(floats.doubt(force)) >= sum(floats));
    REQUIRE(static_cast<double>(floats.doubt(force)) <= sum(floats) * almost);
    REQUIRE(static_cast<double>(alike.doubt(force)) >= sum(alike));
    REQUIRE(static_cast<double>(alike.doubt(force)) <= sum(alike) * almost);
  }
}

TEST_CASE("a way that is shown has been made but for a step on each axis", "[steps]") {
  const auto own = at<d3>(unequal);
  CHECK(own.surely(d3::vector(20e-6, -30e-6, -1e-6)) == d3::vector(0, -30e-6 - -10e-6, -1e-6));
  CHECK(own.surely(d3::vector(-80e-6, 10e-6, 0.0)) == d3::vector(-80e-6 - -50e-6, 0, 0));
  const auto alike = at<d3>(ph::encoder_step(50e-6));
  CHECK(alike.surely(d3::vector(60e-6, -60e-6, 40e-6)) ==
        d3::vector(60e-6 - 50e-6, -(60e-6 - 50e-6), 0));
}

TEST_CASE("a way is shown to the length of one step on every axis", "[steps]") {
  CHECK_THAT(at<d3>(ph::encoder_steps<3>{{30e-6, 40e-6, 120e-6}}).travel_error(),
             WithinRel(130e-6, 1e-14));
  CHECK_THAT(at<d3>(ph::encoder_step(50e-6)).travel_error(),
             WithinRel(50e-6 * std::sqrt(3.0), 1e-14));
  CHECK(at<d1>(ph::encoder_step(50e-6)).travel_error() == 50e-6);
}

TEST_CASE("steps are refused with their name, and given back", "[steps]") {
  CHECK(refused(ph::encoder_step(0.0)).empty());
  CHECK(refused(unequal).empty());
  for (const double bad : {-1e-9, std::nan(""), HUGE_VAL}) {
    CHECK(refused(ph::encoder_step(bad)) == "quantum");
    CHECK(refused(ph::encoder_steps<2>{{0.0, bad}}) == "quantum");
  }
  CHECK(at<d3>(unequal).parameters().widths == unequal.widths);
  CHECK(at<f1>(ph::encoder_step(0.25)).parameters().width == 0.25);
}
