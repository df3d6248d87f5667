// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What may happen to a haptic loop, once, and what becomes of a wall that a hand is pressing.

#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace faults {

namespace ph = passive_haptics;
namespace sim = ph::simulation;

using d3 = ph::space<double, 3>;
using vector = d3::vector;
using sample = ph::device_sample<d3>;
using hand = sim::impedance_hand<d3>;

inline constexpr double T = 1e-3;  // [s]

/// What the loop is shown instead of the truth.
struct fault {
  std::string name;
  int lasts = 1;  ///< [ticks]
  std::function<void(sample&)> spoil = [](sample&) {};
  int held = 1;        ///< for how many ticks the device goes on with its last command
  bool stuck = false;  ///< it shows where it was before
  double dt = T;       ///< what the loop is told of that tick [s]
};

/// Every kind, with the signs and sizes that hurt most; z is the way out of the wall.
[[nodiscard]] inline std::vector<fault> single_faults() {
  std::vector<fault> all;
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const auto off = [](const vector& by) {
    return [by](sample& s) { s.position = vector(vector(s.position) + by); };
  };
  for (const double mm : {0.1, 0.5, 1.0, 2.0, 4.0, 4.9, 10.0}) {
    for (const double sign : {1.0, -1.0}) {
      const std::string size = (sign > 0.0 ? "+" : "-") + std::to_string(mm).substr(0, 4);
      all.push_back({"outlier " + size + " mm", 1, off({0, 0, sign * mm * 1e-3})});
      all.push_back({"5 outliers " + size + " mm", 5, off({0, 0, sign * mm * 1e-3})});
    }
  }
  all.push_back({"outlier 4.0 mm beside", 1, off({4e-3, 0, 0})});
  for (const double x : {nan, inf, -inf, 1e300}) {
    all.push_back({"position " + std::to_string(x).substr(0, 5), 1, off({0, 0, x})});
  }
  for (const double dt : {0.0, -1e-3, 1e-9, 0.1, 1.0, 1e300, nan, inf}) {
    all.push_back(
        {"dt " + std::to_string(dt).substr(0, 6) + " s", 1, [dt](sample& s) { s.dt = dt; }});
  }
  for (const double N : {5.0, -5.0, 100.0, -100.0, 1e30, -1e30, nan}) {
    all.push_back({"held " + std::to_string(N).substr(0, 6) + " N", 1,
                   [N](sample& s) { s.held = vector(0, 0, N); }});
  }
  for (const int n : {1, 20, 300}) {
    all.push_back({"lost " + std::to_string(n) + " ticks", n, [](sample& s) { s.valid = false; }});
  }
  for (const int n : {1, 5, 50}) {
    all.push_back({"stuck for " + std::to_string(n) + " ticks", n, [](sample&) {}, 1, true});
  }
  const auto flipped = [](double x, int bit) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ (std::uint64_t{1} << bit));
  };
  for (const int bit : {40, 46, 49, 50, 51, 52, 53, 54, 56, 60, 61, 62, 63}) {
    const std::string name = "bit " + std::to_string(bit) + " of ";
    all.push_back({name + "z", 1, [=](sample& s) {
                     const vector x = s.position;
                     s.position = vector(x.x(), x.y(), flipped(x.z(), bit));
                   }});
    all.push_back({name + "dt", 1, [=](sample& s) { s.dt = flipped(s.dt, bit); }});
    all.back().dt = flipped(T, bit);
    all.push_back({name + "held", 1, [=](sample& s) {
                     const vector f = s.held;
                     s.held = vector(f.x(), f.y(), flipped(f.z(), bit));
                   }});
  }
  for (const int n : {2, 5, 20, 100, 300}) {
    all.push_back({"late " + std::to_string(n) + " ms", 1, [](sample&) {}, n});
    all.back().dt = n * T;
  }
  return all;
}

/// What a loop answers to a sample.
struct answer {
  vector force;
  ph::event what;
};
using controller = std::function<answer(const sample&)>;

/// A device, the hand on it, and the composition that is tried.
struct subject {
  std::string name;
  sim::device_parameters<d3> device{};
  double limit = 9.0;   ///< of the force [N]
  double amends = 0.0;  ///< A [J]
  int learns = 0;       ///< ticks that are so long are the longest from then on [T]
  std::function<controller(double amends)> make;
};

/// A run of three seconds: the hand presses 10 mm in within 0.25 s, holds, or taps once a second.
struct course {
  std::vector<double> force, depth;  ///< outward [N], [m]
  double largest = 0.0;              ///< [N]
  double created = 0.0;              ///< by the port, out of the true motion [J]
  ph::event worst = ph::event::nominal;
  bool finite = true;
};
[[nodiscard]] inline course press(const subject& who, double amends, bool taps, int at,
                                  const fault* f, int ticks = 3000) {
  auto parameters = who.device;
  parameters.start = vector(0, 0, 4e-3);
  parameters.substeps = 5;
  sim::device<d3, hand> device(parameters, {.stiffness = 300.0, .damping = 2.0, .limit = 5.0});
  const controller loop = who.make(amends);
  course all;
  sample s = device.exchange(vector::Zero());
  auto before = s.position;
  for (int n = 0; n < ticks;) {
    sample shown = s;
    if (f && n >= at && n < at + f->lasts) {
      f->spoil(shown);
      if (f->stuck) shown.position = before;
    } else {
      before = shown.position;
    }
    const answer a = loop(shown);
    all.finite = all.finite && a.force.allFinite();
    all.largest = std::max(all.largest, a.force.norm());
    if (n >= at) all.worst = ph::worse(all.worst, a.what);
    double dt = 0.0;
    for (int left = f && n == at ? f->held : 1; left > 0; --left, ++n) {
      const double in = std::min(n, 250) / 250.0;
      const double tap = taps && n > 400 ? 7e-3 * (1.0 - std::cos(6.2832e-3 * (n - 400))) : 0.0;
      device.hand().target = vector(0, 0, 4e-3 - 14e-3 * in + tap);
      s = device.exchange(a.force);
      dt += s.dt;
      all.force.push_back(a.force.z());
      all.depth.push_back(-device.position().z());
    }
    s.dt = dt;
  }
  all.created = std::max(0.0, -device.meter().minimum());
  return all;
}

/// How long after the fault the wall was last felt as it would have been not: by a tenth and 0.1 N, or
/// 0.5 mm, off [s].
[[nodiscard]] inline double back_after(const course& found, const course& right, int at,
                                       const fault& f) {
  const int end = at + std::max(f.lasts, f.held);
  int last = end;
  for (int n = end; n < static_cast<int>(std::min(found.force.size(), right.force.size())); ++n) {
    const auto i = static_cast<std::size_t>(n);
    const bool as_before =
        std::abs(found.force[i] - right.force[i]) <= 0.1 * std::abs(right.force[i]) + 0.1 &&
        std::abs(found.depth[i] - right.depth[i]) <= 5e-4;
    if (!as_before) last = n + 1;
  }
  return (last - end) * T;
}

/// A fault at several times, to a hand that holds still and one that taps.
struct harm {
  int runs = 0, lost = 0;  ///< lost: not back within a second
  double created = 0.0;    ///< at worst [J]
  double itself = 0.0;     ///< the same where nothing is forgiven: what the fault did [J]
  double largest = 0.0;    ///< [N]
  double back = 0.0;       ///< at worst [s]
  ph::event worst = ph::event::nominal;
  bool finite = true;
};
[[nodiscard]] inline harm tried(const subject& who, const fault& f, const std::vector<int>& when) {
  harm all;
  for (const bool taps : {false, true}) {
    const course right = press(who, who.amends, taps, 0, nullptr);
    for (const int at : when) {
      const course found = press(who, who.amends, taps, at, &f);
      const double back = back_after(found, right, at, f);
      ++all.runs;
      all.lost += back > 1.0;
      all.back = std::max(all.back, back);
      all.created = std::max(all.created, found.created);
      all.itself = std::max(all.itself, press(who, 0.0, taps, at, &f).created);
      all.largest = std::max(all.largest, found.largest);
      all.worst = ph::worse(all.worst, found.worst);
      all.finite = all.finite && found.finite;
    }
  }
  return all;
}

}  // namespace faults
