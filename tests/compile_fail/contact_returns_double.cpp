// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the contact law does not model contact_law_for
//
// force() must return the scalar of the space, not something that converts to it.

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
using number = float;
#else
using number = double;
#endif

struct mine : ph::spring {
  template <class Space>
  struct on : ph::spring::on<Space> {
    using ph::spring::on<Space>::on;
    constexpr number force(float depth, float /*outward_speed*/) const noexcept { return depth; }
  };
};

ph::local_model model{scene{},          ph::followed<wall>{}, ph::turn_at_once{},
                      mine{},           ph::reduced_energy{}, ph::strict_bound{},
                      ph::loop_limits{}};
