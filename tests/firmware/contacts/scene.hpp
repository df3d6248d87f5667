// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the scenes of sizes.cmake share: float, a reachable bound. Each tick has a file of its own, so that
// its bytes can be counted.

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/firmware.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace ph = passive_haptics;

using solid = ph::space<float, 3>;
using plane = ph::half_space<solid>;
template <class Source>
using with_source = ph::passive_port<solid, Source, ph::reduced_energy, ph::reachable_bound>;
