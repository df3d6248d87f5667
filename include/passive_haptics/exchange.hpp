// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// exchange: the newest value from one thread to another, never a queue, never half of one.
//
//     ph::exchange<ph::half_space<scene>> inbox;         // shared
//     inbox.publish(plane);                              // slow thread, 20-100 Hz
//     if (const auto* plane = inbox.take()) touch.update(*plane);  // haptic thread, 1 kHz
//
// Wait-free for one writer and one reader: three slots, one atomic byte. The writer fills its slot
// and swaps it with the middle one; the reader, when the middle one is new, swaps it with its own.
// Nobody ever waits, retries or copies under the other's hands. What to do when nothing new comes
// is the supply's stale-data rule (freshness, supply.hpp). Use a second one for the way back.

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace passive_haptics {
inline namespace v0 {

/// One writer thread, one reader thread. Payload: any trivially copyable value, copied once a side.
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
    slots_[back_] = value;
    const std::uint8_t old =
        middle_.exchange(static_cast<std::uint8_t>(back_ | fresh), std::memory_order_acq_rel);
    back_ = old & slot;
  }

  /// Reader only: the newest value if one came since the last take(), else null. It stays untouched
  /// until the next take().
  [[nodiscard]] const Payload* take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & fresh) == 0) return nullptr;
    const std::uint8_t old = middle_.exchange(front_, std::memory_order_acq_rel);
    front_ = old & slot;
    return &slots_[front_];
  }

 private:
  static constexpr std::uint8_t slot = 3;   // the low bits number a slot
  static constexpr std::uint8_t fresh = 4;  // the reader has not seen it
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);

  std::array<Payload, 3> slots_{};
  std::uint8_t back_ = 0;                // the writer's
  std::atomic<std::uint8_t> middle_{1};  // between the two
  std::uint8_t front_ = 2;               // the reader's
};

}  // namespace v0
}  // namespace passive_haptics
