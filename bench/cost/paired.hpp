// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Nanoseconds per tick, composed and by hand in turns: a busy machine slows both, so their ratio says
// more than either. A block is 100 ticks of the workload on one model, one after the other; which side
// goes first alternates. Single ticks are too short for a clock, so the largest figures are those of
// the worst block.

#include "workload.hpp"

#include <algorithm>
#include <chrono>

namespace cost {

struct timing {
  double p50 = 0, p999 = 0, max = 0;  ///< of blocks, ns per tick, composed
  double by_hand = 0;                 ///< p50
  double ratio = 0;                   ///< median over the pairs
};

[[nodiscard]] inline double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(q * last + 0.5)];
}

/// One step as a side takes it, converted beforehand.
template <class Scene, class State>
struct prepared {
  decltype(position_for<Scene, State>({})) position;
  decltype(time_for<Scene, State>({})) dt;
};

template <class Scene, class State>
class stopwatch {
 public:
  using result =
      decltype(advance(std::declval<State&>(), std::declval<prepared<Scene, State>&>().position,
                       std::declval<prepared<Scene, State>&>().dt));

  explicit stopwatch(const std::vector<step>& steps) : steps_(steps) {
    for (const step& s : steps) {
      ready_.push_back({position_for<Scene, State>(s.position), time_for<Scene, State>(s.dt)});
    }
  }

  /// [ns per tick] of the steps from `begin`, all on one state.
  [[nodiscard]] double run(State& state, std::size_t begin, std::size_t ticks) {
    using clock = std::chrono::steady_clock;
    const auto start = clock::now();
    for (std::size_t n = begin; n < begin + ticks; ++n) {
      if (steps_[n].news) update_any(state, steps_[n].target);
      last_ = advance(state, ready_[n].position, ready_[n].dt);
      asm volatile("" : : "g"(&last_) : "memory");
    }
    return std::chrono::duration<double, std::nano>(clock::now() - start).count() /
           static_cast<double>(ticks);
  }

  /// [ns per tick] of up to 64 ticks of one path, each from the state in which it happened.
  [[nodiscard]] double run(const State& start, path along, int repeats) {
    std::vector<State> before;
    std::vector<std::size_t> which;
    State state = start;
    for (std::size_t n = 0; n < steps_.size() && which.size() < 64; ++n) {
      if (steps_[n].news) update_any(state, steps_[n].target);
      if (steps_[n].taken == along) {
        before.push_back(state);
        which.push_back(n);
      }
      last_ = advance(state, ready_[n].position, ready_[n].dt);
    }
    if (which.empty()) return std::nan("");
    std::vector<double> times;
    using clock = std::chrono::steady_clock;
    for (int r = 0; r < repeats; ++r) {
      std::vector<State> now = before;
      const auto begin = clock::now();
      for (std::size_t i = 0; i < now.size(); ++i) {
        last_ = advance(now[i], ready_[which[i]].position, ready_[which[i]].dt);
        asm volatile("" : : "g"(&last_) : "memory");
      }
      times.push_back(std::chrono::duration<double, std::nano>(clock::now() - begin).count() /
                      static_cast<double>(now.size()));
    }
    return quantile(times, 0.5);
  }

 private:
  const std::vector<step>& steps_;
  std::vector<prepared<Scene, State>> ready_;
  result last_{};
};

/// Two states of two scenes in turns, `rounds` times through the workload; the second is the yardstick.
template <class Scene, class Other, class One, class Two>
[[nodiscard]] timing time_in_turns(const One& one, const Two& two, const std::vector<step>& steps,
                                   int rounds) {
  stopwatch<Scene, One> first(steps);
  stopwatch<Other, Two> second(steps);
  std::vector<double> ours, theirs, ratios;
  constexpr std::size_t block = 100;
  for (int round = -1; round < rounds; ++round) {
    One composed = one;
    Two yardstick = two;
    for (std::size_t begin = 0; begin + block <= steps.size(); begin += block) {
      double a = 0, b = 0;
      if ((static_cast<std::size_t>(round + 1) + begin / block) % 2 == 0) {
        a = first.run(composed, begin, block);
        b = second.run(yardstick, begin, block);
      } else {
        b = second.run(yardstick, begin, block);
        a = first.run(composed, begin, block);
      }
      if (round < 0) continue;  // caches and branch predictors learn
      ours.push_back(a);
      theirs.push_back(b);
      ratios.push_back(a / b);
    }
  }
  return {quantile(ours, 0.5), quantile(ours, 0.999), quantile(ours, 1), quantile(theirs, 0.5),
          quantile(ratios, 0.5)};
}

/// Both sides of a scene.
template <class Scene>
[[nodiscard]] timing time_pairs(int rounds) {
  return time_in_turns<Scene, Scene>(Scene::composed(ordinary), Scene::by_hand(ordinary),
                                     workload<Scene>(), rounds);
}

/// A part of three dimensions in double, and the yardstick of parts.
template <class Part, class Yardstick>
[[nodiscard]] timing time_part(int rounds) {
  return time_in_turns<Part, Yardstick>(Part::composed(ordinary), Yardstick::composed(ordinary),
                                        workload<half_space<double>>(), rounds);
}

/// [ns per tick] of each path of the composed scene, NaN where there is none; p50.
template <class Scene>
[[nodiscard]] std::array<double, all_paths.size()> time_paths(int repeats) {
  const auto steps = workload<Scene>();
  const auto composed = Scene::composed(ordinary);
  stopwatch<Scene, std::remove_const_t<decltype(composed)>> watch(steps);
  std::array<double, all_paths.size()> times{};
  for (std::size_t i = 0; i < all_paths.size(); ++i) {
    times[i] = watch.run(composed, all_paths[i], repeats);
  }
  return times;
}

}  // namespace cost
