// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The contract of a friction model of a simulated device; the menu is in friction.hpp.
//
//   friction_model     the contract: slide() along a piece of the way, one axis at a time
//   friction_work      the work of that piece, and how much of it was dissipated
//   friction_claim     the bounds that a controller may state of a friction
//   coulomb_friction   rigid, of device_parameters::friction: the default of a device

#include <passive_haptics/base/parameter.hpp>

#include <concepts>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

struct friction_work {
  double work = 0.0;        ///< done by the axis against the friction [J]
  double dissipated = 0.0;  ///< the part of it that is lost; the springs store the rest [J]
};

/// Claims that the friction dissipates at least `level` times the way slipped [J], where the way slipped is
/// the way of the device less a deflection z of at most `presliding`, and that it stores at least c z²/(2p)
/// [J] meanwhile. A ledger needs no more. A level of zero claims nothing.
struct friction_claim {
  double level = 0.0;       ///< c [N]
  double presliding = 0.0;  ///< p [m]
};

/// Friction along one axis, with its memory in `state`. slide(state, from, way, time) moves the axis from `from`
/// [m] by `way` [m] at constant velocity in `time` [s].
template <class F>
concept friction_model = requires(const F f, typename F::state s, double x) {
  { f.begin() } -> std::same_as<typename F::state>;
  { f.slide(s, x, x, x) } -> std::same_as<friction_work>;
  { f.stiffness() } -> std::same_as<double>;  // largest slope of the force over the way [N/m]
  { f.claim() } -> std::same_as<friction_claim>;
  { f.check() } -> std::same_as<parameter_fault>;
  requires noexcept(f.begin())&& noexcept(f.slide(s, x, x, x));
};

/// Rigid friction, which sticks and slips at a constant level; axis.hpp integrates it exactly.
struct coulomb_friction {
  struct state {};
  [[nodiscard]] constexpr state begin() const noexcept { return {}; }
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }
};

/// The friction of a simulated device: dry friction without elasticity, or a model that has a state.
template <class F>
concept device_friction = std::same_as<F, coulomb_friction> || friction_model<F>;

/// The first fault of a friction on a device whose device_parameters::friction is `coulomb` [N].
template <device_friction F>
[[nodiscard]] constexpr parameter_fault fault_of(const F& friction, double coulomb) noexcept {
  if (friction_model<F> && coulomb > 0.0) {
    return {"friction", coulomb, "0 N: the friction model brings its own level"};
  }
  return friction.check();
}

namespace detail {

/// The first fault in the numbers of every friction model: its level [N], its presliding displacement [m], and the
/// share of that by which it is deflected at the start.
[[nodiscard]] constexpr parameter_fault friction_fault(double level, double presliding,
                                                       double start) noexcept {
  if (!passive_haptics::detail::not_negative(level)) {
    return {"friction level", level, "finite and ≥ 0 N"};
  }
  if (!passive_haptics::detail::positive(presliding)) {
    return {"presliding", presliding, "finite and > 0 m; coulomb_friction is rigid"};
  }
  if (!(start >= -1.0 && start <= 1.0)) return {"friction start", start, "−1 to 1"};
  return {};
}

/// Calls `slide` for pieces no longer than `longest` [m] and sums their work, which is continuous in the way.
[[nodiscard]] constexpr friction_work slide_in_pieces(double way, double longest,
                                                      auto slide) noexcept {
  friction_work sum;
  double left = kernels::magnitude(way);
  double gone = 0.0;
  while (left > 0.0) {
    const double piece = kernels::smaller(left, longest);
    const friction_work took = slide(way < 0.0 ? -gone : gone, piece);
    sum.work += took.work;
    sum.dissipated += took.dissipated;
    gone += piece;
    left -= piece;
  }
  return sum;
}

}  // namespace detail

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
