// SPDX-License-Identifier: BSD-3-Clause
// The Falcon's device and a clock that is not steady: never more force, never a tick of no length.
#include "falcon/bench.hpp"

#include <algorithm>
#include <memory>
#include <optional>

namespace {

using falcon::nanoseconds;

// A clock that may be off, or stopped; the far side lives in the true time.
class unsteady_transport : public falcon::in_memory_transport<scripted_falcon> {
  using steady = falcon::in_memory_transport<scripted_falcon>;

 public:
  falcon::transfer read(std::span<falcon::byte> into, nanoseconds deadline) noexcept {
    auto got = steady::read(into, steady::now() + (deadline - now()));
    got.stamp = now();
    return got;
  }
  [[nodiscard]] nanoseconds now() const noexcept {
    return stopped_at ? *stopped_at : steady::now() + off;
  }

  nanoseconds off{0};
  std::optional<nanoseconds> stopped_at;
};

using unsteady = falcon::device<unsteady_transport>;

std::unique_ptr<unsteady> homed() {
  auto device = std::make_unique<unsteady>(k);
  device->line().peer().now = scripted_falcon::mode::running;
  device->line().peer().homed = 7;
  REQUIRE(device->open());
  REQUIRE(device->start());
  for (int n = 0; n < 700; ++n) (void)device->exchange(push);
  REQUIRE(device->latest().strength == 1.0);
  return device;
}

// The force [N] of the words that went out last.
double force_at_the_grip(const unsteady& device) {
  const auto& now = device.latest();
  const auto angles = falcon::inverse(now.position);
  REQUIRE(angles);
  return falcon::norm(falcon::force_from(falcon::rates(now.position, angles.value),
                                         falcon::decode(now.sent.motor, device.gain())));
}

}  // namespace

TEST_CASE("a clock that steps back never makes more force than the limit", "[falcon][device]") {
  for (const auto back :
       {nanoseconds(0), nanoseconds(10'000), nanoseconds(3'000'000), nanoseconds(7'000'000'000)}) {
    INFO("back by " << back.count() << " ns");
    const auto device = homed();
    const d3::vector much(1e3, 0.0, 0.0);
    double most = 0.0, least_strength = 1.0;
    int seen = 0, negative = 0;
    for (int n = 0; n < 3000; ++n) {
      if (n % 100 == 50) device->line().off -= back;
      const auto sample = device->exchange(much);
      if (sample.valid) ++seen;
      if (sample.valid && !(sample.dt > 0.0)) ++negative;
      most = std::max(most, force_at_the_grip(*device));
      least_strength = std::min(least_strength, device->latest().strength);
    }
    CHECK(most <= device->setup().force_limit * (1 + 1e-3));  // and half a word
    CHECK(least_strength >= 0.0);
    CHECK(negative == 0);
    CHECK(seen >= 2900);
    if (back == nanoseconds(0)) {
      CHECK(seen == 3000);  // the control: a steady clock loses nothing,
      CHECK(most > 7.9);    // and the limit is reached
    }
  }
}

TEST_CASE("a clock that steps back costs one sample and the ramp", "[falcon][device]") {
  const auto device = homed();
  scripted_falcon& box = device->line().peer();
  CHECK(device->exchange(push).valid);
  CHECK(box.last.motor != nothing);
  device->line().off -= std::chrono::seconds(10);
  CHECK_FALSE(device->exchange(push).valid);
  CHECK(device->latest().what == code::clock_backwards);
  CHECK(device->where() == state::homed);
  CHECK(box.last.motor == nothing);  // at once, in the same call
  CHECK(device->exchange(push).valid);
  CHECK(device->latest().what == code::ok);
  for (int n = 0; n < 700; ++n) CHECK(device->exchange(push).valid);
  CHECK(device->latest().strength == 1.0);
  CHECK(box.last.motor != nothing);
}

TEST_CASE("a clock that stands still gives no sample, however good the reply", "[falcon][device]") {
  const auto device = homed();
  auto& line = device->line();
  for (int n = 0; n < 10; ++n) CHECK(device->exchange(push).valid);  // the control
  line.stopped_at = device->latest().asked;
  for (int n = 0; n < 10; ++n) CHECK_FALSE(device->exchange(push).valid);
  CHECK(device->latest().what == code::clock_backwards);
  CHECK(device->where() == state::homed);
  CHECK(line.peer().last.motor == nothing);
  line.stopped_at.reset();
  for (int n = 0; n < 700; ++n) (void)device->exchange(push);
  CHECK(device->latest().what == code::ok);
  CHECK(line.peer().last.motor != nothing);
}
