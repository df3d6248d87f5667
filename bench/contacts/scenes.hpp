// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The planes that several sections press on, and the port that carries them.

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace contacts {

namespace ph = passive_haptics;
namespace sim = ph::simulation;

using d3 = ph::space<double, 3>;
using vector = d3::vector;
using plane = ph::half_space<d3>;

inline constexpr double T = 1e-3;          // [s]
inline constexpr double damping = 0.03;    // of the device, and stated [N·s/m]
inline constexpr double hand_force = 5.0;  // [N]
inline constexpr double gravity = 9.81;    // [m/s²]
inline constexpr double degree = 3.14159265358979323846 / 180.0;

/// A scene: the normals of its planes, which go through the origin, and the direction up.
struct planes {
  const char* name;
  std::vector<vector> normals;
};

inline vector tilted(double from_up, double around) {
  return {std::sin(from_up) * std::cos(around), std::sin(from_up) * std::sin(around),
          std::cos(from_up)};
}
inline planes cone(const char* name, double from_up) {
  planes p{name, {}};
  for (int i = 0; i < 3; ++i) p.normals.push_back(tilted(from_up, i * 120.0 * degree));
  return p;
}
/// Two walls 20 degrees apart, downhill at 30 degrees to an end.
inline planes groove() {
  const double slope = 30.0 * degree, lean = 80.0 * degree;
  const vector up(0.0, -std::sin(slope), std::cos(slope)), across(1.0, 0.0, 0.0);
  return {"groove of 20 deg with an end",
          {across * std::sin(lean) + up * std::cos(lean),
           across * -std::sin(lean) + up * std::cos(lean),
           vector(0.0, std::cos(slope), std::sin(slope))}};
}
inline const std::vector<planes>& all_planes() {
  static const std::vector<planes> all{
      {"one plane", {vector(0.0, 0.0, 1.0)}},
      cone("box corner", std::acos(1.0 / std::sqrt(3.0))),
      cone("flat cone, 10 deg", 10.0 * degree),
      cone("flat cone, 5 deg", 5.0 * degree),
      groove(),
      {"8 copies of a plane", std::vector<vector>(8, vector(0.0, 0.0, 1.0))},
  };
  return all;
}

/// The parts that a set may have beside its planes.
template <class Friction = ph::frictionless, class Observer = ph::reduced_energy,
          class Motion = ph::last_difference>
struct beside {
  Friction friction{};
  Observer observer{.damping = damping};
  Motion motion{};
  double push = hand_force;
};

/// A set of `Count` planes under the reachable law.
template <int Count, class Friction = ph::frictionless, class Observer = ph::reduced_energy,
          class Motion = ph::last_difference>
auto port_of(const planes& scene, double mass, double K,
             const beside<Friction, Observer, Motion>& rest = {}) {
  ph::passive_port port{d3{},
                        ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{},
                                        rest.friction, ph::slots<plane, Count>{}},
                        rest.observer,
                        ph::reachable_bound{.mass = mass, .hand_force = rest.push},
                        ph::loop_limits{.longest_tick = T},
                        rest.motion};
  for (std::size_t i = 0; i < scene.normals.size(); ++i) {
    port.source().update(static_cast<int>(i), plane{vector(0.0, 0.0, 0.0), scene.normals[i], K});
  }
  return port;
}

/// The way in which a device has come to rest.
struct settled {
  double seconds = 0.0;       ///< time until it stays within 0.5 mm of its end [s]
  double swing = 0.0;         ///< twice the largest distance in the last two seconds [m]
  double least_energy = 0.0;  ///< at the port [J]
};

/// Runs a device for so long and says how it came to rest; watch(now) is called in each tick.
template <class Device, class Port>
settled settle(Device& device, Port& port, double seconds, const auto& watch) {
  std::vector<vector> track;
  const int ticks = static_cast<int>(seconds / T);
  track.reserve(static_cast<std::size_t>(ticks));
  settled result;
  result.least_energy = sim::run(device, port, ticks, sim::idle, sim::idle, [&](const auto& now) {
                          watch(now);
                          track.push_back(device.position());
                          return device.position().norm() < 1.0;
                        }).least_energy;
  if (track.size() < static_cast<std::size_t>(ticks)) return {seconds, 1.0, result.least_energy};
  const std::size_t last = static_cast<std::size_t>(2.0 / T);
  vector end = vector::Zero();
  for (std::size_t i = track.size() - last; i < track.size(); ++i) end += track[i];
  end /= static_cast<double>(last);
  for (std::size_t i = 0; i < track.size(); ++i) {
    const double away = (track[i] - end).norm();
    if (away > 0.5e-3) result.seconds = static_cast<double>(i + 1) * T;
    if (i + last >= track.size()) result.swing = std::max(result.swing, 2.0 * away);
  }
  return result;
}

}  // namespace contacts
