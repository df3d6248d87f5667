// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which replies may be believed. Packets have no checksum, and homing moves the origin of the counts
// in one step, perhaps some replies after the homed bits: so a jump, or a leg that is not homed,
// takes `settle` good replies to be forgotten.

#include <passive_haptics/falcon/settings.hpp>

#include <optional>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

template <real S>
class reply_guard {
 public:
  /// ok, encoder_jump, not_homed or settling, for the reply that came at `stamp`.
  [[nodiscard]] constexpr code judge(const from_device& reply, nanoseconds stamp,
                                     const settings<S>& setup) noexcept {
    const bool jumped = heard_ && farther(reply.encoder, most(stamp - *heard_, setup));
    heard_ = stamp;
    encoder_ = reply.encoder;
    if (jumped || !reply.is_homed()) {
      settled_ = 0;
      return jumped ? code::encoder_jump : code::not_homed;
    }
    if (settled_ < setup.settle) ++settled_;
    return settled_ < setup.settle ? code::settling : code::ok;
  }

 private:
  /// Counts that a leg may move in that time; in less than a tick as many as in one.
  [[nodiscard]] static constexpr S most(nanoseconds passed, const settings<S>& setup) noexcept {
    const S ticks = std::chrono::duration<S>(passed).count() / setup.tick;
    return kernels::larger(S(1), ticks) * S(setup.largest_step);
  }
  [[nodiscard]] constexpr bool farther(const leg_words& encoder, S allowed) const noexcept {
    for (std::size_t i = 0; i < encoder.size(); ++i) {
      if (kernels::magnitude(S(encoder[i]) - S(encoder_[i])) > allowed) return true;
    }
    return false;
  }

  leg_words encoder_{};               ///< of the last reply
  std::optional<nanoseconds> heard_;  ///< when it came
  int settled_ = 0;                   ///< good replies in a row
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
