// SPDX-License-Identifier: BSD-3-Clause
// What the static conditions call passive loses no energy on the exact device; what they refuse can.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/design.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>
#include <cmath>

namespace design = ph::design;
namespace passivity = ph::design::passivity;
namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using design::loop;

namespace {

constexpr double T = 1e-3;
constexpr loop thesis{.damping = 0.03, .period = T};

/// The least true port energy [J], friction included, of a linear spring and damper under a
/// prescribed motion: a wall that holds on both sides, or one that only pushes.
template <class Motion>
double prescribed(const loop& l, double K, Motion motion, std::uint64_t seed, bool pulls,
                  int ticks = 3000) {
  sim::random_source random(seed);
  sim::prescribed_motion<d1> device(
      {.damping = l.damping, .quantum = l.quantum, .period = l.period, .latency = l.delay});
  auto sample = device.exchange(0.0);
  double last = sample.position, friction = 0.0, worst = 0.0;
  for (int n = 0; n < ticks; ++n) {
    const double d = sample.position;  // the surface at 0, inside > 0
    const double wanted = K * d + l.virtual_damping * (d - last) / l.period;
    const double f = pulls || (d > 0.0 && wanted > 0.0) ? -wanted : 0.0;
    last = d;
    const double before = device.position();
    device.move_to(motion.next({.position = before,
                                .normal = -1.0,
                                .depth = before,
                                .force = f,
                                .dt = l.period,
                                .damping = l.damping},
                               random));
    sample = device.exchange(f);
    friction += l.friction * std::abs(device.position() - before);
    worst = std::min(worst, device.meter().value() + friction);
  }
  return worst;
}

/// A slow sine, where delay takes most.
struct slow_sine {
  double period = 0.2, amplitude = 1e-3, time = 0.0;
  double next(const sim::adversary_view<d1>& view, sim::random_source& /*random*/) noexcept {
    time += view.dt;
    return amplitude * std::sin(2 * design::pi * time / period);
  }
};

/// Goes to the first step of the sensor and hovers there, by less than damping can pay for.
struct edge_shaker {
  double step = 1e-4, swing = 1e-5;
  bool below = false;
  double next(const sim::adversary_view<d1>& /*view*/, sim::random_source& /*random*/) noexcept {
    below = !below;
    return step + (below ? -swing : swing) / 2;
  }
};

double worst_prescribed(const loop& l, double K, bool pulls) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    worst = std::min({worst, prescribed(l, K, sim::nyquist_motion<d1>{}, seed, pulls),
                      prescribed(l, K, sim::random_walk<d1>{}, seed, pulls),
                      prescribed(l, K, sim::greedy_motion<d1>{}, seed, pulls),
                      prescribed(l, K, sim::greedy_motion<d1>{.speed = 0.05}, seed, pulls),
                      prescribed(l, K, slow_sine{}, seed, pulls)});
  }
  return worst;
}

}  // namespace

TEST_CASE("a wall that is passive by Colgate never loses energy, one just above does",
          "[design][passivity]") {
  for (const double B : {0.0, 0.01, 0.025}) {
    const loop l{.damping = 0.03, .period = T, .virtual_damping = B};
    const double K = passivity::colgate_schenkel(l);
    for (const bool pulls : {true, false}) CHECK(worst_prescribed(l, K, pulls) >= -1e-12);
    CHECK(prescribed(l, 1.02 * K, sim::nyquist_motion<d1>{}, 1, true) < -1e-6);
  }
  const loop hindering{.damping = 0.03, .period = T, .virtual_damping = -0.01};
  CHECK(worst_prescribed(hindering, passivity::colgate_schenkel(hindering), true) >= -1e-12);
}

TEST_CASE("with delay the same holds, and a slow sine draws energy just above",
          "[design][passivity]") {
  for (const int D : {1, 3}) {
    const loop l{.damping = 0.03, .period = T, .delay = D};
    const double K = passivity::colgate_schenkel(l);
    for (const bool pulls : {true, false}) CHECK(worst_prescribed(l, K, pulls) >= -1e-12);
    CHECK(prescribed(l, 1.02 * K, slow_sine{}, 1, true) < -1e-7);
    // stability and passivity forget about the delay at their peril
    CHECK(worst_prescribed(l, passivity::colgate_schenkel(thesis), true) < -1e-6);
  }
}

TEST_CASE("a wall that is passive by Colgate never loses energy on the exact device",
          "[design][passivity]") {
  const auto tapped = [](double K, double push, double mass) {
    sim::device<d1, sim::tapping_hand<d1>> device({.mass = mass, .start = -1e-4},
                                                  {.surface = 0.0, .normal = -1.0, .limit = push});
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 5000; ++n) {
      sample = device.exchange(-K * std::max(sample.position, 0.0));
    }
    return device.meter().minimum();
  };
  double control = 0.0;
  for (const double push : {0.01, 1.0, 20.0}) {
    for (const double mass : {0.002, 0.05, 0.5}) {
      CHECK(tapped(passivity::colgate_schenkel(thesis), push, mass) >= -1e-12);
      control = std::min(control, tapped(1e4, push, mass));
    }
  }
  CHECK(control < -1e-3);
}

TEST_CASE("sensor steps within Abbott and Okamura's bound cost no energy, larger ones do",
          "[design][passivity]") {
  const double K = 60.0;
  for (const int D : {0, 2}) {
    loop l{.damping = 0.03 * (1 + 2 * D), .period = T, .delay = D, .quantum = 1e-4};
    l.friction = K * l.quantum / 2;
    CHECK_THAT(passivity::diolaiti(l), WithinRel(K, 1e-12));
    CHECK_THAT(passivity::abbott_okamura(l), WithinAbs(D == 0 ? K : 0.0, 1e-12));
    CHECK(worst_prescribed(l, K, false) >= -1e-12);
    CHECK(prescribed(l, K, edge_shaker{}, 1, false) >= -1e-12);
    loop smooth = l;
    smooth.friction = 0.0;
    CHECK(passivity::diolaiti(smooth) == 0.0);
    CHECK(prescribed(smooth, K, edge_shaker{}, 1, false) < -1e-6);  // the control: no friction
  }
}
