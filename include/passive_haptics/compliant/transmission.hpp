// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is known of what stands between the motor, with its encoder, and the hand; the device's own `mass` stays what the
// hand feels of it all.
//
//   any_transmission       that it gives: strict, and soft while the ledger is empty
//   observed_transmission  the rotor's mass, and how fast the pull on it can change        jitter, any number of modes
//   chain_transmission<N>  every mass, spring and damper, within 3 %                        equal ticks, stiffest

#include <passive_haptics/compliant/modelled_reach.hpp>
#include <passive_haptics/compliant/observed_reach.hpp>

namespace passive_haptics {
inline namespace v0 {

struct any_transmission {
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }
};

struct observed_transmission {
  double rotor{};        ///< mass that moves rigidly with the encoder, at least [kg]
  double rotor_above{};  ///< the same, at most [kg]; 0: not known
  double
      slew{};  ///< how fast the pull on it changes, at most [N/s]: slew_of() where a mode is known
  double pull = detail::no_limit;  ///< how large it is, at most [N]
  double damping_above{};          ///< of the rotor, at most [N·s/m]
  double friction{};               ///< dry, on the rotor, at most [N]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return observed_reach{rotor, rotor_above, slew, friction, damping_above, pull}.check();
  }
};

template <int N = 2>
struct chain_transmission {
  chain<N> device{};             ///< as found, its damping the likely one and not half of it
  double friction{};             ///< dry, on the first mass, at most [N]
  double tolerance = 0.03;       ///< of its masses and springs
  double loss_tolerance = 0.30;  ///< of its losses and damping

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return modelled_reach<N>{device, 0.0, friction, 1e-3, tolerance, loss_tolerance}.check();
  }
};

/// R [N/s] of a first mode: k v + d (n + G)/μ, with n = σ hand + (1 − σ) motors the force that parts the ends of the spring,
/// G = n + (√(k μ) + d) v the most that it pulls, and v [m/s] the fastest that they part (Lemma A, § 14).
[[nodiscard]] constexpr double slew_of(const chain<2>& c, double hand, double motors,
                                       double v) noexcept {
  const double m = c.masses[0] + c.masses[1], share = c.masses[0] / m;
  const double mu = share * c.masses[1], n = share * hand + (1.0 - share) * motors;
  const double G = n + (kernels::square_root(c.springs[0] * mu) + c.losses[0]) * v;
  return c.springs[0] * v + c.losses[0] * (n + G) / mu;
}

}  // namespace v0
}  // namespace passive_haptics
