// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rotor that anything pushes: a force g with |g| ≤ G and |dg/dt| ≤ R, dry friction that flips at will, and a wall.
#include "support/catch.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace pushed {

namespace ph = passive_haptics;

struct world {
  double m = 0.05, b = 0.1, c = 0.0, G = 15.0, R = 3000.0, K = 5000.0, jitter = 0.0;
  unsigned seed = 1;
};
struct outcome {
  double port = 0.0, ledger = 0.0;  ///< the least energy, true and counted [J]
};

/// One run: `style` says how g moves, by slopes of ±R.
template <class Space, int Late>
outcome run(const world& w, const ph::observed_reach& told, unsigned seed, int style) {
  using vector = typename Space::vector;
  using scalar = typename Space::scalar;
  constexpr double T = 1e-3, top_speed = 100.0;
  constexpr int axes = Space::dof, normal = axes - 1, steps = 32;
  ph::local_model touch{
      Space{},
      ph::followed<ph::half_space<Space>>{},
      ph::turn_at_once{},
      ph::spring{},
      ph::reduced_energy{.damping = w.b},
      told,
      ph::late_loop_limits<Late>{
          .longest_tick = T * (1.0 + w.jitter), .top_speed = top_speed, .workspace = 100.0}};
  vector n = Space::zero();
  Space::component(n, normal) = scalar(1);
  (void)touch.update({Space::zero(), n, scalar(w.K)});
  if (touch.check()) return {-1.0, -1.0};
  std::mt19937 from(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> slopes(8 + from() % 60);
  for (auto& s : slopes) s = unit(from) < 0.5 ? -1.0 : 1.0;
  const double share = unit(from);
  std::array<double, 3> x{}, v{}, g{}, rub{};
  x[normal] = 0.002;
  std::array<std::array<double, 3>, 4> queue{};
  double energy = 0.0, dt = T;
  outcome least;
  std::size_t at = 0;
  for (int tick = 0; tick < 400; ++tick) {
    vector shown = Space::zero();
    for (int i = 0; i < axes; ++i) {
      Space::component(shown, i) = scalar(x[static_cast<std::size_t>(i)]);
    }
    const auto out = touch.tick(shown, ph::seconds<scalar>{scalar(dt)});
    least.ledger = std::min(least.ledger, double(out.energy));
    for (std::size_t i = 3; i > 0; --i) queue[i] = queue[i - 1];
    for (int i = 0; i < axes; ++i) {
      queue[0][static_cast<std::size_t>(i)] = double(Space::component(vector(out.force), i));
    }
    const auto f = queue[Late];
    dt = T * (1.0 + w.jitter * (2.0 * unit(from) - 1.0));
    dt = double(scalar(dt));
    const double h = dt / steps;
    for (int s = 0; s < steps; ++s) {
      if (s % 8 == 0) ++at;
      double size = 0.0;
      std::array<double, 3> slope{};
      for (std::size_t i = 0; i < axes; ++i) {
        const double now = slopes[(at + 7 * i) % slopes.size()];
        slope[i] = style == 0   ? now
                   : style == 1 ? (f[i] > 0.5 && v[i] < 0.0 ? 1.0
                                   : f[i] > 0.2             ? 1.0
                                                            : -share)
                   : style == 2 ? (v[i] > 0.0 ? 1.0 : -1.0)
                   : style == 3 ? (x[i] < -2e-3 * share ? 1.0 : -1.0)
                                : (tick % 24 < 12 ? -1.0 : 1.0);
        if (x[i] > 0.006) slope[i] = -1.0;
        if (x[i] < -0.02) slope[i] = 1.0;
        size += slope[i] * slope[i];
        if (s % 10 == 0) rub[i] = w.c / std::sqrt(axes) * slopes[(at + 3 * i + 1) % slopes.size()];
      }
      double pull = 0.0;
      for (std::size_t i = 0; i < axes; ++i) {
        g[i] += w.R * h * slope[i] / std::max(1.0, std::sqrt(size));
        pull += g[i] * g[i];
      }
      if (pull > w.G * w.G) {
        for (auto& p : g) p *= w.G / std::sqrt(pull);
      }
      for (std::size_t i = 0; i < axes; ++i) {
        const double v0 = v[i], half = v0 + 0.5 * h * (f[i] + g[i] + rub[i] - w.b * v0) / w.m;
        const double a = (f[i] + g[i] + rub[i] - w.b * half) / w.m;
        const double v1 = v0 + a * h, dx = v0 * h + a * h * h / 2.0;
        energy += w.b * h * (v0 * v0 + v0 * v1 + v1 * v1) / 3.0 - f[i] * dx;
        x[i] += dx;
        v[i] = v1;
      }
      least.port = std::min(least.port, energy);
    }
    const double speed = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (std::abs(x[normal]) > 1.0 || speed > 0.9 * top_speed) break;  // not what the port was told
  }
  return least;
}

inline world drawn(unsigned seed) {
  std::mt19937 from(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto log = [&](double a, double b) { return a * std::pow(b / a, unit(from)); };
  world w;
  w.m = log(0.003, 0.2);
  w.b = log(0.02, 0.8);
  w.c = unit(from) < 0.5 ? 0.0 : log(0.01, 0.5);
  w.G = log(2.0, 30.0);
  w.R = log(50.0, 20000.0);
  w.K = log(300.0, 20000.0);
  w.jitter = unit(from) < 0.4 ? 0.0 : 0.2 * unit(from);
  w.seed = seed;
  return w;
}
/// All that is stated rightly.
inline ph::observed_reach told(const world& w) {
  return {.mass = w.m,
          .mass_above = w.seed % 2 == 0 ? w.m : 0.0,
          .slew = w.R,
          .friction = w.c,
          .damping_above = w.b};
}

/// On how many of `worlds` devices from the `first` on does the ledger, or the port, fall below −`tolerance`?
template <class Space, int Late = 0>
int lost(int worlds, int tries, double tolerance, const auto& change, int first = 0) {
  int count = 0;
  for (int i = first; i < first + worlds; ++i) {
    world w = drawn(static_cast<unsigned>(i) + 1u);
    ph::observed_reach says = told(w);
    change(says, w);
    double worst = 0.0;
    for (int k = 0; k < tries; ++k) {
      const auto out = run<Space, Late>(w, says, static_cast<unsigned>(31 * i + k), k % 5);
      worst = std::min({worst, out.port, out.ledger});
    }
    count += worst < -tolerance ? 1 : 0;
  }
  return count;
}

}  // namespace pushed
