// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Three numbers of one kind, and 3 × 3 matrices of them: all the algebra that three legs need.
// A point is no force and a torque no angle: the kind is part of the type. No Eigen, no allocation,
// every function constexpr.

#include <passive_haptics/base/kernels.hpp>

#include <array>
#include <cstddef>

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

/// Three rows.
template <real S>
struct matrix {
  std::array<std::array<S, 3>, 3> row{};

  [[nodiscard]] constexpr S operator()(std::size_t i, std::size_t j) const noexcept {
    return row[i][j];
  }
  [[nodiscard]] friend constexpr bool operator==(const matrix&, const matrix&) noexcept = default;
};

template <real S, class A, class B>
[[nodiscard]] constexpr S dot(const triple<S, A>& a, const triple<S, B>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <real S, class Kind>
[[nodiscard]] constexpr S norm(const triple<S, Kind>& a) noexcept {
  return kernels::square_root(dot(a, a));
}

template <real S, class Kind>
[[nodiscard]] constexpr bool is_finite(const triple<S, Kind>& a) noexcept {
  return kernels::is_finite(a[0]) && kernels::is_finite(a[1]) && kernels::is_finite(a[2]);
}

/// M a
template <class Result, real S, class Kind>
[[nodiscard]] constexpr Result multiply(const matrix<S>& m, const triple<S, Kind>& a) noexcept {
  Result r;
  for (std::size_t i = 0; i < 3; ++i) {
    r[i] = m(i, 0) * a[0] + m(i, 1) * a[1] + m(i, 2) * a[2];
  }
  return r;
}

/// Mᵀ a
template <class Result, real S, class Kind>
[[nodiscard]] constexpr Result multiply_transposed(const matrix<S>& m,
                                                   const triple<S, Kind>& a) noexcept {
  Result r;
  for (std::size_t j = 0; j < 3; ++j) {
    r[j] = m(0, j) * a[0] + m(1, j) * a[1] + m(2, j) * a[2];
  }
  return r;
}

/// M⁻¹, by cofactors; not finite when M is singular.
template <real S>
[[nodiscard]] constexpr matrix<S> inverse(const matrix<S>& m) noexcept {
  matrix<S> r;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t i1 = (i + 1) % 3;
    const std::size_t i2 = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t j1 = (j + 1) % 3;
      const std::size_t j2 = (j + 2) % 3;
      r.row[j][i] = m(i1, j1) * m(i2, j2) - m(i1, j2) * m(i2, j1);
    }
  }
  const S determinant = m(0, 0) * r(0, 0) + m(0, 1) * r(1, 0) + m(0, 2) * r(2, 0);
  for (auto& row : r.row) {
    for (S& entry : row) entry = entry / determinant;
  }
  return r;
}

/// √Σ mᵢⱼ²
template <real S>
[[nodiscard]] constexpr S frobenius_norm(const matrix<S>& m) noexcept {
  S sum(0);
  for (const auto& row : m.row) {
    for (const S entry : row) sum += entry * entry;
  }
  return kernels::square_root(sum);
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
