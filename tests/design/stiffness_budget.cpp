// SPDX-License-Identifier: BSD-3-Clause
// The stiffness that a device pays for: worked by hand, at compile time; and what the formula says of a
// swing against the certificate itself, summed tick by tick.
#include "support/catch.hpp"
#include "support/half_told.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/design/stiffness_budget.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/motion_estimator/edge_observer.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace design = ph::design;
namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using design::stated_device;
using design::stiffness_budget;
using design::stiffness_limit;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr bool near(double a, double b) {
  return a - b <= 1e-9 * b && b - a <= 1e-9 * b;
}

// half of what a Touch may have: (0.13 + 0.05·0.005)/55e-6 by slow kneading; 45e-3·0.1/1e-6 by the mass;
// 3 N twice a second take the hand 6π N/s/K far, less than a step a tick; 2·0.13/55e-6 at rest
constexpr stated_device touch{.mass = 0.045,
                              .damping = 0.05,
                              .friction = 0.13,
                              .presliding = 0.0,
                              .quantum = 55e-6,
                              .force_limit = 3.3};
constexpr auto of_touch = stiffness_budget(touch);
static_assert(near(of_touch.stiffness, 0.13025 / 55e-6));
static_assert(of_touch.binding == stiffness_limit::slow_kneading);
static_assert(near(of_touch.limit(stiffness_limit::sampled_mass), 4500.0));
constexpr double pi = 3.14159265358979323846;
constexpr double of_fast_touch = of_touch.limit(stiffness_limit::fast_kneading);
static_assert(near(of_fast_touch * 55e-6, 0.13 + 0.05 * 6 * pi / of_fast_touch));
static_assert(near(of_touch.limit(stiffness_limit::holding), 0.26 / 55e-6));
// 3 N need 27.5 µm and a reach of 55 µm + 8 N (1 ms)²/45 g; the motors' 3.3 N for a step
static_assert(near(of_touch.working_capital, 3.0 * (27.5e-6 + 55e-6 + 8e-6 / 0.045)));
static_assert(near(of_touch.loan, 3.3 * 55e-6));
static_assert(of_touch.crossing == 0.0);  // rigid friction holds it for nothing

// presliding of 15 µm makes each turn of a swing of 0.4 N cost 2·0.13·15e-6/0.4 m for each newton per metre,
// and a crossing K q p
constexpr auto elastic_touch = [] {
  stated_device d = touch;
  d.presliding = 15e-6;
  return d;
}();
static_assert(near(stiffness_budget(elastic_touch).stiffness, 0.13025 / (55e-6 + 9.75e-6)));
static_assert(near(stiffness_budget(elastic_touch).crossing,
                   0.13025 / (55e-6 + 9.75e-6) * 55e-6 * 15e-6));
static_assert(stiffness_budget(elastic_touch, {.swing = 1e-3, .hand_swing = 0.0}).stiffness < 40.0);
// of a long swing most edges are seen by an observer that knows the speed: 5/6 of a step
static_assert(near(stiffness_budget(elastic_touch, {.swing = 1e9}).stiffness,
                   0.13025 / (55e-6 * 5 / 6)));
// of 1.12 N that a hand swings by, 0.6 N are left for the wall
static_assert(near(stiffness_budget(elastic_touch, {.hand_swing = 1.12}).stiffness,
                   stiffness_budget(elastic_touch, {.swing = 0.6}).stiffness));

// a tick late: the sampled mass as of ticks of 3 ms, 5 µm a tick more that the force lags, and two ticks' reach
constexpr auto late_touch = [] {
  stated_device d = touch;
  d.latency = 1;
  return stiffness_budget(d);
}();
static_assert(near(late_touch.limit(stiffness_limit::sampled_mass), 500.0));
static_assert(near(late_touch.limit(stiffness_limit::slow_kneading), 0.13025 / (55e-6 + 5e-6)));
static_assert(near(late_touch.working_capital, 3.0 * (27.5e-6 + 110e-6 + 3 * 8e-6 / 0.045)));
// any latency that check() accepts is counted with: an overflow would not compile
static_assert([] {
  stated_device d = touch;
  d.latency = std::numeric_limits<int>::max();
  return !d.check() && stiffness_budget(d).stiffness >= 0.0;
}());

// a light device with fine encoders is held by its mass; a slow loop, by its sampling
static_assert(near(
    stiffness_budget(
        {.mass = 0.02, .friction = 0.2, .presliding = 0.0, .quantum = 1e-6, .force_limit = 5.0})
        .stiffness,
    2000.0));
constexpr stated_device fine{.mass = 1.0,
                             .damping = 0.5,
                             .friction = 0.05,
                             .presliding = 0.0,
                             .quantum = 1e-6,
                             .force_limit = 5.0};
constexpr design::intended_use shaking{.slowest = 1e-3, .frequency = 10.0};
constexpr auto of_fine = stiffness_budget(fine, shaking);
static_assert(of_fine.binding == stiffness_limit::fast_kneading);
static_assert(near(of_fine.stiffness * 0.5e-6 + 30 * pi * 0.5e-3,
                   0.05 + 0.5 * 30 * pi / of_fine.stiffness));
static_assert(near(of_fine.limit(stiffness_limit::slow_kneading), 0.0505 / 1e-6));
// at most as fast as is said
static_assert(near(stiffness_budget(fine, {.slowest = 1e-3, .fastest = 2e-3, .frequency = 10.0})
                       .limit(stiffness_limit::fast_kneading),
                   0.051 / 1.5e-6));
// exact positions and no friction: Colgate's 2b/T, at any speed
static_assert(near(stiffness_budget({.mass = 1.0, .damping = 0.3, .force_limit = 5.0}).stiffness,
                   600.0));
static_assert(stiffness_budget({.mass = 1.0, .damping = 0.3, .force_limit = 5.0})
                  .limit(stiffness_limit::holding) == infinity);

// without friction nothing: 9 N/m for slow kneading on steps of 10 µm, and none for a hand at rest
constexpr stated_device slippery{
    .mass = 0.1, .damping = 0.015, .quantum = 10e-6, .force_limit = 12.0};
static_assert(stiffness_budget(slippery).stiffness == 0.0);
static_assert(stiffness_budget(slippery).binding == stiffness_limit::holding);
constexpr double of_slippery = stiffness_budget(slippery).limit(stiffness_limit::slow_kneading);
static_assert(8.999 < of_slippery && of_slippery < 9.0);

// what cannot be is no budget
static_assert(stiffness_budget({}).binding == stiffness_limit::not_stated);
static_assert(stiffness_budget({}).stiffness == 0.0);
static_assert(stiffness_budget(touch, {.slowest = 0.1}).binding == stiffness_limit::not_stated);
static_assert(stated_device{.mass = 0.1}.check());
// friction is stated with what of it is elastic, and a continuous force with its time constant
static_assert(stiffness_budget({.mass = 0.1, .friction = 0.1, .quantum = 1e-5, .force_limit = 3.0})
                  .binding == stiffness_limit::not_stated);
static_assert(stated_device{.mass = 0.1, .force_limit = 3.0, .continuous_force = 1.0}.check());
static_assert(!stated_device{
    .mass = 0.1, .force_limit = 3.0, .continuous_force = 1.0, .winding_time = 10.0}
                   .check());
static_assert(design::intended_use{.swing = 0.0}.check());
static_assert(design::intended_use{.frequency = 0.0}.check());
static_assert(design::intended_use{.hand_swing = -1.0}.check());
static_assert(
    stated_device{.mass = 0.1, .quantum = 1e-5, .force_limit = 3.0, .latency = -1}.check());

// A device that turns has the budget of the same device at its handle, told in newtons and metres: a grip of 10 N at a
// lever of 20 mm is a knob of 0.2 N·m. A use of one's own is taken as it is.
constexpr stated_device at_its_handle{.mass = 0.1,
                                      .damping = 0.05,
                                      .friction = 0.13,
                                      .presliding = 15e-6,
                                      .quantum = 55e-6,
                                      .force_limit = 10.0};
constexpr double lever = 0.02;  // [m]
constexpr stated_device in_radians{.mass = 0.1 * lever * lever,
                                   .damping = 0.05 * lever * lever,
                                   .friction = 0.13 * lever,
                                   .presliding = 15e-6 / lever,
                                   .quantum = 55e-6 / lever,
                                   .force_limit = 10.0 * lever,
                                   .rotary = true};
constexpr auto of_handle = stiffness_budget(at_its_handle), of_knob = stiffness_budget(in_radians);
static_assert(of_knob.binding == of_handle.binding);
static_assert(near(of_knob.stiffness, of_handle.stiffness* lever* lever));
static_assert(near(of_knob.limit(stiffness_limit::fast_kneading),
                   of_handle.limit(stiffness_limit::fast_kneading) * lever * lever));
static_assert(near(of_knob.working_capital, of_handle.working_capital));  // [J]
static_assert(near(of_knob.loan, of_handle.loan));
static_assert(near(stiffness_budget(in_radians, {.swing = 0.002, .hand_swing = 0.0}).stiffness,
                   (0.13 * lever + 0.05 * lever * lever * 5e-3) /
                       (55e-6 / lever + 2.0 * 0.13 * 15e-6 / 0.002)));

constexpr double c = 0.1;  // [N]

/// The middle of the step that is shown.
struct middle_of_step {
  double q;
  double at(double shown, double /*way*/) const { return shown + q / 2; }
};
/// What encoder_touch has.
struct edges {
  explicit edges(double q) : eyes(ph::edge_observer{.quantum = q}) {
    (void)eyes.estimate(0.0, 0.0, 0.0, 1e-3, false);
  }
  double at(double shown, double way) {
    return eyes.estimate(shown, way, 0.0, 1e-3, true).position;
  }
  ph::part_at<ph::edge_observer, d1> eyes;
};

/// What is left of c for each metre of a swing of 20 mm into a wall K and out again: the certificate
///     Σ (u − f) Δx̂ − ½ q |change of u − f|,   u = c along the motion,
/// of forces held for a tick and positions known to a step.
template <class Eyes>
double left_of_friction(Eyes eyes, double K, double q, double v, double T) {
  const auto shown = [q](double x) { return q * std::floor(x / q); };
  double x = 0.1 * q, last = shown(x), sum = 0.0, way = 0.0;
  double seen = eyes.at(last, 0.0), slope = c + K * seen;
  for (const double side : {1.0, -1.0}) {
    while (side > 0.0 ? x < 20e-3 : x > q) {
      x += side * v * T;
      const double now = shown(x), force = -K * seen, u = side * c;
      sum += (u - force) * (now - last) - q / 2 * std::abs((u - force) - slope);
      slope = u - force;
      way += std::abs(now - last);
      seen = eyes.at(now, now - last);
      last = now;
    }
  }
  return sum / way;
}

}  // namespace

TEST_CASE("a swing into a wall costs K (q + max(q, vT))/2 for each metre of it",
          "[design][devices]") {
  for (const double K : {300.0, 1000.0, 5000.0}) {
    for (const double q : {1e-6, 10e-6, 60e-6}) {
      for (const double v : {1.7e-3, 5.3e-3, 51e-3, 0.31}) {
        CAPTURE(K, q, v);
        const double cost = K * (q + std::max(q, v * 1e-3)) / 2;
        CHECK_THAT(c - left_of_friction(middle_of_step{q}, K, q, v, 1e-3), WithinRel(cost, 0.06));
      }
    }
  }
}

TEST_CASE("a budget leaves a swing at either end of its speeds what it costs, and no more",
          "[design][devices]") {
  for (const double q : {1e-6, 10e-6, 60e-6}) {
    const stated_device device{
        .mass = 1.0, .friction = c, .presliding = 0.0, .quantum = q, .force_limit = 9.0};
    const design::intended_use use{
        .slowest = 1.7e-3, .fastest = 0.31, .frequency = 1e6, .swing = 1e6};
    const auto budget = stiffness_budget(device, use);
    CAPTURE(q, budget.stiffness);
    const double K = std::min(budget.limit(stiffness_limit::slow_kneading),
                              budget.limit(stiffness_limit::fast_kneading));
    for (const double v : {use.slowest, use.fastest}) {
      CHECK(left_of_friction(edges(q), 0.94 * K, q, v, 1e-3) > 0.0);
    }
    const double worst = std::min(left_of_friction(edges(q), 1.06 * K, q, use.slowest, 1e-3),
                                  left_of_friction(edges(q), 1.06 * K, q, use.fastest, 1e-3));
    CHECK(worst < 0.0);
  }
}

TEST_CASE("an edge crossed to and fro costs the ledger itself two crossings", "[design][devices]") {
  const double q = 10e-6;
  for (const double p : {0.0, 3e-6, 9e-6, 15e-6, 1.0}) {
    const bool rubs = p < 1.0;
    const stated_device device{
        .mass = 1.0, .friction = rubs ? c : 0.0, .presliding = p, .quantum = q, .force_limit = 9.0};
    const double K = 100.0;
    const double crossing = design::detail::crossing(device, K);
    ph::part_at<ph::dual_ledger, d1> ledger(ph::dual_ledger{
        .damping = {.coefficient = 1e-9, .coulomb = device.friction, .presliding = rubs ? p : 0.0},
        .quantum = q,
        .loan = 1.0});
    const double before = ledger.value();
    for (int i = 0; i < 1000; ++i) {
      REQUIRE(ledger.update(-q, 0.0, 1e-3));  // in, and the motors hold what was before the edge
      REQUIRE(ledger.update(q, K * q, 1e-3));
    }
    CAPTURE(p, crossing);
    CHECK_THAT(before - ledger.value(), WithinAbs(2000 * crossing, 1e-3 * 2000 * K * q * q));
  }
}

TEST_CASE("every limit has a name, and says what would raise it", "[design][devices]") {
  for (int i = 0; i < 5; ++i) {
    design::budget b{.stiffness = 1.0, .binding = static_cast<stiffness_limit>(i)};
    CHECK(std::string(to_string(b.binding)) != "unknown limit");
    CHECK(std::string(b.because()).size() > 20);
  }
  CHECK(std::string(to_string(static_cast<stiffness_limit>(99))) == "unknown limit");
  CHECK(std::string(stiffness_budget(slippery).because()).find("No dry friction") == 0);
}

TEST_CASE("the simulated devices, half of b and c stated, can promise what a table says",
          "[design][devices]") {
  for (const auto& preset : sim::all_presets) {
    const auto budget = stiffness_budget(half_told(preset, 0.0));
    CAPTURE(preset.name, budget.stiffness, to_string(budget.binding));
    CHECK((budget.stiffness > 0.0) == (preset.friction > 0.0));
    CHECK(budget.stiffness < 15e3);
    CHECK(budget.working_capital < 4e-3);
  }
}
