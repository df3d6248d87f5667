// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers found of a device, each as a bound on the side that the proofs of the ledgers need.
//
// A ledger may credit no more energy than the device dissipates, so mass, damping and friction are lower bounds. The
// numbers that reduce the credit are upper bounds: presliding, step, noise, latency and the longest tick.

#include <passive_haptics/design/stiffness_budget.hpp>
#include <passive_haptics/identification/disturbance.hpp>
#include <passive_haptics/identification/trust.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// One axis, in SI units; for a joint in radians and newton metres. If `problem` is not null, no other member
/// counts.
struct axis_found {
  double mass = 0.0;            ///< lower bound of m, all that moves [kg]
  double damping = 0.0;         ///< lower bound of b, both ways [N·s/m]; 0: not found
  double damping_max = 0.0;     ///< upper bound of b [N·s/m]
  double friction = 0.0;        ///< lower bound of c, anywhere on the stroke [N]; 0: not found
  double presliding = 0.0;      ///< upper bound of p [m]; not used where friction is 0
  double quantum = 0.0;         ///< upper bound of q, the step of the position [m]; 0: no steps
  double noise = 0.0;           ///< upper bound of the noise beside the steps, end to end [m]
  int latency = 0;              ///< upper bound of the ticks from a command to its holding
  double longest_tick = 0.0;    ///< the longest tick seen [s]
  double damping_ways[2]{};     ///< lower bounds of b, backward [0] and forward [1] [N·s/m]
  double breakaway_least[2]{};  ///< lower bounds of the break-away force, both ways [N]
  double breakaway_most[2]{};   ///< upper bounds of the break-away force, both ways [N]

  // The most likely values, for people to read: no bound is computed from them.
  double likely_mass = 0.0, likely_damping = 0.0, likely_friction = 0.0, likely_presliding = 0.0;
  double load = 0.0;       ///< constant force, such as a weight [N]
  double explained = 0.0;  ///< share of the changes of velocity that the model explains, ≤ 1
  double uneven = 0.0;     ///< share by which friction varies along the way, 0 to 1
  double creep = 0.0;      ///< share of the least friction up to which no creep is assumed, 0 to 1

  /// Lower bound of what moves rigidly with the encoder [kg]: below `mass` by the mode that was found, or by one of up to
  /// 400 Hz that the steps could hide; 0: not known, `mass` then.
  double rotor = 0.0;
  disturbances_found wrong{};  ///< what was found wrong, by name

  const char* remark = nullptr;   ///< reason why friction was not found, or null
  const char* problem = nullptr;  ///< reason why nothing was found, or null

  /// The mass that a composition may rest on [kg].
  [[nodiscard]] double moves_rigidly() const noexcept { return rotor > 0.0 ? rotor : mass; }
};

/// All axes of a device, each measured by itself.
template <int Dof>
struct device_found {
  std::array<axis_found, static_cast<std::size_t>(Dof)> axes{};
  double force_limit = 0.0;  ///< the largest force allowed in the identification [N]
  double drift =
      trust{}.drift;  ///< share of damping and friction that may be lost by warmth and wear

  /// The first problem of any axis, or null.
  [[nodiscard]] const char* problem() const noexcept {
    for (const axis_found& a : axes) {
      if (a.problem != nullptr) return a.problem;
    }
    return nullptr;
  }
  /// The bounds that hold in every direction: the least mass, damping and friction, the latter two less the drift, the
  /// presliding √Σ p², as deflections add, or 0 without friction, and 1.2 times the longest tick seen.
  [[nodiscard]] encoder_device stated() const noexcept {
    encoder_device d{.mass = axes[0].moves_rigidly(),
                     .damping = axes[0].damping,
                     .friction = axes[0].friction,
                     .force_limit = force_limit,
                     .longest_tick = 0.0,
                     .latency = latency()};
    double squares = 0.0;
    for (const axis_found& a : axes) {
      d.mass = kernels::smaller(d.mass, a.moves_rigidly());
      d.damping = kernels::smaller(d.damping, a.damping);
      d.friction = kernels::smaller(d.friction, a.friction);
      d.quantum = kernels::larger(d.quantum, a.quantum + a.noise);
      d.longest_tick = kernels::larger(d.longest_tick, 1.2 * a.longest_tick);
      squares += a.presliding * a.presliding;
    }
    d.damping *= 1.0 - drift;
    d.friction *= 1.0 - drift;
    d.presliding = d.friction > 0.0 ? std::sqrt(squares) : 0.0;
    return d;
  }
  /// The largest latency of all axes [ticks].
  [[nodiscard]] int latency() const noexcept {
    int most = 0;
    for (const axis_found& a : axes) most = a.latency > most ? a.latency : most;
    return most;
  }
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
