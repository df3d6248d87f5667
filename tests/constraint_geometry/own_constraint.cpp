// SPDX-License-Identifier: BSD-3-Clause
// A constraint of one's own, a sphere: nothing of the library has to know of it.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cmath>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;

namespace {

/// All x with |x − c| ≤ r: the first constraint whose normal depends on x.
struct sphere {
  using space_type = d3;
  using vector = d3::vector;

  d3::coordinates centre{};
  double radius{};     ///< [m]
  double stiffness{};  ///< [N/m]

  bool prepare() noexcept {
    return d3::is_finite(centre) && radius > 0.0 && stiffness > 0.0 && std::isfinite(stiffness) &&
           std::isfinite(radius);
  }
  struct probe {
    double depth;
    vector normal;
    [[nodiscard]] vector outward() const noexcept { return normal; }
    [[nodiscard]] static bool covered() noexcept { return true; }
  };
  [[nodiscard]] probe at(const vector& x) const noexcept {
    const vector out = x - vector(centre);
    const double away = d3::norm(out);
    return {radius - away, away > 0.0 ? vector(out / away) : vector(vector::UnitZ())};
  }
  /// A sphere of the target's size whose surface is d above x along n.
  [[nodiscard]] sphere toward(const sphere& target, const vector& x, const vector& n,
                              double d) const noexcept {
    return {vector(x + n * (d - target.radius)), target.radius, target.stiffness};
  }
};
static_assert(ph::constraint_for<sphere, d3>);

const sphere ball{.centre = d3::vector(0.0, 0.0, -0.04), .radius = 0.04, .stiffness = 2000.0};

/// A ball that the environment moves.
auto touch(const auto& ledger, const auto& bound) {
  return ph::local_model{d3{},
                         ph::followed<sphere>{},
                         ph::turn_limited{.rate = 4.0},
                         ph::spring{},
                         ledger,
                         bound,
                         thesis_loop};
}

/// The least port energy of a mass that a hand of 3 N presses on the ball and slides about it.
double slide(auto model) {
  (void)model.update(ball);
  sim::random_source random(5);
  sim::device<d3, sim::tapping_hand<d3>> device(
      {.mass = 0.1, .damping = 0.03, .start = {0.0, 0.0, 1e-3}},
      {.normal = {0.0, 0.0, 1.0}, .limit = 3.0});
  d3::vector x = device.position();
  for (int n = 0; n < 3000; ++n) {
    if (n % 40 == 39) {
      sphere next = ball;
      next.centre = d3::vector(random.uniform(-2e-3, 2e-3), 0.0, random.uniform(-0.041, -0.039));
      (void)model.update(next);
    }
    x = device.exchange(model.tick(x, 1ms).force).position;
  }
  return device.meter().minimum();
}

}  // namespace

TEST_CASE("a sphere of one's own obeys the law of constraints and presses outwards everywhere",
          "[geometry]") {
  CHECK(ph::laws::all<sphere, d3>(ball));
  auto model = touch(ph::no_observer{}, ph::no_bound{});
  REQUIRE(model.update(ball));
  (void)model.tick(d3::vector(0.0, 0.05, -0.04), 1ms);
  const d3::vector side = model.tick(d3::vector(0.0, 0.0399, -0.04), 1ms).force;
  CHECK_THAT(side.norm(), WithinAbs(0.2, 1e-9));
  CHECK_THAT(side.normalized().y(), WithinAbs(1.0, 1e-9));
}

TEST_CASE("a strict bound on a moving sphere of one's own loses nothing, no bound does",
          "[geometry][passivity]") {
  CHECK(slide(touch(thesis_ledger(), ph::strict_bound{})) >= -1e-12);
  CHECK(slide(touch(ph::no_observer{}, ph::no_bound{})) < -1e-3);  // the control
}
