// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A program that Ctrl-C stops where it may, so that nothing is half written: the body of a main().

#include <atomic>
#include <csignal>
#include <string>
#include <vector>

namespace experiments {

inline std::atomic<bool> interrupt_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

/// run(arguments, stop): what it returns is the program's.
template <class Run>
[[nodiscard]] int interruptible(int argc, char** argv, const Run& run) {
  std::signal(SIGINT, [](int) { interrupt_asked = true; });
  return run(std::vector<std::string>(argv + 1, argv + argc), interrupt_asked);
}

}  // namespace experiments
