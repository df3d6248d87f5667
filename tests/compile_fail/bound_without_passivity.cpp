// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the bound does not model force_bound_for
//
// Every bound states what it promises; a port promises the least of its parts.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

struct mine {
#ifdef POSITIVE_CONTROL
  static constexpr ph::guarantee passivity = ph::guarantee::none;
#endif
  static constexpr ph::bound_traits traits{};
  constexpr ph::share<float> limit(float /*desired*/, const auto& /*state*/) const noexcept {
    return {1};
  }
};

ph::local_model model{scene{},          ph::followed<wall>{}, ph::turn_at_once{},
                      ph::spring{},     ph::reduced_energy{}, mine{},
                      ph::loop_limits{}};
