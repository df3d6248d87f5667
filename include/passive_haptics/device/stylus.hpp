// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// stylus<Scalar>: the port of a device that senses six degrees of freedom and actuates three, such as a Touch.
//
// The motors push at the centre of the gimbal, so energy is f·Δp [J] of that point, as in space<Scalar, 3>, with the
// same damping and the same bounds. The orientation is part of the pose, because it decides what the tip touches, but
// the motors do no work on it. Turning the tip into a wall therefore adds no energy to the ledger, and an empty ledger
// allows no force that pushes the tip out: docs/design/six_dof.md has the remedies.

#include <passive_haptics/device/rigid_body.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Scalar is float, double or any `real`. Models port (port/concepts.hpp).
template <real Scalar>
struct stylus : detail::vectors<Scalar, 3>, private detail::rigid_poses<Scalar> {
 private:
  using poses = detail::rigid_poses<Scalar>;

 public:
  using scalar = Scalar;
  using geometry = space<Scalar, 3>;  ///< where the gimbal moves and forces act
  using typename poses::body_space, typename poses::pose, typename poses::stored_pose;
  using vector = typename geometry::vector;
  using coordinates = typename geometry::coordinates;
  using motion = vector;  ///< Δp of the gimbal [m]
  using effort = vector;  ///< force on the gimbal [N]
  using stored_effort = coordinates;

  using poses::is_finite, poses::place;
  [[nodiscard]] static bool is_finite(const vector& a) noexcept { return geometry::is_finite(a); }
  /// Δp [m]; NaN if a quaternion is not of norm one, because the tip's position is then unknown.
  [[nodiscard]] static motion between(const pose& from, const pose& to) noexcept {
    if (!rotation::is_unit(from.orientation) || !rotation::is_unit(to.orientation)) {
      const Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
      return {nan, nan, nan};
    }
    return geometry::between(place(from), place(to));
  }
  /// The pose that a motion leads to; the orientation stays.
  [[nodiscard]] static pose moved(const pose& from, const motion& by) noexcept {
    return {motion(place(from) + by), from.orientation};
  }
  /// f·Δp [J].
  [[nodiscard]] static auto work(const effort& f, const motion& dx) noexcept {
    return geometry::work(f, dx);
  }
  /// |Δp|² [m²].
  [[nodiscard]] static Scalar squared(const motion& dx) noexcept { return geometry::squared(dx); }
};

}  // namespace v0
}  // namespace passive_haptics
