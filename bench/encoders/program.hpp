// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(), so that a test can run it; and what its sections share.

#include "../common/rows.hpp"
#include "../common/sections.hpp"
#include "compositions.hpp"

namespace encoders {

namespace ex = experiments;

using settings = ex::section_settings;

struct session : ex::workshop {
  const settings& chosen;
  const std::vector<composition>& judged;
};

[[nodiscard]] const std::vector<ex::section<session>>& sections();
[[nodiscard]] std::vector<std::string> run_gentle_touch(const session& s);
[[nodiscard]] std::vector<std::string> run_endurance(const session& s);
[[nodiscard]] std::vector<std::string> run_tremor(const session& s);
[[nodiscard]] std::vector<std::string> run_nearest(const session& s);
[[nodiscard]] std::vector<std::string> run_guarantee(const session& s);

/// What the command line asks for. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: a promise was broken, or something could not be written. 2: an argument is
/// wrong. 130: stopped; what is on disk has been said.
[[nodiscard]] int run(const std::vector<std::string>& arguments,
                      const std::vector<composition>& judged, const std::atomic<bool>& stop);

}  // namespace encoders
