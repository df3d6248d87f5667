// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(), so that a test can run it.

#include "../common/rows.hpp"
#include <passive_haptics/identification/recording_file.hpp>
#include <passive_haptics/identification/trust.hpp>

namespace replaying {

namespace ex = experiments;
namespace identification = passive_haptics::identification;

struct settings {
  std::string read;  ///< the recording; empty: one that the simulator makes
  identification::recording_columns columns{};
  std::string told;  ///< a description of a device, as save_device() writes it; empty: none
  std::string out = "replay";
  identification::trust trust{};
};

/// What the command line asks for. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: nothing is refuted. 1: the recording was refused or bears no numbers, or what was told is refuted. 2: an argument
/// is wrong. 130: stopped. A recording that is not there is skipped, with a word, and 0.
[[nodiscard]] int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop);

}  // namespace replaying
