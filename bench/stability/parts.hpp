// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts of the program. run_...() returns a sentence for everything that fails it.

#include "program.hpp"
#include "trial.hpp"

namespace stability {

// ------------------------------------------------------------------------------------------ sweep
// Every controller of the catalogue, float and double, in one and three dimensions, in every cell.

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
  world where{};
  outcome found{};
  verdict says{};
  std::string why{};  ///< of outside
};

/// Why the tag does not cover the cell; empty if it does.
[[nodiscard]] std::string why_outside(const controllers::controller& c, const world& w,
                                      const outcome& found);
[[nodiscard]] row judged(const controllers::controller& c, const char* scalar, int dof,
                         const world& w, const outcome& found);

[[nodiscard]] std::vector<std::string> run_sweep(const session& s);

// ----------------------------------------------------------------------------------------- shapes
// Triangles that are next to none, and normals that are next to equal or next to opposite.

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

[[nodiscard]] std::vector<std::string> run_shapes(const session& s);

// ---------------------------------------------------------------------------------------- numbers
// Numbers at the ends of their range, in any order: subnormal, near overflow, infinite, none at all;
// as positions, forces held, tick lengths, surfaces and parameters.

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

[[nodiscard]] std::vector<std::string> run_numbers(const session& s);

// ------------------------------------------------------------------------------------------- soak
// A long run in virtual time: how far the ledger drifts from the true energy, plain and compensated.

struct soak_row {
  std::string ledger;  ///< "float", "float, compensated", ...
  const char* motion = "";
  int ticks = 0;
  double drift = 0.0;         ///< E1 − true energy [J]; > 0: the ledger promises too much
  double overstated = 0.0;    ///< most of that so far [J]
  double least_energy = 0.0;  ///< true [J]
  double bank = 0.0;          ///< E1 [J]
  double unit = 0.0;          ///< ε/2 of the scalar: what showing a compensated sum rounds by
};

/// strict_bound in one dimension; a row at each power of ten of the ticks and at the end.
[[nodiscard]] std::vector<soak_row> soak(int ticks, int threads);

[[nodiscard]] std::vector<std::string> run_soak(const session& s);

}  // namespace stability
