// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The core, whole: everything a haptic loop needs, nothing of devices, environments or simulation. A
// loop with one degree of freedom that wants no Eigen includes local_model.hpp and its parts instead.
//
//   compositions.hpp        start here: touch, encoder_touch, force_guard, strict_guard
//   local_model.hpp         one contact on one device
//   port/passive_port.hpp   one device, whatever pushes on it
//   energy_observer/        counts the energy that the hand and the device exchange
//   force_bound/            limits the force by that energy
//   normal_interpolation/   limits how fast the contact normal turns
//   constraint_geometry/    pieces of the world, and who moves them
//   contact/                depth to force; several contacts; a force of your own
//   shaper/                 shapes the wanted force by the contact, before the bound
//   base/exchange.hpp       the newest value from another thread
//   laws.hpp                what a part of your own must obey; not in here
//   six_dof.hpp             devices that turn, or sense that they do; not in here

#include <passive_haptics/base/exchange.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/constraint_geometry/distance_brick.hpp>
#include <passive_haptics/constraint_geometry/distance_field.hpp>
#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/patch.hpp>
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/constraint_geometry/segment.hpp>
#include <passive_haptics/constraint_geometry/shell.hpp>
#include <passive_haptics/constraint_geometry/sphere.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>
#include <passive_haptics/constraint_geometry/triangle.hpp>
#include <passive_haptics/contact/capped.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/contact/contacts.hpp>
#include <passive_haptics/contact/damped_spring.hpp>
#include <passive_haptics/contact/eased.hpp>
#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/contact/manifold.hpp>
#include <passive_haptics/contact/settled_force.hpp>
#include <passive_haptics/contact/shaped.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/contact/virtual_coupling.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/energy_observer/forgiving.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/energy_observer/quantised_energy.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/energy_bounding.hpp>
#include <passive_haptics/force_bound/energy_tank.hpp>
#include <passive_haptics/force_bound/parallel_passivity_controller.hpp>
#include <passive_haptics/force_bound/passivity_controller.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/force_bound/sector_bound.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/force_bound/thermal_limit.hpp>
#include <passive_haptics/force_bound/watched.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/motion_estimator/edge_observer.hpp>
#include <passive_haptics/motion_estimator/mass_observer.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>
#include <passive_haptics/normal_interpolation/turn_limited.hpp>
#include <passive_haptics/port/passive_port.hpp>
#include <passive_haptics/shaper/force_rate_limit.hpp>
#include <passive_haptics/shaper/reference_energy.hpp>
#include <passive_haptics/shaper/set_position_modulation.hpp>
#include <passive_haptics/shaper/stiffness_augmentation.hpp>
#include <passive_haptics/shaper/thesis_rule.hpp>
#include <passive_haptics/version.hpp>
