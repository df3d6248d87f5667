// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/falcon/device.hpp>
#include <passive_haptics/falcon/runner.hpp>

using falcon::code;
using falcon::state;

namespace {

using grip = falcon::device<falcon::in_memory_transport<scripted_falcon>>;
constexpr double k = falcon::cautious_gain<double>;
constexpr auto quick = std::chrono::microseconds(50);
const falcon::settings<double> short_ramp{.ramp = 0.01, .settle = 5};

void begin(grip& device) {
  device.line().peer().now = scripted_falcon::mode::running;
  device.line().peer().homed = 7;
  REQUIRE(device.open());
  REQUIRE(device.start());
}

}  // namespace

TEST_CASE("a runner exchanges in a thread of its own and shows its newest state",
          "[falcon][threads]") {
  grip device{k, short_ramp};
  begin(device);
  std::atomic<long> calls{0};
  falcon::runner touch{device,
                       [&calls](const auto& sample) {
                         ++calls;
                         return d3::vector(0, 0, sample.valid ? 1.0 : 0.0);
                       },
                       quick};
  CHECK_FALSE(touch.running());
  CHECK(touch.take() == nullptr);
  REQUIRE(touch.start());
  CHECK(touch.running());
  std::uint64_t ticks = 0;
  bool whole = true, pushed = false;
  while (ticks < 500) {
    const auto* news = touch.take();
    if (news == nullptr) continue;
    whole = whole && news->counts.ticks > ticks && news->reading.counts.replies >= ticks;
    pushed = pushed || news->reading.sent.motor != falcon::dac_words{};
    ticks = news->counts.ticks;
  }
  touch.stop();
  CHECK_FALSE(touch.running());
  CHECK(whole);
  CHECK(pushed);
  CHECK(calls >= 500);
  CHECK(device.line().peer().last.motor == falcon::dac_words{});  // ours again, and at zero
  const long after = calls;
  REQUIRE(touch.start());  // and once more
  while (calls == after) std::this_thread::yield();
}

TEST_CASE("a runner ends by itself when the device is unplugged", "[falcon][threads]") {
  grip device{k, short_ramp};
  begin(device);
  device.line().peer().unplug_after = device.line().peer().calls + 100;
  falcon::runner touch{device, [](const auto&) { return d3::vector(0, 0, 1); }, quick};
  REQUIRE(touch.start());
  while (touch.running()) std::this_thread::yield();
  const auto* news = touch.take();
  REQUIRE(news != nullptr);
  CHECK(news->reading.what == code::unplugged);
  CHECK(news->reading.where == state::fault);
}

TEST_CASE("a runner that an unplug has ended says so at start(), and starts once it is back",
          "[falcon][threads]") {
  grip device{k, short_ramp};
  begin(device);
  auto& peer = device.line().peer();
  peer.unplug_after = peer.calls + 100;
  std::atomic<long> calls{0};
  falcon::runner touch{device,
                       [&calls](const auto&) {
                         ++calls;
                         return d3::vector(0, 0, 1);
                       },
                       quick};
  REQUIRE(touch.start());
  CHECK(touch.start());  // the control: it runs, so there is nothing to do
  while (touch.running()) std::this_thread::yield();
  CHECK(touch.start().what == code::unplugged);
  CHECK_FALSE(touch.running());
  peer.unplug_after = -1;
  peer.plugged = true;
  begin(device);
  const long before = calls;
  REQUIRE(touch.start());
  CHECK(touch.running());
  while (touch.running() && calls == before) std::this_thread::yield();
  CHECK(calls > before);
  touch.stop();
  CHECK(device.where() != state::fault);
}

TEST_CASE("a runner counts ticks that are late", "[falcon][threads]") {
  grip device{k, short_ramp};
  begin(device);
  std::atomic<int> calls{0};
  falcon::runner touch{device,
                       [&calls](const auto&) {
                         if (++calls == 10)
                           std::this_thread::sleep_for(std::chrono::milliseconds(30));
                         return d3::vector(0, 0, 0);
                       },
                       std::chrono::milliseconds(10)};
  REQUIRE(touch.start());
  while (calls < 13) std::this_thread::yield();
  touch.stop();
  const auto* news = touch.take();
  REQUIRE(news != nullptr);
  CHECK(news->counts.late >= 1);
  CHECK(news->counts.longest >= std::chrono::milliseconds(30));
}
