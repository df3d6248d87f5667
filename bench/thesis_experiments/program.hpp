// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(), so that a test can run it.

#include <string>
#include <vector>

namespace experiments {

/// 0: all is well. 1: a mesh cannot be used, or something could not be written. 2: an argument is wrong.
[[nodiscard]] int run_thesis_experiments(const std::vector<std::string>& arguments);

}  // namespace experiments
