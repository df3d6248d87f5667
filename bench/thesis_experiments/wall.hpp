// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Thesis section 3.2: every controller of the thesis's time on the wall of common/wall.hpp, and the
// settling composition over decades of mass and stiffness (docs/design/mathematics.md § 9).

#include "../common/wall.hpp"
#include <passive_haptics/passive_haptics.hpp>

#include <functional>

namespace experiments {

struct wall_controller {
  std::string name;
  std::function<wall_result(const wall_scene&, std::uint64_t seed, csv_file*)> run;
};

/// A local model over a half-space that follows the wall, in a loop that believes what a wall without
/// a bound does to the device.
template <class Law, class Observer, class Bound>
auto wall_model(const Law& law, const Observer& observer, const Bound& bound) {
  return ph::local_model{
      line{},
      ph::followed<ph::half_space<line>>{},
      ph::turn_at_once{},
      law,
      observer,
      bound,
      ph::loop_limits{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3}};
}

/// Passive and settled (docs/design/mathematics.md § 9): the composition of the sweep.
inline auto settling_model(double mass) {
  return wall_model(ph::damped_spring{.mass = mass}, ph::reduced_energy{.damping = 0.03},
                    ph::reachable_bound{.mass = mass, .hand_force = 5.0});
}

[[nodiscard]] std::vector<wall_controller> wall_controllers();

/// All controllers in all scenes. S1 is random in its schedule and run `seeds` times; S0 and S2
/// have nothing random in them.
void run_wall(report& out, int seeds);

/// § 9: masses and stiffnesses over decades, on an ideal device. 48 cases with the static wall and
/// with one update of lag, 24 more without the lag.
void run_sweep(report& out);

}  // namespace experiments
