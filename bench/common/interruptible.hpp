// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The body of a main() that Ctrl-C stops only where it may, so that no file is half written.

#include <atomic>
#include <csignal>
#include <string>
#include <vector>

namespace experiments {

inline std::atomic<bool> interrupt_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

/// Calls run(arguments, stop) and returns its result, the exit code of the program.
template <class Run>
[[nodiscard]] int interruptible(int argc, char** argv, const Run& run) {
  std::signal(SIGINT, [](int) { interrupt_asked = true; });
  return run(std::vector<std::string>(argv + 1, argv + argc), interrupt_asked);
}

}  // namespace experiments
