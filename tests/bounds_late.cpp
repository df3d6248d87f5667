// SPDX-License-Identifier: BSD-3-Clause
// late_reachable_bound: what is promised when commands are held one tick late.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/simulation/challenge.hpp>
#include <passive_haptics/simulation/search.hpp>

#include <algorithm>

namespace sim = ph::simulation;
namespace k = ph::kernels;
using Catch::Matchers::WithinRel;
using by = sim::adversary;

namespace {

constexpr sim::circumstances late{.latency = 1};

template <class Space>
constexpr ph::late_reachable_bound<Space> told(double mass = 0.1, double hand_force = 5.0) {
  using scalar = typename Space::scalar;
  return {.mass = scalar(mass), .hand_force = scalar(hand_force)};
}

template <class Space, class Bound>
auto model_of(const Bound& bound) {
  return following_half_space<Space>(ph::spring<Space>{}, thesis_ledger<Space>(), bound);
}

template <class Space>
constexpr bool obeys(int ticks) {
  return ph::laws::scales_down<Space>(told<Space>(), ticks) &&
         ph::laws::adds_nothing_to_zero<Space>(told<Space>(), ticks);
}
static_assert(obeys<d1>(50) && obeys<f1>(50));
static_assert(ph::late_reachable_bound<d1>::traits.latency == 1);

/// Taps and loses samples now and then; the least port energy.
template <class Bound, class Observer>
double tapped(const Bound& bound, const Observer& ledger, double quantum, double lost,
              std::uint64_t seed) {
  auto model = following_half_space<d1>(ph::spring<d1>{}, ledger, bound);
  sim::random_source random(seed);
  const double K = random.uniform(500.0, 20000.0);
  model.retarget(wall<d1>(K));
  sim::device<d1, sim::tapping_hand<d1>> device(
      {.mass = 0.1, .quantum = quantum, .start = -1e-3, .latency = 1},
      {.surface = 0.0, .normal = -1.0, .limit = 5.0});
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 2000; ++n) {
    if (n % 35 == 0) model.retarget({random.uniform(-2e-3, 2e-3), -1.0, K});
    if (random.chance(lost)) sample.valid = false;
    sample = device.exchange(model.tick(sample).force);
  }
  return device.meter().minimum();
}

}  // namespace

TEST_CASE("reachable_outflow is the most that a force can hand over within its reach",
          "[kernels]") {
  for (const double B : {3.0, 30.0, 300.0}) {
    for (const double f : {0.01, 1.0, 20.0}) {
      for (const double reach : {-1e-3, 0.0, 1e-6, 1e-4, 1e-2, 1.0}) {
        double most = 0.0;
        for (int i = 0; i <= 10000; ++i) {
          const double s = std::clamp(reach, 0.0, f / B) * i / 10000.0;
          most = std::max(most, f * s - B * s * s);
        }
        const double said = k::reachable_outflow(f, B, reach);
        CHECK(said >= most * (1 - 1e-12));
        CHECK(said <= most * (1 + 1e-6));
      }
      CHECK(k::reachable_outflow(f, B, 1e9) == k::worst_outflow(f, B));
      CHECK(k::reachable_outflow(-f, B, 1.0) == 0.0);
      // What reachable_force_bound allows costs just what there is.
      const double F = k::reachable_force_bound(1e-3, B, 1e-3);
      CHECK(k::reachable_outflow(F, B, 1e-3) <= 1e-3);
      CHECK_THAT(k::reachable_outflow(F, B, 1e-3), WithinRel(1e-3, 1e-9));
    }
  }
}

TEMPLATE_TEST_CASE("late_reachable_bound survives hands a tick late, reachable_bound does not",
                   "[bound][law]", d1, d2, d3) {
  for (const by adversary : {by::tapping, by::random_tapping}) {
    CAPTURE(to_string(adversary));
    const auto v = sim::challenge(model_of<TestType>(told<TestType>()), adversary, late, 200);
    CHECK(passes(v));
    CHECK(v.largest_force > 1.0);
    const ph::reachable_bound<TestType> prompt{.mass = 0.1, .hand_force = 5.0};
    const auto control = sim::challenge(model_of<TestType>(prompt), adversary, late, 50);
    CHECK(control.least_energy < -1e-5);
    CHECK(passes(sim::challenge(model_of<TestType>(told<TestType>()), adversary, {}, 50)));
  }
}

TEST_CASE("the search with a limited force finds nothing in late_reachable_bound",
          "[bound][search]") {
  CHECK(sim::worst_push(model_of<d1>(told<d1>()), late, 1000).energy >= -1e-12);
  const ph::reachable_bound<d1> prompt{.mass = 0.1, .hand_force = 5.0};
  CHECK(sim::worst_push(model_of<d1>(prompt), late, 300).energy < -1e-4);
}

TEST_CASE("late_reachable_bound loses where it was misled", "[bound]") {
  const auto worst = [](const auto& bound, const sim::circumstances& world) {
    return std::min(
        sim::challenge(model_of<d1>(bound), by::tapping, world, 50).least_energy,
        sim::challenge(model_of<d1>(bound), by::random_tapping, world, 50).least_energy);
  };
  CHECK(worst(told<d1>(), late) >= -1e-12);
  CHECK(worst(told<d1>(0.5), late) < -1e-5);
  CHECK(worst(told<d1>(), {.hand_force = 30.0, .latency = 1}) < -1e-5);
  CHECK(worst(told<d1>(), {.latency = 2}) < -1e-5);
  CHECK(sim::worst_motion(model_of<d1>(told<d1>()), late, 300).energy < -1e-3);  // any hand
}

TEST_CASE("late_reachable_bound stays passive on steps and through lost samples", "[bound]") {
  const ph::quantised_energy<d1> sure{.damping = 0.03, .quantum = 6e-5};
  const ph::reachable_bound<d1> prompt{.mass = 0.1, .hand_force = 5.0};
  double steps = 0.0, losses = 0.0, both = 0.0, control = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    steps = std::min(steps, tapped(told<d1>(), sure, 6e-5, 0.0, seed));
    losses = std::min(losses, tapped(told<d1>(), thesis_ledger<d1>(), 0.0, 0.05, seed));
    both = std::min(both, tapped(told<d1>(), sure, 6e-5, 0.05, seed));
    control = std::min(control, tapped(prompt, sure, 6e-5, 0.05, seed));
  }
  CHECK(steps >= -1e-12);
  CHECK(losses >= -1e-12);
  CHECK(both >= -1e-12);
  CHECK(control < -1e-5);
}

TEST_CASE("late_reachable_bound pays for what is in flight", "[bound]") {
  const ph::isotropic_damping<d1> b = 0.03;
  ph::tick_state<d1> state{.damping = b,
                           .energy = 1e-5,
                           .in_flight = 0.0,
                           .dt = 1e-3,
                           .longest_tick = 1e-3,
                           .held = 0.0,
                           .displacement = -1e-4,
                           .motion_known = true,
                           .normal = -1.0,
                           .stiffness = 1e4,
                           .depth = 1e-3,
                           .target_depth = 1e-3,
                           .local_force = 0.0,
                           .target_changed = false};
  auto bound = told<d1>();
  const double first = -bound.limit(-10.0, state);
  CHECK(first > 0.0);
  const double second = -bound.limit(-10.0, state);  // the same again, `first` being on its way
  CHECK(second < 0.5 * first);
  SECTION("pressing costs nothing, in flight or not") {
    auto pressing = told<d1>();
    state.displacement = 1e-3;
    state.energy = 0.0;
    CHECK(pressing.limit(-10.0, state) == -10.0);
    CHECK(pressing.limit(-10.0, state) == -10.0);
  }
  SECTION("after a lost sample it is the strict bound with latency") {
    auto blind = told<d1>();
    state.motion_known = false;
    const double now = -blind.limit(-10.0, state);
    CHECK_THAT(now, WithinRel(std::sqrt(4 * 30 * 1e-5), 1e-9));
    CHECK(-blind.limit(-10.0, state) < 1e-6);
  }
}

TEST_CASE("a bad parameter of late_reachable_bound is refused with its name", "[bound]") {
  CHECK_FALSE(told<d1>().check());
  CHECK(std::string(told<d1>(0.0).check().parameter) == "mass");
  CHECK(std::string(told<d1>(0.1, -1.0).check().parameter) == "hand_force");
}
