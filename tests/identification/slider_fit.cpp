// SPDX-License-Identifier: BSD-3-Clause
// Sliders from a recording: they say what a device loses on other motions than the one they are fitted to, and no more.
#include "support/catch.hpp"
#include <passive_haptics/identification/slider_fit.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace id = ph::identification;

namespace {

/// A motion, the force that it takes, and what it loses.
struct recording {
  std::vector<id::slow_row> rows{};
  double lost = 0.0;  ///< [J]
};

/// Moves a friction slowly from one place to the next; positions are shown in steps of `step`.
template <class Friction>
recording moved(const Friction& friction, const std::vector<double>& places, double step,
                double offset = 0.0) {
  recording seen;
  auto state = friction.begin();
  double x = 0.0;
  const auto show = [step](double at) { return step > 0.0 ? step * std::floor(at / step) : at; };
  for (const double goal : places) {
    while (std::abs(goal - x) > 1e-12) {
      const double way = std::clamp(goal - x, -0.5e-6, 0.5e-6);
      const auto took = friction.slide(state, x, way, 1e-3);
      x += way;
      seen.lost += took.dissipated;
      seen.rows.push_back({show(x), took.work / way + offset});
    }
  }
  return seen;
}

/// Both ways, with small reversals.
const std::vector<double> ramps{400e-6, -400e-6, 200e-6,  150e-6,  300e-6, 290e-6,
                                310e-6, 0.0,     20e-6,   -100e-6, 400e-6, 380e-6,
                                390e-6, -400e-6, -350e-6, -400e-6, 100e-6};

std::vector<double> wander(std::uint64_t seed, double most, int turns) {
  sim::random_source random(seed);
  std::vector<double> all{400e-6, 0.0};
  for (int i = 0; i < turns; ++i) all.push_back(random.uniform(-most, most));
  return all;
}

double credited(const id::slider_fit& f, const recording& r) {
  double last = 0.0;
  id::loss_of(std::span<const id::slider>(f.list.data(), static_cast<std::size_t>(f.count)), r.rows,
              1.0, [&last](std::size_t /*n*/, double sum) { last = sum; });
  return last;
}

const sim::maxwell_slip<4> soft{{0.05, 0.1, 0.1, 0.05}, {3e-6, 12e-6, 40e-6, 90e-6}};

}  // namespace

TEST_CASE("fit_sliders says what several sliders lose on motions it has not seen, and no more",
          "[identification][sliders]") {
  for (const double step : {0.0, 0.2e-6, 1e-6, 5e-6}) {
    const auto found = id::fit_sliders(moved(soft, ramps, step).rows, {.step = step});
    CAPTURE(step, found.refused == nullptr ? "" : found.refused, found.left, found.credited);
    REQUIRE(found.refused == nullptr);
    CHECK(found.level() <= 0.3 * 1.02);
    CHECK(found.level() > 0.3 * 0.85);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      for (const double most : {10e-6, 40e-6, 200e-6}) {
        const auto other = moved(soft, wander(seed, most, 400), step);
        const double reserve = 2.5 * found.level() * found.mean_presliding();
        CAPTURE(seed, most, other.lost);
        REQUIRE(credited(found, other) <= other.lost + reserve);
        if (step <= 1e-6 && most > 20e-6) REQUIRE(credited(found, other) >= 0.6 * other.lost);
      }
    }
  }
}

TEST_CASE("one slider with the mean presliding credits little of what small motions lose",
          "[identification][sliders]") {
  const auto found = id::fit_sliders(moved(soft, ramps, 0.2e-6).rows, {.step = 0.2e-6});
  REQUIRE(found.refused == nullptr);
  id::slider_fit one;
  one.list[0] = {found.level(), found.mean_presliding()};
  one.count = 1;
  const auto small = moved(soft, wander(3, 20e-6, 2000), 0.2e-6);
  CAPTURE(small.lost, credited(found, small), credited(one, small));
  CHECK(credited(found, small) > 0.5 * small.lost);
  CHECK(credited(one, small) < 0.3 * small.lost);
  // The control: levels told half as large again are refuted by what the motors put in.
  id::slider_fit more = found;
  for (auto& s : more.list) s.level *= 1.5;
  CHECK(credited(more, small) > small.lost);
}

TEST_CASE("fit_sliders lowers friction that differs by direction to what is sure either way",
          "[identification][sliders]") {
  // 0.3 N forward and 0.2 N back, of which a recording shows 0.25 N and an offset.
  const sim::slider_and_spring rigid{{0.25}, {5e-6}};
  const auto found = id::fit_sliders(moved(rigid, ramps, 0.2e-6, 0.05).rows, {.step = 0.2e-6});
  REQUIRE(found.refused == nullptr);
  CHECK(std::abs(found.offset - 0.05) < 0.005);
  CHECK(found.level() < 0.22);
  CHECK(found.level() > 0.15);
}

TEST_CASE("fit_sliders refuses by a sentence what is no recording", "[identification][sliders]") {
  const auto why = [](const std::vector<id::slow_row>& rows, const id::slider_fit_settings& by) {
    const auto found = id::fit_sliders(rows, by);
    return std::string(found.refused == nullptr ? "" : found.refused);
  };
  auto good = moved(soft, ramps, 1e-6).rows;
  CHECK(why(good, {.step = 1e-6}).empty());
  CHECK(why({}, {}).find("too few") != std::string::npos);
  CHECK(why(std::vector<id::slow_row>(1000), {}).find("has not moved") != std::string::npos);
  CHECK(why(good, {.step = 1.0}).find("setting") != std::string::npos);
  CHECK(why(good, {.most = 16}).find("setting") != std::string::npos);
  auto swapped = good;
  for (auto& r : swapped) r.force = -r.force;
  CHECK(why(swapped, {.step = 1e-6}).find("does not resist") != std::string::npos);
  good[500].force = std::nan("");
  const auto found = id::fit_sliders(good, {.step = 1e-6});
  REQUIRE(found.refused != nullptr);
  CHECK(found.row == 500);
  CHECK(found.level() == 0.0);
}
