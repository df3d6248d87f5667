// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Every controller of the catalogue, float and double, in one and three dimensions, in every cell.

#include "session.hpp"
#include "trial.hpp"

namespace stability {

enum class verdict : std::uint8_t {
  holds,      ///< claimed, attacked, and nothing lost that rounding does not explain
  refused,    ///< check() names the parameter; force zero and an event at every tick
  told,       ///< outside what the tag covers, and an event said so
  outside,    ///< outside what the tag covers: `why`
  no_claim,   ///< the tag is none
  lost,       ///< claimed and lost: the program fails
  no_number,  ///< NaN or infinity came out: the program fails
  silent,     ///< refused or late, and no event: the program fails
};
[[nodiscard]] const char* to_string(verdict v) noexcept;

struct row {
  std::string controller;
  ph::guarantee tag{};
  const char* scalar = "";
  int dof = 0;
  world where;
  outcome found;
  verdict says{};
  std::string why;  ///< of outside
};

/// Why the tag does not cover the cell; empty if it does.
[[nodiscard]] std::string why_outside(const controllers::controller& c, const world& w,
                                      const outcome& found);
[[nodiscard]] row judged(const controllers::controller& c, const char* scalar, int dof,
                         const world& w, const outcome& found);

/// Returns a sentence for everything that fails the program.
[[nodiscard]] std::vector<std::string> run_sweep(const session& s);

}  // namespace stability
