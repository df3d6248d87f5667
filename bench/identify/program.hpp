// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(), so that a test can run it.

#include "../common/median.hpp"
#include "../common/rows.hpp"
#include "disturbed.hpp"

namespace identify {

namespace ex = experiments;

struct settings {
  std::string device = "Touch";  ///< simulated: a name of sim::all_presets
  double presliding = 15e-6;     ///< of its friction [m]
  double hung = 0.0;             ///< mass to weigh by [kg]; 0: it is not weighed
  double gain = 1.0;             ///< of the simulated motors
  /// Of each pose of the weighing: where the mass pulls, and then the rows of Jᵀ where motors are behind a linkage.
  std::vector<std::vector<std::vector<double>>> poses{};
  std::string file;              ///< to write what was found; empty: none
  std::string json;              ///< to write the description; empty: none
  std::string read;              ///< a file to read instead
  std::string out = "identify";  ///< folder of the study
  int study = 0;                 ///< devices; 0: no study
  int disturbed = 0;             ///< devices with something wrong; 0: none
  int seed = 1;                  ///< of the first of them
  int threads = 0;               ///< 0: as many as the machine has
  identification::identification_parameters how{};
};

/// What the command line asks for. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: nothing was found, a file was refused, or a bound of the study holds for fewer
/// than 99 of 100 devices. 2: an argument is wrong. 130: stopped, and nothing is half written.
[[nodiscard]] int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop);

/// The seeds of so many devices of a study.
[[nodiscard]] inline std::vector<std::uint64_t> seeds_of(const settings& chosen, int devices) {
  std::vector<std::uint64_t> seeds;
  for (int i = 0; i < devices; ++i) seeds.push_back(static_cast<std::uint64_t>(chosen.seed + i));
  return seeds;
}
/// A sentence on how long the devices of a study were busy.
[[nodiscard]] std::string took(const auto& verdicts) {
  std::vector<double> times;
  for (const auto& v : verdicts) times.push_back(v.seconds);
  return ex::format("Each took %.0f s (median), ", ex::median(times)) +
         ex::format("%.0f s at most.", *std::max_element(times.begin(), times.end()));
}

/// A device of the study as a row of its table.
[[nodiscard]] ex::record record_of(const verdict& v);

[[nodiscard]] ex::record record_of(const mended_verdict& v);

/// The study, into a folder: a row for each device and a summary.
[[nodiscard]] int run_study(const settings& chosen, const std::atomic<bool>& stop);
/// The same on devices with something wrong.
[[nodiscard]] int run_disturbed(const settings& chosen, const std::atomic<bool>& stop);

}  // namespace identify
