// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the parts of a run share.

#include "../common/progress.hpp"
#include "../common/report.hpp"
#include "../controllers/catalogue.hpp"

namespace stability {

namespace ex = experiments;
namespace ph = passive_haptics;

struct settings {
  std::string out = "stability";
  bool quick = false;
  long long soak = 0;  ///< ticks; 0: 10⁷, quick 10⁶
  int threads = 0;     ///< 0: as many as the machine has
};

struct session {
  ex::report& out;
  const settings& chosen;
  const std::vector<controllers::controller>& judged;
};

}  // namespace stability
