// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tank that counts the worst outflow allows what strict_bound does, bit for bit.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/published/energy_tank.hpp>

template <class Space>
void check_tank_is_strict() {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  ph::laws::samples random(11);
  const auto tank = at<Space>(ph::energy_tank{});
  const auto kept = at<Space>(ph::energy_tank{.reserve = 0.01});
  const auto strict = at<Space>(ph::strict_bound{});
  int bound = 0, different = 0;
  for (int i = 0; i < 1000; ++i) {
    const vector normal = random.direction<Space>();
    situation<Space> now{.energy = random.number<scalar>() * scalar(0.1),
                         .held = random.vector<Space>(),
                         .travel = random.vector<Space>() * scalar(1e-3)};
    const vector desired = normal * (scalar(5) * random.number<scalar>());
    const vector allows = allowed(tank, desired, now);
    bool same = allows == allowed(strict, desired, now);
    const vector less = allowed(kept, desired, now);
    now.energy -= scalar(0.01);
    same = same && less == allowed(strict, desired, now);
    different += same ? 0 : 1;
    bound += allows == desired ? 0 : 1;
  }
  CHECK(different == 0);
  CHECK((bound > 100 && bound < 900));
}
