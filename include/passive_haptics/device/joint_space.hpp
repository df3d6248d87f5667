// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// joint_space<Scalar, Joints>: the port of a device whose samples are joint positions, a gripper's included.
//
// A pose holds angles [rad] or travels [m], an effort torques [N·m] or forces [N]. The motors hold their torques between
// two samples, so τ·Δq is exactly their work in any mechanism (lemma J, docs/design/mathematics.md).
// A joint_space has neither geometry nor length of a vector, because a radian and a metre do not add up:
// constraints, directions and limits of a force in newtons need a space. Its damping is diagonal_damping,
// with a number for each joint.

#include <passive_haptics/device/eigen_space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Scalar is float, double or any `real`; Joints ≥ 1. Models port (port/concepts.hpp).
template <real Scalar, int Joints>
struct joint_space {
  static_assert(Joints >= 1, "passive_haptics: a joint_space has one joint or more");

 private:
  using algebra = detail::vectors<Scalar, Joints>;

 public:
  using scalar = Scalar;
  static constexpr int dof = Joints;
  using vector = typename algebra::vector;
  using coordinates = typename algebra::coordinates;

  using pose = vector;    ///< [rad], or [m] where a joint slides
  using motion = vector;  ///< from one pose to another [rad], [m]
  using effort = vector;  ///< [N·m], [N]
  using stored_pose = coordinates;
  using stored_effort = coordinates;

  [[nodiscard]] static constexpr vector zero() noexcept { return algebra::zero(); }
  [[nodiscard]] static constexpr bool is_finite(const vector& a) noexcept {
    return algebra::is_finite(a);
  }
  /// Joint i of a vector or of coordinates, to read and to write.
  template <class Vector>
  [[nodiscard]] static constexpr decltype(auto) component(Vector& a, int i) noexcept {
    return algebra::component(a, i);
  }
  [[nodiscard]] static constexpr motion between(const pose& from, const pose& to) noexcept {
    return to - from;
  }
  /// τ·Δq [J], and the sum Σ |τᵢ Δqᵢ| beside it.
  [[nodiscard]] static constexpr auto work(const effort& torque, const motion& turned) noexcept {
    return detail::work<algebra>(torque, turned);
  }
  /// max Δqᵢ² [rad²]: loop_limits::top_speed limits the fastest joint.
  [[nodiscard]] static constexpr Scalar squared(const motion& turned) noexcept {
    Scalar most(0);
    for (int i = 0; i < dof; ++i) {
      const Scalar one = component(turned, i) * component(turned, i);
      if (one > most || one != one) most = one;  // a NaN is taken and kept
    }
    return most;
  }
};

}  // namespace v0
}  // namespace passive_haptics
