// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a run has found wrong, a sentence each, and how every program ends with them.

#include <iostream>
#include <string>
#include <vector>

namespace experiments {

using failures = std::vector<std::string>;

/// Adds a sentence unless it holds.
inline void expect(failures& found, bool holds, const std::string& sentence) {
  if (!holds) found.push_back(sentence);
}

/// The last that a program says: what has failed, a line each. Its exit code.
[[nodiscard]] inline int ended(const std::string& program, const failures& found) {
  if (found.empty()) return 0;
  std::cerr << program << ": FAILED, " << found.size() << " in all:\n";
  for (const auto& sentence : found) std::cerr << "  " << sentence << '\n';
  return 1;
}

}  // namespace experiments
