// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The names of the experiments in three dimensions.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/schedule.hpp>

namespace experiments {

namespace ph = passive_haptics;
namespace env = passive_haptics::environment;
namespace sim = passive_haptics::simulation;

using volume = ph::space<double, 3>;
using vector3 = volume::vector;

}  // namespace experiments
