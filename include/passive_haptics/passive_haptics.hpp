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
//   firmware.hpp            what of all this needs no Eigen
//   published.hpp           controllers that others have published; not in here
//   laws.hpp                what a part of your own must obey; not in here
//   six_dof.hpp             devices that turn, or sense that they do; not in here

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
