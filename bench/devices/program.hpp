// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(), so that a test can run it; and what its sections share. A section is a file: it
// adds its tables to the report and returns a sentence for each promise that was broken, and for each control that
// should have lost and did not.

#include "../common/quiet.hpp"
#include "../common/rows.hpp"
#include "../common/sections.hpp"
#include <passive_haptics/passive_haptics.hpp>

namespace devices {

namespace ex = experiments;
namespace ph = passive_haptics;

using settings = ex::section_settings;

struct session : ex::workshop {
  const settings& chosen;
};

[[nodiscard]] const std::vector<ex::section<session>>& sections();
[[nodiscard]] ex::failures run_compliance(const session& s);
[[nodiscard]] ex::failures run_chains(const session& s);
[[nodiscard]] ex::failures run_late(const session& s);

/// What the command line asks for. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: a promise was broken, or something could not be written. 2: an argument is
/// wrong. 130: stopped; what is on disk has been said.
[[nodiscard]] int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop);

}  // namespace devices
