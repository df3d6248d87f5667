// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Energy tanks: a force is allowed while the tank holds the energy that it gives out in the next tick.
//
//   energy_tank       ¼ fᵀB⁻¹f ≤ E1 − ε         equal to strict_bound on E1 − ε, passive
//   predicting_tank   T f·v ≤ E1 − ε            assumes that the motion continues; NOT passive
//   two_layer_tank    T f·v ≤ H, f_TLC = −d v   any desired force, with a damper that refills the tank;
//                                               NOT passive
//
// Energy quanta from another port are not offered, because a port has one tank.

#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/published/own_ledger.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// The energy [J] that the tank assumes it lets out in the next tick.
enum class tank_outflow : std::uint8_t {
  worst_case,  ///< ¼ fᵀB⁻¹f, whatever the motion
  predicted,   ///< T max(0, f·v), which assumes that the velocity stays the same
};

/// The force is scaled down until its outflow is at most E1 − ε. The tank is the observer's ledger, the observer's
/// `cap` its size. Source: Ferraguti et al. 2015, in the discrete form of docs/design/mathematics.md § 2(h).
///
/// With worst_case this is strict_bound on a ledger smaller by ε. With predicted the tank lets all of f* pass until
/// a sample shows that the device has turned round, so it is NOT passive.
template <tank_outflow Outflow = tank_outflow::worst_case>
struct basic_energy_tank {
  static constexpr guarantee passivity =
      Outflow == tank_outflow::worst_case ? guarantee::strict : guarantee::none;
  static constexpr bound_traits traits{.needs_ledger = true,
                                       .exact_travel = Outflow == tank_outflow::predicted,
                                       .latency = any_latency,
                                       .turns = true,
                                       .reported_work = true};

  double reserve{};  ///< ε [J], never spent

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (detail::not_negative(reserve)) return {};
    return {"reserve", reserve, "finite and ≥ 0 J"};
  }
  template <port P>
  class on;
};

using energy_tank = basic_energy_tank<>;
using predicting_tank = basic_energy_tank<tank_outflow::predicted>;

template <tank_outflow Outflow>
template <port P>
class basic_energy_tank<Outflow>::on {
 public:
  using scalar = typename P::scalar;

  constexpr explicit on(const basic_energy_tank& p) noexcept
      : reserve_(detail::number<scalar>(p.reserve)) {}
  [[nodiscard]] constexpr basic_energy_tank parameters() const noexcept {
    return {static_cast<double>(reserve_)};
  }
  [[nodiscard]] constexpr share<scalar> limit(const typename P::effort& desired,
                                              const auto& state) const noexcept {
    const scalar level = state.credit() - reserve_;
    if (Outflow == tank_outflow::worst_case || !state.motion_known) {
      return {state.damping.affordable(desired, level, state.longest_tick)};
    }
    const scalar outflow = P::work(desired, state.travel).joules * (state.longest_tick / state.dt);
    if (outflow <= kernels::larger(level, scalar(0))) return {scalar(1)};
    return {kernels::larger(level, scalar(0)) / outflow};
  }

 private:
  scalar reserve_;
};

/// An upper layer desires any force f*, and a tank of energy H [J] gives out at most its content:
///     H ← min(H + Δxᵀ(b/dt)Δx − f_held·Δx, cap)
///     f = s f* − d v,   T s f*·v ≤ H and s ‖f*‖ ≤ g H on the way out,
///     d = min(max_damping, a max(0, H_d − H)),   v = Δx/dt
/// The tank level controller −d v refills the tank at the cost of drag, in free space too. A force against the
/// motion is never reduced, because it fills the tank. Source: Franken et al. 2011, form from memory, for a single
/// port and without quanta (docs/design/mathematics.md § 2(h)); their H has no damping credit.
///
/// NOT passive: the outflow is predicted from the last displacement, and −d v pushes the wrong way
/// for the first tick after the motion turns. With strict_bound behind it, it is passive. Keep
/// max_damping ≤ 0.35 to 0.5 m/T, or the refill itself rings (series_passivity_controller).
struct two_layer_tank {
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.needs_ledger = true};

  double wanted{};                                                   ///< H_d [J], the level to keep
  double refill{};                                                   ///< a, gain of d [N·s/(m J)]
  double max_damping{};                                              ///< largest d [N·s/m]
  double force_per_joule = std::numeric_limits<double>::infinity();  ///< g, largest ‖f‖/H [N/J]
  double cap = std::numeric_limits<double>::infinity();              ///< size of the tank [J]
  double loan{};                                                     ///< H at the start [J]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    using detail::not_negative;
    if (!not_negative(wanted)) return {"wanted", wanted, "finite and ≥ 0 J"};
    if (!not_negative(refill)) return {"refill", refill, "finite and ≥ 0 N·s/(m J)"};
    if (!not_negative(max_damping)) return {"max_damping", max_damping, "finite and ≥ 0 N·s/m"};
    if (!(force_per_joule > 0.0)) return {"force_per_joule", force_per_joule, "> 0 N/J"};
    if (!(cap >= wanted)) return {"cap", cap, "≥ wanted"};
    if (!not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    return {};
  }
  template <port Space>
  class on;
};

template <port Space>
class two_layer_tank::on {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::effort;
  static_assert(detail::has_geometry<Space>,
                "passive_haptics: two_layer_tank drags with one damping in all directions of a "
                "space: joints need strict_bound");

  constexpr explicit on(const two_layer_tank& p) noexcept {
    set(p);
    reset();
  }
  constexpr void set(const two_layer_tank& p) noexcept {
    wanted_ = detail::number<scalar>(p.wanted);
    refill_ = detail::number<scalar>(p.refill);
    max_damping_ = detail::number<scalar>(p.max_damping);
    force_per_joule_ = detail::number<scalar>(p.force_per_joule);
    cap_ = detail::number<scalar>(p.cap);
    loan_ = detail::number<scalar>(p.loan);
  }
  [[nodiscard]] constexpr two_layer_tank parameters() const noexcept {
    return {.wanted = static_cast<double>(wanted_),
            .refill = static_cast<double>(refill_),
            .max_damping = static_cast<double>(max_damping_),
            .force_per_joule = static_cast<double>(force_per_joule_),
            .cap = static_cast<double>(cap_),
            .loan = static_cast<double>(loan_)};
  }
  constexpr void reset() noexcept { tank_.reset(loan_); }

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    const scalar brought =
        state.damping.dissipated(state.travel, state.dt) - Space::dot(state.held, state.travel);
    if (!tank_.book(state, cap_, brought)) return Space::zero();  // its outflow cannot be predicted
    const scalar lack = kernels::larger(wanted_ - tank_.energy(), scalar(0));
    const scalar drag = kernels::smaller(refill_ * lack, max_damping_) / state.dt;
    return desired * left(desired, state) - state.travel * drag;
  }

 private:
  /// s, the share of f* that passes: 1 if f* is against the motion, else the share that the tank covers.
  [[nodiscard]] constexpr scalar left(const vector& desired, const auto& state) const noexcept {
    const scalar outflow = Space::dot(desired, state.travel) * (state.longest_tick / state.dt);
    if (!(outflow > scalar(0))) return scalar(1);
    const scalar needed = kernels::larger(outflow, Space::norm(desired) / force_per_joule_);
    return needed > tank_.energy() ? kernels::larger(tank_.energy(), scalar(0)) / needed
                                   : scalar(1);
  }

  scalar wanted_{}, refill_{}, max_damping_{}, force_per_joule_{}, cap_{}, loan_{};
  detail::own_ledger<scalar> tank_{};  ///< H [J]
};

static_assert(force_bound_for<energy_tank, space<float, 1>>);
static_assert(force_bound_for<two_layer_tank, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
