// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A lower bound of the damping of a handle that moves and turns, and a bound on the error of the work of a turn
// that is computed from its end poses.
//
//   rigid_damping   b [N·s/m] for travel, b_ω [N·m·s/rad] for turns
//
// In no pose may the device's damping matrix at the handle point be below diag(b I, b_ω I), so b and b_ω are the
// smallest over all directions and poses.

#include <passive_haptics/device/damping.hpp>
#include <passive_haptics/device/rigid_body.hpp>

namespace passive_haptics {
inline namespace v0 {

/// diag(b I, b_ω I) at the handle point, in any frame.
struct rigid_damping {
  double linear{};   ///< b [N·s/m], > 0
  double angular{};  ///< b_ω [N·m·s/rad], > 0

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(linear)) return {"linear", linear, "finite and > 0 N·s/m"};
    if (!detail::positive(angular)) return {"angular", angular, "finite and > 0 N·m·s/rad"};
    return {};
  }
  template <class Port>
  class on;
};

template <class Port>
class rigid_damping::on {
 public:
  using scalar = typename Port::scalar;
  using motion = typename Port::motion;
  using effort = typename Port::effort;
  static_assert(
      detail::moves_and_turns<Port>,
      "passive_haptics: rigid_damping has one number for travel and one for turns: it is for a "
      "rigid_body");

  constexpr explicit on(const rigid_damping& p) noexcept
      : linear_(detail::number<scalar>(p.linear)), angular_(detail::number<scalar>(p.angular)) {}
  [[nodiscard]] constexpr rigid_damping parameters() const noexcept {
    return {.linear = static_cast<double>(linear_), .angular = static_cast<double>(angular_)};
  }

  /// (b|Δp|² + b_ω|θ|²)/dt [J]: no path between two poses is shorter than |Δp| and |θ|.
  [[nodiscard]] constexpr scalar dissipated(const motion& m, scalar dt) const noexcept {
    return (linear_ * squared<0>(m) + angular_ * squared<3>(m)) / dt;
  }
  /// T|f|²/(4b) + T|τ|²/(4b_ω) [J], the most energy that w can give to the hand on any path of a tick of T [s].
  [[nodiscard]] constexpr scalar worst_outflow(const effort& w, scalar T) const noexcept {
    return T * (squared<0>(w) / linear_ + squared<3>(w) / angular_) / scalar(4);
  }
  [[nodiscard]] constexpr effort force(const motion& m, scalar T) const noexcept {
    effort w = m;
    for (int i = 0; i < 6; ++i) Port::component(w, i) *= along_axis(i) / T;
    return w;
  }
  /// The share of w that E [J] covers for T [s], at most so large that |τ| ≤ 4b_ω/T (lemma C).
  [[nodiscard]] constexpr scalar affordable(const effort& w, scalar E, scalar T) const noexcept {
    const scalar share = kernels::strict_scale(E, worst_outflow(w, T));
    return kernels::coning_share(share, squared<3>(w), angular_, T);
  }
  /// The most by which the true gain of a turn may fall short of b_ω|θ|²/dt − τ·θ [J], because its path need not
  /// be straight: dt|θ × τ|²/(36 b_ω) if |θ| ≤ 1 rad and |τ| ≤ 4b_ω/dt (lemma C, docs/design/six_dof.md).
  /// Beyond these limits the worst path is assumed, so that the gain becomes −dt|τ|²/(4b_ω).
  [[nodiscard]] constexpr scalar unsure(const motion& m, const effort& held,
                                        scalar dt) const noexcept {
    const scalar turn = squared<3>(m);
    const scalar torque = squared<3>(held);
    const scalar limit = scalar(4) * angular_ / dt;
    if (turn <= scalar(1) && torque <= limit * limit) [[likely]] {
      const scalar across = detail::vectors<scalar, 3>::dot(cross(m, held), cross(m, held));
      return kernels::coning(across, angular_, dt);
    }
    const auto work =
        detail::work<detail::vectors<scalar, 3>>(Port::angular(held), Port::angular(m));
    const scalar booked = angular_ * turn / dt;
    const scalar worst = dt * torque / (scalar(4) * angular_);
    return booked - work.joules + worst +
           kernels::rounding<scalar>() * (booked + work.passed + worst);
  }
  /// 1/(uᵀ(b/T)⁻¹u), u the direction of `along`, normalised as a vector of six numbers in N and N·m.
  [[nodiscard]] constexpr scalar per_tick(const effort& along, scalar T) const noexcept {
    return (squared<0>(along) + squared<3>(along)) / (scalar(4) * worst_outflow(along, T));
  }
  [[nodiscard]] constexpr scalar along_axis(int i) const noexcept {
    return i < 3 ? linear_ : angular_;
  }
  static constexpr bool rubs = false;

 private:
  template <int First>
  [[nodiscard]] static constexpr scalar squared(const motion& m) noexcept {
    return detail::squared_from<Port, First>(m);
  }
  [[nodiscard]] static constexpr auto cross(const motion& m, const effort& held) noexcept {
    return detail::vectors<scalar, 3>::cross(Port::angular(m), Port::angular(held));
  }

  scalar linear_, angular_;
};

}  // namespace v0
}  // namespace passive_haptics
