// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Error against run time of a deforming organ, by the fineness of its mesh, its rate and the published surface.

#include "../common/rows.hpp"
#include <passive_haptics/environment/stiffness_solver.hpp>

#include <string>
#include <vector>

namespace organ {

namespace ex = experiments;

struct precision_settings {
  std::vector<int> sides;     ///< nodes along an edge of the organ's grid, ascending
  std::vector<double> rates;  ///< of the environment [Hz]
  double seconds = 3.0;       ///< of virtual time
  int threads = 0;            ///< that compute the tables
};

/// One mesh, published as one surface so many times a second. Forces are those of the model alone, under no
/// bound, while a hand goes where it wants, whatever it feels.
struct precision_row {
  std::size_t nodes = 0;
  std::string surface{};
  double rate = 0.0;          ///< [Hz]
  double update = 0.0;        ///< CPU time of contact and surface, mean [ms]
  double work = 0.0;          ///< the same a second of touching [ms]
  double force = 0.0;         ///< rms, of the same mesh at 10 kHz [N]
  double error = 0.0;         ///< rms, from the triangles of the same mesh at 10 kHz [N]
  double share = 0.0;         ///< the same of `force` [%]
  double own = 0.0;           ///< rms, from the same surface at 10 kHz [N]
  double own_share = 0.0;     ///< the same of `force` [%]
  double largest_step = 0.0;  ///< of the force, from tick to tick [N]
  bool front = false,
       own_front = false;  ///< no other has as little of that error for as little work
};
/// A mesh against the finest one, both at 10 kHz.
struct mesh_row {
  std::size_t nodes = 0;
  double edge = 0.0;          ///< of the triangles that are touched, mean [mm]
  double stiffness = 0.0;     ///< at the contact, mean [N/m]
  double of_point = 0.0;      ///< the same where a point is pressed, and no area [N/m]
  double force = 0.0;         ///< rms [N]
  double error = 0.0;         ///< rms, from that of the finest [N]
  double largest_step = 0.0;  ///< [N]
};
[[nodiscard]] ex::record record_of(const precision_row& r);
[[nodiscard]] ex::record record_of(const mesh_row& r);

struct precision_result {
  std::vector<precision_row> rows;
  std::vector<mesh_row> meshes;
};
[[nodiscard]] precision_result run_precision(ex::report& out, const precision_settings& chosen,
                                             const passive_haptics::environment::on_progress& tell);

}  // namespace organ
