// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The failures of a run, a sentence for each, and the end of a program that has them.

#include <iostream>
#include <string>
#include <vector>

namespace experiments {

using failures = std::vector<std::string>;

/// Adds `sentence` unless `holds`.
inline void expect(failures& found, bool holds, const std::string& sentence) {
  if (!holds) found.push_back(sentence);
}

/// Prints the failures of a program, a line for each; returns its exit code.
[[nodiscard]] inline int ended(const std::string& program, const failures& found) {
  if (found.empty()) return 0;
  std::cerr << program << ": FAILED, " << found.size() << " in all:\n";
  for (const auto& sentence : found) std::cerr << "  " << sentence << '\n';
  return 1;
}

}  // namespace experiments
