// SPDX-License-Identifier: BSD-3-Clause
// What a tick must not do. Its own program, because it counts every call of operator new.
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <memory>

TEST_CASE("a tick allocates nothing", "[local_model][realtime]") {
  ph::local_model model{d3{},
                        ph::following<ph::half_space<d3>>{},
                        ph::rotate_limited<d3>{.rate = 4.0},
                        ph::spring<d3>{},
                        thesis_ledger<d3>(),
                        ph::bound_chain{ph::force_rate_limit<d3>{.rate = 50},
                                        ph::reachable_bound<d3>{.mass = 0.1, .hand_force = 5},
                                        ph::actuator_limit<d3>{.most = 9}}};
  const long before = allocations();
  for (int n = 0; n < 1000; ++n) {
    if (n % 30 == 0) {
      model.retarget({{0, 0, 1e-6 * n}, d3::vector(0.0003 * n, 0.1, 1), 900.0 + n});
    }
    (void)model.tick({0, 0, n % 97 == 0 ? std::nan("") : -1e-6 * n}, 1e-3);
  }
  CHECK(allocations() == before);
  // the control: the counter counts
  const auto control = std::make_unique<int>(5);
  CHECK(allocations() == before + 1);
  CHECK(*control == 5);
}
