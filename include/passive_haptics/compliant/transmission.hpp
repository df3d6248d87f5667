// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The known numbers of a compliant transmission between the motor, with its encoder, and the hand. The device's own `mass` is
// still that of everything the hand feels.
//
//   any_transmission       nothing need be known: strict, and soft while the ledger is empty
//   observed_transmission  the rotor's mass, and the rate limit of the force on it         jitter, any number of modes
//   chain_transmission<N>  every mass, spring and damper, within 3 %                        equal ticks, stiffest

#include <passive_haptics/compliant/modelled_reach.hpp>
#include <passive_haptics/compliant/observed_reach.hpp>

namespace passive_haptics {
inline namespace v0 {

struct any_transmission {
  /// Lower bound of the mass that moves rigidly with the encoder [kg]; 0: all of it. Springs and dampers are designed for
  /// it. The energy does not rest on it, but on a rotor that is lighter a wall that the ledger lets be stiff may ring.
  double rotor{};

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(rotor)) return {"rotor", rotor, "finite and ≥ 0 kg"};
    return {};
  }
};

struct observed_transmission {
  double rotor{};        ///< lower bound of the mass that moves rigidly with the encoder [kg]
  double rotor_above{};  ///< upper bound of that mass [kg]; 0: unknown
  double slew{};         ///< largest rate of the force on it [N/s]; slew_of() for a known mode
  double pull = detail::no_limit;  ///< largest force on it without dry friction [N]
  double damping_above{};          ///< upper bound of the rotor's damping [N·s/m]
  double friction{};               ///< largest dry friction of the rotor [N]
  /// Upper bound of the frequencies at which the handle swings on the rotor [Hz]; 0: unknown. The energy does not rest on
  /// it, but below 3/(16 (k + 1) T), in a loop k > 0 ticks late, walls are shown twice as stiff.
  double fastest_mode{};

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(fastest_mode)) {
      return {"fastest_mode", fastest_mode, "finite and ≥ 0 Hz"};
    }
    return observed_reach{rotor, rotor_above, slew, friction, damping_above, pull}.check();
  }
};

template <int N = 2>
struct chain_transmission {
  chain<N> device{};             ///< as identified; damping is the expected value, no lower bound
  double friction{};             ///< largest dry friction of the first mass [N]
  double tolerance = 0.03;       ///< relative, of masses and springs
  double loss_tolerance = 0.30;  ///< relative, of losses and damping

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return modelled_reach<N>{device, 0.0, friction, 1e-3, tolerance, loss_tolerance}.check();
  }
};

/// R = k v + d (n + G)/μ [N/s] of two masses (ours; Lemma A, § 14), with n = σ hand + (1 − σ) motors [N] the force that parts
/// the ends of the spring, v [m/s] their largest relative speed, and G = n + (√(k μ) + d) v [N] the largest force of the spring.
[[nodiscard]] constexpr double slew_of(const chain<2>& c, double hand, double motors,
                                       double v) noexcept {
  const double m = c.masses[0] + c.masses[1], share = c.masses[0] / m;
  const double mu = share * c.masses[1], n = share * hand + (1.0 - share) * motors;
  const double G = n + (kernels::square_root(c.springs[0] * mu) + c.losses[0]) * v;
  return c.springs[0] * v + c.losses[0] * (n + G) / mu;
}

}  // namespace v0
}  // namespace passive_haptics
