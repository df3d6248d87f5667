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
                double offset = 0.0, double speed = 0.5e-3) {
  recording seen;
  auto state = friction.begin();
  double x = 0.0;
  const auto show = [step](double at) { return step > 0.0 ? step * std::floor(at / step) : at; };
  for (const double goal : places) {
    while (std::abs(goal - x) > 1e-12) {
      const double way = std::clamp(goal - x, -0.5e-6, 0.5e-6);
      const auto took = friction.slide(state, x, way, std::abs(way) / speed);
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

TEST_CASE("friction that has fallen since it was stated shows with hands off, and only that",
          "[identification][sliders]") {
  const auto found = id::fit_sliders(moved(soft, ramps, 1e-6).rows, {.step = 1e-6});
  REQUIRE(found.refused == nullptr);
  const std::span<const id::slider> list(found.list.data(), static_cast<std::size_t>(found.count));
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto places = wander(seed, 200e-6, 40);
    CHECK(id::sure_share(list, moved(soft, places, 1e-6).rows, 1e-6) == 1.0);
    sim::maxwell_slip<4> worn = soft;
    for (double& c : worn.level) c *= 0.7;
    const double left = id::sure_share(list, moved(worn, places, 1e-6).rows, 1e-6);
    CHECK(left < 0.8);
    CHECK(left > 0.65);
  }
}

TEST_CASE("which frictions a list of sliders covers, told how much", "[identification][sliders]") {
  constexpr double step = 0.2e-6;
  const auto overstated = [](const auto& friction, double drift, double speed) {
    const auto found =
        id::fit_sliders(moved(friction, ramps, step).rows, {.step = step, .drift = drift});
    REQUIRE(found.refused == nullptr);
    double worst = -1.0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      for (const double most : {10e-6, 40e-6, 200e-6}) {
        const auto other = moved(friction, wander(seed, most, 400), step, 0.0, speed);
        const double reserve = 2.5 * found.level() * found.mean_presliding();
        worst = std::max(worst, credited(found, other) - other.lost - reserve);
      }
    }
    return worst;
  };
  // Covered as identified: what remembers where it was reversed.
  CHECK(overstated(soft, 0.0, 0.5e-3) <= 0.0);
  CHECK(overstated(sim::slider_and_spring{{0.25}, {15e-6}}, 0.0, 0.5e-3) <= 0.0);
  CHECK(overstated(sim::dupont_friction{0.2, 10e-6, 20e-6}, 0.0, 0.5e-3) <= 0.0);
  // A Stribeck curve is covered if the kinetic level is what is told: here 0.2 N of 0.3 N at speed.
  const sim::stribeck_friction stribeck{0.2, 0.3, 2e-3, 15e-6};
  CHECK(overstated(stribeck, 0.4, 20e-3) <= 0.0);
  CHECK(overstated(stribeck, 0.0, 20e-3) > 0.0);  // the control

  // Covered by nothing: what forgets it. "Forward 2, back 1" goes on for less than c a metre.
  const sim::dahl_friction dahl{0.25, 30e-6};
  const auto found = id::fit_sliders(moved(dahl, ramps, step).rows, {.step = step});
  REQUIRE(found.refused == nullptr);
  std::vector<double> dither{400e-6, 0.0};
  for (int i = 1; i < 2000; ++i) {
    dither.push_back(dither.back() + 2e-6);
    dither.push_back(dither.back() - 1e-6);
  }
  const auto creeping = moved(dahl, dither, step);
  CAPTURE(credited(found, creeping), creeping.lost);
  CHECK(credited(found, creeping) > creeping.lost + 2.5 * found.level() * found.mean_presliding());
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
