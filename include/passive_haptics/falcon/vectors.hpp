// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The algebra of three legs: triples of numbers of one kind, 3 × 3 matrices, sine and cosine.
// device/eigen_space.hpp does not serve here for three reasons: a microcontroller that turns counts into words
// must not need Eigen (tests/falcon_firmware), every function is constexpr, and the kind is part of the type, so that
// a point cannot be used as a force, nor a torque as an angle.

#include <passive_haptics/base/kernels.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// Components along x, y, z, or of the legs 0 (top), 1 (right), 2 (left).
template <real S, class Kind>
struct triple {
  std::array<S, 3> value{};

  [[nodiscard]] constexpr S operator[](std::size_t i) const noexcept { return value[i]; }
  [[nodiscard]] constexpr S& operator[](std::size_t i) noexcept { return value[i]; }
  [[nodiscard]] friend constexpr bool operator==(const triple&, const triple&) noexcept = default;

  [[nodiscard]] friend constexpr triple operator+(const triple& a, const triple& b) noexcept {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
  }
  [[nodiscard]] friend constexpr triple operator-(const triple& a, const triple& b) noexcept {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }
  [[nodiscard]] friend constexpr triple operator*(S k, const triple& a) noexcept {
    return {{k * a[0], k * a[1], k * a[2]}};
  }
};

template <real S>
using point = triple<S, struct point_kind>;  ///< [m]
template <real S>
using velocity = triple<S, struct velocity_kind>;  ///< [m/s]
template <real S>
using force = triple<S, struct force_kind>;  ///< on the grip [N]
template <real S>
using angles = triple<S, struct angle_kind>;  ///< θ of the thighs [rad]
template <real S>
using torques = triple<S, struct torque_kind>;  ///< of the thighs [N·m]

template <real S, class A, class B>
[[nodiscard]] constexpr S dot(const triple<S, A>& a, const triple<S, B>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <real S, class Kind>
[[nodiscard]] constexpr S norm(const triple<S, Kind>& a) noexcept {
  return kernels::square_root(dot(a, a));
}

/// The largest |aᵢ|.
template <real S, class Kind>
[[nodiscard]] constexpr S largest_in(const triple<S, Kind>& a) noexcept {
  using kernels::larger, kernels::magnitude;
  return larger(larger(magnitude(a[0]), magnitude(a[1])), magnitude(a[2]));
}

template <real S, class Kind>
[[nodiscard]] constexpr bool is_finite(const triple<S, Kind>& a) noexcept {
  return kernels::is_finite(a[0]) && kernels::is_finite(a[1]) && kernels::is_finite(a[2]);
}

template <real S>
struct matrix {
  using row_type = triple<S, struct row_kind>;
  std::array<row_type, 3> row{};

  [[nodiscard]] constexpr S operator()(std::size_t i, std::size_t j) const noexcept {
    return row[i][j];
  }
  [[nodiscard]] friend constexpr bool operator==(const matrix&, const matrix&) noexcept = default;
};

template <real S>
[[nodiscard]] constexpr matrix<S> transposed(const matrix<S>& m) noexcept {
  return {{{{{m(0, 0), m(1, 0), m(2, 0)}},
            {{m(0, 1), m(1, 1), m(2, 1)}},
            {{m(0, 2), m(1, 2), m(2, 2)}}}}};
}

/// M a
template <class Result, real S, class Kind>
[[nodiscard]] constexpr Result multiply(const matrix<S>& m, const triple<S, Kind>& a) noexcept {
  return {{dot(m.row[0], a), dot(m.row[1], a), dot(m.row[2], a)}};
}

/// M⁻¹, whose columns are rᵢ₊₁ × rᵢ₊₂/det for the rows r of M; not finite if M is singular.
template <real S>
[[nodiscard]] constexpr matrix<S> inverse(const matrix<S>& m) noexcept {
  const auto cross = [](const auto& a, const auto& b) -> typename matrix<S>::row_type {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  };
  const auto& [r0, r1, r2] = m.row;
  matrix<S> r = transposed(matrix<S>{{cross(r1, r2), cross(r2, r0), cross(r0, r1)}});
  const S determinant = m(0, 0) * r(0, 0) + m(0, 1) * r(1, 0) + m(0, 2) * r(2, 0);
  for (auto& row : r.row) {
    for (S& entry : row.value) entry = entry / determinant;
  }
  return r;
}

/// √Σ mᵢⱼ²
template <real S>
[[nodiscard]] constexpr S frobenius_norm(const matrix<S>& m) noexcept {
  S sum(0);
  for (const auto& row : m.row) {
    for (const S entry : row.value) sum += entry * entry;
  }
  return kernels::square_root(sum);
}

template <real S>
inline constexpr S pi = S(3.14159265358979323846264338327950288L);

template <real S>
struct sine_cosine {
  S sine, cosine;
};

/// sin φ and cos φ, φ in [rad], by cmath; in a constant expression by their power series, for |φ| ≤ 2π.
template <real S>
[[nodiscard]] constexpr sine_cosine<S> sine_cosine_of(S angle) noexcept {
  using std::cos, std::sin;
  if (!std::is_constant_evaluated()) return {S(sin(angle)), S(cos(angle))};
  sine_cosine<S> sum{S(0), S(0)};
  S term(1);  // ±φᵏ/k!
  for (int k = 0; k < 48; k += 2) {
    sum.cosine += term;
    term *= angle / S(k + 1);
    sum.sine += term;
    term *= -angle / S(k + 2);
  }
  return sum;
}

/// The angle of (x, y) from the x axis, in [−π, π] rad; in a constant expression by Newton's iteration.
template <real S>
[[nodiscard]] constexpr S angle_of(S y, S x) noexcept {
  using std::atan2;
  if (!std::is_constant_evaluated()) return S(atan2(y, x));
  const S quarter = y < S(0) ? -pi<S> / S(2) : pi<S> / S(2);
  S angle = x >= kernels::magnitude(y)   ? S(0)
            : -x > kernels::magnitude(y) ? S(2) * quarter
                                         : quarter;
  for (int i = 0; i < 8; ++i) {
    const auto [s, c] = sine_cosine_of(angle);
    const S along = x * c + y * s;
    if (along > S(0)) angle += (y * c - x * s) / along;
  }
  return angle;
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
