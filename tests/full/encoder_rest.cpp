// SPDX-License-Identifier: BSD-3-Clause
// make_touch on encoders comes to rest in a hand that holds still, within the floor K q of what it displays, whatever
// the device: drawn masses told to 30-100 %, steps, frictions, stiffnesses, loads, and where in a step the surface is.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/quiet.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace sim = ph::simulation;

namespace {

constexpr double T = 1e-3;

/// A device, what is stated of it, and where a wall is; friction is stiffer than the wall, c ≥ 2 K p as stated.
struct drawn {
  double mass, damping, friction, presliding, quantum, stiffness, load, surface;
  ph::encoder_device stated;
  ph::known_hand hand;

  explicit drawn(sim::random_source& random) {
    const auto decades = [&random](double least, double most) {
      return least * std::pow(most / least, random.uniform(0.0, 1.0));
    };
    do {
      mass = decades(0.05, 1.0);
      damping = decades(0.02, 2.0);
      friction = decades(0.05, 1.0);
      presliding = decades(2e-6, 30e-6);
      quantum = decades(1e-6, 100e-6);
      stiffness = decades(200.0, 30e3);
      load = decades(0.3, 4.5);
      surface = random.uniform(0.0, 1.0) * quantum;
      const double share = random.uniform(0.5, 1.0);
      stated = {.mass = random.uniform(0.3, 1.0) * mass,
                .damping = share * damping,
                .friction = share * friction,
                .presliding = presliding,
                .quantum = quantum,
                .force_limit = 20.0,
                .longest_tick = T};
      hand = {.force = load + 5.0 + 2.0 * friction};
    } while (stated.friction < 2.0 * displayed() * presliding);
  }
  [[nodiscard]] auto touch() const {
    auto port = ph::make_touch<d1>(stated, hand);
    REQUIRE(port.update({surface, -1.0, stiffness}));
    return port;
  }
  /// The same of positions that are taken as they are shown.
  [[nodiscard]] auto raw() const {
    const double most = ph::detail::budget_of(stated, hand, 0);
    ph::local_model port{d1{},
                         ph::followed<ph::half_space<d1>>{},
                         ph::turn_limited{.rate = 2.0},
                         ph::detail::law_of(stated, hand, most),
                         ph::detail::sums_of(stated, hand),
                         ph::detail::bounds_of(stated, hand),
                         ph::detail::limits_of<ph::loop_limits>(stated)};
    REQUIRE(port.update({surface, -1.0, stiffness}));
    return port;
  }
  /// K_s [N/m].
  [[nodiscard]] double displayed() const {
    auto port = touch();
    (void)port.tick(-2e-3, ph::seconds{T});
    return port.explain().shown;
  }
};

struct tally {
  int runs = 0, quiet = 0;
  double least_energy = 0.0;  ///< [J]

  /// From 2 mm in front of the wall until the hand rests on it with the load, 6 s; relaxed, and stiff.
  void press(const drawn& d, const auto& port) {
    using fingers = sim::impedance_hand<d1>;
    for (const auto& [k, b] : {std::array{100.0, 1.0}, std::array{400.0, 6.0}}) {
      const sim::device_parameters<d1> device_of{
          .mass = d.mass, .damping = d.damping, .quantum = d.quantum, .start = -2e-3};
      const fingers hand{.stiffness = k, .damping = b, .limit = d.load + 5.0, .target = d.load / k};
      sim::device<d1, fingers, sim::slider_and_spring> device(device_of, hand,
                                                              {d.friction, d.presliding});
      sim::quiet_judge<d1> judge(sim::quiet_bars{}.on_encoders(d.quantum, d.displayed(), d.mass));
      const std::array<double, 1> normal{-1.0};
      auto pressed = port;
      const auto seen = sim::run(device, pressed, 6000, sim::idle, sim::idle, [&](const auto& now) {
        judge.add(now.force, device.velocity(), T,
                  std::span(normal).first(now.position > d.surface ? 1 : 0));
      });
      ++runs;
      quiet += judge.settling() <= 5.0 ? 1 : 0;
      least_energy = std::min(least_energy, seen.least_energy);
    }
  }
};

}  // namespace

// Two of these 120 are not quiet, and five of 1042 of four other seeds. Where friction's own spring is softer than the wall the
// share is less, and a hand that lets go leaves the device to that spring (docs/design/encoders.md).
TEST_CASE("make_touch rests on drawn encoders within the floor K q", "[door][quiet]") {
  sim::random_source random(5);
  tally ours, raw;
  for (int i = 0; i < 60; ++i) {
    const drawn d(random);
    ours.press(d, d.touch());
    raw.press(d, d.raw());
  }
  CAPTURE(ours.quiet, ours.runs, raw.quiet);
  CHECK(ours.quiet >= 0.98 * ours.runs);
  CHECK(ours.least_energy >= -1e-12);
  CHECK(raw.quiet < 0.9 * raw.runs);  // the control: positions as they are shown
}
