// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A long run in virtual time: how far the ledger drifts from the true energy, plain and compensated.

#include "session.hpp"

namespace stability {

struct soak_row {
  std::string ledger;  ///< "float", "float, compensated", ...
  std::string motion;
  long long ticks = 0;
  double drift = 0.0;         ///< E1 − true energy [J]; > 0: the ledger promises too much
  double overstated = 0.0;    ///< most of that so far [J]
  double least_energy = 0.0;  ///< true [J]
  double bank = 0.0;          ///< E1 [J]
  double unit = 0.0;          ///< ε/2 of the scalar: what showing a compensated sum rounds by
};

/// strict_bound in one dimension; a row at each power of ten of the ticks and at the end.
[[nodiscard]] std::vector<soak_row> soak(long long ticks, int threads);

/// Returns a sentence for everything that fails the program.
[[nodiscard]] std::vector<std::string> run_soak(const session& s);

}  // namespace stability
