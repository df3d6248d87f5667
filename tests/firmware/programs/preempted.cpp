// SPDX-License-Identifier: BSD-3-Clause
// A tick is reentrant: while main() ticks one model, an interrupt ticks another of the same type, at
// every point of the first one's way. Both must get the results they get undisturbed. And the
// mailbox: main() publishes, the interrupt takes, nobody ever sees half a value.
#include "../replay/subjects.hpp"
#include "../target/cortex_m.hpp"
#include "check.hpp"
#include "recorded.hpp"
#include <passive_haptics/base/exchange.hpp>

namespace {

namespace recorded = replay::recorded;

constexpr std::uint32_t wanted_interruptions = 1500;
#ifdef __ARM_FP
constexpr std::uint32_t longest_handler = 2000;  // instructions
#elif defined(__ARM_FEATURE_CLZ)
constexpr std::uint32_t longest_handler = 36000;
#else
constexpr std::uint32_t longest_handler = 60000;  // ARMv6-M
#endif

std::uint32_t mixed(std::uint32_t sum, std::uint32_t value) {
  return (sum ^ value) * 16777619U;
}

/// A model on its way through the recording; the sum over all it has answered.
template <class Subject>
class player {
 public:
  explicit player(const replay::recording& r) : recording_(r) {}

  /// One tick; at the end, from the start again.
  void step() {
    // The control is interrupted between the last sample and the first: still no other memory is read.
    const replay::sample& s = recording_.samples[at_ < recording_.ticks ? at_ : 0];
    if (s.news >= 0) subject_.update(recording_.surfaces[s.news]);
    using position = typename Subject::position;
    const auto x = replay::vector_of<position, Subject::dof>(s.x);
    const auto out = Subject::call(subject_.model, x, replay::real_of(s.dt));
    for (int i = 0; i < Subject::dof; ++i) {
      add(static_cast<real>(Subject::space::component(out.force, i)));
    }
    add(out.energy);
    sum_ = mixed(sum_, static_cast<std::uint32_t>(out.what));
    if (++at_ < recording_.ticks) return;
    at_ = 0;
    finished_ = sum_;
    sum_ = first_sum;
    ++rounds_;
    subject_ = Subject();
  }
  [[nodiscard]] std::uint32_t rounds() const { return rounds_; }
  /// The sum over the last full round.
  [[nodiscard]] std::uint32_t finished() const { return finished_; }

 private:
  static constexpr std::uint32_t first_sum = 2166136261U;
  void add(real value) {
    sum_ = mixed(sum_, value != value ? 1U : std::bit_cast<std::uint32_t>(value));
  }

  const replay::recording& recording_;
  Subject subject_;
  std::uint32_t at_ = 0, sum_ = first_sum, finished_ = 0, rounds_ = 0;
};

using subject = replay::composed_triangle_thesis;
player<subject>* interrupting = nullptr;
volatile bool inside = false;  // is main() in a tick?
volatile std::uint32_t interruptions = 0, interruptions_inside = 0;
std::uint32_t wrong_rounds = 0, right_rounds = 0, expected = 0;

struct letter {
  std::uint32_t words[12];
};
passive_haptics::exchange<letter> mailbox;
std::uint32_t letters = 0, torn = 0;

/// The next interrupt comes some instructions after this one is done, never at the same place.
void rewind_clock() {
  static std::uint32_t dice = 2463534242U;
  dice ^= dice << 13;
  dice ^= dice >> 17;
  dice ^= dice << 5;
  cortex_m::systick_reload = platform::readings(longest_handler + dice % 977);
  cortex_m::systick_value = 0;
}

/// The sum over a round that nobody interrupts.
std::uint32_t undisturbed() {
  player<subject> alone(recorded::triangle_thesis);
  while (alone.rounds() == 0) alone.step();
  return alone.finished();
}

/// The control: the sum over a round of a model that main() and the interrupt both tick.
std::uint32_t shared_by_both() {
  player<subject> shared(recorded::triangle_thesis);
  interrupting = &shared;
  rewind_clock();
  cortex_m::systick_control = 7;
  while (shared.rounds() == 0) shared.step();
  cortex_m::systick_control = 0;
  return shared.finished();
}

}  // namespace

extern "C" void SysTick_Handler() {
  rewind_clock();
  interruptions = interruptions + 1;
  if (inside) interruptions_inside = interruptions_inside + 1;
  const std::uint32_t before = interrupting->rounds();
  interrupting->step();
  if (interrupting->rounds() != before) {
    ++(interrupting->finished() == expected ? right_rounds : wrong_rounds);
  }
  if (const letter* news = mailbox.take()) {
    ++letters;
    for (const std::uint32_t word : news->words) torn += word != news->words[0] ? 1 : 0;
  }
}

int program() {
  checks check;
  expected = undisturbed();
  check(expected == undisturbed(), "a round", "gives the same twice");

  player<subject> one(recorded::triangle_thesis), other(recorded::triangle_thesis);
  interrupting = &other;
  std::uint32_t disturbed_rounds = 0, number = 0;
  rewind_clock();
  cortex_m::systick_control = 7;  // on, with its interrupt
  while (interruptions < wanted_interruptions) {
    const std::uint32_t before = one.rounds();
    inside = true;
    one.step();
    inside = false;
    if (one.rounds() != before) {
      ++disturbed_rounds;
      check(one.finished() == expected, "the interrupted tick", "gives what it gives undisturbed");
    }
    letter next{};
    ++number;
    for (std::uint32_t& word : next.words) word = number;
    mailbox.publish(next);
  }
  cortex_m::systick_control = 0;

  text_line line;
  line.number(interruptions).words("interruptions,").number(interruptions_inside);
  line.words("inside a tick,").number(disturbed_rounds).words("rounds interrupted,");
  line.number(right_rounds).words("rounds interrupting,").number(letters).words("letters").print();
  check(interruptions_inside > wanted_interruptions / 2, "the interrupt", "comes inside the tick");
  check(disturbed_rounds > 0 && right_rounds > 0, "both", "have played a whole round");
  check(wrong_rounds == 0, "the interrupting tick", "gives what it gives undisturbed");
  check(letters > wanted_interruptions / 2 && torn == 0, "the mailbox", "delivers whole letters");
  check(shared_by_both() != expected, "a model that both tick", "comes out otherwise: the control");
  return check.result();
}
