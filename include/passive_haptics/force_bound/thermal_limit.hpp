// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The limit of motors that hold a peak force for a short time only (the menu is in actuator_limit.hpp).
//
//     ph::thermal_limit motors{.peak = 3.3, .continuous = 0.88, .time_constant = 20.0};  // a Touch, say

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// |f| ≤ `peak` at any time, and m [N²], the mean square of the command filtered by the winding's time
/// constant τ, never exceeds c², c = `continuous` (a winding warms with the square of its current, I²t):
///     m ← m + (f² − m) dt/(τ + dt),      f² ≤ m + (c² − m)/ε,     ε = 1/32, or T/(τ + T) where that is more
/// m stays ≤ c², because in a tick of dt ≤ T it goes at most the share ε of the way to f². The force does not
/// drop all at once but falls smoothly to c as m nears c². If set() lowers c² below m, |f| is at most c until m has
/// fallen to c². m is computed from the force that this bound returns, so put it last in a chain; a rejected tick
/// counts as held. reset() sets m = 0, a cold winding, so let the motors cool before.
///
/// The limit only reduces the force, so it breaks no guarantee of a bound before it (bound_chain.hpp). Unless the
/// device reports the force it held, `peak` must be no larger than the force at which the motors saturate.
struct thermal_limit {
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.exact_travel = false, .latency = any_latency};

  double peak{};        ///< largest force at any time [N]
  double continuous{};  ///< c, the force that can be held for ever [N]; ≥ peak: no thermal limit
  double time_constant{};  ///< τ of the winding [s]; not used if continuous ≥ peak

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(peak)) return {"peak", peak, "≥ 0 N; of a device: .force_limit > 0"};
    if (!(continuous >= 0.0)) return {"continuous", continuous, "≥ 0 N"};
    if (!(continuous < peak) || detail::positive(time_constant)) return {};
    return {"time_constant", time_constant, "finite and > 0 s"};
  }

  template <port Space>
  class on;
};

template <port Space>
class thermal_limit::on {
 public:
  using scalar = typename Space::scalar;
  static_assert(
      detail::has_geometry<Space>,
      "passive_haptics: thermal_limit bounds the length of a force: joints need motor_limits");

  constexpr explicit on(const thermal_limit& p) noexcept { set(p); }
  constexpr void set(const thermal_limit& p) noexcept {
    peak_ = detail::number<scalar>(p.peak);
    heats_ = p.continuous < p.peak;
    continuous_ = detail::number<scalar>(p.continuous);
    time_constant_ = detail::number<scalar>(p.time_constant);
  }
  [[nodiscard]] constexpr thermal_limit parameters() const noexcept {
    return {.peak = static_cast<double>(peak_),
            .continuous = static_cast<double>(continuous_),
            .time_constant = static_cast<double>(time_constant_)};
  }
  constexpr void reset() noexcept { mean_square_ = held_square_ = scalar(0); }

  [[nodiscard]] constexpr typename Space::effort most_held() const noexcept {
    return detail::longest_held<Space>(peak_);
  }
  [[nodiscard]] constexpr bool can_hold(const typename Space::effort& held) const noexcept {
    return detail::can_be_held(Space::norm(held), peak_);
  }
  [[nodiscard]] constexpr share<scalar> limit(const typename Space::effort& desired,
                                              const auto& state) noexcept {
    const scalar force = Space::norm(desired);
    scalar most = peak_;
    if (heats_) {
      const scalar c2 = continuous_ * continuous_;
      const scalar T = state.longest_tick;
      mean_square_ += (held_square_ - mean_square_) * (state.dt / (time_constant_ + state.dt));
      const scalar largest = kernels::larger(scalar(1) / scalar(32), T / (time_constant_ + T));
      const scalar room = c2 - mean_square_;  // < 0 where set() has lowered the limit
      const scalar square = room > scalar(0) ? mean_square_ + room / largest : c2;
      most = kernels::smaller(most, kernels::square_root(square));
      const scalar held = kernels::smaller(force, most);
      held_square_ = held * held;
    }
    return {force > most ? most / force : scalar(1)};
  }
  constexpr void explain(explanation& e, const auto& /*damping*/, scalar /*T*/,
                         int /*late*/) const noexcept {
    const bool warm = heats_ && warmth() > scalar(0.9);
    e.saturate(static_cast<double>(warm ? continuous_ : peak_));
  }
  /// m/c², in [0, 1], and above 1 while m falls to a c² that set() has lowered; 0 if the winding is not modelled.
  [[nodiscard]] constexpr scalar warmth() const noexcept {
    return heats_ && continuous_ > scalar(0) ? mean_square_ / (continuous_ * continuous_)
                                             : scalar(0);
  }

 private:
  scalar peak_{}, continuous_{}, time_constant_{};
  scalar mean_square_{}, held_square_{};  ///< m and f² of the last tick [N²]
  bool heats_ = false;
};

static_assert(force_bound_for<thermal_limit, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
