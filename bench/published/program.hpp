// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(), so that a test can run it; and what its sections share. A section is a paper or a
// few: it adds its tables to the report, its lines to the table of all of them, and returns a sentence for each
// promise that was broken, each limit that is not where a paper has it, and each control that agrees.

#include "../common/rows.hpp"
#include "../common/sections.hpp"
#include "trial.hpp"

namespace papers {

using settings = ex::section_settings;

/// A line of the table of all papers.
struct figure {
  std::string source{}, says{}, bare{}, ours{}, quiet{}, joules{}, verdict{};
};

struct session : ex::workshop {
  const settings& chosen;
  std::vector<figure>& figures;
};

/// All contenders on one model, the table added to the report; `found` gets each promise that was broken. A bare spring
/// that loses nothing at `asked` is no control, and is named where `must_lose`.
[[nodiscard]] std::vector<outcome> all_on(const session& s, const std::string& source,
                                          const std::string& model, const facts& f, double asked,
                                          const press& by, ex::failures& found,
                                          bool must_lose = true);

/// The stiffest of ours that lost nothing and came to rest; of the bare spring, the first.
[[nodiscard]] const outcome& best_of(const std::vector<outcome>& rows);

/// What keeps ours from being stiffer on these facts: the budget of friction, in words.
[[nodiscard]] std::string what_binds(const facts& f);

/// A line for the table, from the outcomes on a model.
[[nodiscard]] figure figure_of(const std::string& source, const std::string& says,
                               const std::vector<outcome>& rows, const std::string& verdict);

// ----------------------------------------------------------------------------------- a limit, measured

/// A limit of design.hpp for the bare spring on one model, and where the spring really begins to lose.
struct limit {
  std::string source{};
  facts on{};
  double says = 0.0, measured = 0.0;  ///< [N/m]
  bool is_control = false;            ///< a limit that no paper has: it must not agree
  double tolerance = 0.02;            ///< of the ratio

  [[nodiscard]] double ratio() const noexcept { return measured / says; }
  [[nodiscard]] bool agrees() const noexcept { return std::abs(ratio() - 1.0) <= tolerance; }
};
[[nodiscard]] ex::record record_of(const limit& l);
/// Without what is measured.
[[nodiscard]] std::vector<limit> limits();
/// The largest stiffness [N/m] of which no periodic motion draws energy: a sine of any of ten periods, and on encoders
/// a motion across one edge that is a thousandth of a step wide.
[[nodiscard]] double largest_passive(const facts& f);
/// The largest stiffness [N/m] of a spring, damped by B, that a free device comes to rest on.
[[nodiscard]] double largest_stable(const facts& f);

/// Walls at one update rate: stiffness [N/m], quiet [s], energy [J].
struct rate_row {
  double rate = 0.0, damping = 0.0;  ///< [Hz], [N·s/m]
  double paper = std::nan("");
  double bare_quiet = 0.0, touch = 0.0, touch_quiet = 0.0, strict = 0.0, strict_quiet = 0.0;
  double bare_energy = 0.0, ours_energy = 0.0;
};
[[nodiscard]] ex::record record_of(const rate_row& r);
/// The largest stable stiffness of a device whose transmission gives, and walls on it.
struct mode_row {
  double mode = 0.0, damping = 0.0;  ///< [Hz], [N·s/m]
  double stiff = 0.0, giving = 0.0;  ///< of a rigid device and of this one [N/m]
  double untold = 0.0;               ///< energy of make_touch that takes it for rigid [J]
  double told = 0.0, shown = 0.0, quiet = 0.0;  ///< of one that knows the chain [J], [N/m], [s]
};
[[nodiscard]] ex::record record_of(const mode_row& r);

[[nodiscard]] const std::vector<ex::section<session>>& sections();
[[nodiscard]] ex::failures run_limits(const session& s);
[[nodiscard]] ex::failures run_rates(const session& s);
[[nodiscard]] ex::failures run_bounces(const session& s);
[[nodiscard]] ex::failures run_stiff(const session& s);
[[nodiscard]] ex::failures run_modes(const session& s);
[[nodiscard]] ex::failures run_thesis(const session& s);

/// What the command line asks for. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: a promise was broken, a caption is not so, or something could not be written. 2: an argument
/// is wrong. 130: stopped.
[[nodiscard]] int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop);

}  // namespace papers
