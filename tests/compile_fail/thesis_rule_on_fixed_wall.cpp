// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this shaper compares with a local model that can move
//
// A fixed wall keeps no second copy to compare with.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/shaped.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>
#include <passive_haptics/shaper/thesis_rule.hpp>

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
                      ph::shaped{ph::spring{}, ph::thesis_rule{}},
                      ph::reduced_energy{},
                      ph::strict_bound{},
                      ph::loop_limits{}};
