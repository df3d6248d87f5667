// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the constraint does not model constraint_for
//
// at() runs in the haptic loop and must say that it never throws.

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
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif

struct mine : wall {
  struct probe {
    float depth;
    constexpr float outward() const noexcept { return 1; }
    constexpr bool covered() const noexcept { return true; }
  };
  constexpr probe at(const float& x) const noexcept(quiet) { return {x}; }
  constexpr mine toward(const mine& target, float /*x*/, float /*n*/, float /*d*/) const noexcept {
    return target;
  }
};

ph::local_model model{scene{},          ph::followed<mine>{}, ph::turn_at_once{},
                      ph::spring{},     ph::reduced_energy{}, ph::strict_bound{},
                      ph::loop_limits{}};
