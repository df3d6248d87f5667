// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the bound does not model force_bound_for
//
// limit() must return a share or an effort of the port: a double would drag soft-float into firmware.

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
using number = float;
#else
using number = double;
#endif

struct mine : ph::no_bound {
  template <ph::port P>
  struct on : ph::no_bound::on<P> {
    using ph::no_bound::on<P>::on;
    constexpr ph::share<number> limit(float /*desired*/, const auto& /*state*/) const noexcept {
      return {1};
    }
  };
};

ph::local_model model{scene{},          ph::followed<wall>{}, ph::turn_at_once{},
                      ph::spring{},     ph::reduced_energy{}, mine{},
                      ph::loop_limits{}};
