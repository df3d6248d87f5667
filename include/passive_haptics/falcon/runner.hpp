// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A thread of its own for the Falcon, and its newest state for everybody else.
//
//   runner thread, 1 kHz    sample ─▶ controller ─▶ force ─▶ device.exchange ─▶ sample
//                                                                      └─▶ news, lock-free
//   your thread             runner.take()
//
// On a computer that is not real-time some ticks are late; they are counted, not made up for. Ask
// the system for priority in the controller's first call if you need it (docs/falcon.md).

#include <passive_haptics/concepts.hpp>
#include <passive_haptics/exchange.hpp>
#include <passive_haptics/falcon/settings.hpp>

#include <atomic>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// The ticks of a runner.
struct runner_counts {
  std::uint64_t ticks = 0;
  std::uint64_t late = 0;  ///< began more than half a period late
  nanoseconds longest{};   ///< from one to the next
};

/// While it runs, the device belongs to its thread: touch it again after stop(). `controller` is
/// called there with each sample and returns the next force.
///     runner touch{grip, [&](const auto& sample) { return wall.tick(sample).force; }};
///     if (const auto done = touch.start(); !done) …
template <class Device, class Controller>
class runner {
 public:
  struct news {
    typename Device::reading_type reading{};
    runner_counts counts{};
  };

  runner(Device& device, Controller controller,
         nanoseconds period = std::chrono::milliseconds(1)) noexcept
      : device_(device), controller_(std::move(controller)), period_(period) {}
  runner(const runner&) = delete;
  runner& operator=(const runner&) = delete;
  ~runner() { stop(); }

  /// Does nothing while it runs. After an unplug: unplugged, until the device is open again.
  result start() noexcept {
    if (thread_.joinable()) {
      if (running_) return {};
      thread_.join();  // it has ended by itself
    }
    if (device_.latest().what == code::unplugged) return {code::unplugged};
    stop_ = false;
    running_ = true;
    const int refused = begin();
    if (refused == 0) return {};
    running_ = false;
    return {code::no_thread, refused};
  }

  /// Returns when the thread has ended and zero force was sent. Any thread but the runner's own.
  void stop() noexcept {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

  /// False before start(), after stop(), and once the device is unplugged.
  [[nodiscard]] bool running() const noexcept { return running_; }

  /// The newest state since the last take(), or null. One thread only.
  [[nodiscard]] const news* take() noexcept { return box_.take(); }

 private:
  using clock = std::chrono::steady_clock;

  /// Zero, or the system's number for why it grants no thread. Where there are no exceptions the
  /// standard library can only end the program then.
  int begin() noexcept {
#if defined(__cpp_exceptions)
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error& refused) {
      return refused.code().value();
    }
#else
    thread_ = std::thread([this] { run(); });
#endif
    return 0;
  }

  void run() noexcept {
    using vector = typename Device::vector;
    auto sample = device_.exchange(vector(vector::Zero()));
    runner_counts so_far;
    for (auto due = clock::now(), last = due; !stop_;) {
      sample = device_.exchange(controller_(std::as_const(sample)));
      ++so_far.ticks;
      box_.publish({device_.latest(), so_far});
      if (device_.latest().what == code::unplugged) break;
      due = (std::max)(due + period_, clock::now());  // what was missed is not made up for
      std::this_thread::sleep_until(due);
      const auto begin = clock::now();
      const nanoseconds took = begin - std::exchange(last, begin);
      so_far.late += took > period_ + period_ / 2 ? 1U : 0U;
      so_far.longest = (std::max)(so_far.longest, took);
    }
    (void)device_.exchange(vector(vector::Zero()));
    running_ = false;
  }

  Device& device_;
  Controller controller_;
  nanoseconds period_;
  std::thread thread_;
  std::atomic<bool> stop_{false}, running_{false};
  exchange<news> box_;
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
