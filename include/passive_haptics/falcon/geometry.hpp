// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Novint Falcon as a mechanism: its frame, its lengths, its encoders.
//
//        y up                        legs, seen from the front:  0 top, 1 right, 2 left
//        │   z out, to the user      origin: on the axis, in the plane of the thighs' hinges;
//        │ ╱                         z = 0.1346 m at count 0. NO offset is taken off: subtract
//        o──── x right               `workspace.centre` yourself if you want one.
//
//     θ = 35° + (5.13/140.8)°·n      thigh angle from count n [rad]; holds once homed
//
// Lengths and angles are those the Falcon's open drivers agree on (Stamper's delta mechanism with
// an extra offset s per leg); no maker's drawing was ever published, and the 35° is approximate.

#include <passive_haptics/falcon/trigonometry.hpp>
#include <passive_haptics/falcon/triple.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// Lengths of each leg [m].
template <real S>
struct link_lengths {
  S thigh = S(0.060);           ///< a
  S parallelogram = S(0.1025);  ///< b
  S grip = S(0.01443);          ///< c, hinge to the middle of the grip
  S hinges = S(0.0225);         ///< d + e, both ends of the parallelogram
  S side = S(-0.025);           ///< f
  S base = S(0.0400);           ///< r, axis to the thigh's hinge
  S offset = S(-0.02309);       ///< s, sideways
};
template <real S>
inline constexpr link_lengths<S> links{};

/// φ of the legs: 105°, −15°, −135°.
template <real S>
inline constexpr std::array<sine_cosine<S>, 3> leg_directions{
    {{S(0.965925826289068286749743L), S(-0.258819045102520762348899L)},
     {S(-0.258819045102520762348899L), S(0.965925826289068286749743L)},
     {S(-0.707106781186547524400844L), S(-0.707106781186547524400844L)}}};

/// Encoder readings, one per leg.
using counts = std::array<int, 3>;

template <real S>
inline constexpr S angle_at_zero = S(35) * pi<S> / S(180);  ///< θ at n = 0 [rad]
template <real S>
inline constexpr S angle_per_count = S(5.13L / 140.8L) * pi<S> / S(180);  ///< [rad]

template <real S>
[[nodiscard]] constexpr angles<S> to_angles(const counts& n) noexcept {
  angles<S> theta;
  for (std::size_t i = 0; i < 3; ++i) theta[i] = angle_at_zero<S> + angle_per_count<S> * S(n[i]);
  return theta;
}

/// The nearest counts, for |θ| ≤ π.
template <real S>
[[nodiscard]] constexpr counts to_counts(const angles<S>& theta) noexcept {
  counts n{};
  for (std::size_t i = 0; i < 3; ++i) {
    const S exact = (theta[i] - angle_at_zero<S>) / angle_per_count<S>;
    n[i] = static_cast<int>(exact < S(0) ? exact - S(0.5) : exact + S(0.5));
  }
  return n;
}

/// Where the Falcon is at its best: a ball in which θ stays within −17° and 67° and cond(A) ≤ 3.1.
template <real S>
struct ball {
  point<S> centre{{S(0), S(0), S(0.125)}};  ///< [m]
  S radius = S(0.040);                      ///< [m]

  [[nodiscard]] constexpr bool contains(const point<S>& p) const noexcept {
    return dot(p - centre, p - centre) <= radius * radius;
  }
};
template <real S>
inline constexpr ball<S> workspace{};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
