// SPDX-License-Identifier: BSD-3-Clause
#include "follow_stroke.hpp"

namespace experiments {

stroke_result passive_stroke(const stroke_scene& scene, double period) {
  const ph::local_model model{volume{},
                              ph::followed<ph::half_space<volume>>{{.stale_after = 0.2}},
                              ph::turn_limited{.rate = 3.0},
                              ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 3.0}},
                              ph::reduced_energy{.damping = 0.03},
                              ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                                              ph::actuator_limit{.most = 9.0}},
                              ph::loop_limits{.longest_tick = 1e-3}};
  return follow_stroke(model, scene, period);
}

}  // namespace experiments
