// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Z-width sweep as a list, as lines of a file, and as a page.

#include "z_width.hpp"

namespace controllers {

struct z_cell {
  const controller* c = nullptr;
  double damping = 0.0, stiffness = 0.0;
};

/// The whole sweep in its order: controllers that render a damped wall, then B, then K.
[[nodiscard]] std::vector<z_cell> z_cells(const std::vector<controller>& judged,
                                          const z_grid& grid);

inline constexpr const char* z_heading =
    "controller,damping N s/m,stiffness N/m,motion J,hand J,growth,passive for,stable";
[[nodiscard]] std::string z_line(const z_row& r);

/// The name of its plot, without .svg.
[[nodiscard]] std::string z_plot_name(std::string controller);

/// Tables and plots of a complete sweep, from z_width.csv in the folder of the report.
void show_z_width(const session& s, const std::vector<z_row>& rows);

}  // namespace controllers
