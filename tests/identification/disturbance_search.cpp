// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a device is found by name, and nothing is found where nothing is wrong.
#include "support/catch.hpp"
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/identification/axis_identification.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using namespace ph::identification;
using d1 = ph::space<double, 1>;

namespace {

const sim::device_parameters<d1> grip{
    .mass = 0.1, .damping = 0.3, .quantum = 10e-6, .load = 0.2, .latency = 1};
const sim::slider_and_spring rubs{.level = {0.2}, .presliding = {15e-6}};

/// pass(force) is what the motor gets of a command.
axis_found identified(auto&& device, auto pass) {
  axis_identification of;
  double force = 0.0;
  while (!of.done()) {
    const auto sample = device.exchange(pass(force));
    force = of.tick(sample.position, ph::seconds{sample.dt});
  }
  return of.result();
}
axis_found identified(auto&& device) {
  return identified(device, [](double f) { return f; });
}
int names(const axis_found& found) {
  int count = 0;
  for (const suspicion& s : found.wrong.all) count += s.found ? 1 : 0;
  return count;
}

/// A magnet at every wavelength.
struct cogs : sim::no_hand<d1> {
  double amplitude = 0.0, wavelength = 1.0;
  [[nodiscard]] double force(double /*t*/, double x, double /*v*/) const noexcept {
    return amplitude * std::sin(2.0 * std::numbers::pi * x / wavelength);
  }
};

/// Ticks of 0.1 kg without friction on steps of 10 µm: it swings for 3 s, and then goes to and fro slowly, in crossings
/// of 1 s, while a force of 0.02 N acts along the way, every 2 mm, late by phase(crossing) [rad].
std::vector<kept_tick> crossed(auto phase) {
  std::vector<kept_tick> all;
  constexpr double m = 0.1, T = 1e-3, q = 10e-6, pi = std::numbers::pi;
  double x = 0.0, v = 0.0;
  for (int n = 0; n < 15000; ++n) {
    const int crossing = n < 3000 ? -1 : (n - 3000) / 1000;
    const double time = n * T, speed = crossing % 2 == 0 ? 0.04 : -0.04;
    const double f = crossing < 0 ? 0.8 * std::cos(4.0 * pi * time) : 2.0 * (speed - v);
    all.push_back({q * std::round(x / q), f, T, time, n == 0, crossing >= 0});
    for (int i = 0; i < 20; ++i) {
      const double along = crossing < 0 ? 0.0 : 0.02 * std::sin(1000.0 * pi * x - phase(crossing));
      v += (f + along) / m * T / 20.0;
      x += v * T / 20.0;
    }
  }
  return all;
}

}  // namespace

TEST_CASE("nothing is found wrong with a device that is as it should be", "[identification]") {
  const auto found =
      identified(sim::device<d1, sim::no_hand<d1>, sim::slider_and_spring>(grip, {}, rubs));
  REQUIRE(found.problem == nullptr);
  CHECK(names(found) == 0);
  CHECK(found.rotor <= 0.1);
  CHECK(found.rotor > 0.07);
}

TEST_CASE("a mode is found with its frequency, and what moves with the encoder is stated",
          "[identification][long]") {
  for (const double hz : {200.0, 300.0}) {
    CAPTURE(hz);
    const auto found = identified(sim::compliant_device<d1>({.mass = 0.2,
                                                             .share = 0.4,
                                                             .mode = hz,
                                                             .damping = 0.3,
                                                             .friction = 0.1,
                                                             .quantum = 5e-6,
                                                             .latency = 1}));
    const suspicion& mode = found.wrong.of(disturbance::mode);
    REQUIRE(found.problem == nullptr);
    REQUIRE(mode.found);
    CHECK(std::abs(mode.size - hz) < 0.05 * hz);
    CHECK(std::abs(mode.where - 0.4) < 0.08);
    CHECK(found.rotor <= 0.08);
    CHECK(found.rotor > 0.05);
    CHECK(found.mass > 0.08);  // the control: all that moves is more
    CHECK(names(found) == 1);
  }
}

TEST_CASE("cogging of half a millimetre is found with its size under steps of 30 micrometres",
          "[identification][long]") {
  const double amplitude = 0.12, wavelength = 0.5e-3;
  double mean = 0.0;
  for (const double load : {0.2, 0.23, 0.26}) {
    CAPTURE(load);
    auto coarse = grip;
    coarse.quantum = 30e-6;
    coarse.load = load;
    coarse.substeps = 50;
    cogs magnets;
    magnets.amplitude = amplitude;
    magnets.wavelength = wavelength;
    const auto found =
        identified(sim::device<d1, cogs, sim::slider_and_spring>(coarse, magnets, rubs));
    REQUIRE(found.problem == nullptr);
    const suspicion& cogging = found.wrong.of(disturbance::cogging);
    REQUIRE(cogging.found);
    CHECK(names(found) == 1);
    CHECK(std::abs(cogging.where - wavelength) < 0.01 * wavelength);
    CHECK(found.friction <= rubs.level[0]);
    mean += cogging.size / 3.0;
  }
  // Where the place was told by the steps, it was half of that.
  CHECK(std::abs(mean - amplitude) < 0.25 * amplitude);
}

TEST_CASE("a wave that is another in each crossing is no cogging", "[identification]") {
  const auto cogging = [](const std::vector<kept_tick>& ticks) {
    disturbance_model of(ticks, 0, 10e-6);
    of.fit_latency();
    auto wave = of.tried({.is = column_of::cogging, .p1 = 500.0});
    CHECK(wave.drop > 0.15 * of.left());  // of all that the rigid device leaves
    return std::pair{wave.wald, std::hypot(wave.g[0], wave.g[1]) * of.mass()};
  };
  const auto [same, size] = cogging(crossed([](int /*crossing*/) { return 0.7; }));
  CHECK(same > 1000.0);
  CHECK(std::abs(size - 0.02) < 0.002);
  const auto [other, part] = cogging(crossed([](int n) { return n % 2 == 0 ? 1.1 : -1.1; }));
  CHECK(part > 0.005);
  CHECK(other == 0.0);
}

TEST_CASE("a mode that spoils the swing is refused by name", "[identification]") {
  const auto found = identified(sim::compliant_device<d1>(
      {.mass = 0.2, .share = 0.4, .mode = 25.0, .damping = 0.3, .friction = 0.1, .quantum = 5e-6}));
  REQUIRE(found.problem != nullptr);
  CHECK(std::string(found.problem).find("rings") != std::string::npos);
  CHECK(std::abs(found.wrong.of(disturbance::mode).size - 25.0) < 1.5);
}

TEST_CASE("a mode slower than half a sweep is refused, although the swing comes about",
          "[identification][long]") {
  const auto with = [](double hz) {
    return identified(sim::compliant_device<d1>({.mass = 0.2,
                                                 .share = 0.76,
                                                 .mode = hz,
                                                 .damping = 0.12,
                                                 .friction = 0.02,
                                                 .quantum = 20e-6}));
  };
  const auto slow = with(17.6);
  REQUIRE(slow.problem != nullptr);
  CHECK(std::string(slow.problem).find("rings") != std::string::npos);
  CHECK(slow.damping == 0.0);
  const auto fast = with(150.0);  // the control
  CHECK(fast.problem == nullptr);
  CHECK(fast.damping <= 0.12);
}

TEST_CASE("a slow mode that hardly loses is found, although the rigid fit is far off",
          "[identification]") {
  const auto found = identified(sim::compliant_device<d1>({.mass = 0.7,
                                                           .share = 0.34,
                                                           .mode = 19.0,
                                                           .loss = 0.01,
                                                           .damping = 0.06,
                                                           .friction = 0.3,
                                                           .quantum = 3e-6}));
  const suspicion& mode = found.wrong.of(disturbance::mode);
  REQUIRE(mode.found);
  CHECK(std::abs(mode.size - 19.0) < 0.2);
  CHECK(std::abs(mode.where - 0.34) < 0.02);
  CHECK(std::abs(found.wrong.mass - 0.7) < 0.035);
  CHECK(found.wrong.unexplained < 1e-3);
  CHECK(names(found) == 1);
}

TEST_CASE("a hand that holds lightly is refused by name", "[identification]") {
  using held = sim::device<d1, sim::impedance_hand<d1>, sim::slider_and_spring>;
  const auto found =
      identified(held(grip, {.stiffness = 15.0, .damping = 1.0, .own_mass = 0.05}, rubs));
  REQUIRE(found.problem != nullptr);
  CHECK(std::string(found.problem) == refusal_of(disturbance::hand));
}

TEST_CASE("a force that is filtered on its way is refused by name", "[identification]") {
  double held = 0.0;
  const auto found = identified(
      sim::device<d1, sim::no_hand<d1>, sim::slider_and_spring>(grip, {}, rubs), [&](double f) {
        held += (f - held) * (1.0 - std::exp(-0.5));
        return held;
      });
  REQUIRE(found.problem != nullptr);
  CHECK(std::string(found.problem) == refusal_of(disturbance::filter));
  // Held for each tick, it is late by 1.54 ticks on average in place of the 2 of a continuous one.
  const double lag = found.wrong.of(disturbance::filter).size;
  CHECK(lag > 1.3e-3);
  CHECK(lag < 2.2e-3);
}
