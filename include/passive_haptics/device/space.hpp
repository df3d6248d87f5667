// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// space<Scalar, Dof>: the space in which a point moves, and the sign convention of the whole library.
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
// A space is also the port of a device that moves such a point (`translation`). A device whose samples are joint
// positions has a joint_space. space<Scalar, 1> computes with plain numbers, in constant expressions too, and includes no
// Eigen; two and three dimensions are in eigen_space.hpp.

#include <passive_haptics/base/kernels.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The work of an effort over a motion.
template <class Scalar>
struct work_done {
  Scalar joules;  ///< f·Δx [J]
  Scalar passed;  ///< Σ |fᵢ Δxᵢ| [J], to which the rounding error of `joules` is proportional
};

namespace detail {

/// Satisfied by the port of a point in a space, where vectors have a length and a direction.
template <class P>
concept has_geometry = requires {
  typename P::geometry;
};
/// Satisfied by the port of a handle that moves and turns, whose efforts are a force and a torque.
template <class P>
concept moves_and_turns = requires(typename P::motion m) {
  P::angular(m);
};

/// |.|² of the three components from `First` on: f or Δp from 0, τ or θ from 3.
template <class P, int First>
[[nodiscard]] constexpr typename P::scalar squared_from(const typename P::motion& m) noexcept {
  const typename P::scalar x = P::component(m, First);
  const typename P::scalar y = P::component(m, First + 1);
  const typename P::scalar z = P::component(m, First + 2);
  return x * x + y * y + z * z;
}

/// The algebra of vectors of `Dof` components, specialised here for Dof = 1 and in eigen_space.hpp for more.
///   scalar        a number
///   vector        for computing: Scalar for Dof 1, Eigen::Matrix<Scalar, Dof, 1> above
///   coordinates   for storing and sending: trivially copyable, converts to and from vector
template <real Scalar, int Dof>
struct vectors {
  static_assert(
      Dof == 1,
      "passive_haptics: vectors are Eigen's: include <passive_haptics/device/eigen_space.hpp>");
};

template <real Scalar>
struct vectors<Scalar, 1> {
  using scalar = Scalar;
  using vector = Scalar;
  using coordinates = Scalar;
  static constexpr int dof = 1;

  [[nodiscard]] static constexpr vector zero() noexcept { return Scalar(0); }
  [[nodiscard]] static constexpr Scalar dot(Scalar a, Scalar b) noexcept { return a * b; }
  [[nodiscard]] static constexpr Scalar norm(Scalar a) noexcept { return kernels::magnitude(a); }
  [[nodiscard]] static constexpr Scalar difference(Scalar a, Scalar b) noexcept { return a - b; }
  [[nodiscard]] static constexpr Scalar scaled(Scalar a, Scalar by) noexcept { return a * by; }
  [[nodiscard]] static constexpr bool is_finite(Scalar a) noexcept { return kernels::is_finite(a); }
  /// Component i, to read and to write.
  [[nodiscard]] static constexpr Scalar component(const Scalar& a, int /*i*/) noexcept { return a; }
  [[nodiscard]] static constexpr Scalar& component(Scalar& a, int /*i*/) noexcept { return a; }
};

/// f·Δx [J] and Σ |fᵢ Δxᵢ| [J], summed from the first component to the last.
template <class Vectors>
[[nodiscard, gnu::always_inline]] constexpr auto work(
    const typename Vectors::vector& effort, const typename Vectors::vector& motion) noexcept {
  using scalar = typename Vectors::scalar;
  scalar joules = Vectors::component(effort, 0) * Vectors::component(motion, 0);
  scalar passed = kernels::magnitude(joules);
  for (int i = 1; i < Vectors::dof; ++i) {
    const scalar along = Vectors::component(effort, i) * Vectors::component(motion, i);
    joules += along;
    passed += kernels::magnitude(along);
  }
  return work_done<scalar>{joules, passed};
}

}  // namespace detail

/// Scalar is float, double or any `real`; Dof is 1, 2 or 3. Models port (port/concepts.hpp).
template <real Scalar, int Dof>
struct space : detail::vectors<Scalar, Dof> {
  static_assert(1 <= Dof && Dof <= 3,
                "passive_haptics: a space has one, two or three dimensions: the joints of a device "
                "are a joint_space");
  using vector = typename detail::vectors<Scalar, Dof>::vector;
  using coordinates = typename detail::vectors<Scalar, Dof>::coordinates;

  using geometry = space;           ///< the space of constraints
  using pose = vector;              ///< [m]
  using motion = vector;            ///< from one pose to another [m]
  using effort = vector;            ///< [N]
  using stored_pose = coordinates;  ///< a pose to store and to send: trivially copyable
  using stored_effort = coordinates;

  [[nodiscard]] static constexpr motion between(const pose& from, const pose& to) noexcept {
    return space::difference(to, from);
  }
  /// f·Δx [J].
  [[nodiscard, gnu::always_inline]] static constexpr auto work(const effort& f,
                                                               const motion& dx) noexcept {
    return detail::work<space>(f, dx);
  }
  /// |Δx|² [m²].
  [[nodiscard]] static constexpr Scalar squared(const motion& dx) noexcept {
    return space::dot(dx, dx);
  }
};

/// The port of a device that moves a point.
template <real Scalar, int Dof>
using translation = space<Scalar, Dof>;

}  // namespace v0
}  // namespace passive_haptics
