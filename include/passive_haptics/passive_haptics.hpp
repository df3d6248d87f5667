// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The core, whole: everything a haptic loop needs, nothing of devices, environments or simulation.
// A one-degree-of-freedom scene that wants no Eigen includes local_model.hpp and its parts instead.

#include <passive_haptics/bounds.hpp>
#include <passive_haptics/contact.hpp>
#include <passive_haptics/eigen_space.hpp>
#include <passive_haptics/exchange.hpp>
#include <passive_haptics/geometry.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/motion.hpp>
#include <passive_haptics/normals.hpp>
#include <passive_haptics/observers.hpp>
#include <passive_haptics/supply.hpp>
#include <passive_haptics/version.hpp>
