// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the observer does not model energy_observer_for
//
// value() must return the scalar of the port, not something that converts to it.

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
using number = float;
#else
using number = double;
#endif

struct mine : ph::no_observer {
  template <ph::port P>
  struct on : ph::no_observer::on<P> {
    using ph::no_observer::on<P>::on;
    constexpr number value() const noexcept { return 0; }
  };
};

ph::local_model model{scene{}, ph::followed<wall>{}, ph::turn_at_once{}, ph::spring{},
                      mine{},  ph::no_bound{},       ph::loop_limits{}};
