// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The facts of a tool and of the hand on it, whatever the tool touches.
#include "ports.hpp"
#include <passive_haptics/six_dof.hpp>

namespace c_interface {

[[nodiscard]] inline ph::rigid_device rigid_device_of(const ph_parameters& p) noexcept {
  return {.inertia = {.mass = p.mass,
                      .least = p.least_inertia,
                      .spread = p.inertia_spread,
                      .offset = p.inertia_offset},
          .damping = {.linear = p.damping, .angular = p.angular_damping},
          .damping_most = {.linear = p.damping_most, .angular = p.angular_damping_most},
          .force_limit = p.force_limit,
          .torque_limit = p.torque_limit,
          .lever = stated(p.lever, ph::rigid_device{}.lever),
          .longest_tick = p.longest_tick};
}
[[nodiscard]] inline ph::rigid_hand rigid_hand_of(const ph_parameters& p) noexcept {
  return {.force = p.hand_force, .torque = p.hand_torque};
}

}  // namespace c_interface
