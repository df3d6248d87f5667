// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What was found of a device: bounds, each from the side that a promise needs.
//
// A ledger may credit no more than the device takes: mass, damping and friction are stated from below.
// What makes it pay is stated from above: presliding, step, noise, latency, the longest tick.

#include <passive_haptics/design/stiffness_budget.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// One axis, in SI units; of a joint radians and newton metres. Where `problem` is not null nothing else
/// says anything.
struct axis_found {
  double mass = 0.0;            ///< m is no less [kg]
  double damping = 0.0;         ///< b is no less, either way [N·s/m]; 0: not found
  double damping_max = 0.0;     ///< b is no more [N·s/m]
  double friction = 0.0;        ///< c is no less, anywhere on the stroke [N]; 0: not found
  double presliding = 0.0;      ///< p is no more [m]; nobody asks where friction is 0
  double quantum = 0.0;         ///< q, the step of the position, is no more [m]; 0: no steps
  double noise = 0.0;           ///< of the position beside its steps, end to end, is no more [m]
  int latency = 0;              ///< ticks from a command to its holding, no more
  double longest_tick = 0.0;    ///< seen [s]
  double damping_ways[2]{};     ///< no less going backward [0] and forward [1] [N·s/m]
  double breakaway_least[2]{};  ///< the same for the force at which it slips, where it is least [N]
  double breakaway_most[2]{};   ///< and no more, where it is largest [N]

  // Most likely, for people: no promise rests on them.
  double likely_mass = 0.0, likely_damping = 0.0, likely_friction = 0.0, likely_presliding = 0.0;
  double load = 0.0;       ///< a constant force, a weight [N]
  double explained = 0.0;  ///< share of the changes of velocity
  double uneven = 0.0;     ///< share by which friction varies along the way
  double creep = 0.0;      ///< share of that friction's least up to which it is taken not to creep

  const char* remark = nullptr;   ///< why friction was not found
  const char* problem = nullptr;  ///< why nothing was
};

/// All axes of a device, each measured by itself.
template <int Dof>
struct device_found {
  std::array<axis_found, static_cast<std::size_t>(Dof)> axes{};
  double force_limit = 0.0;  ///< what was allowed in the identification [N]

  /// The first problem, and the axis that has it; null if all is well.
  [[nodiscard]] const char* problem() const noexcept {
    for (const axis_found& a : axes) {
      if (a.problem != nullptr) return a.problem;
    }
    return nullptr;
  }
  /// What a promise may rest on in every direction. The presliding of several axes adds up as their
  /// deflections do, by squares; 1.2 of the longest tick seen is left for those that were not.
  [[nodiscard]] design::stated_device stated() const noexcept {
    design::stated_device d{.mass = axes[0].mass,
                            .damping = axes[0].damping,
                            .friction = axes[0].friction,
                            .force_limit = force_limit,
                            .longest_tick = 0.0};
    double squares = 0.0;
    for (const axis_found& a : axes) {
      d.mass = kernels::smaller(d.mass, a.mass);
      d.damping = kernels::smaller(d.damping, a.damping);
      d.friction = kernels::smaller(d.friction, a.friction);
      d.quantum = kernels::larger(d.quantum, a.quantum + a.noise);
      d.longest_tick = kernels::larger(d.longest_tick, 1.2 * a.longest_tick);
      squares += a.presliding * a.presliding;
    }
    d.presliding = d.friction > 0.0 ? std::sqrt(squares) : 0.0;
    return d;
  }
  /// The longest of all axes [ticks].
  [[nodiscard]] int latency() const noexcept {
    int most = 0;
    for (const axis_found& a : axes) most = a.latency > most ? a.latency : most;
    return most;
  }
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
