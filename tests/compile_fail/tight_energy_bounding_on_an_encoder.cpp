// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this bound reads the motion itself and takes it as exact
//
// What it puts aside is the last tick's, and an encoder with steps shows another.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/quantised_energy.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>
#include <passive_haptics/published/energy_bounding.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
using bound = ph::strict_bound;
#else
using bound = ph::tight_energy_bounding;
#endif

ph::local_model model{scene{},          ph::followed<wall>{},   ph::turn_at_once{},
                      ph::spring{},     ph::quantised_energy{}, bound{},
                      ph::loop_limits{}};
