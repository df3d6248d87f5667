// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the limits of the loop are left out
//
// The longest tick is that of YOUR loop, so it is never assumed.

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
#define LIMITS            \
  , ph::loop_limits {     \
    .longest_tick = 0.001 \
  }
#else
#define LIMITS
#endif

ph::local_model model{scene{},      ph::followed<wall>{}, ph::turn_at_once{},
                      ph::spring{}, ph::reduced_energy{}, ph::strict_bound{} LIMITS};
