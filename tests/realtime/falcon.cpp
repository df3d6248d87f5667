// SPDX-License-Identifier: BSD-3-Clause
// Between open() and close() the Falcon's driver allocates nothing.
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/falcon_loop.hpp"
#include "support/scripted_falcon.hpp"

#include <memory>

TEST_CASE("the Falcon's driver allocates nothing after open()", "[falcon][realtime]") {
  const auto image = synthetic_image();
  falcon_device<sim::no_hand<d3>> device{3500.0, {}, mock_parameters{.homed = true}};
  auto model =
      following_half_space<d3>(ph::damped_spring{.mass = 0.1},
                               ph::quantised_energy{.damping = 0.03, .quantum = 1e-4, .loan = 1e-3},
                               ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                               ph::late_loop_limits<1>{.longest_tick = 1e-3, .top_speed = 100.0});
  model.update({d3::vector(0, 0, 0.13), d3::vector(0, 0, 1), 1e3});
  bool fine = static_cast<bool>(device.open());
  const long before = allocations();
  fine = fine && falcon::boot(device, image).how && device.home(std::chrono::seconds(2));
  d3::vector force = d3::zero();
  double most = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const auto sample = device.exchange(force);
    force = model.tick(sample).force;
    fine = fine && sample.valid;
    most = std::max(most, force.norm());
  }
  device.line().peer().unplug();
  (void)device.exchange(force);
  (void)device.close();
  const long after = allocations();
  CHECK(after == before);
  CHECK(fine);
  CHECK(most > 0.1);
  const long counted = allocations();
  const auto control = std::make_unique<int>(1);
  const bool counts = allocations() == counted + 1;
  CHECK(counts);
  CHECK(*control == 1);
}
