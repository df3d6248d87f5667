// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Table 3: the closed loop with a hand on walls of 0.5 to 16 kN/m, as measured on other libraries.
//
// Device 0.1 kg, 0.1 N·s/m; hand 30 N/m and 0.5 N·s/m, asked every 20 µs, released 20 mm in front
// of the wall with its target 15 mm behind the surface; 6 s at 1 kHz, exact positions. The start is
// not published; this one reproduces the published row without a bound.

#include "session.hpp"

namespace controllers {

struct stiffness_row {
  std::string controller;
  ph::guarantee tag{};
  double stiffness = 0.0;    ///< of the wall [N/m]
  bool covered = false;      ///< the guarantee has to hold here
  double out_of_port = 0.0;  ///< most that wall and device together ever gave the hand [J]
  double out_of_wall = 0.0;  ///< Σ f·Δx at the end: what the device's damper took is in it [J]
  double rms_speed = 0.0;    ///< over the last 2 s [m/s]
};

[[nodiscard]] std::vector<double> swept_stiffnesses();
[[nodiscard]] stiffness_row judge_on_stiffness(const controller& c, double stiffness);

/// Returns what contradicts the tags: a covered row that gave anything to the hand.
[[nodiscard]] std::vector<std::string> run_stiffness(const session& s);

}  // namespace controllers
