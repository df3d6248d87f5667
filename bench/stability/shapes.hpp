// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Triangles that are next to none, and normals that are next to equal or next to opposite.

#include "session.hpp"

namespace stability {

struct sliver_row {
  const char* scalar = "";
  double size = 0.0;    ///< longest edge [m]
  double aspect = 0.0;  ///< longest edge over height
  int tried = 0, accepted = 0;
  double largest_error = 0.0;  ///< of an accepted normal [rad]
  int silent = 0;              ///< refused without an event: must be 0
  int not_finite = 0;          ///< must be 0
};
[[nodiscard]] std::vector<sliver_row> slivers(int each);

struct normal_row {
  const char* scalar = "";
  double apart = 0.0;          ///< angle from the first normal to the last [rad]
  double fastest = 0.0;        ///< largest turn of a step over rate·dt
  double longest_error = 0.0;  ///< most | ‖n‖ − 1 |
  int tried = 0, arrived = 0;
};
[[nodiscard]] std::vector<normal_row> turns(int each);

struct attack_row {
  const char* scalar = "";
  std::string what;
  double least_energy = 0.0;   ///< true, at the port [J]
  double largest_force = 0.0;  ///< [N]
};
/// strict_bound on slivers that turn, and no_bound on the same.
[[nodiscard]] std::vector<attack_row> attacks_on_slivers(int runs);

/// Returns a sentence for everything that fails the program.
[[nodiscard]] std::vector<std::string> run_shapes(const session& s);

}  // namespace stability
