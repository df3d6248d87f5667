// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A haptic loop: a thread with a fixed period, and its newest state for another thread.
//
//   haptic thread, 1 kHz    wait ─▶ controller ─▶ force ─▶ device.exchange ─▶ sample ─┐
//                             ▲                          zero if not finite            ├─▶ state, wait-free
//                             └────────────────────────────────────────────────────────┘
//   your thread             touch.take()
//
//     ph::runner touch{device, [&](const auto& sample) {
//       if (const auto* plane = inbox.take()) wall.update(*plane);
//       return wall.tick(sample).force;
//     }};
//     if (const auto done = touch.start({.priority = 80, .lock_memory = true}); !done) …
//     …  touch.stop();
//
// A tick of the loop neither allocates nor locks. Its force is sent in the next exchange() and its sample came from
// the last one. So if an exchange does not wait until the force is held, the loop is one tick late,
// late_loop_limits<1>; identification/measure_latency.hpp measures that. lateness.hpp has the lengths of the
// ticks and the longest_tick to state, realtime.hpp the requests to the operating system.

#include <passive_haptics/base/exchange.hpp>
#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/runner/haptic_device.hpp>
#include <passive_haptics/runner/lateness.hpp>
#include <passive_haptics/runner/pace.hpp>
#include <passive_haptics/runner/realtime.hpp>

#include <atomic>
#include <exception>
#include <system_error>
#include <thread>

namespace passive_haptics {
inline namespace v0 {

/// A controller is called with each sample, or with the sample and the `wake` that began its tick, and returns
/// the next force.
template <class C, class P>
concept controller_for = std::is_invocable_r_v < typename P::effort,
        C&, const device_sample<P>
& > || std::is_invocable_r_v<typename P::effort, C&, const device_sample<P>&, const wake&>;

/// Why a loop has ended.
enum class loop_end : std::uint8_t {
  not_yet,           ///< it runs, or has never run
  stopped,           ///< stop() was called, or the ticks asked for are over
  unplugged,         ///< the device is gone
  controller_threw,  ///< error() has the exception
};

/// The result of start(). It converts to true if the loop runs.
struct [[nodiscard]] loop_start {
  enum class code : std::uint8_t { ok, unplugged, no_thread, bad_period };
  code what = code::ok;
  int error = 0;              ///< the system's error number, if there is no thread
  realtime_report granted{};  ///< which realtime requests were granted and which refused

  constexpr explicit operator bool() const noexcept { return what == code::ok; }
};

/// One sentence on the result, with the remedy.
[[nodiscard]] constexpr const char* to_string(loop_start::code c) noexcept {
  switch (c) {
    case loop_start::code::ok:
      return "ok";
    case loop_start::code::unplugged:
      return "the device is gone: open it again, then start";
    case loop_start::code::no_thread:
      return "the system gave no thread: ulimit -u, or too little memory";
    case loop_start::code::bad_period:
      return "the period is not > 0 ns";
  }
  return "unknown code";
}

/// While it runs, only its thread may use the device; use it again after stop(). At the end of the loop, by stop(), an
/// unplugged device or an exception of the controller, zero force is sent, up to three times until a valid sample
/// is returned.
template <haptic_device Device, class Controller, pace Pace = steady_pace>
requires controller_for<Controller, port_of_device<Device>>
class runner {
 public:
  using port_type = port_of_device<Device>;
  using effort = typename port_type::effort;
  using sample_type = device_sample<port_type>;
  using reading_type = decltype(detail::reading_of(std::declval<const Device&>()));

  struct news {
    sample_type sample{};                       ///< the newest sample
    typename port_type::stored_effort force{};  ///< the force commanded for it
    loop_counts counts{};
    PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS reading_type reading{};  ///< Device::latest(), if it has that
  };

  runner(Device& device, Controller controller, Pace pace) noexcept
      : device_(device), controller_(std::move(controller)), pace_(std::move(pace)) {}
  runner(Device& device, Controller controller,
         std::chrono::nanoseconds period = std::chrono::milliseconds(
             1)) noexcept requires std::constructible_from<Pace, std::chrono::nanoseconds>
      : runner(device, std::move(controller), Pace(period)) {}
  runner(const runner&) = delete;
  runner& operator=(const runner&) = delete;
  ~runner() { stop(); }

  /// Starts the thread and returns once it has made its requests to the system; the loop runs even if some are
  /// refused. While it runs, start() does nothing. After an unplug it fails until the device is open again.
  loop_start start(const realtime_request& wanted = {}) noexcept {
    if (thread_.joinable()) {
      if (running_) return {.granted = granted_};
      thread_.join();  // it has ended by itself
    }
    if (const auto refused = prepare(); !refused) return refused;
    asked_ = false;
    if (const int refused = begin(wanted); refused != 0) {
      running_ = false;
      return {.what = loop_start::code::no_thread, .error = refused};
    }
    asked_.wait(false);
    return {.granted = granted_};
  }

  /// The same loop in the thread that calls it, for so many ticks or until it ends.
  loop_start run(std::uint64_t ticks) noexcept {
    stop();
    if (const auto refused = prepare(); !refused) return refused;
    loop(ticks);
    return {};
  }

  /// Returns when the thread has ended and zero force was sent. Any thread but the runner's own.
  void stop() noexcept {
    request_stop();
    if (thread_.joinable()) thread_.join();
  }
  /// Ends the loop after the present tick. Any thread may call it, the controller too.
  void request_stop() noexcept { stop_ = true; }

  /// False before start(), after stop(), and once it has ended by itself.
  [[nodiscard]] bool running() const noexcept { return running_; }

  /// The newest state since the last take(), or null. One thread only.
  [[nodiscard]] const news* take() noexcept { return box_.take(); }

  // The following functions may be called only while it does not run.
  [[nodiscard]] loop_end ended() const noexcept { return end_; }
  /// The exception of the controller, or null.
  [[nodiscard]] std::exception_ptr error() const noexcept { return error_; }
  /// The tick lengths and the counts of the last run.
  [[nodiscard]] const loop_timing& timing() const noexcept { return timing_; }
  [[nodiscard]] const loop_counts& counts() const noexcept { return counts_; }

 private:
  loop_start prepare() noexcept {
    if (pace_.period() <= std::chrono::nanoseconds(0)) {
      return {.what = loop_start::code::bad_period};
    }
    if (detail::is_unplugged(device_)) return {.what = loop_start::code::unplugged};
    timing_ = {};
    counts_ = {};
    error_ = nullptr;
    granted_ = {};
    end_ = loop_end::not_yet;
    stop_ = false;
    running_ = true;
    return {};
  }

  /// Starts the thread: zero, or the system's error number where it gives none. Without exceptions the
  /// standard library can only end the program then.
  int begin(const realtime_request& wanted) noexcept {
    const auto work = [this, wanted] {
      granted_ = become_realtime(wanted);
      asked_ = true;
      asked_.notify_one();
      loop(~std::uint64_t(0));
    };
#if defined(__cpp_exceptions)
    try {
      thread_ = std::thread(work);
    } catch (const std::system_error& refused) {
      return refused.code().value();
    }
#else
    thread_ = std::thread(work);
#endif
    return 0;
  }

  void loop(std::uint64_t most) noexcept {
#if defined(__cpp_exceptions)
    try {
      end_ = turn(most);
    } catch (...) {
      error_ = std::current_exception();
      end_ = loop_end::controller_threw;
    }
#else
    end_ = turn(most);
#endif
    let_go();
    running_ = false;
  }

  loop_end turn(std::uint64_t most) {
    wake now{};
    sample_type sample = first(now);
    while (counts_.ticks < most && !stop_) {
      const effort force = finite(ask(sample, now));
      sample = device_.exchange(force);
      ++counts_.ticks;
      box_.publish({sample, force, counts_, detail::reading_of(std::as_const(device_))});
      if (detail::is_unplugged(device_)) return loop_end::unplugged;
      now = pace_.next();
      book(now);
    }
    return loop_end::stopped;
  }
  /// The sample of the first exchange spans the time since the last run, so it is dropped. That of the second,
  /// which is a tick long, is the first that the controller gets.
  [[nodiscard]] sample_type first(wake& now) noexcept {
    (void)device_.exchange(port_type::zero());
    pace_.begin();
    (void)pace_.next();
    const sample_type sample = device_.exchange(port_type::zero());
    now = pace_.next();
    return sample;
  }

  [[nodiscard]] effort ask(const sample_type& sample, const wake& now) {
    if constexpr (std::is_invocable_r_v<effort, Controller&, const sample_type&, const wake&>) {
      return controller_(sample, now);
    } else {
      return controller_(sample);
    }
  }

  [[nodiscard]] effort finite(const effort& wanted) noexcept {
    if (port_type::is_finite(wanted)) return wanted;
    ++counts_.refused;
    return port_type::zero();
  }

  void book(const wake& now) noexcept {
    timing_.lengths.book(now.dt);
    timing_.lateness.book(now.late);
    counts_.late += now.dt > pace_.period() + pace_.period() / 2 ? 1U : 0U;
    counts_.lost += now.lost;
    counts_.longest = (std::max)(counts_.longest, now.dt);
  }

  void let_go() noexcept {
    for (int tries = 0; tries < 3 && !device_.exchange(port_type::zero()).valid; ++tries) {
    }
  }

  Device& device_;
  Controller controller_;
  Pace pace_;
  loop_timing timing_{};
  loop_counts counts_{};
  realtime_report granted_{};
  loop_end end_ = loop_end::not_yet;
  std::exception_ptr error_;
  std::thread thread_;
  std::atomic<bool> stop_{false}, running_{false}, asked_{false};
  exchange<news> box_;
};

template <class Device, class Controller>
runner(Device&, Controller) -> runner<Device, Controller>;
template <class Device, class Controller, class Representation, class Unit>
runner(Device&, Controller, std::chrono::duration<Representation, Unit>)
    -> runner<Device, Controller>;
template <class Device, class Controller, pace Pace>
runner(Device&, Controller, Pace) -> runner<Device, Controller, Pace>;

}  // namespace v0
}  // namespace passive_haptics
