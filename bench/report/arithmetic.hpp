// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Arithmetic error: float, float with a compensated ledger, double and long double against the same
// composition in 113 bits, fed with the same motion, tick by tick.

#include "cost.hpp"

#include <string>
#include <vector>

namespace experiments {

/// Largest difference from the 113-bit run so far, as a share of the largest value of that run.
struct arithmetic_error {
  double force = 0;   ///< ‖f − f_ref‖
  double energy = 0;  ///< |E1 − E1_ref|
  double plane = 0;   ///< of the depth of the device in the local model's surface
  double normal = 0;  ///< ‖n − n_ref‖, of a unit vector
};

struct arithmetic_row {
  std::string composition, scalar;
  double epsilon = 0;  ///< one unit in the last place of 1
  long ticks = 0;
  arithmetic_error error;
  bool same_motion = true;  ///< was it at the same positions, to the last bit?
};

struct arithmetic_composition {
  std::string name;
  /// All scalars, at 1e3, 1e4 … up to so many ticks.
  std::function<std::vector<arithmetic_row>(long ticks)> compare;
  std::vector<candidate> timed;  ///< in all scalars but the reference: "composition, scalar"
};
/// In the order of the tables.
[[nodiscard]] const std::vector<arithmetic_composition>& arithmetic_compositions();

}  // namespace experiments
