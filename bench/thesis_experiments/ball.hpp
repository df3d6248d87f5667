// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ball of thesis section 3.3: 16 tetrahedra, 11 nodes, soft and held on one side. A hand pushes
// the device along z towards its centre; the environment answers every 0.5 s or at 30 Hz. Each
// answer turns the contact normal by degrees: taken at once it throws the device sideways.

#include "../common/report.hpp"
#include "volume.hpp"
#include <passive_haptics/environment/tetrahedral_stiffness.hpp>

namespace experiments {

/// The radius and what the ball is made of: soft enough that a few newtons turn its faces by
/// degrees.
inline constexpr double ball_radius = 0.05;
inline constexpr env::material ball_material{.young = 1e4, .poisson = 0.3};
inline constexpr double hand_limit = 10.0;  ///< [N]

inline constexpr double turning_rate = 0.5;  ///< of the turn_limited runs [rad/s]

struct ball_result {
  double normal_step = 0;    ///< [rad] in one tick, in contact
  double force_step = 0;     ///< [N] in one tick, in contact
  double position_jump = 0;  ///< [m]
};

/// Normals are taken at once, or turned at turning_rate if it is `limited`; the environment answers
/// every `period` [s].
[[nodiscard]] ball_result press(bool limited, double period, csv_file& csv);

void run_ball(report& out);

}  // namespace experiments
