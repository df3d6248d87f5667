// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ends of a two-port in its tests: environments that lie, and sides that control nothing.
#include "support/scenes.hpp"
#include <passive_haptics/simulation/schedule.hpp>
#include <passive_haptics/two_port.hpp>

#include <algorithm>
#include <cmath>

namespace sim = ph::simulation;

namespace two_ends {

template <class Space>
using vector_of = typename Space::vector;

// ---- environments: force() on the tool; move() returns the true work done on the tool ----------

/// In discrete time: a force held over the step, and any force after it. It pushes along the motion
/// of the tool (negative damping), at random, or not at all.
template <class Space>
struct wild_environment {
  double strength = 10.0;  ///< [N]
  double damping = -20.0;  ///< [N·s/m]
  vector_of<Space> now = Space::zero();

  vector_of<Space> force() const { return now; }
  double move(const vector_of<Space>& step, double dt, sim::random_source& random) {
    const double work = static_cast<double>(Space::dot(now, step));
    using scalar = typename Space::scalar;
    const double kind = random.uniform();
    if (kind < 0.4) {
      now = step * static_cast<scalar>(-damping / dt);
    } else if (kind < 0.8) {
      const vector_of<Space> push = sim::to_port<Space>(random.direction<Space>());
      now = push * static_cast<scalar>(random.uniform() * strength);
    } else {
      now = Space::zero();
    }
    return work;
  }
};

/// In continuous time: a linear wall whose surface jumps between steps.
template <class Space>
struct moving_wall {
  double stiffness = 2e3;  ///< [N/m]
  double jump = 2e-3;      ///< [m]
  double restless = 0.1;   ///< probability of a jump after a step
  vector_of<Space> normal = Space::zero();
  vector_of<Space> tool = Space::zero();
  double surface = 0.0;

  double depth() const { return surface - static_cast<double>(Space::dot(tool, normal)); }
  double stored() const { return stiffness * std::pow(std::max(depth(), 0.0), 2) / 2; }
  vector_of<Space> force() const {
    return normal * static_cast<typename Space::scalar>(stiffness * std::max(depth(), 0.0));
  }
  double move(const vector_of<Space>& step, double /*dt*/, sim::random_source& random) {
    const double before = stored();
    tool += step;
    const double work = before - stored();
    if (random.chance(restless)) surface = random.uniform(-jump, jump);
    return work;
  }
};

// ---- sides that control nothing, or only what was published --------------------------------------

template <class Space>
using packet_of = ph::port_packet<typename Space::scalar, typename Space::coordinates>;

template <class Space>
struct bare_master {
  vector_of<Space> desired = Space::zero();
  typename Space::coordinates position{};
  std::uint64_t newest = 0, number = 0;

  void receive(const packet_of<Space>& p) {
    if (p.number <= newest) return;
    newest = p.number;
    desired = p.payload;
  }
  ph::port_result<Space> tick(const ph::device_sample<Space>& sample) {
    position = sample.position;
    return {desired, 0, ph::event::nominal, false};
  }
  packet_of<Space> packet() { return {0, ++number, position}; }
};

template <class Space>
struct bare_remote {
  vector_of<Space> target = Space::zero(), tool = Space::zero();
  std::uint64_t newest = 0, number = 0;

  void receive(const packet_of<Space>& p) {
    if (p.number <= newest) return;
    newest = p.number;
    target = p.payload;
  }
  ph::admittance_result<Space> step(const vector_of<Space>& /*force*/, ph::seconds<double> /*dt*/) {
    const vector_of<Space> moved = target - tool;
    tool = target;
    return {moved, Space::zero(), 0, ph::event::nominal, false};
  }
  void settle(double /*work*/) {}
  packet_of<Space> packet(const vector_of<Space>& force) { return {0, ++number, force}; }
};

/// The right end of the device, by its observer.
template <class Space = d1, class Bound = ph::strict_bound, class Limits = ph::loop_limits>
constexpr auto side_of(const ph::two_port_energy& observer, const Bound& bound = {},
                       const Limits& limits = thesis_loop) {
  return ph::impedance_side{Space{}, observer, bound, limits};
}

}  // namespace two_ends
