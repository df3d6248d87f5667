// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: update.*constraints not satisfied
//
// A fixed wall does not move.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
using supply = ph::followed<wall>;
#else
using supply = ph::fixed<wall>;
#endif

ph::local_model model{scene{},
                      supply{},
                      ph::turn_at_once{},
                      ph::spring{},
                      ph::reduced_energy{},
                      ph::strict_bound{},
                      ph::loop_limits{}};
bool usable = model.update(wall{0, 1, 1000});
