// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Works through a list of cells on all cores. Results are handed on in the order of the list for any number of
// threads, so two runs leave the same files.

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace experiments {

/// `asked` threads, or, if that is 0, as many as the machine has.
inline int threads_of(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls cell(i) for 0 ≤ i < count in `threads` threads, and done(i, result) for each i in
/// order, one at a time. Once `stop` is set the cells under way are finished and handed on, and no others
/// are begun. Returns how many were handed on. An exception of a cell ends the run and is thrown here.
template <class Cell, class Done>
int work_through(int count, int threads, const std::atomic<bool>& stop, Cell cell, Done done) {
  using result = decltype(cell(0));
  std::atomic<int> next = 0;
  std::atomic<bool> failed = false;
  std::mutex guard;
  std::map<int, result> waiting;  // finished before one that comes earlier in the list
  int handed_on = 0;
  std::exception_ptr problem;

  const auto worker = [&] {
    try {
      while (!stop && !failed) {
        const int i = next++;
        if (i >= count) return;
        result finished = cell(i);
        const std::lock_guard lock(guard);
        waiting.emplace(i, std::move(finished));
        for (auto it = waiting.begin(); it != waiting.end() && it->first == handed_on;) {
          done(handed_on++, std::move(it->second));
          it = waiting.erase(it);
        }
      }
    } catch (...) {
      failed = true;
      const std::lock_guard lock(guard);
      if (!problem) problem = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < std::min(threads, count); ++i) others.emplace_back(worker);
  worker();
  for (auto& thread : others) thread.join();
  if (problem) std::rethrow_exception(problem);
  return handed_on;
}

}  // namespace experiments
