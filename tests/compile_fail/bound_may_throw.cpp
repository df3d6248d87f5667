// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the bound does not model force_bound_for
//
// limit() runs in the haptic loop and must say that it never throws.

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

#ifdef POSITIVE_CONTROL
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif

struct mine : ph::no_bound {
  template <ph::port P>
  struct on : ph::no_bound::on<P> {
    using ph::no_bound::on<P>::on;
    constexpr float limit(float desired, const auto& /*state*/) const noexcept(quiet) {
      return desired;
    }
  };
};

ph::local_model model{scene{},          ph::followed<wall>{}, ph::turn_at_once{},
                      ph::spring{},     ph::reduced_energy{}, mine{},
                      ph::loop_limits{}};
