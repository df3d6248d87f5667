// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One controller in one cell: attacked by motions or by a hand, and left alone with a falling mass.
// Energy is that of the TRUE positions, in double; the slack is what rounding alone can explain.

#include "../controllers/catalogue.hpp"
#include "world.hpp"

namespace stability {

namespace ph = passive_haptics;

/// Of one run, or the worst of several.
struct outcome {
  double least_energy = 0.0;  ///< true, at the port [J], ≤ 0
  double margin = 0.0;        ///< least of energy + slack up to then [J]; < 0: not explained
  double slack = 0.0;         ///< rounding of numbers, by running error analysis [J]
  double blurred = 0.0;       ///< rounding of positions far from the origin [J]
  double exchanged = 0.0;     ///< Σ ‖f‖‖Δx‖ + b‖Δx‖²/dt [J]
  double largest_force = 0.0;
  double swing = 0.0;    ///< falling: most mechanical energy of the second half over the first
  unsigned events = 0;   ///< bit e: event e was reported
  bool finite = true;    ///< every number that came out
  bool stable = true;    ///< swing ≤ 1
  bool refused = false;  ///< check() names a fault
};

struct effort {
  int runs = 6;     ///< seeds per cell
  int ticks = 600;  ///< of a run
};

/// All runs of one cell. Hands instead of velocity sources where the guarantee asks for them.
template <class Space>
[[nodiscard]] outcome judge(const controllers::controller& c, const world& w, const effort& how);

}  // namespace stability
