// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(): so that a test can run it, and stop it.

#include "session.hpp"

namespace controllers {

/// A part of the run. It writes its rows as they are finished, adds itself to the report, and
/// returns a sentence for everything that contradicts a tag.
struct section {
  const char* name;
  std::vector<std::string> (*run)(const session&);
};
[[nodiscard]] const std::vector<section>& sections();

/// What the command line asks for. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: a cell contradicts a tag, or something could not be written or read.
/// 2: an argument is wrong. 130: stopped; what is on disk has been said.
[[nodiscard]] int run(const std::vector<std::string>& arguments,
                      const std::vector<controller>& judged, const std::atomic<bool>& stop);

}  // namespace controllers
