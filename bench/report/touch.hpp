// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Model error: what the local model's force and depth are off by because the environment answers
// seldom, for a hand that moves the same way whatever it feels. The truth is the same scene with the
// environment solved at 10 kHz and nothing between it and the device.

#include "cost.hpp"
#include <passive_haptics/environment/deformable_body.hpp>

#include <functional>
#include <string>
#include <vector>

namespace experiments {

namespace env = passive_haptics::environment;

using vector3 = Eigen::Vector3d;

/// Of all these scenes.
inline constexpr ph::loop_limits loop{.longest_tick = 1e-3};

/// What an environment says of the place that is touched; in one dimension x is all there is.
struct answer {
  std::array<vector3, 3> nodes;
  vector3 point, normal;
  double stiffness;
  vector3 rest;  ///< the point where it is pressed by nothing
  double soft;   ///< the stiffness, in series with the body behind [N/m]
};

/// A scene: where the hand is, and an environment that answers. `fresh` makes one at rest.
struct touch_scene {
  std::string name;
  int dof = 3;
  double duration = 2.0;                ///< [s]
  double from = 0.0, to = 2.0;          ///< the part that is in continuous contact and counts [s]
  std::function<vector3(double)> hand;  ///< position [m] at t [s]
  std::function<std::function<answer(const vector3& device, const vector3& held)>()> fresh;
};

/// 1-DOF: presses 1 to 5 mm into a wall of 1 kN/m that gives way like one of 2 kN/m.
[[nodiscard]] touch_scene yielding_wall();
/// The ball of thesis 3.3: 11 nodes, pressed to 6 mm and slid over its faces.
[[nodiscard]] touch_scene soft_ball();
/// The organ of the thesis experiments, stroked 1 to 3 mm deep.
[[nodiscard]] touch_scene stroked_organ();

/// Force on the device and depth in the model, every millisecond.
struct felt {
  std::vector<vector3> force;  ///< [N]
  std::vector<double> depth;   ///< [m]
  double update_ns = 0;        ///< of the environment, median
  double quiet = std::nan(
      "");  ///< from when the hand holds still, at `to`, until it is quiet [s]; NaN: it is not
  double asked = 0, shown = 0;  ///< stiffness there, told and felt along the force [N/m]
};

struct model_error {
  double rms_force = 0, largest_force = 0;  ///< of f − f_ref [N]
  double rms_depth = 0;                     ///< of the penetration [m]
  double largest_step = 0;  ///< ‖f(n) − f(n−1)‖, what a hand feels as a jump [N]
};
[[nodiscard]] model_error error_of(const touch_scene& scene, const felt& run, const felt& truth);

/// One composition of the local model, ready for any scene of its dimension.
struct composition {
  ph::guarantee tag = ph::guarantee::none;
  int dof = 3;
  candidate cost;
  std::function<felt(const touch_scene&, double rate)> touch;
};

/// The environment solved at 10 kHz, straight to the device.
[[nodiscard]] felt truth_of(const touch_scene& scene);

void compose_walls(std::vector<composition>& all);
void compose_planes(std::vector<composition>& all);
void compose_triangles(std::vector<composition>& all);
[[nodiscard]] const std::vector<composition>& all_compositions();

}  // namespace experiments
