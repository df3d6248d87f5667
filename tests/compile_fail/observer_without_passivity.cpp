// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the observer does not model energy_observer_for
//
// Every observer states what it promises; a port promises the least of its parts.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
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
  static constexpr bool counts = true;
  static constexpr bool exact = true;
  ph::isotropic_damping::on<scene> b{ph::isotropic_damping{1}};
  constexpr bool update(float /*dx*/, float /*held*/, float /*dt*/) noexcept {
    return true;
  }
  constexpr void forfeit(float /*held*/, float /*T*/) noexcept {}
  constexpr float value() const noexcept {
    return 0;
  }
  constexpr const auto& damping() const noexcept {
    return b;
  }
};

ph::local_model model{scene{}, ph::followed<wall>{}, ph::turn_at_once{}, ph::spring{},
                      mine{},  ph::no_bound{},       ph::loop_limits{}};
