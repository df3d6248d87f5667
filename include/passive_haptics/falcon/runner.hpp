// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A thread for the Falcon: the runner of any device (runner.hpp), with the Falcon's results.

#include <passive_haptics/falcon/settings.hpp>
#include <passive_haptics/runner.hpp>

#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// The ticks of a runner.
using runner_counts = loop_counts;

/// While it runs, the device belongs to its thread: use the device again after stop(). In that thread
/// `controller` is called with each sample and returns the next force [N]. news::reading is device.latest().
///     runner touch{grip, [&](const auto& sample) { return wall.tick(sample).force; }};
///     if (const auto done = touch.start(); !done) …
template <class Device, class Controller>
class runner : private passive_haptics::runner<Device, Controller> {
  using any = passive_haptics::runner<Device, Controller>;

 public:
  using news = typename any::news;

  runner(Device& device, Controller controller,
         nanoseconds period = std::chrono::milliseconds(1)) noexcept
      : any(device, std::move(controller), period) {}

  /// Starts the thread; it does nothing while that runs. After an unplug it returns unplugged until the device is
  /// open again. A real-time request that the system refuses does not stop it: granted() says what was granted.
  result start(const realtime_request& wanted = {}) noexcept {
    const loop_start done = any::start(wanted);
    granted_ = done.granted;
    switch (done.what) {
      case loop_start::code::ok:
        return {};
      case loop_start::code::unplugged:
        return {code::unplugged};
      case loop_start::code::bad_period:
        return {code::bad_setting};
      case loop_start::code::no_thread:
        return {code::no_thread, done.error};
    }
    return {};
  }
  [[nodiscard]] const realtime_report& granted() const noexcept { return granted_; }

  using any::ended, any::error, any::timing, any::counts;
  using any::stop, any::request_stop, any::running, any::take;

 private:
  realtime_report granted_{};
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
