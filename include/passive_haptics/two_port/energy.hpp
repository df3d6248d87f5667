// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy observer of a device port that is one end of a two-port.

#include <passive_haptics/concepts.hpp>
#include <passive_haptics/two_port/packet.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// Energy observer of the device port. With the flow into the channel split by its sign,
///     E_out += max(f_held·Δx, 0)      E_in += share · max(−f_held·Δx, 0)
///     E1 = ∑ Δxᵀ(b/dt)Δx + E_in_rx − E_out + (1 − share) ∑ max(−f_held·Δx, 0)
/// E_in is promised to the other side, so it is no credit here; the damping stays here and is
/// promised to nobody. share = 1 is the published bookkeeping (§ 2(d)).
///
/// Drops into local_model or impedance_side; with strict_bound E1 ≥ 0 by lemma L3, because a tick
/// changes E1 by ΔxᵀBΔx − f·Δx when f·Δx > 0 and never lowers it otherwise.
///
/// The price: what the hand puts in comes back over the channel or not at all. Pressed slowly from
/// an empty ledger, strict_bound shows at most 2B (1 − share) N/m, B = b/T (lemma L4 with the
/// promised part gone): for share = 1 nothing but what the damping and the other side have paid.
template <class Space, class Damping = isotropic_damping<Space>,
          class Ledger = typename Space::scalar>
struct two_port_energy {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bool counts = true;

  Damping damping{};                                ///< b [N·s/m], a lower bound
  scalar share = scalar(1);                         ///< promised of what the hand puts in, 0 to 1
  scalar cap = std::numeric_limits<scalar>::max();  ///< most credit to keep [J] (L7)
  Ledger energy{};                                  ///< E1 [J]; its first value is the loan
  Ledger promised{};                                ///< E_in [J], never falls
  received_energy<scalar> received{};               ///< E_in_rx [J]

  constexpr bool update(const vector& displacement, const vector& held, scalar dt) noexcept {
    const scalar gain =
        detail::sure_gain<Space>(damping.dissipated(displacement, dt), held, displacement);
    const scalar gave = Space::dot(held, displacement);
    const scalar passed_on = gave < scalar(0) ? share * -gave : scalar(0);
    if (!kernels::is_finite(value() + gain - passed_on)) return false;
    detail::book(energy, gain);
    detail::book(energy, -passed_on);
    detail::book(promised, passed_on);
    cut();
    return true;
  }
  /// A tick that nobody saw promises nothing and costs the worst that `held` can have done.
  constexpr void forfeit(const vector& held, scalar T) noexcept {
    energy = detail::written_off(value(), damping.worst_outflow(held, T));
  }
  /// Takes the other side's E_in [J] from a packet, in whatever order they come.
  constexpr void receive(scalar other) noexcept {
    energy += received.gain(other);
    cut();
  }

  [[nodiscard]] constexpr scalar value() const noexcept { return static_cast<scalar>(energy); }
  /// E_in to send [J].
  [[nodiscard]] constexpr scalar outgoing() const noexcept { return static_cast<scalar>(promised); }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (const auto fault = damping.check()) return fault;
    if (!(share >= scalar(0) && share <= scalar(1))) return {"share", share, "in [0, 1]"};
    if (!(cap >= scalar(0))) return {"cap", cap, "≥ 0 J"};
    if (!(value() >= scalar(0)) || !kernels::is_finite(value())) {
      return {"energy", value(), "finite and ≥ 0 J at the start"};
    }
    return {};
  }

 private:
  constexpr void cut() noexcept {
    if (value() > cap) energy = cap;
  }
};

static_assert(energy_observer_for<two_port_energy<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
