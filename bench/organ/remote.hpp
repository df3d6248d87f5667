// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The section about a wall on another machine.

#include "../common/rows.hpp"

#include <string>
#include <vector>

namespace organ {

/// Four networks, three ways to cross them; some seconds. Adds to `found` a sentence for each figure missed.
void add_remote(experiments::report& out, std::vector<std::string>& found);

}  // namespace organ
