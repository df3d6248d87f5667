// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The list of all controllers that the bench judges. To add one, add one entry(...) to the room it
// belongs to: catalogue_bounding.cpp, catalogue_time_domain.cpp,
// catalogue_couplings.cpp, catalogue_encoders.cpp.

#include "model.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace controllers {

using d1 = ph::space<double, 1>;
using d2 = ph::space<double, 2>;
using d3 = ph::space<double, 3>;

/// What the designer of a controller knows of the device and the scene; all of it is true there.
struct premises {
  double mass = 0.1;           ///< m of the device [kg]
  double damping = 0.03;       ///< b [N·s/m]
  double friction = 0.0;       ///< f_c [N]
  double hand_force = 5.0;     ///< most of hand, load and friction together [N]
  double load = 0.0;           ///< the largest weight the wall is to carry [N]
  double quantum = 0.0;        ///< q of the encoders [m]
  double longest_tick = 1e-3;  ///< [s]
  int latency = 0;             ///< ticks from a command to its holding
  double wall_damping = 0.0;   ///< B of the virtual wall [N·s/m]
};

/// What a guarantee covers beside the environment, which may always do anything else. A cell of the
/// adversarial table that is covered must not lose; one that is not shows what is lost.
struct coverage {
  bool any_motion = true;  ///< false: hands of at most premises::hand_force on premises::mass
  bool any_clock = true;   ///< false: ticks of one length, none lost
  bool rounding = false;   ///< positions floored to premises::quantum
  int latency = 0;         ///< ticks: it is built for devices that have them, and judged on those
  double stiffest = std::numeric_limits<double>::infinity();  ///< surface [N/m]
};

struct facts {
  std::string name;
  std::string composition;        ///< in the library's terms, one line
  coverage covers{};              ///< means nothing with the tag none
  bool wall_damping = true;       ///< it renders premises::wall_damping: it has a Z-width
  bool credits_friction = false;  ///< judged on a device that has some, dry friction booked too
};

struct controller : facts {
  ph::guarantee tag{};  ///< of the type: the weakest of its parts
  std::function<model<d1>(const premises&)> in_1;
  std::function<model<d2>(const premises&)> in_2;  ///< empty: not offered in two dimensions
  std::function<model<d3>(const premises&)> in_3;  ///< empty: not offered in three

  template <class Space>
  [[nodiscard]] const auto& maker() const noexcept {
    if constexpr (Space::dof == 1) return in_1;
    if constexpr (Space::dof == 2) return in_2;
    if constexpr (Space::dof == 3) return in_3;
  }
};

/// All of them, each name once.
[[nodiscard]] const std::vector<controller>& catalogue();

// The rooms.
[[nodiscard]] std::vector<controller> bounding_controllers();
[[nodiscard]] std::vector<controller> time_domain_controllers();
[[nodiscard]] std::vector<controller> coupling_controllers();
[[nodiscard]] std::vector<controller> encoder_controllers();

}  // namespace controllers
