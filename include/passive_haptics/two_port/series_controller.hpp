// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The published passivity controller of the impedance side, for comparison.

#include <passive_haptics/concepts.hpp>
#include <passive_haptics/two_port/packet.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// With the force f and the velocity v = Δx/dt of ONE sample (f here is the force on the device):
///     E_out += max(f·v dt, 0)      E_in += max(−f·v dt, 0)
///     E_out > E_in_rx and ‖v‖ > v_min:   α = (E_out − E_in_rx)/(dt v²) ≤ max_gain
///                                        f' = f − α v,   E_out −= α v² dt
/// § 2(d), from memory; thresholds as seen in public code. What the cap leaves is carried on.
///
/// Passive if f and v were constant over the sample together. They are not: f' is held during the
/// NEXT displacement, and on a sampled stiff wall this bookkeeping sees no leak at all (lemma L2).
/// impedance_side is the form that holds.
template <class Space, class Ledger = typename Space::scalar>
struct two_port_series_controller {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;

  scalar min_speed = scalar(1e-3);                       ///< no action below [m/s]
  scalar max_gain = std::numeric_limits<scalar>::max();  ///< most α [N·s/m]; ≤ 0.5 m/T is stable
  Ledger in{};                                           ///< E_in [J]
  Ledger out{};                                          ///< E_out [J]
  received_energy<scalar> received{};                    ///< E_in_rx [J]

  constexpr void receive(scalar other) noexcept { static_cast<void>(received.gain(other)); }

  /// The force to command [N] for the force received [N] and the displacement [m] of the tick of
  /// length dt > 0 [s] that has just ended.
  [[nodiscard]] constexpr vector force(const vector& desired, const vector& displacement,
                                       scalar dt) noexcept {
    const scalar gave = Space::dot(desired, displacement);
    (gave > scalar(0) ? out : in) += kernels::magnitude(gave);
    const scalar square = Space::dot(displacement, displacement) / (dt * dt);
    const scalar excess = static_cast<scalar>(out) - received.newest;
    if (!(excess > scalar(0)) || !(square > min_speed * min_speed)) return desired;
    const scalar alpha = kernels::smaller(excess / (dt * square), max_gain);
    out += -alpha * square * dt;
    return desired - displacement * (alpha / dt);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(min_speed >= scalar(0)) || !kernels::is_finite(min_speed)) {
      return {"min_speed", min_speed, "finite and ≥ 0 m/s"};
    }
    if (!(max_gain >= scalar(0))) return {"max_gain", max_gain, "≥ 0 N·s/m"};
    return {};
  }
};

}  // namespace v0
}  // namespace passive_haptics
