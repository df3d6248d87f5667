// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Table 2: every controller against every adversary, judged by the true port energy and held to its
// tag.

#include "session.hpp"
#include <passive_haptics/simulation/challenge.hpp>

namespace controllers {

namespace sim = passive_haptics::simulation;

struct attack {
  std::string name;
  sim::adversary by{};
  sim::circumstances world{};
};
[[nodiscard]] std::vector<attack> attacks();

struct attack_row {
  std::string controller;
  ph::guarantee tag{};
  std::string attack;
  int dof = 0, runs = 0;
  bool covered = false;        ///< the guarantee has to hold here
  double least_energy = 0.0;   ///< true, at the port [J]
  double largest_force = 0.0;  ///< commanded [N]
  std::uint64_t worst_seed = 0;
};

/// Does the tag of c promise anything against this attack?
[[nodiscard]] bool covers(const controller& c, const attack& a) noexcept;

/// One cell of the table, in one dimension; the controller is told the truth about the attack.
[[nodiscard]] attack_row judge_under_attack(const controller& c, const attack& a, int dof,
                                            int runs);

/// What contradicts the tags, a sentence each; empty if all is well. A covered cell must lose less
/// than 1e-12 J and must have pushed; `conditional` and `none` must be seen losing somewhere else.
[[nodiscard]] std::vector<std::string> contradictions(const std::vector<attack_row>& rows);

/// Returns the contradictions.
[[nodiscard]] std::vector<std::string> run_adversaries(const session& s);

}  // namespace controllers
