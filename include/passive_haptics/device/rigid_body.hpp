// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// rigid_body<Scalar>: the port of a handle that moves and turns, with motors for all six.
//
//     pose     p [m], q             where the handle point is, and how the handle is turned
//     motion   (Δp, θ) [m], [rad]   θ = Log(R₁R₀ᵀ), the shortest turn, in the WORLD frame
//     effort   (f, τ) [N], [N·m]    at the handle point, in the world frame, held there over the tick
//
// The work of a wrench is computed as f·Δp + τ·θ. If the path of a tick is not straight, the true work differs;
// rigid_damping bounds the difference, so this port needs it (lemma C, docs/design/six_dof.md).
// If a driver reports the work of its motors, use reported_work.hpp.
//
// Metres and radians do not add up, so a motion or an effort has no length here, and parts that need a length
// refuse this port. loop_limits::top_speed counts a radian as 0.1 m, so 5 m/s is 50 rad/s, too.

#include <passive_haptics/device/rotation.hpp>

namespace passive_haptics {
inline namespace v0 {

struct rigid_damping;

/// Position and orientation of a handle. The same plain struct is stored, sent and computed with.
template <real Scalar>
struct rigid_pose {
  stored_vector<Scalar, 3> position{};  ///< p of the handle point [m]
  quaternion<Scalar> orientation{};     ///< from the handle to the world; q and −q are the same
};

namespace detail {

/// The common part of the ports whose pose is a rigid_pose.
template <real Scalar>
struct rigid_poses {
  using scalar = Scalar;
  using pose = rigid_pose<Scalar>;
  using stored_pose = rigid_pose<Scalar>;
  using body_space = space<Scalar, 3>;  ///< where the handle point moves

  /// Position of the handle point [m], to which loop_limits::workspace applies.
  [[nodiscard]] static typename body_space::vector place(const pose& x) noexcept {
    return x.position;
  }
  /// True if the position is finite and the orientation a rotation, of a norm within 1e-3 of 1.
  [[nodiscard]] static bool is_finite(const pose& x) noexcept {
    return body_space::is_finite(place(x)) && rotation::is_unit(x.orientation);
  }
};

}  // namespace detail

/// Scalar is float, double or any `real`. Models port (port/concepts.hpp).
template <real Scalar>
struct rigid_body : detail::rigid_poses<Scalar> {
 private:
  using algebra = detail::vectors<Scalar, 6>;
  using poses = detail::rigid_poses<Scalar>;

 public:
  static constexpr int dof = 6;
  static constexpr bool turns = true;      ///< the end poses of a tick do not determine its path
  using damping_of_turns = rigid_damping;  ///< it bounds the resulting error of the work
  using vector = typename algebra::vector;
  using coordinates = typename algebra::coordinates;
  using triple = typename poses::body_space::vector;

  using typename poses::pose;
  using motion = vector;  ///< (Δp, θ) [m], [rad]
  using effort = vector;  ///< (f, τ) [N], [N·m]
  using stored_effort = coordinates;

  [[nodiscard]] static vector zero() noexcept { return algebra::zero(); }
  using poses::is_finite;
  [[nodiscard]] static bool is_finite(const vector& a) noexcept { return algebra::is_finite(a); }
  template <class Vector>
  [[nodiscard]] static decltype(auto) component(Vector& a, int i) noexcept {
    return algebra::component(a, i);
  }
  /// Δp [m] of a motion, f [N] of an effort.
  [[nodiscard]] static triple linear(const vector& a) noexcept { return {a(0), a(1), a(2)}; }
  /// θ [rad] of a motion, τ [N·m] of an effort.
  [[nodiscard]] static triple angular(const vector& a) noexcept { return {a(3), a(4), a(5)}; }
  [[nodiscard]] static vector join(const triple& linear, const triple& angular) noexcept {
    vector all;
    for (int i = 0; i < 3; ++i) {
      all(i) = linear(i);
      all(i + 3) = angular(i);
    }
    return all;
  }

  /// (Δp, θ). If a quaternion is not of norm one, θ is NaN, so that no ledger books the motion.
  [[nodiscard]] static motion between(const pose& from, const pose& to) noexcept {
    const triple travel = triple(to.position) - triple(from.position);
    if (!rotation::is_unit(from.orientation) || !rotation::is_unit(to.orientation)) {
      const Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
      return join(travel, {nan, nan, nan});
    }
    return join(travel, rotation::turned(rotation::normalised(from.orientation),
                                         rotation::normalised(to.orientation)));
  }
  /// The pose that a motion leads to.
  [[nodiscard]] static pose moved(const pose& from, const motion& by) noexcept {
    const auto turned = rotation::product(rotation::exp<Scalar>(angular(by)), from.orientation);
    return {triple(triple(from.position) + linear(by)), rotation::normalised(turned)};
  }
  /// f·Δp + τ·θ [J].
  [[nodiscard]] static auto work(const effort& w, const motion& m) noexcept {
    return detail::work<algebra>(w, m);
  }
  /// The larger of |Δp|² and (0.1 m/rad · |θ|)² [m²].
  [[nodiscard]] static Scalar squared(const motion& m) noexcept {
    const Scalar gone = detail::squared_from<rigid_body, 0>(m);
    const Scalar turned = detail::squared_from<rigid_body, 3>(m) / Scalar(100);
    return turned > gone || turned != turned ? turned : gone;  // a NaN stays
  }
};

}  // namespace v0
}  // namespace passive_haptics
