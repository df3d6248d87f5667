// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Time-domain passivity control (PO/PC): an observer sums the energy, and a damper acts when it is negative.
//
//   series_passivity_controller     f = f* − α v   position in, force out       NOT passive
//
// With a reference energy, which depends on the contact, the controller is a shaper: published/reference_energy.hpp.
// Its dual, for devices that take a velocity, is parallel_passivity_controller.hpp.
//
// Both repay a deficit after it has occurred, and only if the motion (for the dual: the force) stays the same in
// the next tick. With a hand that damps they are hardly felt.
//
// The published pairing of the NEW force with the last displacement is not offered: on a sampled wall it never acts
// (lemma L2; a test shows it).

#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/published/own_ledger.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// Whether the controller credits the damping of the device to the environment.
enum class damping_credit : std::uint8_t {
  none,     ///< E is that of the environment alone and needs no observer
  counted,  ///< E includes the damper's, so the controller acts only if both together are negative
};

/// A damper α that dissipates the energy that the port has generated (series form, impedance causality):
///     E(n) = E(n−1) − f_held·Δx [+ Δxᵀ(b/dt)Δx]
///     f = f* − α v,   α = (E_thr − E) dt/‖Δx‖²  in [0, max_damping],   v = Δx/dt
/// A deficit beyond max_damping stays in E for the next tick. The controller keeps its own E, so no_observer is
/// enough unless the damping is counted. f may point inwards. Sources: Hannaford and Ryu 2002 (the idea and α); the
/// pairing with the held force is in docs/design/mathematics.md § 2(c).
///
/// It is NOT passive: the deficit is repaid if the motion continues and DOUBLES if it turns round. A damper α on a
/// free mass m is stable for α < 2 m/T and overshoots above 0.343 m/T, so use max_damping ≤ 0.35 to 0.5 m/T.
template <damping_credit Credit = damping_credit::none>
struct basic_series_controller {
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.needs_ledger = Credit == damping_credit::counted};

  double max_damping{};   ///< largest α [N·s/m], > 0
  double threshold{};     ///< E_thr [J]; below zero it is a loan
  double least_speed{};   ///< no action for ‖v‖ below this [m/s]
  double least_travel{};  ///< no action for ‖Δx‖ below this [m], one quantum of the encoder
  double reset_after = detail::no_limit;  ///< force-free time after which E ≤ 0 [s]
  double loan{};                          ///< E at the start [J]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    using detail::not_negative, detail::positive;
    if (!positive(max_damping)) return {"max_damping", max_damping, "finite and > 0 N·s/m"};
    if (!kernels::is_finite(threshold)) return {"threshold", threshold, "finite, in J"};
    if (!not_negative(least_speed)) return {"least_speed", least_speed, "finite and ≥ 0 m/s"};
    if (!not_negative(least_travel)) return {"least_travel", least_travel, "finite and ≥ 0 m"};
    if (!(reset_after >= 0.0)) return {"reset_after", reset_after, "≥ 0 s"};
    if (!not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    return {};
  }
  template <port Space>
  class on;
};

using series_passivity_controller = basic_series_controller<>;
using series_controller_with_damping = basic_series_controller<damping_credit::counted>;

template <damping_credit Credit>
template <port Space>
class basic_series_controller<Credit>::on {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::effort;
  static_assert(detail::has_geometry<Space>,
                "passive_haptics: series_passivity_controller damps alike in all directions of a "
                "space: joints need strict_bound");

  constexpr explicit on(const basic_series_controller& p) noexcept {
    set(p);
    reset();
  }
  constexpr void set(const basic_series_controller& p) noexcept {
    max_damping_ = detail::number<scalar>(p.max_damping);
    threshold_ = detail::number<scalar>(p.threshold);
    least_speed_ = detail::number<scalar>(p.least_speed);
    least_travel_ = detail::number<scalar>(p.least_travel);
    reset_after_ = detail::number<scalar>(p.reset_after);
    loan_ = detail::number<scalar>(p.loan);
  }
  [[nodiscard]] constexpr basic_series_controller parameters() const noexcept {
    return {.max_damping = static_cast<double>(max_damping_),
            .threshold = static_cast<double>(threshold_),
            .least_speed = static_cast<double>(least_speed_),
            .least_travel = static_cast<double>(least_travel_),
            .reset_after = static_cast<double>(reset_after_),
            .loan = static_cast<double>(loan_)};
  }
  constexpr void reset() noexcept {
    ledger_.reset(loan_);
    idle_ = scalar(0);
  }

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    return repaid(desired, state, scalar(0));
  }

  /// The force [N] that raises E to E_thr + `kept` [J].
  [[nodiscard]] constexpr vector repaid(const vector& desired, const auto& state,
                                        scalar kept) noexcept {
    book(state);
    const scalar square = Space::dot(state.travel, state.travel);
    const scalar least = kernels::larger(least_speed_ * state.dt, least_travel_);
    if (!(square > scalar(0)) || square < least * least) return desired;
    const scalar wanted = threshold_ + kept;
    if (!(ledger_.energy() < wanted)) return desired;
    const scalar damping =
        kernels::smaller((wanted - ledger_.energy()) * state.dt / square, max_damping_);
    return desired - state.travel * (damping / state.dt);
  }

 private:
  constexpr void book(const auto& state) noexcept {
    const scalar any = kernels::largest<scalar>();
    const scalar environment = -Space::dot(state.held, state.travel);
    scalar device(0);
    if constexpr (Credit == damping_credit::counted) {
      device = state.damping.dissipated(state.travel, state.dt);
    }
    if (!ledger_.book(state, any, environment, device)) return;
    idle_ = Space::dot(state.held, state.held) > scalar(0) ? scalar(0) : idle_ + state.dt;
    if (idle_ >= reset_after_) ledger_.keep_no_credit();
  }

  scalar max_damping_{}, threshold_{}, least_speed_{}, least_travel_{}, reset_after_{}, loan_{};
  detail::own_ledger<scalar> ledger_{};  ///< E [J]
  scalar idle_{};                        ///< force-free time so far [s]
};

static_assert(force_bound_for<series_passivity_controller, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
