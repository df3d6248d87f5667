// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Devices that turn, or sense that they do: everything of passive_haptics.hpp, and
//
//   device/rigid_body.hpp                      pose (p, q), motion (Δp, θ), wrench (f, τ)
//   device/stylus.hpp                          senses six degrees of freedom, pushes in three
//   port/reported_work.hpp                     the driver tells the work of its motors in joints
//   device/rigid_damping.hpp                   b, b_ω, and the work that the ends of a turn do not show
//   device/rigid_inertia.hpp                   mass, moments, offset of the centre of mass
//   force_bound/rigid_reachable_bound.hpp      in joules, on time or a tick late; rigid_actuator_limit
//   contact/rigid_tool.hpp                     a tool that touches at several points
//   contact/at_tip.hpp                         what a stylus touches with its tip
//
//     using device = ph::rigid_body<double>;
//     ph::passive_port port{device{}, ph::given_force{},
//                           ph::basic_reduced_energy<ph::rigid_damping>{
//                               .damping = {.linear = 0.03, .angular = 1e-4}},
//                           ph::strict_bound{}, ph::loop_limits{.longest_tick = 0.0011}};
//     motors.command(port.tick({p, {w, x, y, z}}, ph::seconds{dt}, device::join(f, tau)).force);
//
// docs/design/six_dof.md says what is promised, and why.

#include <passive_haptics/contact/at_tip.hpp>
#include <passive_haptics/contact/rigid_tool.hpp>
#include <passive_haptics/device/rigid_body.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/device/rigid_inertia.hpp>
#include <passive_haptics/device/stylus.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/port/reported_work.hpp>
