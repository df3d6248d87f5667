// SPDX-License-Identifier: BSD-3-Clause
// The program that callgrind counts: every scene through its workload, composed and by hand. Each tick
// is one call of probe<Scene, State> from along<path>, so the counts of a tick are those of that call:
// the tick, its frame and its return.

#include "parts.hpp"
#include "workload.hpp"

#include <cstdio>

namespace cost {

#if defined(__clang__)
constexpr const char* compiler = "clang++";
constexpr int version[] = {__clang_major__, __clang_minor__, __clang_patchlevel__};
#else
constexpr const char* compiler = "g++";
constexpr int version[] = {__GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__};
#endif

template <class Scene, class State, class Position, class Time>
[[gnu::flatten]] auto probe(State& state, const Position& x, Time dt) noexcept {
  return advance(state, x, dt);
}

volatile int going = 0;

/// Calls `ticker` and leaves its path in the call graph.
template <path Path, class Scene, class State, class Position, class Time, class Ticker>
[[gnu::noinline]] void along(Ticker ticker, State& state, const Position& x, Time dt) {
  going = static_cast<int>(Path);  // no two of these are alike, so none are merged
  [[maybe_unused]] const auto result = ticker(state, x, dt);
}

template <class Scene, class State>
void run(State state, const std::vector<step>& steps) {
  using position = decltype(position_for<Scene, State>({}));
  using time = decltype(time_for<Scene, State>({}));
  auto* volatile ticker = &probe<Scene, State, position, time>;  // not to be inlined
  using pointer = decltype(&probe<Scene, State, position, time>);
  for (const step& s : steps) {
    if (s.news) update_any(state, s.target);
    const position x = position_for<Scene, State>(s.position);
    const time dt = time_for<Scene, State>(s.dt);
    const pointer call = ticker;
    switch (s.taken) {
      case path::air:
        along<path::air, Scene>(call, state, x, dt);
        break;
      case path::contact:
        along<path::contact, Scene>(call, state, x, dt);
        break;
      case path::following:
        along<path::following, Scene>(call, state, x, dt);
        break;
      case path::limited:
        along<path::limited, Scene>(call, state, x, dt);
        break;
      case path::late:
        along<path::late, Scene>(call, state, x, dt);
        break;
      case path::bad:
        along<path::bad, Scene>(call, state, x, dt);
        break;
    }
  }
}

template <class Scene>
void run_both() {
  const auto steps = workload<Scene>();
  run<Scene>(Scene::composed(ordinary), steps);
  run<Scene>(Scene::by_hand(ordinary), steps);
}

template <template <class, int> class Part>
void run_part() {
  run<Part<float, 1>>(Part<float, 1>::composed(ordinary), workload<wall<float>>());
  run<Part<double, 3>>(Part<double, 3>::composed(ordinary), workload<half_space<double>>());
}

/// One tick of each.
template <template <class, int> class Part>
void run_hardest() {
  using single = Part<float, 1>;
  using exact = Part<double, 3>;
  const std::vector<step> last{
      {.position = exact::place(exact::data.now), .target = {}, .taken = path::contact}};
  run<single>(single::composed(ordinary), last);
  run<exact>(exact::composed(ordinary), last);
}

}  // namespace cost

int main() {
  std::printf("%s %d.%d.%d\n", cost::compiler, cost::version[0], cost::version[1],
              cost::version[2]);
  cost::run_both<cost::wall<float>>();
  cost::run_both<cost::wall<double>>();
  cost::run_both<cost::half_space<float>>();
  cost::run_both<cost::half_space<double>>();
  cost::run_both<cost::triangle<float>>();
  cost::run_both<cost::triangle<double>>();
  cost::run_part<cost::part_bare>();
  cost::run_part<cost::part_turning>();
  cost::run_part<cost::part_counting>();
  cost::run_part<cost::part_strict>();
  cost::run_part<cost::part_limited>();
  cost::run_part<cost::part_following>();
  cost::run_part<cost::part_stepped>();
  cost::run_part<cost::part_rubbing>();
  cost::run_part<cost::part_reachable>();
  cost::run_part<cost::part_plane>();
  cost::run_part<cost::part_rough>();
  cost::run_part<cost::part_corner>();
  cost::run_part<cost::part_six>();
  cost::run_part<cost::part_sixteen>();
  cost::run_hardest<cost::part_hardest_three>();
  cost::run_hardest<cost::part_hardest_six>();
  cost::run_hardest<cost::part_hardest_sixteen>();
  cost::run_part<cost::part_crowd>();
  cost::run_part<cost::part_tool>();
  cost::run_part<cost::part_tool_sixteen>();
}
