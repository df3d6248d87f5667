// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand of limited force that tries to draw energy out of a controller, on the exact device.
// The menu is in adversary.hpp.

#include <passive_haptics/simulation/hand.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// Either a tapping_hand, which reverses at the surface and between two ticks if need be, or a push that the
/// caller may change at any time. Its force is at most taps.limit [N].
template <class Space>
struct striking_hand {
  using vector = typename physical<Space>::vector;
  using coordinates = typename physical<Space>::coordinates;

  tapping_hand<Space> taps{};  ///< acts while `tapping`; its limit counts for the push, too
  coordinates push{};          ///< force while not tapping [N]
  bool tapping = true;

  [[nodiscard]] constexpr vector force(double t, const vector& x, const vector& v) const noexcept {
    return tapping ? taps.force(t, x, v) : clamp_norm<Space>(push, taps.limit);
  }
  [[nodiscard]] constexpr double mass() const noexcept { return taps.mass(); }
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return taps.check(); }
};

static_assert(hand_for<striking_hand<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
