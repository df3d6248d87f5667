// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program without main(), so that a test can run it; and the declarations that its sections share.

#include "../common/rows.hpp"
#include "../common/sections.hpp"
#include "scenes.hpp"

#include <atomic>
#include <string>
#include <vector>

namespace contacts {

namespace ex = experiments;
using ex::expect;

struct settings : ex::section_settings {
  int seed = 1;  ///< of what is drawn at random
};

struct session : ex::workshop {
  const settings& chosen;
};

[[nodiscard]] const std::vector<ex::section<session>>& sections();
[[nodiscard]] std::vector<std::string> run_quiet(const session& s);
[[nodiscard]] std::vector<std::string> run_quiet_tool(const session& s);
[[nodiscard]] std::vector<std::string> run_settling(const session& s);
[[nodiscard]] std::vector<std::string> run_stroke(const session& s);
[[nodiscard]] std::vector<std::string> run_frames(const session& s);
[[nodiscard]] std::vector<std::string> run_touch(const session& s);
[[nodiscard]] std::vector<std::string> run_news(const session& s);
[[nodiscard]] std::vector<std::string> run_curved(const session& s);
[[nodiscard]] std::vector<std::string> run_friction(const session& s);
[[nodiscard]] std::vector<std::string> run_static(const session& s);
[[nodiscard]] std::vector<std::string> run_passive(const session& s);
[[nodiscard]] std::vector<std::string> run_rigid(const session& s);
[[nodiscard]] std::vector<std::string> run_tool(const session& s);
[[nodiscard]] std::vector<std::string> run_guards(const session& s);
[[nodiscard]] std::vector<std::string> run_steep(const session& s);
[[nodiscard]] std::vector<std::string> run_meshes(const session& s);

/// The settings of a command line. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: a promise was broken, or something could not be written. 2: an argument is
/// wrong. 130: stopped; what is on disk has been said.
[[nodiscard]] int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop);

}  // namespace contacts
