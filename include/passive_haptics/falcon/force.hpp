// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From a force at the grip to the three words the motors get, and back.
//
//     τ = A⁻ᵀ F          torques_for       so that F·v = τ·θ̇ for every v
//     F = Aᵀ τ           force_from
//     word = −round(k τ) encode            if one is beyond ±4095, ONE factor shortens all three, so the
//     τ = −word/k        decode            direction of the force is kept and no word wraps
//
// The gain k [DAC counts per N·m] has never been published. Indirect values lie between 2500 and 4000; with the 10 000
// of other drivers forces are about three times too large. Calibrate it (docs/falcon.md).

#include <passive_haptics/falcon/kinematics.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// The words for the motors of legs 0, 1, 2. A positive word pulls the arm in.
using dac_words = std::array<std::int16_t, 3>;

inline constexpr int largest_word = 4095;  ///< of either sign; beyond it motors saturate

/// A gain [counts per N·m] with which no force exceeds its command if the true gain is ≥ this.
template <real S>
inline constexpr S cautious_gain = S(3500);

/// τ = A⁻ᵀ F [N·m], for A in [1/m]. All are zero if A is singular or anything is not finite.
template <real S>
[[nodiscard]] constexpr torques<S> torques_for(const matrix<S>& A, const force<S>& f) noexcept {
  const auto tau = multiply<torques<S>>(transposed(inverse(A)), f);
  return is_finite(tau) ? tau : torques<S>{};
}

/// F = Aᵀ τ [N].
template <real S>
[[nodiscard]] constexpr force<S> force_from(const matrix<S>& A, const torques<S>& tau) noexcept {
  return multiply<force<S>>(transposed(A), tau);
}

/// F shortened to ‖F‖ ≤ most [N], the direction kept; zero if a component is not finite.
template <real S>
[[nodiscard]] constexpr force<S> limited(const force<S>& f, S most) noexcept {
  if (!is_finite(f) || !(most > S(0))) return {};
  const S largest = largest_in(f);  // f is scaled by it, so that no square overflows
  if (!(largest > S(0))) return f;
  const force<S> direction = S(1) / largest * f;
  const S length = norm(direction) * largest;
  return length > most ? most / norm(direction) * direction : f;
}

/// The words for torques [N·m] at a gain [counts per N·m]. All are zero if a torque is not finite or the gain
/// not finite and > 0.
template <real S>
[[nodiscard]] constexpr dac_words encode(const torques<S>& tau, S gain) noexcept {
  if (!is_finite(tau) || !(gain > S(0)) || !kernels::is_finite(gain)) return {};
  const S largest = largest_in(tau);
  const S most = S(largest_word) / gain;
  const S scale = largest > most ? most / largest : S(1);
  dac_words words{};
  for (std::size_t i = 0; i < 3; ++i) {
    words[i] = static_cast<std::int16_t>(detail::nearest(-gain * (scale * tau[i])));
  }
  return words;
}

/// The torques [N·m] that words stand for.
template <real S>
[[nodiscard]] constexpr torques<S> decode(const dac_words& words, S gain) noexcept {
  torques<S> tau;
  for (std::size_t i = 0; i < 3; ++i) tau[i] = -S(words[i]) / gain;
  return tau;
}

/// The constant force [N] that does the work of constant torques over one tick, F·Δp = τ·Δθ: the motors
/// hold torques while the pose, and so the force, changes. It is `f`, the force at the new pose, corrected
/// along Δp, and `f` itself if Δp is too short.
template <real S>
[[nodiscard]] constexpr force<S> force_over(const force<S>& f, const torques<S>& tau,
                                            const angles<S>& turned,
                                            const point<S>& moved) noexcept {
  constexpr S shortest = S(1e-6);  // [m], a twentieth of the finest count
  const S square = dot(moved, moved);
  if (!(square > shortest * shortest)) return f;
  const S missing = (dot(tau, turned) - dot(f, moved)) / square;
  return f + missing * force<S>{moved.value};
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
