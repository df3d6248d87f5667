// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand strokes an organ 1-3 mm below its surface while the environment answers at 30 Hz. Five runs
// along the same path:
//
//   reference   the environment solved at 1 kHz
//   bare        30 Hz, normals taken at once, no bound
//   passive     30 Hz, normals turned at a rate, force-rate limit and energy bound: the thesis
//   touch       30 Hz, make_touch
//   lent        30 Hz, make_touch, told the surface as it yields, with a loan

#include "../common/report.hpp"
#include "organ.hpp"

#include <array>
#include <vector>

namespace experiments {

struct stroke_result {
  std::vector<std::array<double, 11>> rows;  ///< of the CSV file, one per tick
  std::vector<vector3> forces;               ///< [N]
  double force_step = 0;                     ///< largest in one tick [N]
  int contact_lost = 0;                      ///< ticks of the stroke without force
  double port_energy = 0;                    ///< least [J]
  double end_energy = 0;                     ///< at the port, when the hand has left [J]
  std::vector<double> update_ms;             ///< wall-clock time of each environment update
};

/// The runs, each in a file of its own: they take the compiler longer than the machine.
[[nodiscard]] stroke_result bare_stroke(const stroke_scene& scene, double period);
[[nodiscard]] stroke_result passive_stroke(const stroke_scene& scene, double period);
[[nodiscard]] stroke_result touched_stroke(const stroke_scene& scene, double period);
[[nodiscard]] stroke_result lent_stroke(const stroke_scene& scene, double period);
inline constexpr double loan = 2e-4;  ///< [J]

struct strokes {
  stroke_result reference, bare, passive, touch, lent;
};

/// All of them, with nothing written. Throws unusable_organ for one that the stroke does not fit: too
/// small or too large for its depth, or in parts that turn about a node or an edge.
[[nodiscard]] strokes stroke(const stroke_scene& scene);

/// Root mean square of |f − f_ref| over the stroke [N].
[[nodiscard]] double rms_error(const stroke_result& run, const stroke_result& reference);

void show_strokes(report& out, const stroke_scene& scene, const strokes& runs);

}  // namespace experiments
