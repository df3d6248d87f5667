// SPDX-License-Identifier: BSD-3-Clause
// The stiffness that steps which are crossed pay for: where it is more, and that a swing seen by the ledger sustains it.
#include "support/catch.hpp"
#include "support/half_told.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/identification/crossed_budget.hpp>
#include <passive_haptics/identification/crossed_step.hpp>
#include <passive_haptics/identification/middle_observer.hpp>

#include <cmath>
#include <string>

namespace sim = ph::simulation;
namespace design = ph::design;

namespace {

/// What the ledger gains in each swing over N edges to and fro at v [m/s], against a wall of K [N/m] [J].
double gained(const design::stated_device& d, double K, int N, double v) {
  ph::part_at<ph::crossed_ledger, d1> ledger(ph::crossed_ledger{
      .damping = {d.damping, d.friction, d.presliding},
      .quantum = {.quantum = d.quantum, .mass = d.mass, .hand_force = 5.0 + 2.0 * d.friction}});
  ph::part_at<ph::middle_observer, d1> observer(ph::middle_observer{.quantum = d.quantum});
  constexpr int swings = 40;
  const double depth = N * d.quantum, T = 1e-3, period = 2.0 * depth / v;
  double before = 0.0, force = 0.0, halfway = 0.0, half_of_them = 0.0;
  for (int n = 0;; ++n) {
    const double t = n * T / period, part = t - std::floor(t);
    const double x =
        0.513 * d.quantum + 0.9999 * depth * (part < 0.5 ? 2.0 * part : 2.0 - 2.0 * part);
    const double shown = d.quantum * std::floor(x / d.quantum);
    if (n > 0) REQUIRE(ledger.update(shown - before, force, T));
    const auto seen = observer.estimate(shown, n > 0 ? shown - before : 0.0, force, T, n > 0);
    before = shown;
    force = -(1.0 + K * static_cast<double>(seen.position));
    if (half_of_them == 0.0 && t >= swings / 2) {
      halfway = ledger.value();
      half_of_them = t;
    }
    if (t >= swings) return (ledger.value() - halfway) / (t - half_of_them);
  }
}
}  // namespace

TEST_CASE("crossing pays on a wheel and a heavy device, and says why not elsewhere", "[crossed]") {
  const auto wheel = sim::wheel_rotary.at_rim();
  const auto told = [](const sim::device_preset& p, double presliding, double T = 1e-3) {
    auto d = half_told(p, presliding);
    d.longest_tick = T;
    return design::crossing_of(d);
  };
  CHECK(told(wheel, 5e-6).pays);
  CHECK(told(sim::heavy_1kg, 5e-6).pays);
  CHECK_FALSE(told(sim::touch_like, 5e-6).pays);
  CHECK_FALSE(told(sim::omega_like, 5e-6).pays);
  CHECK(told(sim::touch_like, 5e-6, 0.25e-3).pays);  // at 4 kHz
  CHECK(std::string(told(sim::touch_like, 5e-6).because).find("faster loop") != std::string::npos);
  CHECK_FALSE(told(wheel, 30e-6).pays);
  CHECK(std::string(told(wheel, 30e-6).because).find("presliding") != std::string::npos);
  CHECK_FALSE(told(sim::ideal, 0.0).pays);
  CHECK_FALSE(told(wheel, std::nan("")).pays);

  for (const auto& preset : sim::all_presets) {
    for (const double p : {0.0, 5e-6, 15e-6, 30e-6}) {
      const auto d = half_told(preset, p);
      const auto today = design::stiffness_budget(d), crossed = design::crossed_budget(d);
      CAPTURE(preset.name, p, today.stiffness, crossed.stiffness);
      CHECK(crossed.stiffness >= today.stiffness);
      if (!design::crossing_of(d).pays) CHECK(crossed.stiffness == today.stiffness);
      if (preset.mass == wheel.mass && p <= 15e-6)
        CHECK(crossed.stiffness > 1.15 * today.stiffness);
    }
  }
}

TEST_CASE("a swing sustains the stiffness that crossed steps pay for", "[crossed]") {
  for (const auto& preset : {sim::wheel_rotary.at_rim(), sim::falcon_like, sim::heavy_1kg}) {
    for (const double p : {0.0, 0.25 * preset.quantum}) {
      for (const int N : {3, 4, 6, 10}) {
        for (const double v : {2e-3, 5e-3}) {
          const auto d = half_told(preset, p);
          double K = 0.0;  // of swings over N edges: S = N K q
          for (double next = 0.05; next < 5.0; next += 0.01) {
            const double trial = next * d.friction / d.quantum, S = N * d.quantum * trial;
            const double bend = (5.0 + 2.0 * d.friction + 1.0 + S) / d.mass * 1e-6;
            if (design::detail::crossings_pay(d, trial, v, S, bend)) K = trial;
          }
          CAPTURE(preset.name, p, N, v, K);
          CHECK(gained(d, K, N, v) >= 0.0);
          CHECK(gained(d, 1.8 * K, N, v) < 0.0);  // the control
        }
      }
    }
  }
}
