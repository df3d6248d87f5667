// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is compared on the model of a paper: the bare spring, and what make_touch, make_guard and make_contacts give
// for the facts of that model, for a hand that is known and for any hand.

#include "../controllers/model.hpp"
#include <passive_haptics/simulation/device.hpp>

#include <string>
#include <vector>

namespace papers {

namespace ph = passive_haptics;
namespace sim = passive_haptics::simulation;

using line = ph::space<double, 1>;
using wall = controllers::model<line>;

/// A device of one axis in its loop, as a paper gives it or as we state it. A controller is told the same numbers.
struct facts {
  double mass = 0.1;           ///< m, of what moves [kg]
  double damping = 0.1;        ///< b [N·s/m]
  double friction = 0.0;       ///< c, dry and rigid [N]
  double quantum = 0.0;        ///< q, step of the encoder [m]; 0: positions are exact
  double force_limit = 200.0;  ///< of the motors [N]
  double period = 1e-3;        ///< T [s]
  int latency = 0;             ///< ticks from a command to its holding, at most 2
  double hand = 5.0;           ///< the most that the hand pushes with [N]
  double wall_damping = 0.0;   ///< B, of the bare wall [N·s/m]

  [[nodiscard]] sim::device_parameters<line> device() const noexcept {
    return {.mass = mass,
            .damping = damping,
            .friction = friction,
            .force_limit = force_limit,
            .quantum = quantum,
            .period = period,
            .latency = latency};
  }
};

/// What a contender promises of the energy that it gives.
enum class promise : std::uint8_t {
  nothing,
  known_hand,  ///< 0 J to a hand of at most facts::hand
  any_hand,    ///< 0 J to whatever moves the device
};
[[nodiscard]] constexpr const char* to_string(promise p) noexcept {
  constexpr const char* names[] = {"nothing", "known hand", "any hand"};
  return names[static_cast<int>(p)];
}

struct contender {
  const char* name;
  promise to;
  wall (*make)(const facts&);
};

/// The bare spring first, then ours.
[[nodiscard]] const std::vector<contender>& contenders();
[[nodiscard]] inline const contender& bare() {
  return contenders().front();
}
/// The passivity controller of Hannaford and Ryu, of published/: it promises nothing for a sampled wall.
[[nodiscard]] const contender& passivity_controlled();

/// The contender's wall, K [N/m] beyond 0. Throws std::invalid_argument if it refuses the facts.
[[nodiscard]] wall wall_of(const contender& c, const facts& f, double K);

}  // namespace papers
