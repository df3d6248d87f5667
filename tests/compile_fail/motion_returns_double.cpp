// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the motion estimator does not model motion_estimator_for
//
// estimate().along() must return the scalar of the space, not something that converts to it.

#include <passive_haptics/bounds.hpp>
#include <passive_haptics/contact.hpp>
#include <passive_haptics/geometry.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/motion.hpp>
#include <passive_haptics/normals.hpp>
#include <passive_haptics/observers.hpp>
#include <passive_haptics/supply.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;
using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
using result = float;
#else
using result = double;
#endif
struct mine : ph::last_difference<scene> {
  struct motion {
    const float& position;
    constexpr result along(float /*n*/) const noexcept { return 0; }
  };
  constexpr motion estimate(const float& position, const float& /*displacement*/,
                            const float& /*held*/, float /*dt*/, bool /*known*/) const noexcept {
    return {position};
  }
};

ph::local_model model{scene{},
                      ph::following<wall>{},
                      ph::snap<scene>{},
                      ph::spring<scene>{},
                      ph::reduced_energy<scene>{},
                      ph::strict_bound<scene>{},
                      ph::loop_limits<scene>{},
                      mine{}};
