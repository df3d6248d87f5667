// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// sin, cos and atan2 that also work in a constant expression; at run time, those of <cmath>.

#include <passive_haptics/base/kernels.hpp>

#include <cmath>
#include <type_traits>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

template <real S>
inline constexpr S pi = S(3.14159265358979323846264338327950288L);

template <real S>
struct sine_cosine {
  S sine, cosine;
};

/// sin φ and cos φ [rad]; |φ| ≤ 2π in a constant expression (power series).
template <real S>
[[nodiscard]] constexpr sine_cosine<S> sine_cosine_of(S angle) noexcept {
  if (std::is_constant_evaluated()) {
    S sine(0);
    S cosine(0);
    S term(1);  // φᵏ/k!
    for (int k = 0; k < 48; k += 2) {
      const S sign = k % 4 == 0 ? S(1) : S(-1);
      cosine += sign * term;
      term *= angle / S(k + 1);
      sine += sign * term;
      term *= angle / S(k + 2);
    }
    return {sine, cosine};
  }
  using std::cos;
  using std::sin;
  return {S(sin(angle)), S(cos(angle))};
}

/// The angle of (x, y) from the x axis, in [−π, π]; by Newton's iteration in a constant expression.
template <real S>
[[nodiscard]] constexpr S angle_of(S y, S x) noexcept {
  if (std::is_constant_evaluated()) {
    const S quarter = pi<S> / S(2);
    S angle = x >= kernels::magnitude(y) ? S(0) : y > S(0) ? quarter : -quarter;
    if (-x > kernels::magnitude(y)) angle = y < S(0) ? -pi<S> : pi<S>;
    for (int i = 0; i < 8; ++i) {
      const auto [s, c] = sine_cosine_of(angle);
      const S along = x * c + y * s;
      if (along > S(0)) angle += (y * c - x * s) / along;
    }
    return angle;
  }
  using std::atan2;
  return S(atan2(y, x));
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
