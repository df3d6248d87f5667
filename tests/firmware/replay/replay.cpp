// SPDX-License-Identifier: BSD-3-Clause
// Plays the recording to every scene, composed and by hand, and prints what came out, bit by bit:
//   tick  SCENE AUTHOR N   force… depth energy event limited        compared with the host's
//   state SCENE AUTHOR BYTES
//   insn  SCENE AUTHOR N   instructions of that tick                on the target
#include "../target/platform.hpp"
#include "recorded.hpp"
#include "subjects.hpp"
#include "text.hpp"

#include <type_traits>

extern "C" {
// Where the counting plugin begins, ends, and starts a new series.
[[gnu::noinline]] void count_begin() {
  asm volatile("" ::: "memory");
}
[[gnu::noinline]] void count_end() {
  asm volatile("" ::: "memory");
}
[[gnu::noinline]] void count_series() {
  asm volatile("" ::: "memory");
}
void nothing();
}

namespace {

namespace ph = passive_haptics;
using replay::recording;

/// The tick, in whichever of the three spellings it has.
template <class Function, class State, class Position>
auto call(Function* tick, State& state, const Position& x, real dt) {
  if constexpr (std::is_invocable_v<Function*, State&, const Position&, real>) {
    return tick(state, x, dt);
  } else if constexpr (std::is_invocable_v<Function*, State*, const Position&, real>) {
    return tick(&state, x, dt);
  } else {
    return tick(&state, &x, dt);
  }
}

/// Calls and counts. One function for the tick and for the one that does nothing, so that what it
/// costs to call and to count is the same.
template <class Function, class State, class Position>
[[gnu::noinline]] auto counted(Function* tick, State& state, const Position& x, real dt,
                               std::uint32_t& instructions) {
  count_begin();
  const std::uint32_t before = platform::clock();
  asm volatile("" ::: "memory");
  auto out = call(tick, state, x, dt);
  asm volatile("" ::: "memory");
  const std::uint32_t after = platform::clock();
  count_end();
  instructions = platform::instructions(before, after);
  return out;
}

template <class Position>
void print_numbers(text_line& line, const Position& v, int dof) {
  real numbers[3] = {};
  __builtin_memcpy(numbers, &v, static_cast<std::size_t>(dof) * sizeof(real));
  for (int i = 0; i < dof; ++i) line.bits(numbers[i]);
}

template <class Subject>
void play(const recording& r) {
  using position = typename Subject::position;
  Subject subject;
  ph::exchange<replay::surface> inbox;
  text_line line;
  line.words("state", r.scene, Subject::author).number(sizeof subject.model).print();

  count_series();
  std::uint32_t empty = 0;
  auto idle = subject.model;
  const auto doing_nothing = reinterpret_cast<decltype(Subject::call)>(&nothing);
  if (platform::clock() != 0) {
    (void)counted(doing_nothing, idle, position{}, real(1), empty);
  }

  for (std::uint32_t n = 0; n < r.ticks; ++n) {
    const replay::sample& s = r.samples[n];
    if (s.news >= 0) inbox.publish(r.surfaces[s.news]);
    if (const replay::surface* news = inbox.take()) subject.update(*news);
    const auto x = replay::vector_of<position, Subject::dof>(s.x);
    std::uint32_t instructions = 0;
    const auto out = counted(Subject::call, subject.model, x, replay::real_of(s.dt), instructions);
    line.words("tick", r.scene, Subject::author).number(n);
    print_numbers(line, out.force, Subject::dof);
    line.bits(out.depth).bits(out.energy);
    line.number(static_cast<unsigned>(out.what)).number(out.limited ? 1 : 0).print();
    if (instructions != 0) {  // the empty function has one, its return
      line.words("insn", r.scene, Subject::author).number(n).number(instructions + 1 - empty);
      line.print();
    }
  }
}

}  // namespace

// A function of one instruction, whatever its arguments.
asm(".text\n.p2align 2\n.global nothing\n.type nothing, %function\n"
#ifdef __arm__
    ".thumb_func\nnothing: bx lr\n"
#else
    "nothing: ret\n"
#endif
);

int program() {
  namespace recorded = replay::recorded;
  play<replay::composed_wall_trusted>(recorded::wall_trusted);
  play<replay::by_hand_wall_trusted>(recorded::wall_trusted);
  play<replay::composed_wall_strict>(recorded::wall_strict);
  play<replay::by_hand_wall_strict>(recorded::wall_strict);
  play<replay::composed_wall_reachable>(recorded::wall_reachable);
  play<replay::by_hand_wall_reachable>(recorded::wall_reachable);
  play<replay::composed_plane_strict>(recorded::plane_strict);
  play<replay::by_hand_plane_strict>(recorded::plane_strict);
  play<replay::composed_plane_reachable>(recorded::plane_reachable);
  play<replay::by_hand_plane_reachable>(recorded::plane_reachable);
  play<replay::composed_triangle_thesis>(recorded::triangle_thesis);
  play<replay::by_hand_triangle_thesis>(recorded::triangle_thesis);
  return 0;
}
