// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the motion estimator does not model motion_estimator_for
//
// estimate() runs in the haptic loop and must say that it never throws.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>
#include <passive_haptics/port/last_difference.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif

struct mine {
  struct seen {
    float position;
    constexpr float along(float /*n*/) const noexcept { return 0; }
  };
  constexpr seen estimate(float shown, float /*travel*/, float /*held*/, float /*dt*/,
                          bool /*known*/) const noexcept(quiet) {
    return {shown};
  }
};

ph::local_model model{scene{},
                      ph::followed<wall>{},
                      ph::turn_at_once{},
                      ph::spring{},
                      ph::reduced_energy{},
                      ph::strict_bound{},
                      ph::loop_limits{},
                      mine{}};
