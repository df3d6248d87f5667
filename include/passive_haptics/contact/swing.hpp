// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decides whether a device swings or a hand moves it. Only a swing is to be damped: a damper against a hand's motion
// is an error of the force, at any update rate of the environment.
//
//     V ← V + (v² − V) dt/τ,   A ← A + (a² − A) dt/τ,   τ = 0.1 s        the mean of v² and of a² = (Δv/dt)²
//     q = A/(V W²)                                     (Ω/W)² of a sinusoidal motion at Ω [1/s]
//     g = 0 below q = ¼, then 4/3 (q − ¼), 1 from q = 1 on
//     W² = min(20², K/4m) [1/s²]
//     s ← s + (g − s) dt/τ_s,   τ_s = 20 ms
//
// s is the share of the speed v [m/s] that is damped. It lags behind g, because an update of the surface raises a²,
// and a damper that changes within a tick is a step of the force. A contact begins with s = 1. A free mass on K, up to
// four times the stated m, swings at W or faster and is fully damped. A hand that moves to and fro once a second is
// damped by s = 1/20, near its turns, because the means are short. Source: ours; docs/design/contacts.md § 6.

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {

template <class Scalar>
class swing {
 public:
  /// s v [m/s] of a speed v after a tick of dt [s], in a contact with K/m = `natural` [1/s²].
  [[nodiscard]] constexpr Scalar damped(Scalar v, Scalar natural, Scalar dt) noexcept {
    const Scalar W2 = kernels::smaller(Scalar(400), natural / Scalar(4));
    const Scalar change = v - last_;
    last_ = v;
    if (!begun_) {
      begun_ = true;
      speed_ = v * v;
      gain_ = W2 * speed_;
      return v;
    }
    const Scalar new_part = dt < Scalar(0.1) ? dt * Scalar(10) : Scalar(1);
    speed_ += new_part * (v * v - speed_);
    gain_ += new_part * (change * change / (dt * dt) - gain_);
    const Scalar most = W2 * speed_, above = gain_ - most / Scalar(4);
    const Scalar damps = !(above > Scalar(0)) ? Scalar(0)
                         : gain_ < most       ? above / (most * Scalar(0.75))
                                              : Scalar(1);
    share_ += (damps - share_) * (dt < Scalar(0.02) ? dt * Scalar(50) : Scalar(1));
    return v * share_;
  }
  /// Ends the contact.
  constexpr void stop() noexcept { *this = {}; }

 private:
  Scalar speed_{}, gain_{};  ///< V [m²/s²], A [m²/s⁴]
  Scalar last_{};            ///< v of the last tick [m/s]
  Scalar share_{1};          ///< s
  bool begun_ = false;
};

}  // namespace v0
}  // namespace passive_haptics
