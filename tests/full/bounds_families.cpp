// SPDX-License-Identifier: BSD-3-Clause
// The relatives of strict_bound, without a bank, with one bank per axis, energy bounding and the
// sector, against all adversaries in 1, 2 and 3 dimensions, judged by the true energy at the port.
// Every promise has a control: something that loses under the same attack.
#include "force_bound/attacks.hpp"
#include "published/stores.hpp"
#include "support/catch.hpp"
#include <passive_haptics/published/published.hpp>
#include <passive_haptics/shaper/force_rate_limit.hpp>
#include <passive_haptics/shaper/thesis_rule.hpp>

using attacks::conditions, attacks::generous;

namespace {

constexpr ph::memoryless_bound memoryless;
constexpr ph::per_axis_bound per_axis;
constexpr ph::energy_bounding eba;
constexpr ph::tight_energy_bounding tight;
constexpr ph::sector_bound sector;

/// The least energy in 1, 2 and 3 dimensions, and in one.
template <class Bound, class Limits = ph::loop_limits>
double least_in_all(const Bound& bound, const conditions& when, const Limits& limits) {
  return std::min({attacks::worst_of<d1>(attacks::model_of<d1>(bound, limits), when).least,
                   attacks::worst_of<d2>(attacks::model_of<d2>(bound, limits), when).least,
                   attacks::worst_of<d3>(attacks::model_of<d3>(bound, limits), when).least});
}
template <class Bound>
double least_in_all(const Bound& bound, const conditions& when) {
  return least_in_all(
      bound, when,
      ph::loop_limits{
          .longest_tick = when.longest_tick, .top_speed = 100.0, .watchdog = when.longest_tick});
}
template <class Bound>
double least_in_one(const Bound& bound, const conditions& when) {
  return attacks::least_of<d1>(bound, when);
}

/// All that may go wrong in a loop that keeps to what it stated.
const std::array<std::pair<const char*, conditions>, 6> troubles{{
    {"exact ticks", {}},
    {"jitter", {.jitter = true, .longest_tick = 1.5e-3}},
    {"lost samples", {.lost = 0.05}},
    {"late ticks and a watchdog", {.late = 0.05}},
    {"weak motors", {.force_limit = 0.03}},
    {"all at once",
     {.jitter = true, .lost = 0.02, .late = 0.02, .longest_tick = 1.5e-3, .force_limit = 0.3}},
}};

}  // namespace

TEST_CASE("memoryless, per axis, energy and sector bounds obey their laws in every dimension",
          "[bound][law]") {
  CHECK(the_families_obey<d2>(1000));
  CHECK(the_families_obey<d3>(1000));
  CHECK(the_families_obey<f2>(1000));
  CHECK(the_families_obey<f3>(1000));
}

TEST_CASE("energy_bounding returns the nearest force of its window in 2 and 3 dimensions",
          "[bound]") {
  const auto nearest = [](auto space) {
    using S = decltype(space);
    using vector = typename S::vector;
    using axes = ph::diagonal_damping<S::dof>;
    axes damping;
    for (int i = 0; i < S::dof; ++i) {
      damping.coefficients[static_cast<std::size_t>(i)] = 0.03 + 0.02 * i;
    }
    situation<S, axes> now{.damping = at<S>(damping)};
    const double c2 = 20.0;
    sim::random_source random(11);
    std::array<int, 3> kinds{};  // as asked, on the ball, on the half-space
    for (int i = 0; i < 400; ++i) {
      const vector held = random.direction<S>() * random.uniform(0.0, 1.0);
      const vector dx = random.direction<S>() * random.uniform(0.0, 2e-2);
      const vector desired = random.direction<S>() * random.uniform(0.0, 2.0);
      const double radius = std::sqrt(held.squaredNorm() + c2 * c2 * dx.squaredNorm());
      const double paid = now.damping.dissipated(dx, 1e-3);
      const auto in_window = [&](const vector& f, double slack) {
        return (held - f).dot(dx) <= paid + slack && (f + c2 * dx).norm() <= radius + slack;
      };
      now.held = held;
      now.travel = dx;
      auto bound = at<S>(ph::energy_bounding{.storage = c2});
      const vector f = allowed(bound, desired, now);
      if (!in_window(f, 1e-12)) return false;
      const double away = (f - desired).norm();
      if (in_window(desired, 0.0) != (away == 0.0)) return false;
      kinds[away == 0.0 ? 0 : (held - f).dot(dx) < paid - 1e-9 ? 1 : 2] += 1;
      for (int k = 0; k < 200; ++k) {
        const vector other =
            f + random.direction<S>() * (k % 2 == 0 ? random.uniform(0.0, 1.0) : 1e-3);
        if (in_window(other, 0.0) && (other - desired).norm() < away - 1e-12) return false;
      }
    }
    return *std::min_element(kinds.begin(), kinds.end()) > 20;
  };
  CHECK(nearest(d2{}));
  CHECK(nearest(d3{}));
}

TEST_CASE("energy_bounding survives steps too small to square", "[bound]") {
  const auto check = [](auto space) {
    using S = decltype(space);
    using scalar = typename S::scalar;
    using vector = typename S::vector;
    sim::random_source random(23);
    for (int i = 0; i < 3000; ++i) {
      const double tiny = std::pow(10.0, random.uniform(-45.0, -3.0));
      const vector held = sim::to_port<S>(random.direction<S>());
      const vector dx =
          sim::to_port<S>(typename sim::physical<S>::vector(random.direction<S>() * tiny));
      const vector desired = sim::to_port<S>(
          typename sim::physical<S>::vector(random.direction<S>() * random.uniform(0.0, 1e4)));
      const situation<S> now{.held = held, .travel = dx};
      const vector f = [&] {
        auto bound = at<S>(ph::energy_bounding{});
        return allowed(bound, desired, now);
      }();
      if (!S::is_finite(f)) return false;
      const scalar slack = scalar(32) * std::numeric_limits<scalar>::epsilon();
      const scalar most =
          scalar(1) + scalar(60) * (now.damping.dissipated(dx, scalar(1e-3)) - S::dot(held, dx));
      if (!(S::dot(f, f) <= most + slack)) return false;
    }
    return true;
  };
  CHECK(check(f1{}));
  CHECK(check(f2{}));
  CHECK(check(f3{}));
  CHECK(check(d3{}));
}

TEST_CASE("the families lose nothing to any adversary in 1, 2 and 3 dimensions",
          "[passivity][families]") {
  for (const auto& [trouble, when] : troubles) {
    INFO(trouble);
    CHECK(least_in_all(memoryless, when) >= -1e-12);
    CHECK(least_in_all(per_axis, when) >= -1e-12);
    CHECK(least_in_all(eba, when) >= -1e-12);
    CHECK(least_in_all(tight, when) >= -1e-12);
    CHECK(least_in_one(sector, when) >= -1e-12);
    CHECK(least_in_one(ph::sector_bound{.slope = 15}, when) >= -1e-12);
    CHECK(least_in_one(ph::energy_bounding{.slope = 20, .storage = 5}, when) >= -1e-12);
    CHECK(least_in_one(ph::tight_energy_bounding{.storage = 15}, when) >= -1e-12);
  }
}

TEST_CASE("memoryless_bound with latency survives it, and so does what remembers as little (§ 3)",
          "[passivity][families]") {
  const ph::late_loop_limits<2> told_two{
      .longest_tick = 1.5e-3, .top_speed = 100.0, .watchdog = 1.5e-3};
  for (const int latency : {1, 2, 5}) {
    const conditions when{.jitter = true,
                          .lost = 0.03,
                          .longest_tick = 1.5e-3,
                          .force_limit = 0.1,
                          .latency = latency};
    CHECK(least_in_all(memoryless, {.latency = latency}) >= -1e-12);
    CHECK(least_in_all(memoryless, when, told_two) >= -1e-12);
    CHECK(least_in_all(ph::strict_bound{}, when) < -1e-7);  // the control
    // by the same proof, for what reads the force really held
    CHECK(least_in_all(eba, when) >= -1e-12);
    CHECK(least_in_one(sector, when) >= -1e-12);
  }
  // told the latency, the model itself knows what was held
  const auto least = [](const auto& limits) {
    auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), memoryless, limits);
    (void)model.update(wall<d1>(1e4));
    sim::prescribed_motion<d1> device({.latency = 2});
    sim::random_source random(3);
    double position = 0.0;
    for (int n = 0; n < 20000; ++n) {
      const double force = model.tick(position, 1ms).force;
      const double worst = device.upcoming(force) / 60.0;
      position += random.chance(0.5) ? random.uniform(0.0, 1e-3) : worst;
      device.move_to(position);
      (void)device.exchange(force);
    }
    return device.meter().minimum();
  };
  CHECK(least(ph::late_loop_limits<2>{
            .longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3}) >= -1e-12);
  CHECK(least(thesis_loop) < -1e-6);  // the control
}

TEST_CASE("the same adversaries draw energy from a little more than the families allow",
          "[passivity][families]") {
  for (const auto& [trouble, when] : troubles) {
    INFO(trouble);
    CHECK(least_in_one(generous<ph::memoryless_bound>{}, when) < -1e-8);
    CHECK(least_in_one(generous<ph::per_axis_bound>{}, when) < -1e-8);
    CHECK(least_in_one(generous<ph::energy_bounding>{{}, 3}, when) < -1e-8);
    CHECK(least_in_one(generous<ph::tight_energy_bounding>{}, when) < -1e-8);
    CHECK(least_in_one(generous<ph::sector_bound>{}, when) < -1e-8);
  }
}

TEST_CASE("the families stand on their assumptions, and fall with them", "[passivity][families]") {
  SECTION("ticks longer than stated, and no watchdog") {
    const conditions when{.jitter = true, .longest_tick = 1e-3};
    CHECK(least_in_one(memoryless, when) < -1e-9);
    CHECK(least_in_one(per_axis, when) < -1e-9);
    CHECK(least_in_one(sector, when) < -1e-9);
    CHECK(least_in_one(eba, when) >= -1e-12);  // up to twice as long is put aside
    CHECK(least_in_one(eba, {.late = 0.1, .watchdog = false}) < -1e-9);
  }
  SECTION("motors that are a tick late") {
    const conditions when{.latency = 1};
    CHECK(least_in_one(per_axis, when) < -1e-6);
    CHECK(least_in_one(ph::strict_bound{}, when) < -1e-6);
  }
  SECTION("motors that give more than they are told") {
    const conditions when{.gain = 1.1};
    CHECK(least_in_one(memoryless, when) < -1e-6);
    CHECK(least_in_one(per_axis, when) < -1e-9);  // a debt, and repaid
    CHECK(least_in_one(per_axis, when) > least_in_one(memoryless, when) / 2);
    CHECK(least_in_one(sector, when) < -1e-6);
    CHECK(least_in_one(eba, when) >= -1e-12);  // up to √2 is put aside
    CHECK(least_in_one(eba, {.gain = 2}) < -1e-6);
  }
  SECTION("positions in steps") {
    const conditions when{.quantum = 60e-6};
    CHECK(least_in_one(memoryless, when) < -1e-6);
    CHECK(least_in_one(per_axis, when) < -1e-6);
    CHECK(least_in_one(sector, when) < -1e-6);
  }
  SECTION("less damping than stated") {
    const conditions when{.b = {0.02, 0.02, 0.02}};
    CHECK(least_in_one(memoryless, when) < -1e-6);
    CHECK(least_in_one(per_axis, when) < -1e-6);
    CHECK(least_in_one(sector, when) < -1e-6);
  }
}

TEST_CASE("the families lose nothing with unequal axes", "[passivity][families]") {
  const conditions when{.jitter = true, .longest_tick = 1.5e-3, .b = {0.03, 0.03, 0.008}};
  const ph::loop_limits limits{.longest_tick = 1.5e-3, .top_speed = 100.0, .watchdog = 1.5e-3};
  using axes = ph::basic_reduced_energy<ph::diagonal_damping<3>>;
  const axes ledger{.damping = {{0.03, 0.03, 0.008}}}, wrong{.damping = {{0.03, 0.03, 0.012}}};
  const auto least = [&](const auto& bound, const axes& observer) {
    const auto model = attacks::model_of<d3>(bound, limits, ph::spring{}, observer);
    return attacks::worst_of<d3>(model, when, 40).least;
  };
  CHECK(least(memoryless, ledger) >= -1e-12);
  CHECK(least(per_axis, ledger) >= -1e-12);
  CHECK(least(eba, ledger) >= -1e-12);
  CHECK(least(tight, ledger) >= -1e-12);
  CHECK(least(memoryless, wrong) < -1e-9);
  CHECK(least(per_axis, wrong) < -1e-9);
  CHECK(least(tight, wrong) < -1e-9);
}

TEST_CASE("a chain around a family loses nothing", "[passivity][families]") {
  const ph::actuator_limit motors{.most = 0.05};
  const ph::shaped slow{ph::spring{}, ph::force_rate_limit{.rate = 100}};
  const ph::shaped thesis{ph::spring{}, ph::thesis_rule{}};
  const auto least = [](const auto& law, const auto& bound) {
    return attacks::worst_of<d2>(attacks::model_of<d2>(bound, thesis_loop, law), {}).least;
  };
  CHECK(least(slow, ph::bound_chain{memoryless, motors}) >= -1e-12);
  CHECK(least(slow, ph::bound_chain{eba, motors}) >= -1e-12);
  CHECK(least(ph::spring{}, ph::bound_chain{eba, ph::strict_bound{}}) >= -1e-12);
  CHECK(least(thesis, ph::bound_chain{per_axis, motors}) >= -1e-12);
  CHECK(least(slow, motors) < -1e-6);
}

TEST_CASE("in float the families lose no more than rounding", "[passivity][families]") {
  const conditions when{.ticks = 2000};
  const auto lost = [&when](auto space, const auto& bound, const auto& law) {
    using S = decltype(space);
    const auto one = attacks::worst_of<S>(attacks::model_of<S>(bound, thesis_loop, law), when, 4);
    REQUIRE(one.through > 1e-3);
    return -one.least / one.through;
  };
  const ph::spring spring;
  CHECK(lost(f1{}, memoryless, spring) < 1e-7);
  CHECK(lost(f1{}, sector, spring) < 1e-7);
  CHECK(lost(f3{}, memoryless, spring) < 1e-7);
  CHECK(lost(f3{}, per_axis, spring) < 1e-7);
  CHECK(lost(f3{}, eba, spring) < 1e-7);
  const ph::shaped thesis{spring, ph::thesis_rule{}};
  CHECK(lost(f1{}, ph::no_bound{}, thesis) > 1e-3);  // the control
}
