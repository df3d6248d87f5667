// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Table 1: every controller on the wall of docs/design/mathematics.md § 5.

#include "../common/wall.hpp"
#include "session.hpp"

namespace controllers {

struct wall_row {
  std::string controller, scene;
  int runs = 0;
  int settled = 0;
  ex::wall_result mean{};           ///< settle: the worst; port_energy: the least; the rest: means
  ex::wall_result least{}, most{};  ///< of the runs, in peak_to_peak and force_error
  double displayed = 0.0;           ///< static stiffness [N/m]
};

[[nodiscard]] std::vector<ex::wall_scene> wall_scenes();

/// What a controller is told of a scene.
[[nodiscard]] premises known_of(const ex::wall_scene& scene);

/// One controller in one scene; S1 and S5 are random and run once per seed.
[[nodiscard]] wall_row judge_on_wall(const controller& c, const ex::wall_scene& scene, int seeds);

/// The stiffness [N/m] that a slow hand feels: pressed from the surface of a wall of 10 kN/m at
/// 1 mm/s by a velocity source, with an empty ledger, the force over the depth when it reaches 1 N,
/// or at 20 mm if it never does. L4: at most 2b/T for what is strict.
[[nodiscard]] double displayed_stiffness(const controller& c);

/// Figures of § 5: peak to peak [mm] and mean force error [N].
struct published {
  const char* controller;
  const char* scene;
  double peak_to_peak_mm;
  double force_error;
  const char* reason = "";  ///< why the row differs, where it does
};
[[nodiscard]] const std::vector<published>& section_5();

/// "yes" if both figures are within 10 % of the published ones, or both less than 0.1 mm or 0.1 N;
/// "within the seeds" if a figure that is not lies between the least and the most of the seeds, and
/// otherwise the reason, or "NO".
[[nodiscard]] std::string agreement(const wall_row& row, const published& p);

/// Promises nothing, so nothing is found to contradict it: the empty list.
[[nodiscard]] std::vector<std::string> run_wall(const session& s);

}  // namespace controllers
