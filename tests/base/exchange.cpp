// SPDX-License-Identifier: BSD-3-Clause
// Every interleaving of a writer and a reader of exchange, however long they go on. Sequentially
// consistent words can be accessed in no other ways than these, so what holds here holds for threads,
// for two cores and for an interrupt. It is the library's own code that is tried, on words that stop it
// after each access; threads/exchange.cpp tries it on threads.
#include "support/catch.hpp"
#include <passive_haptics/base/exchange.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <vector>

namespace {

namespace ph = passive_haptics;

/// A call that is made access by access. To get one access farther it is made again from its start: the
/// loads already made get the answers they got, one access more is made, and the rest does nothing.
class slow_call {
 public:
  static constexpr unsigned longest = 4;  // accesses
  using memory = std::array<unsigned, longest + 1>;

  /// Makes one more access. True if it was the last: then `result` is what the call returns.
  template <class Call>
  bool advance(const Call& call, unsigned& result) {
    now = this;
    at_ = 0;
    const unsigned answer = call();
    const bool over = ++made_ == at_;
    if (made_ > longest) FAIL("a call of more than " << longest << " accesses");
    if (over) {
      result = answer;
      *this = {};
    }
    return over;
  }
  unsigned load(unsigned value) {
    const unsigned here = at_++;
    if (here > made_) return 0;
    if (here == made_) answers_[here] = value;
    return answers_[here];
  }
  void store(unsigned& value, unsigned next) {
    if (at_++ == made_) value = next;
  }
  [[nodiscard]] bool begun() const { return made_ > 0; }
  /// All that the rest of the call depends on.
  [[nodiscard]] memory remembered() const {
    memory all{made_};
    std::copy_n(answers_.begin(), made_, all.begin() + 1);
    return all;
  }

  static inline slow_call* now = nullptr;

 private:
  std::array<unsigned, longest> answers_{};
  unsigned made_ = 0, at_ = 0;
};

/// In the place of std::atomic<unsigned>.
struct slow_word {
  unsigned value;
  slow_word(unsigned v) : value(v) {}
  [[nodiscard]] unsigned load() const { return slow_call::now->load(value); }
  void store(unsigned next) { slow_call::now->store(value, next); }
};

/// A writer and a reader of four slots, at some point of their ways, and what has gone wrong.
template <class Order>
class meeting {
 public:
  using key = std::array<int, 26>;
  enum fault : unsigned { half = 1, overwritten = 2, backwards = 4, missed = 8 };

  [[nodiscard]] unsigned faults() const { return faults_; }

  void writer_goes_on() {
    if (writer_ == choosing) {
      if (!writing_.advance([this] { return order_.free(); }, back_)) return;
      slots_[back_] = torn;
      writer_ = filling;
    } else if (writer_ == filling) {
      slots_[back_] = ++written_;
      writer_ = telling;
    } else {
      const auto filled = [this] { return order_.filled(back_), 0U; };
      unsigned nothing = 0;
      if (!writing_.advance(filled, nothing)) return;
      published_ = written_;
      writer_ = choosing;
    }
    look();
  }
  void reader_goes_on() {
    if (!reading_.begun()) known_ = published_;
    unsigned slot = 0;
    if (!reading_.advance([this] { return order_.newest(); }, slot)) return;
    if (slot != held_) {
      if (slots_[slot] == torn) faults_ |= half;
      if (slots_[slot] <= taken_) faults_ |= backwards;
      taken_ = slots_[slot];
      held_ = slot;
    }
    if (taken_ < known_) faults_ |= missed;
    look();
  }

  /// Two meetings of the same key have the same future: of the values only their order counts.
  [[nodiscard]] key remembered() const {
    std::vector<int> values(slots_.begin(), slots_.end());
    for (const int value : {written_, published_, taken_, known_}) values.push_back(value);
    std::vector<int> sorted = values;
    sorted.push_back(torn);
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    for (int& value : values) {
      value =
          static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
    }
    key all{};
    auto end = std::copy(values.begin(), values.end(), all.begin());
    const auto words = std::bit_cast<std::array<unsigned, 4>>(order_);
    end = std::copy(words.begin(), words.end(), end);
    for (const slow_call* call : {&writing_, &reading_}) {
      const auto memory = call->remembered();
      end = std::copy(memory.begin(), memory.end(), end);
    }
    for (const unsigned value : {static_cast<unsigned>(writer_), back_, held_, faults_}) {
      *end++ = static_cast<int>(value);
    }
    return all;
  }

 private:
  enum stage { choosing, filling, telling };
  static constexpr int torn = -1;

  /// Between two calls the reader's value is its own.
  void look() {
    if (!reading_.begun() && slots_[held_] != taken_) faults_ |= overwritten;
  }

  Order order_;
  std::array<int, 4> slots_{};  ///< which value stands there, 1, 2, 3 …; 0 before the first
  slow_call writing_, reading_;
  stage writer_ = choosing;
  unsigned back_ = 0, held_ = 0;
  int written_ = 0, published_ = 0, taken_ = 0;
  int known_ = 0;  ///< published before the reader's call began
  unsigned faults_ = 0;
};

struct outcome {
  unsigned faults = 0;
  std::size_t meetings = 0;
};

/// Every meeting that can come about.
template <class Order>
outcome every_interleaving() {
  using meeting = meeting<Order>;
  outcome result;
  std::set<typename meeting::key> seen{meeting().remembered()};
  std::vector<meeting> open{meeting()};
  while (!open.empty()) {
    const meeting here = open.back();
    open.pop_back();
    ++result.meetings;
    result.faults |= here.faults();
    if (here.faults() != 0) continue;
    for (const auto move : {&meeting::writer_goes_on, &meeting::reader_goes_on}) {
      meeting next = here;
      (next.*move)();
      if (seen.insert(next.remembered()).second) open.push_back(next);
    }
  }
  return result;
}

enum class mistake { none, announced_late, never_announced, latest_told_first, same_slot_again };

/// Four slots once more, with one mistake.
template <mistake Made>
class mistaken {
 public:
  [[nodiscard]] unsigned free() const {
    const unsigned pair = 1 - (Made == mistake::never_announced ? latest_ : reading_).load();
    const unsigned newest = newest_[pair].load();
    return 2 * pair + (Made == mistake::same_slot_again ? newest : 1 - newest);
  }
  void filled(unsigned slot) {
    if (Made == mistake::latest_told_first) latest_.store(slot / 2);
    newest_[slot / 2].store(slot % 2);
    if (Made != mistake::latest_told_first) latest_.store(slot / 2);
  }
  [[nodiscard]] unsigned newest() {
    const unsigned pair = latest_.load();
    if (Made != mistake::announced_late) reading_.store(pair);
    const unsigned newest = newest_[pair].load();
    if (Made == mistake::announced_late) reading_.store(pair);
    return 2 * pair + newest;
  }

 private:
  slow_word latest_{0};
  std::array<slow_word, 2> newest_{0, 0};
  slow_word reading_{0};
};

}  // namespace

TEST_CASE("exchange is right in every interleaving of its writer and its reader", "[exchange]") {
  const auto found = every_interleaving<ph::detail::four_slots<slow_word>>();
  CHECK(found.faults == 0);
  CHECK(found.meetings > 500);
}

TEST_CASE("the interleavings find what is wrong with four slots that nearly work", "[exchange]") {
  CHECK(every_interleaving<mistaken<mistake::none>>().faults == 0);
  CHECK(every_interleaving<mistaken<mistake::announced_late>>().faults != 0);
  CHECK(every_interleaving<mistaken<mistake::never_announced>>().faults != 0);
  CHECK(every_interleaving<mistaken<mistake::latest_told_first>>().faults != 0);
  CHECK(every_interleaving<mistaken<mistake::same_slot_again>>().faults != 0);
}

TEST_CASE("the reader gets the newest value, once, and keeps it while others are published",
          "[exchange]") {
  ph::exchange<std::array<int, 2>> news;
  CHECK(news.take() == nullptr);
  const auto value = [](int n) { return std::array{n, -n}; };
  for (int n = 1; n < 200; ++n) {
    for (int k = 0; k < n % 4; ++k) news.publish(value(1000 + k));  // which nobody takes
    news.publish(value(n));
    const std::array<int, 2>* taken = news.take();
    REQUIRE(taken != nullptr);
    REQUIRE(*taken == value(n));
    CHECK(news.take() == nullptr);
    for (int k = 0; k < n % 5; ++k) news.publish(value(2000 + k));
    CHECK(*taken == value(n));
  }
}
