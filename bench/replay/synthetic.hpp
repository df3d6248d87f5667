// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A recording that the simulator makes: a drive with a screw and a carriage, as heavy and as fast as EMPS, that a
// controller moves to and fro by itself, faster from time to time.

#include <passive_haptics/identification/recording.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>

namespace replaying {

namespace ph = passive_haptics;
namespace sim = passive_haptics::simulation;

using line = ph::space<double, 1>;

/// The truth of it.
struct drive {
  double mass = 95.0;         ///< [kg]
  double damping = 200.0;     ///< [N·s/m]
  double friction = 20.0;     ///< c [N]
  double presliding = 20e-6;  ///< p [m]
  double quantum = 50e-9;     ///< q [m]
  double load = 0.5;          ///< w [N]
  double stroke = 0.12;       ///< to either side [m]
  double speed = 0.12;        ///< of the middle of a way [m/s]
  double jitter = 0.0;        ///< share of a tick by which it varies
  double held = 0.0;          ///< force of a hand that pushes along, hands-on, for a while [N]
  int latency = 0;            ///< [ticks]
  sim::friction_kind like = sim::friction_kind::one_spring;
};

/// A hand that helps the motion in the second third of the recording.
struct helping_hand {
  double force_of_it = 0.0;
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] double force(double t, double /*x*/, double v) const noexcept {
    if (t < 8.0 || t > 16.0) return 0.0;
    return force_of_it * std::clamp(v / 0.01, -1.0, 1.0);
  }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

[[nodiscard]] inline ph::identification::recording recorded(const drive& d, double seconds = 24.0,
                                                            std::uint64_t seed = 1) {
  sim::device_parameters<line> truth{.mass = d.mass,
                                     .damping = d.damping,
                                     .quantum = d.quantum,
                                     .load = d.load,
                                     .latency = d.latency};
  sim::device<line, helping_hand, sim::friction_like> device(truth, {d.held},
                                                             {d.like, d.friction, d.presliding});
  sim::random_source random(seed);
  ph::identification::recording r;
  const double size = d.mass / 95.0;  // the controller is as stiff as the drive is heavy
  double x = 0.0, before = 0.0, t = 0.0, want = 0.0, speed = 0.0, way = 1.0;
  double most = d.speed;
  while (t < seconds) {
    // Towards the end of the stroke with a speed that grows and falls as a trapezium.
    const double steepest = 0.4 * d.speed / 0.12;
    const double left = d.stroke - way * want;
    speed =
        std::min({speed + steepest * 1e-3, most, std::sqrt(2.0 * steepest * std::max(left, 1e-9))});
    if (left < 1e-5) {
      way = -way;
      speed = 0.0;
      most = d.speed * random.uniform(0.4, 1.0);
    }
    want += way * speed * 1e-3;
    const double v = (x - before) / 1e-3;
    before = x;
    const double force = std::clamp(size * (4e4 * (want - x) + 4e3 * (way * speed - v)),
                                    -160.0 * size, 160.0 * size);
    r.time.push_back(t);
    r.position.push_back(x);
    r.force.push_back(force);
    const double dt = 1e-3 * (1.0 + d.jitter * random.uniform(-1.0, 1.0));
    device.set_period(dt);
    const auto sample = device.exchange(force);
    x = sample.position;
    t += dt;
  }
  return r;
}

}  // namespace replaying
