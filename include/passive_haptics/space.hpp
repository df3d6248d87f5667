// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// space<Scalar, Dof>: the port of the device, and the sign convention of the whole library.
//
//              outside          │ surface       inside the object
//                               │
//        n  ◀───────────────────┤ p
//                               │        x  ·
//                               │◀── d ──▶
//
//     n   UNIT outward normal          d = (p − x)·n   penetration [m], > 0 inside
//     x   device position [m]          f = K d n       force ON THE DEVICE [N], along +n
//     Δx  = x(n) − x(n−1)              E1 += Δxᵀ B Δx − f_held·Δx   [J], > 0: hand → device
//
// Pressing in gives Δx·n < 0, so −f·Δx > 0: the ledger grows. Leaving, it falls. (The thesis mixes
// two conventions; docs/design/audit.md, A1-A3.)
//
// One degree of freedom needs no vectors: space<Scalar, 1> computes with plain numbers, in constant
// expressions too, and includes no Eigen. Two and more are in eigen_space.hpp.

#include <passive_haptics/kernels.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The port: Scalar is float, double or any `real`; Dof ≥ 1 is a compile-time constant.
///   scalar        a number
///   vector        what is computed with: Scalar for Dof 1, Eigen::Matrix<Scalar, Dof, 1> above
///   coordinates   what is stored and sent: trivially copyable, converts to and from vector
template <real Scalar, int Dof>
struct space;

template <real Scalar>
struct space<Scalar, 1> {
  using scalar = Scalar;
  using vector = Scalar;
  using coordinates = Scalar;
  static constexpr int dof = 1;

  [[nodiscard]] static constexpr vector zero() noexcept { return Scalar(0); }
  [[nodiscard]] static constexpr Scalar dot(Scalar a, Scalar b) noexcept { return a * b; }
  [[nodiscard]] static constexpr Scalar norm(Scalar a) noexcept { return a < Scalar(0) ? -a : a; }
  [[nodiscard]] static constexpr bool is_finite(Scalar a) noexcept { return kernels::is_finite(a); }
  /// Σ wᵢ aᵢ², the quadratic form of a diagonal matrix.
  [[nodiscard]] static constexpr Scalar weighted_square(Scalar w, Scalar a) noexcept {
    return w * a * a;
  }
  /// Σ aᵢ²/wᵢ, the quadratic form of its inverse.
  [[nodiscard]] static constexpr Scalar inversely_weighted_square(Scalar w, Scalar a) noexcept {
    return a * a / w;
  }
  /// Component i, to read and to write.
  [[nodiscard]] static constexpr Scalar component(const Scalar& a, int /*i*/) noexcept { return a; }
  [[nodiscard]] static constexpr Scalar& component(Scalar& a, int /*i*/) noexcept { return a; }
  /// The smallest component.
  [[nodiscard]] static constexpr Scalar smallest(Scalar a) noexcept { return a; }
};

}  // namespace v0
}  // namespace passive_haptics
