// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tables of the program, a section each. run_...() returns a sentence for everything that
// contradicts a tag or fails.

#include "../common/draws.hpp"
#include "../common/wall.hpp"
#include "program.hpp"
#include <passive_haptics/simulation/challenge.hpp>

namespace controllers {

namespace sim = passive_haptics::simulation;

// ------------------------------------------------------------------------------------------- wall
// Every controller on the wall of docs/design/mathematics.md § 5.

struct wall_row {
  std::string controller;
  ph::guarantee tag{};
  std::string scene;
  int runs = 0;
  int settled = 0;
  bool covered = false;             ///< the guarantee has to hold here
  ex::wall_result mean{};           ///< settle: the worst; port_energy: the least; the rest: means
  ex::wall_result least{}, most{};  ///< of the runs, in peak_to_peak and force_error
  double displayed = 0.0;           ///< static stiffness [N/m]
  ex::at_rest still{};              ///< of all runs
};

[[nodiscard]] std::vector<ex::wall_scene> wall_scenes();

/// The premises of a controller in a scene.
[[nodiscard]] premises known_of(const ex::wall_scene& scene);

/// One controller in one scene; S1 and S5 are random and run once per seed.
[[nodiscard]] wall_row judge_on_wall(const controller& c, const ex::wall_scene& scene,
                                     const effort& seeds);

/// The stiffness [N/m] that a slow hand feels: pressed from the surface of a wall of 10 kN/m at
/// 1 mm/s by a velocity source, with an empty ledger, the force over the depth when it reaches 1 N,
/// or at 20 mm if it never does. L4: at most 2b/T for what is strict.
[[nodiscard]] double displayed_stiffness(const controller& c);

/// Figures of § 5: peak to peak [mm] and mean force error [N].
struct published {
  std::string controller, scene;
  double peak_to_peak_mm;
  double force_error;
  std::string reason = "";  ///< why the row differs, where it does
};
[[nodiscard]] const std::vector<published>& section_5();

/// "yes" if both figures are within 10 % of the published ones, or both less than 0.1 mm or 0.1 N;
/// "within the seeds" if a figure that is not lies between the least and the most of the seeds, and
/// otherwise the reason, or "NO".
[[nodiscard]] std::string agreement(const wall_row& row, const published& p);

[[nodiscard]] std::vector<std::string> run_wall(const session& s);

// ------------------------------------------------------------------------------------ adversaries
// Every controller against every adversary, judged by the true port energy and held to its tag.

struct attack {
  std::string name;
  sim::adversary by{};
  sim::circumstances world{};
};
[[nodiscard]] std::vector<attack> attacks(int seed = 1);

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

/// True if the tag of c promises anything against this attack.
[[nodiscard]] bool covers(const controller& c, const attack& a) noexcept;

/// One cell of the table, in one dimension; the controller is told the truth about the attack.
[[nodiscard]] attack_row judge_under_attack(const controller& c, const attack& a, int dof,
                                            const effort& how);

/// A sentence for each contradiction of a tag; empty if all is well. A covered cell must lose less than 1e-12 J
/// and must have pushed; a `conditional` or `none` one must lose somewhere else.
[[nodiscard]] std::vector<std::string> contradictions(const std::vector<attack_row>& rows);

[[nodiscard]] std::vector<std::string> run_adversaries(const session& s);

// ------------------------------------------------------------------------------------ assumptions
// Every assumption that a named composition states, kept and violated.

struct assumption_row {
  std::string composition{}, assumption{}, stated{}, in_truth{};
  std::string by{};       ///< the hand that created most
  int runs = 0;           ///< of each hand
  double kept = 0.0;      ///< most that was created while all that is stated is true [J]
  double violated = 0.0;  ///< most that was created while this is not [J]
  bool unpaid = false;    ///< nothing is, as its type says
};

/// A sentence for each failure: energy that is created while an assumption is kept, and an assumption whose
/// violation creates none, unless it is said that it creates none, or some although that is said.
[[nodiscard]] std::vector<std::string> unfounded(const std::vector<assumption_row>& rows);

[[nodiscard]] std::vector<std::string> run_assumptions(const session& s);

// -------------------------------------------------------------------------------------- stiffness
// The closed loop with a hand on walls of 0.5 to 16 kN/m, as measured on other libraries.
//
// Device 0.1 kg, 0.1 N·s/m; hand 30 N/m and 0.5 N·s/m, asked every 20 µs, released 20 mm in front
// of the wall with its target 15 mm behind the surface; 6 s at 1 kHz, exact positions. The start is
// not published; this one reproduces the published row without a bound.

struct stiffness_row {
  std::string controller;
  ph::guarantee tag{};
  double stiffness = 0.0;    ///< of the wall [N/m]
  bool covered = false;      ///< the guarantee has to hold here
  double out_of_port = 0.0;  ///< most that wall and device together ever gave the hand [J]
  double out_of_wall = 0.0;  ///< Σ f·Δx at the end: what the device's damper took is in it [J]
  double rms_speed = 0.0;    ///< over the last 2 s [m/s]
  double quiet = 0.0;        ///< from then on (simulation/quiet.hpp) [s]; NaN: not in time
  sim::quiet_bar missed{};   ///< by the last window that was not
  ex::at_rest still{};       ///< the same in columns
};

[[nodiscard]] stiffness_row judge_on_stiffness(const controller& c, double stiffness, int seed = 1);

[[nodiscard]] std::vector<std::string> run_stiffness(const session& s);

// --------------------------------------------------------------------------------------- settling
// Passive AND settled, on encoders with steps (docs/design/mathematics.md § 9,
// docs/design/settling.md).
//
// The fall of § 5 onto a static wall, and onto one that gives way and answers one update late; four
// masses, six stiffnesses: 48 cases for each encoder step, dry friction and saturation. Settled: the
// last 2 s calmer than 0.5 mm, before 3 s.

[[nodiscard]] std::vector<std::string> run_settling(const session& s);

// ---------------------------------------------------------------------------------------- Z-width
// Which walls K, B a controller keeps passive, and which it keeps stable, on the device of § 5
// (0.1 kg, 0.03 N·s/m, 1 kHz), beside Colgate's line b = KT/2 + |B| and Gil and Hulin's
// K = 2(b + B)/T. The sweep can be split over machines and joined again.

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
[[nodiscard]] ex::record record_of(const z_row& r);

/// 0: loses to a force-limited hand, 1: only to a velocity source, 2: passive.
[[nodiscard]] int passive_for(const z_row& r) noexcept;
[[nodiscard]] bool stable(const z_row& r) noexcept;

struct z_cell {
  const controller* c = nullptr;
  double damping = 0.0, stiffness = 0.0;
};
/// The whole sweep in its order: controllers that render a damped wall, then B, then K.
[[nodiscard]] std::vector<z_cell> z_cells(const std::vector<controller>& judged,
                                          const z_grid& grid);
[[nodiscard]] z_row judge_z(const z_cell& cell, std::uint64_t seed = 1);

/// The name of its plot, without .svg.
[[nodiscard]] std::string z_plot_name(std::string controller);
/// Tables and plots of a complete sweep.
void show_z_width(const session& s, const std::vector<z_row>& rows);

/// Runs the part of the grid that the settings name. The whole grid is drawn at once, a part only
/// written, as z_width_<part>_of_<n>.csv.
[[nodiscard]] std::vector<std::string> run_z_width(const session& s);

/// Joins parts that --shard has written and draws them. Throws std::runtime_error with the name of
/// the file and the row if parts overlap, are incomplete or are not of one sweep.
void merge_z_width(const session& s, const std::vector<std::string>& files);

}  // namespace controllers
