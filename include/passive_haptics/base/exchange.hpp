// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// exchange: hands the newest value from one thread to another, whole and without a queue.
//
//     ph::exchange<ph::half_space<scene>> inbox;         // shared
//     inbox.publish(plane);                              // slow thread, 20-100 Hz
//     if (const auto* plane = inbox.take()) touch.update(*plane);  // haptic thread, 1 kHz
//
// It is wait-free for one writer and one reader (two threads, or an interrupt and main()): neither waits, retries
// or touches a slot that the other is using. Its four words are loaded and stored but never swapped, so a core
// without atomic swaps (Cortex-M0, RISC-V without A) needs no library for it.
// port/freshness.hpp limits the age of a value. The opposite direction needs a second exchange.

#include <passive_haptics/base/language.hpp>

#include <array>
#include <atomic>
#include <type_traits>

namespace passive_haptics {
inline namespace v0 {

namespace detail {

/// Assigns four slots, two pairs of two, to the writer and the reader: H. R. Simpson, Four-slot fully asynchronous
/// communication mechanism, IEE Proceedings E 137 (1990) 17-30. `Word` is an atomic word.
///
/// The writer takes the pair that the reader has not announced, and in that pair the slot that is not the newest.
/// The reader must store its announcement before it looks up the newest slot: all words are sequentially
/// consistent, so every run is an interleaving, and tests/base/exchange.cpp tries them all.
template <class Word>
class four_slots {
 public:
  /// Writer: a slot that the reader does not hold and cannot get before filled() is called.
  [[nodiscard]] unsigned free() const noexcept {
    const unsigned pair = 1 - reading_.load();
    return 2 * pair + (1 - newest_[pair].load());
  }
  /// Writer: the slot from free() has the newest value now.
  void filled(unsigned slot) noexcept {
    newest_[slot / 2].store(slot % 2);
    latest_.store(slot / 2);
  }
  /// Reader: the slot of the newest value. The writer keeps off it until the next call.
  [[nodiscard]] unsigned newest() noexcept {
    const unsigned pair = latest_.load();
    if (reading_.load() != pair) reading_.store(pair);
    return 2 * pair + newest_[pair].load();
  }

 private:
  Word latest_{0};                    // the pair of the newest value; the writer stores it
  std::array<Word, 2> newest_{0, 0};  // the newer slot of each pair; the writer stores it
  Word reading_{0};                   // the pair that the reader uses; the reader stores it
};

}  // namespace detail

/// One writer thread, one reader thread. Payload is any trivially copyable type; each side copies it once.
template <class Payload>
class exchange {
  static_assert(std::is_trivially_copyable_v<Payload>,
                "passive_haptics: exchange carries trivially copyable values only: store Eigen "
                "vectors as space::coordinates");

 public:
  exchange() noexcept = default;
  exchange(const exchange&) = delete;
  exchange& operator=(const exchange&) = delete;

  /// Writer only: replaces what the reader has not taken yet.
  void publish(const Payload& value) noexcept {
    const unsigned slot = order_.free();
    slots_[slot] = value;
    order_.filled(slot);
  }

  /// Reader only: the newest value if one came since the last take(), else null. The value stays unchanged
  /// until the next take().
  [[nodiscard]] const Payload* take() noexcept {
    const unsigned slot = order_.newest();
    if (slot == held_) return nullptr;  // the writer has not written there since
    held_ = slot;
    return &slots_[slot];
  }

 private:
  std::array<Payload, 4> slots_{};
  detail::four_slots<std::atomic<unsigned>> order_;
  unsigned held_ = 0;  // the slot that the reader has
};

}  // namespace v0
}  // namespace passive_haptics
