// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a tick costs: nanoseconds by the clock, in blocks of 16 so that the clock itself stays out of
// the way, and instructions by callgrind, which are exact and include the replay's loop.

#include "recording.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace experiments {

struct tick_time {
  double median = 0, p999 = 0, worst = 0;  ///< of blocks of 16 ticks [ns a tick]
};

/// Something to be timed and counted. The name is its own on the command line.
struct candidate {
  std::string name;
  std::size_t bytes = 0;  ///< of state, parameters included
  std::function<tick_time()> time;
  std::function<double(long)> replay;  ///< that many ticks; a number that depends on all of them
};

inline constexpr long recorded_ticks = 16384;

template <class Model>
double replay(const Model& fresh, const recording<Model>& input, long ticks) {
  Model model = fresh;
  double sum = 0.0;
  for (long n = 0; n < ticks; ++n) {
    sum += static_cast<double>(input.feed(model, n % input.size()).energy);
  }
  return sum;
}

template <class Model>
tick_time time_of(const Model& fresh) {
  constexpr long block = 16;
  const recording<Model> input(recorded_ticks);
  std::vector<double> spent;
  double sink = replay(fresh, input, input.size());  // warm
  for (int pass = 0; pass < 8; ++pass) {
    Model model = fresh;
    for (long n = 0; n + block <= input.size(); n += block) {
      const auto begin = std::chrono::steady_clock::now();
      for (long i = 0; i < block; ++i) sink += static_cast<double>(input.feed(model, n + i).depth);
      const std::chrono::duration<double, std::nano> took =
          std::chrono::steady_clock::now() - begin;
      spent.push_back(took.count() / block);
    }
  }
  std::sort(spent.begin(), spent.end());
  const auto at = [&](double share) {
    return spent[static_cast<std::size_t>(share * static_cast<double>(spent.size() - 1))];
  };
  volatile double kept = sink;  // or the ticks could be optimised away
  (void)kept;
  return {at(0.5), at(0.999), spent.back()};
}

template <class Model>
candidate candidate_of(std::string name, const Model& fresh) {
  return {std::move(name), sizeof(Model), [fresh] { return time_of(fresh); },
          [fresh](long ticks) { return replay(fresh, recording<Model>(recorded_ticks), ticks); }};
}

/// Instructions a tick of the candidate `name`, from two runs of `program` under callgrind that
/// differ in their number of ticks alone. NaN without valgrind.
double instructions_per_tick(const std::string& program, const std::string& name);

}  // namespace experiments
