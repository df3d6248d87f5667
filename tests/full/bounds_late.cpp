// SPDX-License-Identifier: BSD-3-Clause
// reachable_bound in loops that are 0 to 3 ticks late: what it promises there, and what it costs to state another
// latency than the real one, in either direction. And how calmly strict_bound cuts there.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/simulation/challenge.hpp>
#include <passive_haptics/simulation/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sim = ph::simulation;
using by = sim::adversary;

namespace {

constexpr ph::reachable_bound told{.mass = 0.1, .hand_force = 5.0};

/// The spring of the thesis in a loop of the latency stated.
template <class Space, int Stated, class Bound = ph::reachable_bound>
auto model_of(const Bound& bound = told) {
  const ph::late_loop_limits<Stated> limits{
      .longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};
  return following_half_space<Space>(ph::spring{}, thesis_ledger(), bound, limits);
}

/// A model that is shown positions and nothing else, as on a device that does not report its force.
template <class Model>
struct shown_positions {
  using space_type = typename Model::space_type;
  using constraint_type = typename Model::constraint_type;
  Model model;

  auto tick(const ph::device_sample<space_type>& sample) noexcept {
    return model.tick(sample.position, ph::seconds{sample.dt});
  }
  bool update(const constraint_type& next) noexcept { return model.update(next); }
};
template <class Model>
shown_positions(Model) -> shown_positions<Model>;

/// The least energy that a tapping hand has left, of so many runs each.
template <class Model>
double tapped(const Model& model, const sim::circumstances& world, int runs = 50) {
  return std::min(sim::challenge(model, by::tapping, world, runs).least_energy,
                  sim::challenge(model, by::random_tapping, world, runs).least_energy);
}

/// Taps and loses samples now and then; the least port energy.
template <class Limits>
double tapped_and_lost(const Limits& limits, const auto& ledger, double quantum, double lost,
                       std::uint64_t seed) {
  auto model = following_half_space<d1>(ph::spring{}, ledger, told, limits);
  sim::random_source random(seed);
  const double K = random.uniform(500.0, 20000.0);
  (void)model.update(wall<d1>(K));
  sim::device<d1, sim::tapping_hand<d1>> device(
      {.mass = 0.1, .quantum = quantum, .start = -1e-3, .latency = 1},
      {.surface = 0.0, .normal = -1.0, .limit = 5.0});
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 2000; ++n) {
    if (n % 35 == 0) (void)model.update({random.uniform(-2e-3, 2e-3), -1.0, K});
    if (random.chance(lost)) sample.valid = false;
    sample = device.exchange(model.tick(sample).force);
  }
  return device.meter().minimum();
}

/// strict_bound as it was before it shared out: a command may spend all that the ledger has left.
struct all_at_once : ph::strict_bound {
  template <ph::port P>
  struct on {
    template <class... States>
    static constexpr bool only_reduces = true;
    constexpr explicit on(const all_at_once& /*p*/) noexcept {}
    [[nodiscard]] constexpr auto limit(const typename P::effort& desired,
                                       const auto& state) const noexcept {
      return ph::share{
          state.damping.affordable(desired, state.energy - state.in_flight(), state.longest_tick)};
    }
  };
};

/// What a hand that holds still feels of walls that are cut.
struct cut_at_rest {
  int not_quiet = 0;
  double step = 0.0, least_energy = 0.0;
  std::vector<double> shown{};  ///< force over depth of each [N/m]
};

/// 40 devices, masses, dampings, walls, hands and pushes drawn, in a loop so late, for 6 s each.
template <int Late, class Bound>
cut_at_rest held_still(const Bound& bound, std::uint64_t seed) {
  cut_at_rest found;
  for (std::uint64_t i = 0; i < 40; ++i) {
    sim::random_source random(seed * 1000 + i);
    const auto drawn = [&](double low, double high) {
      return low * std::exp(random.uniform(0.0, std::log(high / low)));
    };
    const double mass = drawn(0.05, 0.5), b = mass / 1e-3 * drawn(1e-3, 0.03);
    const double hand = random.chance(0.5) ? 100.0 : 400.0, held_by = hand == 100.0 ? 1.0 : 6.0;
    const double goal = drawn(2e-3, 2e-2), load = random.uniform(0.1, 2.0);
    const ph::late_loop_limits<Late> limits{.longest_tick = 1e-3, .top_speed = 100.0};
    auto model = following_half_space<d1>(ph::damped_spring{.mass = mass},
                                          ph::reduced_energy{.damping = b}, bound, limits);
    REQUIRE(model.update(wall<d1>(drawn(300.0, 2e4))));
    std::array<double, std::size_t{Late} + 1> due{};
    double x = -2e-3, v = 0.0, last = 0.0, energy = 0.0, step = 0.0;
    for (int n = 0; n < 6000; ++n) {
      due.back() = model.tick(x, ph::seconds{1e-3}).force;
      if (n >= 5000) step = std::max(step, std::abs(due.back() - last));
      last = due.back();
      for (int part = 0; part < 20; ++part) {  // of the tick that its force is held for
        const double pushed = hand * (goal - x) + load - held_by * v;
        const double before = v;
        v += (due.front() + pushed - b * v) / mass * 5e-5;
        const double way = (v + before) / 2.0 * 5e-5;
        x += way;
        energy += b * v * way - due.front() * way;
        found.least_energy = std::min(found.least_energy, energy);
      }
      std::rotate(due.begin(), due.begin() + 1, due.end());
    }
    found.not_quiet += step <= 0.02 ? 0 : 1;
    found.step = std::max(found.step, step);
    found.shown.push_back(-last / x);
  }
  return found;
}

}  // namespace

TEST_CASE("what strict_bound cuts in a late loop is cut alike in every tick", "[bound]") {
  const auto look = [](auto late) {
    constexpr int k = decltype(late)::value;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const cut_at_rest now = held_still<k>(ph::strict_bound{}, seed);
      const cut_at_rest before = held_still<k>(all_at_once{}, seed);  // the control
      CAPTURE(k, seed, now.step, before.not_quiet, before.step);
      CHECK(now.not_quiet == 0);
      CHECK(now.least_energy >= -1e-12);
      CHECK(before.not_quiet > 5);
      CHECK(before.step > 0.1);
      double total = 0.0, total_before = 0.0;
      for (std::size_t i = 0; i < now.shown.size(); ++i) {
        total += std::log(now.shown[i]);
        total_before += std::log(before.shown[i]);
      }
      CAPTURE(std::exp((total - total_before) / 40.0));
      CHECK(total >
            total_before - 40.0 * 0.1);  // and no wall is softer for it, by more than a tenth
    }
  };
  look(std::integral_constant<int, 1>{});
  look(std::integral_constant<int, 2>{});
  look(std::integral_constant<int, 3>{});
}

TEMPLATE_TEST_CASE("reachable_bound told of it survives hands a tick late, untold it does not",
                   "[bound][law]", d1, d2, d3) {
  const sim::circumstances late{.latency = 1};
  for (const by adversary : {by::tapping, by::random_tapping}) {
    CAPTURE(to_string(adversary));
    const auto v = sim::challenge(model_of<TestType, 1>(), adversary, late, 200);
    CHECK(passes(v));
    CHECK(v.largest_force > 1.0);
    const auto control = sim::challenge(model_of<TestType, 0>(), adversary, late, 50);
    CHECK(control.least_energy < -1e-5);
    CHECK(passes(sim::challenge(model_of<TestType, 1>(), adversary, {}, 50)));
  }
}

TEMPLATE_TEST_CASE("reachable_bound survives hands two and three ticks late as it does on time",
                   "[bound][law]", d1, d3) {
  const auto survives = [](const auto& model, const auto& untold, int latency) {
    const sim::circumstances late{.latency = latency};
    for (const by adversary : {by::tapping, by::random_tapping}) {
      CAPTURE(to_string(adversary), latency);
      const auto v = sim::challenge(model, adversary, late, 100);
      CHECK(passes(v));
      CHECK(v.largest_force > 1.0);
    }
    CHECK(tapped(untold, late) < -1e-5);  // the control: really one tick later than stated
  };
  survives(model_of<TestType, 0>(), model_of<TestType, 0>(ph::no_bound{}), 0);
  survives(model_of<TestType, 2>(), model_of<TestType, 1>(), 2);
  survives(model_of<TestType, 3>(), model_of<TestType, 2>(), 3);
}

TEST_CASE("the search with a limited force finds nothing in reachable_bound told how late it is",
          "[bound][search]") {
  CHECK(sim::worst_push(model_of<d1, 1>(), {.latency = 1}, 1000).energy >= -1e-12);
  CHECK(sim::worst_push(model_of<d1, 2>(), {.latency = 2}, 1000).energy >= -1e-12);
  CHECK(sim::worst_push(model_of<d1, 3>(), {.latency = 3}, 1000).energy >= -1e-12);
  CHECK(sim::worst_push(model_of<d1, 0>(), {.latency = 1}, 300).energy < -1e-4);
  CHECK(sim::worst_push(model_of<d1, 1>(), {.latency = 2}, 300).energy < -1e-4);
  CHECK(sim::worst_push(model_of<d1, 2>(), {.latency = 3}, 300).energy < -1e-4);
}

TEST_CASE("reachable_bound in a late loop loses where it was misled", "[bound]") {
  const sim::circumstances late{.latency = 1};
  CHECK(tapped(model_of<d1, 1>(), late) >= -1e-12);
  const ph::reachable_bound heavier{.mass = 0.5, .hand_force = 5.0};
  CHECK(tapped(model_of<d1, 1>(heavier), late) < -1e-5);
  CHECK(tapped(model_of<d1, 1>(), {.hand_force = 30.0, .latency = 1}) < -1e-5);
  CHECK(tapped(model_of<d1, 1>(), {.latency = 2}) < -1e-5);
  CHECK(sim::worst_motion(model_of<d1, 1>(), late, 300).energy < -1e-3);  // any hand
}

TEST_CASE("a latency that is overstated loses, too", "[bound]") {
  // The ledger then pairs every motion with a force that was not there.
  const auto strict = [](auto stated, int real) {
    using loop = decltype(stated);
    const shown_positions model{model_of<d1, loop::value>(ph::strict_bound{})};
    return tapped(model, {.latency = real}, 100);
  };
  const auto reachable = [](auto stated, int real) {
    using loop = decltype(stated);
    const shown_positions model{model_of<d1, loop::value>()};
    return tapped(model, {.latency = real}, 100);
  };
  const std::integral_constant<int, 1> one;
  const std::integral_constant<int, 2> two;
  CHECK(reachable(one, 0) < -1e-6);
  CHECK(reachable(two, 1) < -1e-6);
  CHECK(strict(one, 0) < -1e-6);
  CHECK(strict(two, 1) < -1e-6);
  CHECK(reachable(one, 1) >= -1e-12);  // the controls
  CHECK(reachable(two, 2) >= -1e-12);
  CHECK(strict(one, 1) >= -1e-12);
  CHECK(strict(two, 2) >= -1e-12);
}

TEST_CASE("reachable_bound in a late loop stays passive on steps and through lost samples",
          "[bound]") {
  const ph::quantised_energy sure{.damping = 0.03, .quantum = 6e-5};
  const ph::late_loop_limits<1> late{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};
  double steps = 0.0, losses = 0.0, both = 0.0, control = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    steps = std::min(steps, tapped_and_lost(late, sure, 6e-5, 0.0, seed));
    losses = std::min(losses, tapped_and_lost(late, thesis_ledger(), 0.0, 0.05, seed));
    both = std::min(both, tapped_and_lost(late, sure, 6e-5, 0.05, seed));
    control = std::min(control, tapped_and_lost(thesis_loop, sure, 6e-5, 0.05, seed));
  }
  CHECK(steps >= -1e-12);
  CHECK(losses >= -1e-12);
  CHECK(both >= -1e-12);
  CHECK(control < -1e-5);
}
