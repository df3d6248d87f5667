// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The whole chain in real threads: an organ of finite elements at its own rate, exchange, a haptic loop of
// 1 kHz on a runner, a simulated device in the hand of somebody who strokes the organ, a scope, pictures.

#include "../common/quiet.hpp"
#include "../common/rows.hpp"
#include <passive_haptics/environment/stiffness_solver.hpp>

#include <string>

namespace organ {

namespace ex = experiments;

struct chain_settings {
  int side = 32;               ///< nodes along an edge of the organ's grid
  double seconds = 60.0;       ///< of touching
  double rate = 100.0;         ///< of the environment, at most [Hz]
  double longest_tick = 4e-3;  ///< of the loop, and the device's watchdog [s]
  bool by_table = true;        ///< else along the elimination path
  bool planes = false;         ///< published instead of quadrics
  int threads = 0;             ///< that compute the table
};

struct chain_row {
  std::size_t nodes = 0;
  std::string by{}, surface{};
  double seconds = 0.0;
  std::uint64_t updates = 0;
  double update = 0.0;  ///< CPU time of one, mean [ms]
  std::uint64_t ticks = 0, late = 0, lost = 0;
  double longest = 0.0;        ///< tick [ms]
  std::uint64_t beyond = 0;    ///< ticks longer than the longest that was stated
  double contact = 0.0;        ///< of the ticks after the first second, that are in contact [%]
  double largest_force = 0.0;  ///< [N]
  // Largest steps of the force from tick to tick [N]: in the first second; after it, within 10 ms of a tick
  // that was longer than stated, in which the watchdog has dropped the force; and in all other ticks.
  double touch_step = 0.0, late_step = 0.0, largest_step = 0.0;
  double least_energy = 0.0;  ///< that has flowed in at the true port [J]; the loan is 0
  double missing = 0.0;       ///< from the books of the simulated device [J]
  double haptic_cpu = 0.0;    ///< of a core [%]
  double environment_cpu = 0.0;
  ex::at_rest still{};  ///< the hand has stopped, and the organ goes on answering
};
[[nodiscard]] ex::record record_of(const chain_row& r);

/// Runs it and leaves its files and its sections in the report. Throws what the organ's parts throw;
/// stopped_by_caller if `tell` says so while something is computed, and ex::interrupted afterwards.
[[nodiscard]] chain_row run_chain(ex::report& out, const chain_settings& chosen,
                                  const passive_haptics::environment::on_progress& tell);

}  // namespace organ
