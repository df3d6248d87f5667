// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The list of all controllers that the bench judges. To add one, add one entry(...) to the room it
// belongs to: catalogue_bounding.cpp, catalogue_time_domain.cpp, catalogue_couplings.cpp,
// catalogue_encoders.cpp, catalogue_contacts.cpp.

#include "model.hpp"

#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

namespace controllers {

using d1 = ph::space<double, 1>;
using d2 = ph::space<double, 2>;
using d3 = ph::space<double, 3>;
using f1 = ph::space<float, 1>;
using f3 = ph::space<float, 3>;

/// The numbers that the designer of a controller knows of the device and the scene; all are true there.
struct premises {
  double mass = 0.1;           ///< m of the device [kg]
  double damping = 0.03;       ///< b [N·s/m]
  double friction = 0.0;       ///< f_c [N]
  double hand_force = 5.0;     ///< largest force of hand, load and friction together [N]
  double load = 0.0;           ///< the largest weight the wall is to carry [N]
  double quantum = 0.0;        ///< q of the encoders [m]
  double longest_tick = 1e-3;  ///< [s]
  double wall_damping = 0.0;   ///< B of the virtual wall [N·s/m]
};

/// The facts of a controller that its type does not have.
struct facts {
  std::string name;
  std::string composition;   ///< in the library's terms, one line
  bool wall_damping = true;  ///< it renders premises::wall_damping: it has a Z-width
  /// Proved up to this stiffness of the surface [N/m], whatever its type promises.
  double proved_up_to = std::numeric_limits<double>::quiet_NaN();
};

template <class Space>
using maker = std::function<model<Space>(const premises&)>;

/// A controller. Its promise and its assumptions are those of its type.
struct controller : facts {
  ph::guarantee tag{};
  int latency = 0;                ///< ticks: it is built for loops that late, and judged on those
  bool knows_steps = false;       ///< positions floored to premises::quantum are covered
  bool credits_friction = false;  ///< judged on a device that has some, dry friction booked too
  std::tuple<maker<d1>, maker<d2>, maker<d3>, maker<f1>, maker<f3>> makers{};

  /// Empty: not offered there.
  template <class Space>
  [[nodiscard]] auto& in() noexcept {
    return std::get<maker<Space>>(makers);
  }
  template <class Space>
  [[nodiscard]] const auto& in() const noexcept {
    return std::get<maker<Space>>(makers);
  }
  [[nodiscard]] bool promises() const noexcept {
    return tag != ph::guarantee::none || proved_up_to > 0.0;
  }
  [[nodiscard]] bool covers_stiffness(double surface) const noexcept {
    return promises() && !(surface > proved_up_to);
  }
  /// The same in a loop that is not late, which one that is built for late loops promises nothing of.
  [[nodiscard]] bool covers_prompt(double surface) const noexcept {
    return latency == 0 && covers_stiffness(surface);
  }
  /// Hands of at most premises::hand_force on premises::mass only, in ticks of one length.
  [[nodiscard]] bool needs_known_hands() const noexcept {
    return tag == ph::guarantee::conditional;
  }
};

/// All of them, each name once.
[[nodiscard]] const std::vector<controller>& catalogue();

// The rooms.
[[nodiscard]] std::vector<controller> bounding_controllers();
[[nodiscard]] std::vector<controller> time_domain_controllers();
[[nodiscard]] std::vector<controller> coupling_controllers();
[[nodiscard]] std::vector<controller> encoder_controllers();
[[nodiscard]] std::vector<controller> contact_controllers();

}  // namespace controllers
