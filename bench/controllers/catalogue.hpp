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
using f1 = ph::space<float, 1>;
using f3 = ph::space<float, 3>;

/// What the designer of a controller knows of the device and the scene; all of it is true there.
template <class Scalar>
struct premises_in {
  Scalar mass = Scalar(0.1);           ///< m of the device [kg]
  Scalar damping = Scalar(0.03);       ///< b [N·s/m]
  Scalar friction{};                   ///< f_c [N]
  Scalar hand_force = Scalar(5);       ///< most of hand, load and friction together [N]
  Scalar load{};                       ///< the largest weight the wall is to carry [N]
  Scalar quantum{};                    ///< q of the encoders [m]
  Scalar longest_tick = Scalar(1e-3);  ///< [s]
  int latency = 0;                     ///< ticks from a command to its holding
  Scalar wall_damping{};               ///< B of the virtual wall [N·s/m]

  /// The same in another scalar; what float rounds is no longer quite true.
  template <class Other>
  [[nodiscard]] constexpr premises_in<Other> in() const noexcept {
    return {.mass = Other(mass),
            .damping = Other(damping),
            .friction = Other(friction),
            .hand_force = Other(hand_force),
            .load = Other(load),
            .quantum = Other(quantum),
            .longest_tick = Other(longest_tick),
            .latency = latency,
            .wall_damping = Other(wall_damping)};
  }
};
using premises = premises_in<double>;
template <class Space>
using known_in = premises_in<typename Space::scalar>;

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
  std::function<model<f1>(const premises&)> in_1_float;
  std::function<model<f3>(const premises&)> in_3_float;  ///< empty: not offered in three

  template <class Space>
  [[nodiscard]] const auto& maker() const noexcept {
    if constexpr (std::is_same_v<Space, f1>) return in_1_float;
    if constexpr (std::is_same_v<Space, f3>) return in_3_float;
    if constexpr (std::is_same_v<Space, d1>) return in_1;
    if constexpr (std::is_same_v<Space, d2>) return in_2;
    if constexpr (std::is_same_v<Space, d3>) return in_3;
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
