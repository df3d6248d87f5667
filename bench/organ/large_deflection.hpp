// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The error of small strains when the body is pressed far, and of rotated elements, against a neo-Hookean body of
// the same mesh (docs/design/large_deflections.md).

#include "../common/record.hpp"
#include <passive_haptics/environment/stiffness_solver.hpp>

#include <string>
#include <vector>

namespace organ {

/// One body under one force; errors are against the neo-Hookean body, relative.
struct large_deflection_row {
  std::string scene{};
  double percent = 0.0;      ///< where the point goes that is pressed, of the length of the body
  double linear = 0.0;       ///< error of its displacement by small strains
  double linear_body = 0.0;  ///< rms over all nodes
  double linear_stiffness = 0.0;
  double one_step = 0.0;  ///< the same by rotated elements, one correction of the linear answer
  double rotated = 0.0;   ///< and with as many as it takes
  double rotated_body = 0.0;
  double rotated_stiffness = 0.0;
  int steps = 0;  ///< that it takes; 0: it does not converge
};
[[nodiscard]] experiments::record record_of(const large_deflection_row& r);

/// The cost of a correction and of a solution, CPU time [ms].
struct rotation_cost_row {
  std::size_t nodes = 0;
  double solve = 0.0, forces = 0.0;
};
[[nodiscard]] experiments::record record_of(const rotation_cost_row& r);

/// A block that is pressed in the middle of its top, and a beam that is bent, so many percent one after the
/// other, ascending. Throws stopped_by_caller if `tell` says so.
[[nodiscard]] std::vector<large_deflection_row> large_deflections(
    const std::vector<double>& percents,
    const passive_haptics::environment::on_progress& tell = {});
/// Blocks of n³ nodes.
[[nodiscard]] std::vector<rotation_cost_row> rotation_costs(const std::vector<int>& sides);

}  // namespace organ
