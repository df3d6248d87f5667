// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Table 4: passive AND settled, on encoders with steps (docs/design/mathematics.md § 9,
// docs/design/settling.md).
//
// The fall of § 5 onto a static wall, and onto one that gives way and answers one update late; four
// masses, six stiffnesses: 48 cases for each encoder step, dry friction and saturation. Settled: the
// last 2 s calmer than 0.5 mm, before 3 s.

#include "../common/wall.hpp"
#include "session.hpp"

namespace controllers {

/// A composition and what of it is new against the line before.
struct settling_way {
  std::string name;
  bool knows_saturation = false;
  bool observes_motion = false;
  bool counts_surely = false;
};

/// The baseline first, the recommended one last.
[[nodiscard]] std::vector<settling_way> settling_ways();

/// The device of a row; 48 cases each.
struct settling_device {
  double quantum = 0.0;   ///< [m]
  double friction = 0.0;  ///< [N]
  double force_limit = sim_infinity;

  static constexpr double sim_infinity = std::numeric_limits<double>::infinity();
};
[[nodiscard]] std::vector<settling_device> settling_devices();

struct settling_case {
  double mass = 0.1;       ///< [kg]
  double stiffness = 1e4;  ///< [N/m]
  bool yields = false;     ///< and answers one update late
};
[[nodiscard]] std::vector<settling_case> settling_cases();

struct settling_result {
  double swing = 0.0;                     ///< of the last 2 s [m]
  double settle = 0.0;                    ///< [s]; NaN: never
  double port_energy = 0.0;               ///< least, true [J]
  double ledger = 0.0;                    ///< at the end [J]
  double stiffness_error = std::nan("");  ///< of the displayed static stiffness; NaN: not measured
  [[nodiscard]] bool settled() const noexcept { return swing < 0.5e-3 && settle < 3.0; }
};

[[nodiscard]] settling_result judge_settling(const settling_way& way, const settling_device& device,
                                             const settling_case& c);

/// Returns what the recommended composition failed to do.
[[nodiscard]] std::vector<std::string> run_settling(const session& s);

}  // namespace controllers
