// SPDX-License-Identifier: BSD-3-Clause
// Torque constants that differ: what they draw from a wall at 45 degrees, and the margin that covers a tolerance.
#include "support/catch.hpp"
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/identification/known_gains.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>
#include <numbers>

namespace ph = passive_haptics;
namespace identification = ph::identification;
using d2 = ph::space<double, 2>;
using pair = std::array<double, 2>;

namespace {

/// Goes where it is told to, and books the true energy at its port.
struct moved_device {
  double damping = 0.0;
  pair gains{1.0, 1.0}, next{}, at{};
  double energy = 0.0, least = 0.0;
  pair true_force{};

  ph::device_sample<d2> exchange(const d2::vector& f) noexcept {
    for (std::size_t i = 0; i < 2; ++i) {
      const double held = f[static_cast<int>(i)], way = next[i] - at[i];
      energy += damping * way * way / 1e-3 - gains[i] * held * way;
      true_force[i] = gains[i] * held;
      at[i] = next[i];
    }
    least = std::min(least, energy);
    return {{at[0], at[1]}, {f[0], f[1]}, 1e-3, true};
  }
};

enum class motion { circles, schemes };

enum class told { nothing, damping, everything };

/// The least true energy [J] of ten seconds at a wall at 45 degrees, of gains that are off by up to `off`.
double least_energy(std::uint64_t seed, motion how, told what, double off = 0.1) {
  ph::simulation::random_source random(seed);
  moved_device device{.damping = random.uniform(0.05, 2.0)};
  const double turn = random.chance(0.5) ? 1.0 : -1.0;
  for (double& g : device.gains) g = 1.0 + off * random.uniform(-1.0, 1.0);
  if (how == motion::circles) device.gains = {1.0 + turn * off, 1.0 - turn * off};
  identification::known_gains<d2, moved_device> grip(device, {1.0, 1.0}, off);
  const double b = what == told::nothing ? device.damping : grip.damping(device.damping);
  const double deep = 1e-6 * std::pow(400.0, random.uniform());
  const double side = std::sqrt(0.5);
  const ph::half_space<d2> surface{{0.0, 0.0}, {-side, -side}, random.uniform(200.0, 4000.0)};
  ph::local_model wall{d2{},
                       ph::followed{surface},
                       ph::turn_at_once{},
                       ph::spring{},
                       ph::reduced_energy{.damping = b},
                       ph::strict_bound{},
                       ph::loop_limits{.longest_tick = 1e-3}};
  d2::vector force(0.0, 0.0);
  bool out = false;
  for (int n = 0; n < 10000; ++n) {
    if (how == motion::circles) {
      const double phase = 2e-3 * std::numbers::pi * n * 1.0, r = 1.5e-3;
      device.next = {r * std::cos(phase) + 1.1e-3, -r * std::sin(phase) + 1.1e-3};
    } else {  // in at random, and out as takes the most
      if (random.chance(0.1)) out = !out;
      for (std::size_t i = 0; i < 2; ++i) {
        const double most =
            1e-3 * device.gains[i] * force[static_cast<int>(i)] / (2.0 * device.damping);
        device.next[i] = device.at[i] + (out ? most : random.uniform(-0.5 * deep, deep));
      }
    }
    const auto sample = what == told::everything ? grip.exchange(force) : device.exchange(force);
    force = d2::vector(wall.tick(sample).force);
  }
  return device.least;
}

}  // namespace

TEST_CASE("known_gains covers the tolerance stated, in circles and against a hand that schemes",
          "[identification][known_gains]") {
  for (const motion how : {motion::circles, motion::schemes}) {
    int covered = 0, untold = 0, damping_alone = 0;
    double worst = 0.0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const double lost = least_energy(seed, how, told::nothing);
      covered += least_energy(seed, how, told::everything) > -1e-12 ? 1 : 0;
      untold += lost < -1e-9 ? 1 : 0;
      damping_alone += least_energy(seed, how, told::damping) < -1e-9 ? 1 : 0;
      worst = std::min(worst, lost);
    }
    CHECK(covered == 60);
    CAPTURE(untold, damping_alone, worst);
    CHECK(untold > 5);  // the controls
    CHECK(worst < -1e-3);
    if (how == motion::circles) CHECK(damping_alone > 15);
  }
}

TEST_CASE("known_gains divides the commands, reports what may have been held, and refuses no gains",
          "[identification][known_gains]") {
  moved_device device{.damping = 1.0, .gains = {0.8, 1.25}};
  identification::known_gains<d2, moved_device> grip(device, {0.8, 1.25}, 0.1);
  (void)grip.exchange({1.0, 1.0});
  CHECK(device.true_force[0] == 1.0);
  CHECK(device.true_force[1] == 1.0);
  device.next = {1e-3, -1e-3};
  const auto sample = grip.exchange({1.0, 1.0});
  CHECK(sample.valid);
  CHECK(std::abs(sample.held[0] - 1.1) < 1e-12);
  CHECK(std::abs(sample.held[1] - 0.9) < 1e-12);
  CHECK(std::abs(grip.damping(1.21) - 1.0) < 1e-12);
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    identification::known_gains<d2, moved_device> none(device, {1.0, wrong}, 0.1);
    CHECK_FALSE(none.exchange({1.0, 1.0}).valid);
    CHECK(device.true_force[1] == 0.0);
  }
  identification::known_gains<d2, moved_device> wide(device, {1.0, 1.0}, 1.0);
  CHECK_FALSE(wide.exchange({1.0, 1.0}).valid);
}

TEST_CASE("a gain on one axis is a device and a hand divided by it, on encoders as well",
          "[identification][known_gains]") {
  using d1 = ph::space<double, 1>;
  namespace sim = ph::simulation;
  using held = sim::device<d1, sim::impedance_hand<d1>, sim::slider_and_spring>;
  // Both are driven by the same composition. Their motions differ by rounding, unless something does not scale.
  const auto farthest = [](double g, bool friction_too) {
    const double c = friction_too ? g : 1.0;
    held truth(
        {.mass = 0.1, .damping = 0.3, .quantum = 20e-6, .load = 0.1, .gain = g, .latency = 1},
        {.stiffness = 200.0, .damping = 2.0, .own_mass = 0.05, .target = -4e-3},
        {.level = {0.2}, .presliding = {15e-6}});
    held divided(
        {.mass = 0.1 / g, .damping = 0.3 / g, .quantum = 20e-6, .load = 0.1 / g, .latency = 1},
        {.stiffness = 200.0 / g, .damping = 2.0 / g, .own_mass = 0.05 / g, .target = -4e-3},
        {.level = {0.2 / c}, .presliding = {15e-6}});
    auto a = ph::make_touch<d1, ph::half_space<d1>, ph::late_loop_limits<1>>(
        identification::in_commands(ph::encoder_device{.mass = 0.1,
                                                       .damping = 0.2,
                                                       .friction = 0.15,
                                                       .presliding = 20e-6,
                                                       .quantum = 20e-6,
                                                       .force_limit = 5.0,
                                                       .longest_tick = 1.1e-3,
                                                       .latency = 1},
                                    0.2),
        ph::known_hand{.force = 5.0});
    REQUIRE_FALSE(a.check());
    auto b = a;
    double far = 0.0, f = 0.0, h = 0.0;
    for (int n = 0; n < 3000; ++n) {
      if (n % 30 == 0) {
        a.update({.point = 0.0, .normal = 1.0, .stiffness = 400.0});
        b.update({.point = 0.0, .normal = 1.0, .stiffness = 400.0});
      }
      f = double(a.tick(truth.exchange(f)).force);
      h = double(b.tick(divided.exchange(h)).force);
      far = std::max(far, std::abs(truth.position() - divided.position()));
    }
    CHECK(f > 0.01);
    return far;
  };
  for (const double g : {0.8, 1.2}) {
    CHECK(farthest(g, true) < 1e-9);
    CHECK(farthest(g, false) > 1e-6);  // the control: friction that is not divided
  }
}
