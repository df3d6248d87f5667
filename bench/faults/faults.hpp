// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Single faults of a haptic loop, and their effect on a wall that a hand is pressing.

#include "../common/quiet.hpp"
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace faults {

namespace ph = passive_haptics;
namespace sim = ph::simulation;

using d3 = ph::space<double, 3>;
using vector = d3::vector;
using sample = ph::device_sample<d3>;
using hand = sim::impedance_hand<d3>;
using plane = ph::half_space<d3>;

inline constexpr double T = 1e-3;  // [s]

/// A fault: what the loop is shown in place of the truth.
struct fault {
  std::string name;
  int lasts = 1;  ///< [ticks]
  std::function<void(sample&)> spoil = [](sample&) {};
  int held = 1;        ///< ticks for which the device holds its last command
  bool stuck = false;  ///< the device shows its position of before
  int world = 0;       ///< what the world publishes meanwhile, 0: what is there (restarts())
  bool gives_way =
      false;  ///< it lets the finger go somewhere else, from where no passive port pushes it back
};

/// The faults of every kind, with the worst signs and sizes; z points out of the wall.
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
    all.push_back({name + "held", 1, [=](sample& s) {
                     const vector f = s.held;
                     s.held = vector(f.x(), f.y(), flipped(f.z(), bit));
                   }});
  }
  for (const int n : {2, 5, 20, 100, 300}) {
    all.push_back({"late " + std::to_string(n) + " ms", 1, [](sample&) {}, n});
  }
  return all;
}

/// The world's publisher starts anew: for 0.2 s it says what was there when it began, or what another slot is.
enum world : int { right, higher, lower, tilted, stiffer, other_order, none };
[[nodiscard]] inline std::vector<fault> restarts() {
  std::vector<fault> all;
  const auto restart = [&all](const char* name, world what) {
    all.push_back({std::string("a world that starts anew ") + name, 200});
    all.back().world = what;
  };
  restart("5 mm higher", higher);
  for (const auto& [name, what] : {std::pair{"5 mm lower", lower}, {"tilted by 46 deg", tilted}}) {
    restart(name, what);
    all.back().gives_way = true;
  }
  restart("50 times stiffer", stiffer);
  restart("in another order", other_order);
  restart("with no numbers", none);
  return all;
}

/// A plane as a world says it.
[[nodiscard]] inline plane told_as(int what, plane is) {
  const vector n = is.normal;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (what == higher) is.point = vector(vector(is.point) + 5e-3 * n);
  if (what == lower) is.point = vector(vector(is.point) - 5e-3 * n);
  if (what == tilted) is.normal = vector(n + vector(1.03, 0, 0));
  if (what == stiffer) is.stiffness *= 50.0;
  if (what == none) is.point = vector(nan, nan, nan);
  return is;
}

/// The answer of a loop to a sample.
struct answer {
  vector force;
  ph::event what;
};
/// A loop, and who publishes to it, where somebody does.
class controller {
 public:
  template <std::invocable<const sample&> Tick>
  controller(Tick tick, std::function<void(int)> publish = nullptr)  // NOLINT: a loop is one
      : tick_(std::move(tick)), publish_(std::move(publish)) {}
  answer operator()(const sample& s) const { return tick_(s); }
  void publish(int what) const {
    if (publish_) publish_(what);
  }

 private:
  std::function<answer(const sample&)> tick_;
  std::function<void(int)> publish_;
};

/// A device, the hand on it, and the composition that is tried.
struct subject {
  std::string name;
  sim::device_parameters<d3> device{};
  double limit = 9.0;   ///< largest force [N]
  double amends = 0.0;  ///< A of § 11 [J]
  std::function<controller(double amends)> make;
  bool world = false;        ///< somebody publishes to it
  double stiffness = 800.0;  ///< of the floor, and of the surfaces beside it [N/m]
};

/// What a port has created so far, at worst [J]; dry friction is a part of the device (simulation/meter.hpp).
[[nodiscard]] inline double created(const sim::port_energy_meter& meter, double until_now) {
  return std::max(until_now, -(meter.rubbed() ? meter.with_friction() : meter.minimum()));
}

/// A run of three seconds: the hand presses 10 mm in within 0.25 s, holds, or taps once a second.
struct course {
  std::vector<double> force, depth;  ///< outward [N], [m]
  double largest = 0.0;              ///< [N]
  double created = 0.0;              ///< energy created at the port, by the true motion [J]
  ph::event worst = ph::event::nominal;
  bool finite = true;
  experiments::at_rest still{};  ///< of a hand that holds still, from the fault's end on
};
/// The bars of a subject: those of its encoders' floor.
[[nodiscard]] inline sim::quiet_bars bars_of(const subject& who) {
  return sim::quiet_bars{}.on_encoders(who.device.quantum, who.stiffness, who.device.mass);
}
[[nodiscard]] inline course press(const subject& who, double amends, bool taps, int at,
                                  const fault* f, int ticks = 3000) {
  auto parameters = who.device;
  parameters.start = vector(0, 0, 4e-3);
  parameters.substeps = 5;
  sim::device<d3, hand> device(parameters, {.stiffness = 300.0, .damping = 2.0, .limit = 5.0});
  const controller loop = who.make(amends);
  course all;
  sim::quiet_judge<d3> judge(bars_of(who));
  const std::array<vector, 1> up{vector(0, 0, 1)};
  const int news =
      f ? at + std::max(f->lasts, f->held) : 250;  // the last: before it nothing counts
  experiments::held_stiffness held;
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
    if (f && f->world != right && n == at) loop.publish(f->world);
    if (f && f->world != right && n == at + f->lasts) loop.publish(right);
    const answer a = loop(shown);
    all.finite = all.finite && a.force.allFinite();
    all.largest = std::max(all.largest, a.force.norm());
    if (n >= at) all.worst = ph::worse(all.worst, a.what);
    double dt = 0.0;
    for (int left = f && n == at ? f->held : 1; left > 0; --left, ++n) {
      const double in = std::min(n, 250) / 250.0;
      const double tap = taps && n > 400 ? 7e-3 * (1.0 - std::cos(6.2832e-3 * (n - 400))) : 0.0;
      device.hand().target = vector(0, 0, 4e-3 - 14e-3 * in + tap);
      if (n >= news && n >= 250) {
        const double depth = -device.position().z();
        judge.add(a.force, device.velocity(), T, std::span(up).first(depth > 0.0 ? 1 : 0));
        if (n >= ticks - 500) held.add(a.force.z(), depth);
      }
      s = device.exchange(a.force);
      dt += s.dt;
      all.created = created(device.meter(), all.created);
      all.force.push_back(a.force.z());
      all.depth.push_back(-device.position().z());
    }
    s.dt = dt;
  }
  if (!taps) {
    all.still.add(judge, {who.stiffness, held.shown()});
    all.still.on_floor(who.device.quantum * who.stiffness);
  }
  return all;
}

/// The time [s] from the end of the fault until the wall feels for good as it does without the fault: force within
/// a tenth plus 0.1 N, depth within 0.5 mm and, of a tool, the turn within a degree.
template <class Course>
[[nodiscard]] double back_after(const Course& found, const Course& right, int at, const fault& f) {
  const int end = at + std::max(f.lasts, f.held);
  int last = end;
  for (int n = end; n < static_cast<int>(std::min(found.force.size(), right.force.size())); ++n) {
    const auto i = static_cast<std::size_t>(n);
    bool as_before =
        std::abs(found.force[i] - right.force[i]) <= 0.1 * std::abs(right.force[i]) + 0.1 &&
        std::abs(found.depth[i] - right.depth[i]) <= 5e-4;
    if constexpr (requires { found.turn; }) {
      as_before = as_before && std::abs(found.turn[i] - right.turn[i]) <= 0.0175;
    }
    if (!as_before) last = n + 1;
  }
  return (last - end) * T;
}

/// The effect of a fault at several times, for a hand that holds still and one that taps.
struct harm {
  int runs = 0, lost = 0;  ///< lost: not back within a second
  double created = 0.0;    ///< at worst [J]
  double itself = 0.0;     ///< the same where nothing is forgiven: what the fault did [J]
  double largest = 0.0;    ///< [N]
  double torque = 0.0;     ///< the same of a tool [N·m]
  double back = 0.0;       ///< at worst [s]
  ph::event worst = ph::event::nominal;
  bool finite = true;
  experiments::at_rest still{};  ///< of the hands that hold still; not of tools
};
[[nodiscard]] inline const fault& plain(const fault& f) {
  return f;
}
template <class Subject, class Fault>
[[nodiscard]] harm tried(const Subject& who, const Fault& f, const std::vector<int>& when) {
  harm all;
  for (const bool taps : {false, true}) {
    const auto right = press(who, who.amends, taps, 0, nullptr);
    for (const int at : when) {
      const auto found = press(who, who.amends, taps, at, &f);
      const double back = back_after(found, right, at, plain(f));
      ++all.runs;
      all.lost += back > 1.0;
      all.back = std::max(all.back, back);
      all.created = std::max(all.created, found.created);
      all.itself = std::max(all.itself, press(who, 0.0, taps, at, &f).created);
      all.largest = std::max(all.largest, found.largest);
      if constexpr (requires { found.torque; }) all.torque = std::max(all.torque, found.torque);
      all.worst = ph::worse(all.worst, found.worst);
      all.finite = all.finite && found.finite;
      if constexpr (requires { found.still; }) all.still.add(found.still);
    }
  }
  return all;
}

}  // namespace faults
