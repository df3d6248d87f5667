// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Requests of a haptic thread to the operating system, so that its ticks are on time:
//
//   priority       SCHED_FIFO: the thread runs before all threads that have none
//   memory         mlockall and a touched stack: no page has to be fetched in a tick
//   core           the thread stays on one core; boot with isolcpus=N to keep others off it
//
// Each may be refused. The loop then runs all the same, with later ticks, and the report has each refusal, its reason
// and its remedy. This is for Linux only; elsewhere the report says `unsupported`. A kernel without PREEMPT_RT is late by
// milliseconds now and then, whatever the priority.

#include <passive_haptics/runner/text.hpp>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#endif

namespace passive_haptics {
inline namespace v0 {

/// The requests; by default there are none.
struct realtime_request {
  int priority = 0;          ///< priority of SCHED_FIFO, 1 to 99; 0 asks for none
  bool lock_memory = false;  ///< lock the memory of the process, for as long as it lives
  int core = -1;             ///< core to run on, from 0; −1 asks for none
};

enum class grant : std::uint8_t { not_asked, granted, refused, unsupported };

/// The answer of the system to each request.
struct realtime_report {
  struct answer {
    grant what = grant::not_asked;
    int error = 0;  ///< errno of a refusal
  };
  answer scheduler{}, memory{}, core{};

  /// True if everything that was asked for was granted.
  [[nodiscard]] constexpr bool complete() const noexcept {
    const auto well = [](const answer& a) {
      return a.what == grant::not_asked || a.what == grant::granted;
    };
    return well(scheduler) && well(memory) && well(core);
  }
};

/// The system's calls, for the thread that makes them. Each returns 0 or errno.
struct realtime_system {
#if defined(__linux__)
  static constexpr bool supported = true;
  [[nodiscard]] static int schedule(int priority) noexcept {
    sched_param wanted{};
    wanted.sched_priority = priority;
    return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted);
  }
  [[nodiscard]] static int lock_memory() noexcept {
    return ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? 0 : errno;
  }
  [[nodiscard]] static int pin(int core) noexcept {
    if (core < 0 || core >= CPU_SETSIZE) return EINVAL;
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(static_cast<std::size_t>(core), &only);
    return ::pthread_setaffinity_np(::pthread_self(), sizeof only, &only);
  }
#else
  static constexpr bool supported = false;
  [[nodiscard]] static int schedule(int /*priority*/) noexcept {
    return 0;
  }
  [[nodiscard]] static int lock_memory() noexcept {
    return 0;
  }
  [[nodiscard]] static int pin(int /*core*/) noexcept {
    return 0;
  }
#endif
};

namespace detail {

/// Writes once to each page of the stack that a loop may need, 64 kB.
#if defined(__GNUC__)
[[gnu::noinline]]
#endif
inline void
touch_stack() noexcept {
  constexpr std::size_t depth = 64 * 1024, page = 4096;
  volatile char stack[depth];
  for (std::size_t i = 0; i < depth; i += page) stack[i] = 0;
  static_cast<void>(stack[depth - page]);
}

}  // namespace detail

/// Makes the requests for the thread that calls it, before its loop.
template <class System = realtime_system>
realtime_report become_realtime(const realtime_request& request, System&& system = {}) noexcept {
  realtime_report report;
  const auto ask = [](bool wanted, auto call) noexcept -> realtime_report::answer {
    if (!wanted) return {};
    if (!std::remove_cvref_t<System>::supported) return {grant::unsupported, 0};
    const int error = call();
    return {error == 0 ? grant::granted : grant::refused, error};
  };
  report.core = ask(request.core >= 0, [&] { return system.pin(request.core); });
  report.memory = ask(request.lock_memory, [&] { return system.lock_memory(); });
  if (request.lock_memory) detail::touch_stack();
  report.scheduler = ask(request.priority != 0, [&] { return system.schedule(request.priority); });
  return report;
}

/// Writes a line for each refusal, with its reason and the remedy, into `text`, cut off where it is too long.
/// The text is empty if nothing was refused.
inline const char* describe(const realtime_report& report, std::span<char> text) noexcept {
  detail::cut_text said(text);
  const auto why = [](int error) {
    switch (error) {
      case EPERM:
        return "not permitted";
      case ENOMEM:
        return "over the limit of this user";
      case EINVAL:
        return "out of range";
      default:
        return "error";
    }
  };
  const auto line = [&](const char* name, const realtime_report::answer& a, const char* remedy) {
    if (a.what != grant::refused && a.what != grant::unsupported) return;
    said.add(said.empty() ? "" : "\n").add(name);
    if (a.what == grant::refused) {
      said.print(": refused, %s (%d): ", why(a.error), a.error).add(remedy);
    } else {
      said.add(
          ": not asked, since this is not Linux: use the system's own calls in the first call "
          "of the controller");
    }
  };
  line("priority", report.scheduler,
       report.scheduler.error == EINVAL
           ? "1 to 99 are priorities of SCHED_FIFO"
           : "give the user rtprio: a line '@realtime - rtprio 90' in /etc/security/limits.d, and "
             "log in again");
  line("memory", report.memory,
       "give the user memlock: a line '@realtime - memlock unlimited' in /etc/security/limits.d, "
       "and log in again");
  line("core", report.core,
       "name one that is there and that this process may use: taskset -cp $$ lists them");
  return said.c_str();
}

}  // namespace v0
}  // namespace passive_haptics
