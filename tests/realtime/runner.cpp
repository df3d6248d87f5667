// SPDX-License-Identifier: BSD-3-Clause
// What the loop of a runner, and a scope in it, must not do.
#include "runner/virtual_time.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/runner.hpp>
#include <passive_haptics/runner/scope.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <memory>

TEST_CASE("a tick of a runner, recorded by a scope, allocates nothing", "[runner][realtime]") {
  namespace sim = ph::simulation;
  virtual_time time;
  for (int n = 0; n < 1000; ++n) time.overshoots.push_back(microseconds(n % 100 == 99 ? 2500 : 3));
  sim::device<d3> device{{.mass = 0.1, .damping = 0.3, .load = {0, 0, -1}, .start = {0, 0, 0.01}}};
  auto wall = ph::make_touch<d3>(
      {.mass = 0.1, .damping = 0.3, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5});
  REQUIRE(wall.update({.point = {0, 0, 0}, .normal = {0, 0, 1}, .stiffness = 1e3}));
  static ph::scope<d3, 256> seen{ph::event::rejected_sample};
  ph::runner touch{device,
                   [&](const auto& sample) {
                     const auto out = wall.tick(sample);
                     seen.record(sample, out);
                     return out.force;
                   },
                   virtual_pace{milliseconds(1), virtual_clock{&time}}};
  const long before = allocations();
  const bool ran = static_cast<bool>(touch.run(1000));
  const long after = allocations();
  CHECK(ran);
  CHECK(after == before);
  CHECK(seen.size() == 256);
  CHECK(seen[255].given.values[2] > 0.5);
  CHECK(touch.counts().late == 10);
  const long counted = allocations();
  const auto control = std::make_unique<int>(1);
  const bool counts = allocations() == counted + 1;
  CHECK(counts);
  CHECK(*control == 1);
}
