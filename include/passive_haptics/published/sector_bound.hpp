// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A bound on the slope df/dx: the force changes only with the motion, and falls more steeply than it rises.
//
//   sector_bound   0 ≤ df/dx ≤ β pressing, β ≤ df/dx ≤ 2b/T releasing   for one degree of freedom: the
//                                                                       force never jumps, but is soft

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// With F ≥ 0 the size of the force and s the travel of the last tick against it [m]:
///     pressing  (s ≥ 0):   F_held             ≤ F ≤ F_held + β s
///     releasing (s < 0):   F_held − (2b/T)|s| ≤ F ≤ F_held − β |s|         never below zero
/// so the path in the plane of position and force turns clockwise, and |ΔF| ≤ (2b/T)|Δx|: an update of
/// the environment never makes the force jump. Inspired by the input-to-state-stable approach
/// (Jafari, Ryu), whose own law is not confirmed; law and proof are ours (§ 2(f)).
///
/// E ≥ F²/(2β). A force below the window, down to zero, is passive as well; the lower edges only make it continuous.
///
/// It makes the assumptions of memoryless_bound. A force held beyond the last command is given no credit, so a
/// motor that is a little too strong cannot wind the force up. It does not allow latency. Its cost: a wall has a
/// stiffness of 2b/T [N/m] at most, and the bound does NOT only reduce: when a contact is lost, or fades without
/// updates, the force stays until the hand yields; a lost sample or a late tick ends it at once. It needs one
/// degree of freedom, because in the proof the motion is along the force.
struct sector_bound {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.needs_ledger = true};

  double slope = kernels::largest<double>();  ///< β [N/m], > 0; above 2b/T, 2b/T counts

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (detail::positive(slope)) return {};
    return {"slope", slope, "finite and > 0 N/m"};
  }
  template <port P>
  class on;
};

template <port P>
class sector_bound::on {
  static_assert(P::dof == 1,
                "passive_haptics: sector_bound: its proof is for one degree of freedom");

 public:
  using scalar = typename P::scalar;

  constexpr explicit on(const sector_bound& p) noexcept { set(p); }
  constexpr void set(const sector_bound& p) noexcept { slope_ = detail::number<scalar>(p.slope); }
  [[nodiscard]] constexpr sector_bound parameters() const noexcept {
    return {static_cast<double>(slope_)};
  }
  constexpr void reset() noexcept { last_ = kernels::largest<scalar>(); }

  [[nodiscard]] constexpr typename P::effort limit(const typename P::effort& desired,
                                                   const auto& state) noexcept {
    if (state.fate() != tick_fate::on_time) return last_ = scalar(0);
    const scalar steepest = scalar(2) * state.damping.along_axis(0) / state.longest_tick;
    const scalar gentlest = kernels::smaller(slope_, steepest);
    const bool backwards =
        state.held < scalar(0) || (state.held == scalar(0) && desired < scalar(0));
    const scalar side = backwards ? scalar(-1) : scalar(1);

    const scalar held = kernels::smaller(state.held * side, last_);
    const scalar against = -state.travel * side;
    const scalar most = kernels::larger(held + gentlest * against, scalar(0));
    const scalar least =
        against < scalar(0) ? kernels::larger(held + steepest * against, scalar(0)) : held;
    last_ = kernels::clamped(desired * side, least, most);
    return side * last_;
  }

 private:
  scalar slope_{};
  scalar last_ = kernels::largest<scalar>();  ///< F of the last command [N]
};

static_assert(force_bound_for<sector_bound, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
