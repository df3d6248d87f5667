// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What was found of an axis: bounds, each on the side on which a promise needs it.

#include <passive_haptics/design/stiffness_budget.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// SI units; of a joint radians and newton metres. Where `problem` is no null, the rest says nothing.
struct axis_found {
  double mass = 0.0;          ///< m is no less [kg]
  double damping = 0.0;       ///< b is no less [N·s/m]; 0: not found
  double damping_max = 0.0;   ///< b is no more [N·s/m]
  double friction = 0.0;      ///< c is no less, anywhere [N]; 0: not found
  double presliding = 0.0;    ///< p is no more [m]; of no concern where the friction is 0
  double quantum = 0.0;       ///< q, the step of the position, is no more [m]
  double noise = 0.0;         ///< of the position beside the step, from end to end, is no more [m]
  int latency = 0;            ///< from a command to its holding [ticks]
  double longest_tick = 0.0;  ///< [s]

  // for people
  double mass_best = 0.0, damping_best = 0.0, friction_best = 0.0;  ///< most likely
  double presliding_best = 0.0;
  std::array<double, 2> damping_ways{};  ///< no less going backward, forward [N·s/m]
  std::array<double, 2> breakaway_least{}, breakaway_most{};  ///< backward, forward [N]
  double load = 0.0;                                          ///< constant, most likely [N]
  double explained = 0.0;                                     ///< share of the motion
  double uneven = 0.0;  ///< share by which friction varies from place to place
  double creep = 1.0;   ///< share of kinetic friction up to which it was seen not to creep
  bool creep_seen = false;
  const char* remark = nullptr;   ///< why friction was not found
  const char* problem = nullptr;  ///< why nothing was
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
