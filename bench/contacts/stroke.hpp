// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A finger whose motion is played to it, on what is told of a ball, of a ridge and of a plane that turns by itself: is
// its motion taken for news?

#include "ball.hpp"
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/patch.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace stroking {

namespace ph = passive_haptics;
using d3 = ph::space<double, 3>;
using vector = d3::vector;
using plane = ph::half_space<d3>;

inline constexpr double T = 1e-3;       // [s]
inline constexpr double leans = 0.087;  // 5 degrees [rad]
/// What turns news as well as motion at 2 rad/s, and tells no edge from a smooth surface.
inline constexpr ph::pursuit limited{.catch_up = 1e9, .edge = 1e3};

/// What a finger feels against what the surface itself pushes with.
struct felt {
  double off = 0.0;           ///< of the direction of the force, at most [rad]
  double largest_step = 0.0;  ///< of the force in a tick [N]
  double leaning = 0.0;       ///< off by more than 5 degrees [s]
  double work = 0.0;          ///< that the finger got [J]
  double rms = 0.0;           ///< of the force's error [N]
};

/// `scene`.at(n) is where the finger is in tick n, .truth(n) what pushes there, and force_at(n, x) what it feels.
inline felt follow(const auto& scene, int ticks, const auto& force_at) {
  felt all;
  vector last = vector::Zero(), was = scene.at(0);
  for (int n = 0; n < ticks; ++n) {
    const vector x = scene.at(n), force = force_at(n, x), right = scene.truth(n);
    const double off = std::atan2(d3::cross(force, right).norm(), force.dot(right));
    all.off = std::max(all.off, off);
    if (n > 0) all.largest_step = std::max(all.largest_step, (force - last).norm());
    if (off > leans) all.leaning += T;
    all.work += last.dot(x - was);
    all.rms += (force - right).squaredNorm() / ticks;
    last = force;
    was = x;
  }
  all.rms = std::sqrt(all.rms);
  return all;
}

/// Through a set that gives what it asks for, without damping, which has met the surface from outside and is told of it
/// every so many ticks.
inline felt stroke(const ph::pursuit& pace, const auto& scene, int ticks, int every = 33) {
  using surface = decltype(scene.told(0));
  ph::passive_port port{d3{},
                        ph::contact_set{ph::proxy_spring{.mass = 0.1, .damping_ratio = 0.0}, pace,
                                        ph::slots<surface, 1>{}},
                        ph::no_observer{}, ph::no_bound{},
                        ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
  port.source().update(0, scene.told(0));
  const vector begin = scene.at(0), out = scene.truth(0).normalized();
  for (int n = 100; n > 0; --n) {
    static_cast<void>(port.tick(vector(begin + out * (1e-4 * n)), ph::seconds{T}));
  }
  return follow(scene, ticks, [&](int n, const vector& x) -> vector {
    if (n % every == 0) port.source().update(0, scene.told(n));
    return port.tick(x, ph::seconds{T}).force;
  });
}
/// The spring of what was told last, as it is.
inline felt bare(const auto& scene, int ticks, int every = 33) {
  auto now = scene.told(0);
  return follow(scene, ticks, [&](int n, const vector& x) -> vector {
    if (n % every == 0) {
      now = scene.told(n);
      static_cast<void>(now.prepare());
    }
    return curved::force<d3>(now, x);
  });
}

/// Round a ball about the origin, told by its tangent planes.
struct round_a_ball {
  double radius = 0.05, speed = 0.2, depth = 2e-3, stiffness = 500.0;  // [m], [m/s], [m], [N/m]
  vector ahead{1.0, 0.0, 0.0}, beside{0.0, 0.0, 1.0};                  // of length one, orthogonal

  /// The turn of the ball in so many ticks, and one more [rad].
  [[nodiscard]] double turned_in(int ticks) const { return speed / radius * T * (ticks + 1); }
  [[nodiscard]] vector up(int n) const {
    const double angle = speed / radius * T * n;
    return ahead * std::cos(angle) + beside * std::sin(angle);
  }
  [[nodiscard]] vector at(int n) const { return (radius - depth) * up(n); }
  [[nodiscard]] vector truth(int n) const { return stiffness * depth * up(n); }
  [[nodiscard]] plane told(int n) const { return {vector(up(n) * radius), up(n), stiffness}; }
};

/// To and fro over a ridge that falls to both sides, told as it is.
struct over_a_ridge {
  double slope = 0.5235988, speed = 0.045, depth = 2e-3, stiffness = 500.0;  // [rad], [m/s], ...
  vector across{1.0, 0.0, 0.0}, along{0.0, 1.0, 0.0}, up{0.0, 0.0, 1.0};     // of length one
  ph::patch<d3, 4> ridge{}, itself{};

  /// Takes `slope`, `across`, `along` and `up` over; false if they make no ridge.
  bool prepare() {
    const vector fall = 0.05 * std::tan(slope) * up;
    for (std::size_t i = 0; i < 6; ++i) {
      const double side = i < 2 ? 0.0 : i < 4 ? 0.05 : -0.05;
      ridge.nodes[i] = vector(side * across + (i % 2 == 0 ? -0.1 : 0.1) * along -
                              (i < 2 ? vector(vector::Zero()) : fall));
    }
    ridge.node_count = 6;
    ridge.triangles = {{{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}}};
    ridge.triangle_count = 4;
    ridge.stiffness = stiffness;
    itself = ridge;
    return itself.prepare();
  }
  /// From 10 mm on one side to 10 mm on the other, and back [ticks].
  [[nodiscard]] int loop() const { return 2 * static_cast<int>(0.02 / (speed * T)); }
  [[nodiscard]] vector at(int n) const {
    const double way = 0.01 - speed * T * std::abs(n % loop() - loop() / 2);
    return way * across - (std::abs(way) * std::tan(slope) + depth / std::cos(slope)) * up;
  }
  [[nodiscard]] vector truth(int n) const { return curved::force<d3>(itself, at(n)); }
  [[nodiscard]] ph::patch<d3, 4> told(int /*n*/) const { return ridge; }

  /// The bars of so many loops: an edge of radius r [m] that is felt a tick late, told each P [s], a twentieth more, and of a
  /// step what `coarse` says, for ticks that pass much of the edge at once.
  [[nodiscard]] felt as_rounded(double r, double P, int loops, double coarse = 1.05) const {
    const double force = stiffness * depth, turn = 2.0 * slope, way = speed * T / std::cos(slope);
    const double edges = 2.0 * loops;
    return {.off = 1.01 * turn,
            .largest_step = coarse * force * (way / r + turn / P * T),
            .leaning = edges * 1.05 * turn * r / speed,
            .work = edges * 1.05 * force * (r + way) * (1.0 - std::cos(turn)),
            .rms = force};
  }
};

/// A finger that holds still in a plane that turns by itself about an axis on it.
struct turning_plane {
  double amplitude = 0.5, frequency = 0.8, depth = 3e-3, stiffness = 800.0;  // [rad], [Hz], ...
  vector up{0.0, 0.0, 1.0}, aside{1.0, 0.0, 0.0};                            // of length one

  [[nodiscard]] double fastest() const { return 6.2831853 * frequency * amplitude; }  // [rad/s]
  [[nodiscard]] vector normal(int n) const {
    const double angle = amplitude * std::sin(6.2831853 * frequency * T * n);
    return up * std::cos(angle) + aside * std::sin(angle);
  }
  [[nodiscard]] vector at(int /*n*/) const { return -depth * up; }
  [[nodiscard]] vector truth(int n) const {
    return normal(n) * (stiffness * depth * normal(n).dot(up));
  }
  [[nodiscard]] plane told(int n) const { return {d3::zero(), normal(n), stiffness}; }
};

}  // namespace stroking
