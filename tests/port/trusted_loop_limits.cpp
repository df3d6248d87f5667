// SPDX-License-Identifier: BSD-3-Clause
// What a trusted loop keeps: every bit of an ordinary one while its samples are good. What bad ones cost
// it: attacks/trusted_samples.cpp.
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <random>
#include <string>
#include <utility>

namespace {

template <int Latency = 0>
constexpr ph::trusted_loop_limits<Latency> trusted{.longest_tick = 1e-3};
template <int Latency = 0>
constexpr ph::late_loop_limits<Latency> ordinary{.longest_tick = 1e-3, .top_speed = 100.0};

template <class Space>
auto moving_wall(const auto& bound, const auto& limits) {
  return following_half_space<Space>(ph::damped_spring{.mass = 0.1}, thesis_ledger<Space>(), bound,
                                     limits);
}
auto still_wall(const auto& limits) {
  return ph::local_model{d1{},         ph::fixed{wall<d1>(1e4)}, ph::turn_at_once{},
                         ph::spring{}, thesis_ledger(),          ph::strict_bound{},
                         limits};
}

/// The same good samples to two walls in two loops. How many of their forces were bounded; −1 as soon as
/// the results differ in one bit.
template <class Space>
int bounded_alike(auto one, auto other) {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  std::mt19937 random(1);
  const auto between = [&random](double low, double high) {
    return static_cast<scalar>(std::uniform_real_distribution<>(low, high)(random));
  };
  const auto any = [&between](double most) {
    vector v = Space::zero();
    for (int i = 0; i < Space::dof; ++i) Space::component(v, i) = between(-most, most);
    return v;
  };
  vector x = Space::zero(), force = Space::zero();
  int bounded = 0;
  for (int n = 0; n < 3000; ++n) {
    if (n % 50 == 0) {
      const ph::half_space<Space> next{any(1e-3), any(1.0), between(1e3, 9e3)};
      if (one.update(next) != other.update(next)) return -1;
    }
    x = vector(scalar(0.7) * x + any(3e-3));
    const scalar dt = between(0.3e-3, 0.99e-3);
    const ph::device_sample<Space> weak{x, vector(scalar(0.9) * force), dt, true};
    const auto a = n % 3 == 0 ? one.tick(weak) : one.tick(x, ph::seconds{dt});
    const auto b = n % 3 == 0 ? other.tick(weak) : other.tick(x, ph::seconds{dt});
    if (!(a.force == b.force) || a.depth != b.depth || a.energy != b.energy || a.what != b.what ||
        a.limited != b.limited) {
      return -1;
    }
    force = a.force;
    bounded += a.limited ? 1 : 0;
  }
  return bounded;
}

}  // namespace

TEST_CASE("a trusted loop gives every bit of an ordinary one while its samples are good",
          "[trusted_loop_limits]") {
  const ph::strict_bound strict;
  const ph::reachable_bound reach{.mass = 0.1, .hand_force = 5.0};
  const ph::bound_chain chain{strict, ph::actuator_limit{.most = 2.0}};
  const auto alike = [](auto space, const auto& bound, const auto& one, const auto& other) {
    using scene = decltype(space);
    return bounded_alike<scene>(moving_wall<scene>(bound, one), moving_wall<scene>(bound, other));
  };
  CHECK(alike(f1{}, strict, ordinary<>, trusted<>) > 40);
  CHECK(alike(d1{}, strict, ordinary<2>, trusted<2>) > 40);
  CHECK(alike(f2{}, reach, ordinary<>, trusted<>) > 40);
  CHECK(alike(d3{}, chain, ordinary<>, trusted<>) > 40);
  CHECK(alike(d1{}, strict, ordinary<>, trusted<2>) == -1);  // the control
}

TEST_CASE("what a trusted loop promises is conditional", "[trusted_loop_limits]") {
  STATIC_REQUIRE(decltype(still_wall(trusted<>))::passivity == ph::guarantee::conditional);
  STATIC_REQUIRE(decltype(still_wall(ordinary<>))::passivity == ph::guarantee::strict);
}

TEST_CASE("a number that is none gives no force in a trusted loop, and is soon over",
          "[trusted_loop_limits]") {
  const double nan = std::nan(""), T = 1e-3;
  for (const auto& [x, dt] : {std::pair{nan, T}, {HUGE_VAL, T}, {0.002, 0.0}, {0.002, nan}}) {
    CAPTURE(x, dt);
    auto model = still_wall(trusted<>);
    for (int n = 0; n < 20; ++n) static_cast<void>(model.tick(1e-4 * n, ph::seconds{T}));
    const double before = model.energy();
    const auto bad = model.tick(x, ph::seconds{dt});
    CHECK(bad.what == ph::event::rejected_sample);
    CHECK(bad.force == 0.0);
    CHECK(bad.energy == before);  // an ordinary loop writes off what the force may have cost
    CHECK(model.tick(0.002, ph::seconds{T}).force != 0.0);
    CHECK(model.energy() == before);  // nobody knows the motion
  }
  auto fresh = still_wall(trusted<>);
  CHECK(fresh.tick(nan, ph::seconds{T}).force == 0.0);
  CHECK(fresh.tick(1e-4, ph::seconds{T}).what ==
        ph::event::rejected_sample);  // no motion from nowhere
  CHECK(fresh.tick(1e-4, ph::seconds{T}).what == ph::event::nominal);
}

TEST_CASE("a late tick is booked as it was in a trusted loop, and not reported",
          "[trusted_loop_limits]") {
  auto one = still_wall(ordinary<>);
  auto other = still_wall(trusted<>);
  for (int n = 0; n < 20; ++n) {
    REQUIRE(one.tick(1e-4 * n, 1ms).force == other.tick(1e-4 * n, 1ms).force);
  }
  const auto reported = one.tick(0.0018, 5ms);
  const auto unnoticed = other.tick(0.0018, 5ms);
  CHECK(reported.what == ph::event::late_tick);
  CHECK(unnoticed.what == ph::event::nominal);
  CHECK(reported.energy == unnoticed.energy);
  CHECK(reported.force == unnoticed.force);
}

TEST_CASE("a trusted loop has a longest tick and nothing else to state", "[trusted_loop_limits]") {
  using limits = ph::trusted_loop_limits<3>;
  STATIC_REQUIRE(limits::latency == 3);
  STATIC_REQUIRE(sizeof(limits::on<f1>) == sizeof(float));
  STATIC_REQUIRE(sizeof(ph::trusting_guard<f1, 0>) < sizeof(ph::guard<f1, 0>));
  CHECK_FALSE(limits{.longest_tick = 1e-3}.check());
  for (const double bad : {0.0, -1e-3, std::nan(""), HUGE_VAL}) {
    const limits wrong{.longest_tick = bad};
    REQUIRE(wrong.check());
    CHECK(std::string(wrong.check().parameter) == "longest_tick");
    auto model = still_wall(wrong);
    CHECK(model.tick(0.001, 1ms).what == ph::event::rejected_parameters);
    CHECK(model.tick(0.002, 1ms).force == 0.0);
  }
  CHECK(limits::on<d1>(trusted<3>).parameters().longest_tick == 1e-3);
}
