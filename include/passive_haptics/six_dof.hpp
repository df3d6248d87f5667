// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Devices that turn, or sense their orientation: everything of passive_haptics.hpp, and
//
//   device/rigid_body.hpp                      pose (p, q), motion (Δp, θ), wrench (f, τ)
//   device/stylus.hpp                          senses six degrees of freedom, actuates three
//   port/reported_work.hpp                     the driver reports the work of its motors in joints
//   device/rigid_damping.hpp                   b, b_ω, and the error of the work of a turn
//   device/rigid_inertia.hpp                   mass, moments, offset of the centre of mass
//   force_bound/rigid_reachable_bound.hpp      in joules, on time or a tick late; rigid_actuator_limit
//   contact/rigid_tool.hpp                     a tool with contacts at several points
//   contact/at_tip.hpp                         contacts of the tip of a stylus
//
//     auto peg = ph::make_tool({.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},
//                               .damping = {.linear = 0.03, .angular = 1e-4},
//                               .damping_most = {.linear = 0.06, .angular = 2e-4},
//                               .force_limit = 9, .torque_limit = 0.5},
//                              {.force = 5, .torque = 0.1}, ph::slots<plane, 20>{});
//     peg.source().update(slot, point_of_the_tool, surface);
//     motors.command(peg.tick({p, {w, x, y, z}}, ph::seconds{dt}).force);
//
// docs/design/six_dof.md has the guarantees and their proofs.

#include <passive_haptics/contact/at_tip.hpp>
#include <passive_haptics/contact/rigid_tool.hpp>
#include <passive_haptics/device/rigid_body.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/device/rigid_inertia.hpp>
#include <passive_haptics/device/stylus.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/port/reported_work.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The numbers of a handle that moves and turns, on which the guarantee rests.
struct rigid_device {
  rigid_inertia inertia{};       ///< a lower bound
  rigid_damping damping{};       ///< a lower bound
  rigid_damping damping_most{};  ///< an upper bound
  double force_limit{};          ///< the largest force that the motors hold [N]
  double torque_limit{};         ///< the largest torque [N·m]
  double lever = 0.03;           ///< ℓ, a length of the tool [m]
  double longest_tick = 1e-3;    ///< T, the worst tick of YOUR loop [s]
};
/// The largest force and torque of hand and load, about the handle point.
struct rigid_hand {
  double force{};   ///< largest force [N]
  double torque{};  ///< largest torque [N·m]
};

/// A tool with points that touch surfaces, each in a slot. Its guarantee is conditional; it recovers from faults and
/// respects the motors' limits, which check() asks for: one share scales the whole wrench, so a limit of zero would be no
/// wall. A device whose motors give no torque is a stylus, with at_tip.
template <class Body = rigid_body<double>, class Limits = loop_limits, class... Room>
[[nodiscard]] constexpr auto make_tool(const rigid_device& d, const rigid_hand& hand,
                                       const Room&... room) noexcept {
  const double left = d.inertia.at_handle();
  return passive_port{
      Body{},
      rigid_tool{tool_spring{.mass = left * d.inertia.mass,
                             .least_inertia = left * d.inertia.least,
                             .lever = d.lever},
                 pursuit{}, room...},
      forgiving{basic_reduced_energy<rigid_damping>{.damping = d.damping},
                amends_for(d.force_limit)},
      bound_chain{rigid_reachable_bound{.inertia = d.inertia,
                                        .hand_force = hand.force,
                                        .hand_torque = hand.torque,
                                        .linear_damping_most = d.damping_most.linear,
                                        .angular_damping_most = d.damping_most.angular},
                  rigid_actuator_limit{.force = detail::stated(d.force_limit),
                                       .torque = detail::stated(d.torque_limit)}},
      Limits{.longest_tick = d.longest_tick}};
}

}  // namespace v0
}  // namespace passive_haptics
