// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the observer does not model energy_observer_for
//
// value() runs in the haptic loop and must say that it never throws.

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

#ifdef POSITIVE_CONTROL
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif

struct mine : ph::no_observer {
  template <ph::port P>
  struct on : ph::no_observer::on<P> {
    using ph::no_observer::on<P>::on;
    constexpr float value() const noexcept(quiet) { return 0; }
  };
};

ph::local_model model{scene{}, ph::followed<wall>{}, ph::turn_at_once{}, ph::spring{},
                      mine{},  ph::no_bound{},       ph::loop_limits{}};
