// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Z-width: which walls K, B a controller keeps passive, and which it keeps stable, on the device of
// § 5 (0.1 kg, 0.03 N·s/m, 1 kHz), beside Colgate's line b = KT/2 + |B| and Gil and Hulin's
// K = 2(b + B)/T. The sweep can be split over machines and joined again.

#include "session.hpp"

namespace controllers {

struct z_grid {
  int stiffnesses = 0;  ///< from 10 N/m to 100 kN/m, evenly in the logarithm
  int dampings = 0;     ///< from 1 mN·s/m to 100 N·s/m
  [[nodiscard]] double stiffness(int i) const noexcept;
  [[nodiscard]] double damping(int i) const noexcept;
};
[[nodiscard]] z_grid grid_of(bool quick) noexcept;

struct z_row {
  std::string controller;
  double damping = 0.0;        ///< B [N·s/m]
  double stiffness = 0.0;      ///< K [N/m]
  double motion_energy = 0.0;  ///< least true port energy, hand: a velocity source [J]
  double hand_energy = 0.0;    ///< least true port energy, hand: 5 N at most [J]
  double growth = 0.0;         ///< last swing over first swing, released on the wall under 1 N
};

/// 0: loses to a force-limited hand, 1: only to a velocity source, 2: passive.
[[nodiscard]] int passive_for(const z_row& r) noexcept;
[[nodiscard]] bool stable(const z_row& r) noexcept;

[[nodiscard]] z_row judge_z(const controller& c, double damping, double stiffness);

/// Runs the part of the grid that the settings name. The whole grid is drawn at once, a part only
/// written, as z_width_<part>_of_<n>.csv. Judges no tag: the empty list.
[[nodiscard]] std::vector<std::string> run_z_width(const session& s);

/// Joins parts that --shard has written and draws them. Throws std::runtime_error with the name of
/// the file and the row if parts overlap, are incomplete or are not of one sweep.
void merge_z_width(const session& s, const std::vector<std::string>& files);

}  // namespace controllers
