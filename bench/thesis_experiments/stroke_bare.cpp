// SPDX-License-Identifier: BSD-3-Clause
#include "follow_stroke.hpp"

namespace experiments {

stroke_result bare_stroke(const stroke_scene& scene, double period) {
  const ph::local_model model{volume{},
                              ph::followed<ph::half_space<volume>>{},
                              ph::turn_at_once{},
                              ph::spring{},
                              ph::no_observer{},
                              ph::no_bound{},
                              ph::loop_limits{.longest_tick = 1e-3}};
  return follow_stroke(model, scene, period);
}

}  // namespace experiments
