// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the contact law does not model contact_law_for
//
// The local model stands at the depth that the bounded force says: depth() is the inverse of force().

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

struct mine {
  constexpr void adopt(float /*K*/, float /*T*/) noexcept {}
  constexpr float force(float depth, float /*outward_speed*/) const noexcept { return depth; }
#ifdef POSITIVE_CONTROL
  constexpr float depth(float force, float /*outward_speed*/) const noexcept {
    return force;
  }
#endif
};

ph::local_model model{scene{},          ph::followed<wall>{}, ph::turn_at_once{},
                      mine{},           ph::reduced_energy{}, ph::strict_bound{},
                      ph::loop_limits{}};
