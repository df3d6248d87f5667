// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The whole core: everything that a haptic loop needs, without device drivers, environments or simulation. A
// loop with one degree of freedom and without Eigen includes firmware.hpp instead.
//
//   compositions.hpp        start here: make_touch, make_contacts, make_guard
//   local_model.hpp         one contact on one device
//   port/passive_port.hpp   one device, with any contacts and forces
//   energy_observer/        counts the energy that the hand and the device exchange
//   force_bound/            limits the force by that energy
//   normal_interpolation/   limits how fast the contact normal turns
//   constraint_geometry/    the surfaces, and the supplies that own and move them
//   contact/                depth to force; several contacts; a force of your own
//   shaper/                 changes the desired force by the state of the contact, before the bound
//   base/exchange.hpp       the newest value from another thread
//   published/published.hpp controllers of other authors; not included here
//   laws.hpp                the laws that a part of your own must obey; not included here
//   six_dof.hpp             devices that turn, or sense their orientation; not included here

#include <passive_haptics/compositions.hpp>
#include <passive_haptics/constraint_geometry/distance_brick.hpp>
#include <passive_haptics/constraint_geometry/distance_field.hpp>
#include <passive_haptics/constraint_geometry/patch.hpp>
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/constraint_geometry/segment.hpp>
#include <passive_haptics/constraint_geometry/shell.hpp>
#include <passive_haptics/constraint_geometry/sphere.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>
#include <passive_haptics/constraint_geometry/triangle.hpp>
#include <passive_haptics/contact/capped.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/contact/eased.hpp>
#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/contact/manifold.hpp>
#include <passive_haptics/contact/shaped.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/firmware.hpp>
