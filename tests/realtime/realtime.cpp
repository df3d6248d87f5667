// SPDX-License-Identifier: BSD-3-Clause
// What a tick must not do. Its own program, because it counts every call of operator new.
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <array>
#include <memory>
#include <span>

TEST_CASE("a tick allocates nothing", "[local_model][realtime]") {
  ph::local_model model{d3{},
                        ph::followed<ph::half_space<d3>>{},
                        ph::turn_limited{.rate = 4.0},
                        ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 50}},
                        thesis_ledger(),
                        ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5},
                                        ph::actuator_limit{.most = 9}},
                        thesis_loop};
  const long before = allocations();
  for (int n = 0; n < 1000; ++n) {
    if (n % 30 == 0) {
      model.update({{0, 0, 1e-6 * n}, d3::vector(0.0003 * n, 0.1, 1), 900.0 + n});
    }
    (void)model.tick({0, 0, n % 97 == 0 ? std::nan("") : -1e-6 * n}, 1ms);
    if (n % 100 == 50) (void)model.set(ph::actuator_limit{.most = 0.01 * n});
    if (n % 300 == 299) model.release();
    if (n % 500 == 499) model.reset();
  }
  CHECK(allocations() == before);
  // the control: the counter counts
  const auto control = std::make_unique<int>(5);
  CHECK(allocations() == before + 1);
  CHECK(*control == 5);
}

TEST_CASE("surfaces find their slots without an allocation", "[manifold][realtime]") {
  using plane = ph::half_space<d3>;
  ph::passive_port port{
      d3{}, ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<plane, 4>{}},
      thesis_ledger(), ph::reachable_bound{.mass = 0.1, .hand_force = 5}, thesis_loop};
  ph::contact_manifold<plane, 4> seen;
  std::array<plane, 9> surfaces{};  // the last has no normal
  for (std::size_t i = 0; i < 8; ++i)
    surfaces[i] = {{0, 0, 1e-3}, {0.1 * static_cast<double>(i), 1, 2}, 800};
  const long before = allocations();
  for (std::size_t n = 0; n < 1000; ++n) {
    const d3::vector x(0, 0, n % 97 == 0 ? std::nan("") : 1e-3);
    (void)seen.show(port.source(), std::span(surfaces).subspan(n % 9), x);
    (void)port.tick(x, 1ms);
  }
  CHECK(allocations() == before);
}
