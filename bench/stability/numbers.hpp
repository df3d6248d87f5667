// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers at the ends of their range, in any order: subnormal, near overflow, infinite, none at all;
// as positions, forces held, tick lengths, surfaces and parameters.

#include "session.hpp"

namespace stability {

struct numbers_row {
  std::string controller;
  const char* scalar = "";
  int dof = 0;
  long ticks = 0, refused = 0, limited = 0, pushed = 0;
  long not_finite = 0;  ///< ticks from which NaN or infinity came: must be 0
  long silent = 0;      ///< bad samples without event or with a force: must be 0
  std::string first{};  ///< of those, what went in
};

/// `ticks` ticks of every controller in every Space; repeatable.
[[nodiscard]] std::vector<numbers_row> try_numbers(const std::vector<controllers::controller>& all,
                                                   long ticks);

/// Returns a sentence for everything that fails the program.
[[nodiscard]] std::vector<std::string> run_numbers(const session& s);

}  // namespace stability
