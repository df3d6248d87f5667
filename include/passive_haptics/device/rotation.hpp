// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rotations as unit quaternions and rotation vectors, all in the WORLD frame.
//
//   quaternion   w + xi + yj + zk, rotates a vector from handle to world frame; q and −q are the same rotation
//   exp, log     rotation vector [rad] to quaternion and back, |log(q)| ≤ π
//   turned       Log(R₁R₀ᵀ) [rad]: the shortest rotation from one orientation to another
//   rotate       R v, a vector rotated by q

#include <passive_haptics/device/eigen_space.hpp>

#include <cmath>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// A quaternion, which is a rotation if its norm is one. The default is the identity.
template <real Scalar>
struct quaternion {
  Scalar w{1}, x{}, y{}, z{};
};

namespace detail {
/// True if four terms of a series are exact to rounding in this scalar, for arguments below 1e-4.
template <class S>
inline constexpr bool four_terms = std::floating_point<S>&& std::numeric_limits<S>::digits <= 53;
}  // namespace detail

namespace rotation {

template <real S>
using vector = typename detail::vectors<S, 3>::vector;

template <real S>
[[nodiscard]] constexpr S squared_norm(const quaternion<S>& q) noexcept {
  return q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
}
/// True if the norm is within 1e-3 of 1, which admits rotations that were rounded or have drifted; false for NaN.
template <real S>
[[nodiscard]] constexpr bool is_unit(const quaternion<S>& q) noexcept {
  return kernels::magnitude(S(squared_norm(q) - S(1))) <= S(2e-3);
}
/// q/|q|, for any norm but zero. Next to norm one, (1 + e)^(−1/2) comes from its series: no root, no division.
template <real S>
[[nodiscard]] constexpr quaternion<S> normalised(const quaternion<S>& q) noexcept {
  const S square = squared_norm(q);
  S factor{};
  const S e = square - S(1);
  if (passive_haptics::detail::four_terms<S> && kernels::magnitude(e) < S(1e-4)) {
    factor = S(1) - e * (S(0.5) - e * (S(0.375) - e * S(0.3125)));
  } else {
    factor = S(1) / kernels::square_root(square);
  }
  return {q.w * factor, q.x * factor, q.y * factor, q.z * factor};
}
template <real S>
[[nodiscard]] constexpr quaternion<S> conjugate(const quaternion<S>& q) noexcept {
  return {q.w, -q.x, -q.y, -q.z};
}
/// The product ab: first the rotation b, then a.
template <real S>
[[nodiscard]] constexpr quaternion<S> product(const quaternion<S>& a,
                                              const quaternion<S>& b) noexcept {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}
/// R v, the vector v rotated by q.
template <real S>
[[nodiscard]] vector<S> rotate(const quaternion<S>& q, const vector<S>& v) noexcept {
  using algebra = detail::vectors<S, 3>;
  const vector<S> axis(q.x, q.y, q.z);
  const vector<S> t = algebra::cross(axis, v) * S(2);
  return v + t * q.w + algebra::cross(axis, t);
}

namespace detail {

/// asin(s)/s from its series, for s² < 1e-4.
template <real S>
[[nodiscard]] constexpr S arc_over_sine(S squared) noexcept {
  if constexpr (passive_haptics::detail::four_terms<S>) {
    return S(1) + squared * (S(1.0 / 6.0) + squared * (S(0.075) + squared * S(5.0 / 112.0)));
  }
  S sum(1), term(1), odd(1);
  for (int k = 0; k < 64; ++k) {
    term = term * squared * odd * odd / ((odd + S(1)) * (odd + S(2)));
    odd = odd + S(2);
    const S next = sum + term;
    if (!(next > sum)) break;
    sum = next;
  }
  return sum;
}
/// The rotation vector [rad] of the unit quaternion w + v, w ≥ 0.
template <real S>
[[nodiscard]] vector<S> shortest(S w, const vector<S>& v) noexcept {
  const S squared = passive_haptics::detail::vectors<S, 3>::dot(v, v);
  if (squared < S(1e-4)) return v * S(S(2) * arc_over_sine(squared));
  using std::atan2;
  const S sine = kernels::square_root(squared);
  return v * S(S(2) * atan2(sine, w) / sine);
}

}  // namespace detail

/// The rotation vector [rad] of the unit quaternion q; its length is at most π.
template <real S>
[[nodiscard]] vector<S> log(const quaternion<S>& q) noexcept {
  const vector<S> v(q.x, q.y, q.z);
  if (q.w < S(0)) return detail::shortest(S(-q.w), vector<S>(-v));
  return detail::shortest(q.w, v);
}
/// The quaternion of a turn by |turn| [rad] about the direction of `turn`.
template <real S>
[[nodiscard]] quaternion<S> exp(const vector<S>& turn) noexcept {
  using std::cos, std::sin;
  const S angle = passive_haptics::detail::vectors<S, 3>::norm(turn);
  const S half = angle / S(2);
  const S share = angle > S(1e-4) ? S(sin(half) / angle) : S((S(1) - half * half / S(6)) / S(2));
  return {S(cos(half)), S(turn(0) * share), S(turn(1) * share), S(turn(2) * share)};
}
/// Log(R₁R₀ᵀ) [rad] of two quaternions of norm one. It is computed from their difference, so that a turn
/// of 1e-9 rad is as exact, relative to itself, as a large one, and none at all is exactly zero.
template <real S>
[[nodiscard]] vector<S> turned(const quaternion<S>& from, quaternion<S> to) noexcept {
  using algebra = passive_haptics::detail::vectors<S, 3>;
  const S along = from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z;
  if (along < S(0)) to = {-to.w, -to.x, -to.y, -to.z};
  const vector<S> axis(from.x, from.y, from.z);
  const vector<S> change(to.x - from.x, to.y - from.y, to.z - from.z);
  const S change_w = to.w - from.w;
  const vector<S> v = change * from.w - axis * change_w - algebra::cross(change, axis);
  return detail::shortest(kernels::magnitude(along), v);
}

}  // namespace rotation

}  // namespace v0
}  // namespace passive_haptics
