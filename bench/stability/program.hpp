// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(), so that a test can run it; and what its parts share.

#include "../common/rows.hpp"
#include "../common/sections.hpp"
#include "../controllers/catalogue.hpp"

namespace stability {

namespace ex = experiments;
namespace ph = passive_haptics;

struct settings : ex::section_settings {
  int soak = 0;  ///< ticks; 0: 10⁷, quick 10⁶
};

struct session : ex::workshop {
  const settings& chosen;
  const std::vector<controllers::controller>& judged;
};

/// What the command line asks for. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// Every section that is chosen, into `out`. Returns a sentence for each guarantee that was lost, each
/// number that came out and is none.
[[nodiscard]] ex::failures try_all(ex::report& out, const settings& chosen,
                                   const std::vector<controllers::controller>& judged);

/// 0: all is well. 1: a guarantee was lost or a number that is none came out, or something could
/// not be written. 2: an argument is wrong.
[[nodiscard]] int run(const std::vector<std::string>& arguments,
                      const std::vector<controllers::controller>& judged);

}  // namespace stability
