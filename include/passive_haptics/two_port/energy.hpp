// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy observer of a device port that is one end of a two-port.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/two_port/packet.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// Energy observer of the device port. With the flow into the channel split by its sign,
///     E_out += max(f_held·Δx, 0)      E_in += share · max(−f_held·Δx, 0)
///     E1 = ∑ Δxᵀ(b/dt)Δx + E_in_rx − E_out + (1 − share) ∑ max(−f_held·Δx, 0)
/// E_in [J] is promised to the other side, so it is no credit here; the damping's energy is credit here and
/// is not promised. share = 1 is the published bookkeeping (§ 2(d)).
///
/// It fits any passive_port and impedance_side. With strict_bound E1 ≥ 0 by lemma L3, because a tick changes
/// E1 by ΔxᵀBΔx − f·Δx when f·Δx > 0 and never lowers it otherwise.
///
/// Its cost: the promised share of the energy that the hand puts in comes back over the channel only. Pressed slowly
/// from an empty ledger, strict_bound gives at most 2B (1 − share) [N/m], B = b/T (L4 without the promised part).
/// With share = 1 only the energy of the damping and of the other side can be displayed.
template <class Damping = isotropic_damping, ledger_sum Sum = ledger_sum::plain>
struct basic_two_port_energy {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bool counts = true;
  static constexpr bool exact = true;

  Damping damping{};   ///< b [N·s/m], a lower bound
  double share = 1.0;  ///< share of the hand's energy that is promised to the other side, 0 to 1
  double loan{};       ///< E1 at the start [J]
  double cap = std::numeric_limits<double>::infinity();  ///< most credit to keep [J] (L7)

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = damping.check()) return fault;
    if (!(share >= 0.0 && share <= 1.0)) return {"share", share, "in [0, 1]"};
    if (!detail::not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    if (!(cap >= 0.0)) return {"cap", cap, "≥ 0 J"};
    return {};
  }
  template <port P>
  class on;
};

using two_port_energy = basic_two_port_energy<>;

template <class Damping, ledger_sum Sum>
template <port P>
class basic_two_port_energy<Damping, Sum>::on {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;
  using damping_type = part_at<Damping, P>;

  constexpr explicit on(const basic_two_port_energy& p) noexcept : damping_(p.damping) {
    set(p);
    reset();
  }
  constexpr void set(const basic_two_port_energy& p) noexcept {
    damping_ = damping_type(p.damping);
    share_ = detail::number<scalar>(p.share);
    loan_ = detail::number<scalar>(p.loan);
    cap_ = detail::number<scalar>(p.cap);
  }
  [[nodiscard]] constexpr basic_two_port_energy parameters() const noexcept {
    return {.damping = damping_.parameters(),
            .share = static_cast<double>(share_),
            .loan = static_cast<double>(loan_),
            .cap = static_cast<double>(cap_)};
  }
  /// Reset both sides together, because a side that is reset alone could spend the same energy again.
  constexpr void reset() noexcept {
    energy_ = loan_;
    promised_ = scalar(0);
    received_ = {};
  }

  constexpr bool update(const motion& dx, const effort& held, scalar dt) noexcept {
    const scalar gain = detail::sure_gain<P>(damping_.dissipated(dx, dt), held, dx);
    const scalar gave = P::work(held, dx).joules;
    const scalar passed_on = gave < scalar(0) ? share_ * -gave : scalar(0);
    if (!kernels::is_finite(value() + gain - passed_on)) return false;
    detail::book(energy_, gain);
    detail::book(energy_, -passed_on);
    detail::book(promised_, passed_on);
    cut();
    return true;
  }
  /// Writes off a tick of unknown motion: it promises nothing and costs ¼ fᵀB⁻¹f [J] of the force `held`.
  constexpr void forfeit(const effort& held, scalar T) noexcept {
    energy_ = detail::written_off(value(), damping_.worst_outflow(held, T));
  }
  /// Takes the other side's E_in [J] from a packet; packets may come in any order.
  constexpr void receive(scalar other) noexcept {
    energy_ += received_.gain(other);
    cut();
  }

  [[nodiscard]] constexpr scalar value() const noexcept { return static_cast<scalar>(energy_); }
  [[nodiscard]] constexpr const damping_type& damping() const noexcept { return damping_; }
  /// E_in [J], to be sent.
  [[nodiscard]] constexpr scalar outgoing() const noexcept {
    return static_cast<scalar>(promised_);
  }

 private:
  constexpr void cut() noexcept {
    if (value() > cap_) energy_ = cap_;
  }

  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS damping_type damping_;
  scalar share_{}, loan_{}, cap_{};
  detail::ledger_number<scalar, Sum> energy_{};    ///< E1 [J]
  detail::ledger_number<scalar, Sum> promised_{};  ///< E_in [J], never falls
  received_energy<scalar> received_{};             ///< E_in_rx [J]
};

static_assert(energy_observer_for<two_port_energy, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
