// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decides whether a device swings or a hand moves it. Only a swing is to be damped: a damper against a hand's motion
// is an error of the force, at any update rate of the environment.
//
//     q = (π/(W h))²,   W² = min(20², K/4m) [1/s²]     (Ω/W)² of a swing at Ω [1/s], whose halves last h [s]
//     g = 0 below q = ¼, then 4/3 (q − ¼), 1 from q = 1 on
//     s ← s + (g − s) dt/τ_s,   τ_s = 20 ms
//
// h is the longer one of the half before and of this one so far: a hand slower than 1.6 Hz is not damped at all. A half
// ends when v comes back with a quarter of p, its peak, which fades within 0.1 s; noise of the samples does not end it.
// s is the share of the speed v [m/s] that is damped, of no more than 2p of the half before, because a damped swing does
// not grow. s lags behind g: a damper that changes within a tick is a step of the force. A contact begins with s = 1. A
// free mass on K, up to four times the stated m, swings at W or faster. Source: ours; docs/design/contacts.md § 6.

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {

template <class Scalar>
class swing {
 public:
  /// s v [m/s] of a speed v after a tick of dt [s], in a contact with K/m = `natural` [1/s²].
  [[nodiscard]] constexpr Scalar damped(Scalar v, Scalar natural, Scalar dt) noexcept {
    constexpr Scalar once = Scalar(9.8696044010893586);  // π²
    half_ += dt;
    if (const Scalar square = peak_ * peak_; v * peak_ < square / Scalar(-4)) {
      most_ = Scalar(2) * kernels::magnitude(peak_);
      before_ = half_;
      half_ = Scalar(0);
      peak_ = v;
    } else if (v * v > square) {
      peak_ = v;
    } else {
      peak_ -= peak_ * (dt < Scalar(0.1) ? dt * Scalar(10) : Scalar(1));
    }
    const Scalar h = kernels::larger(half_, before_);
    const Scalar Wh = kernels::smaller(Scalar(400), natural / Scalar(4)) * h * h;
    const Scalar damps = !(Wh < Scalar(4) * once) ? Scalar(0)
                         : Wh > once              ? (once / Wh - Scalar(0.25)) / Scalar(0.75)
                                                  : Scalar(1);
    share_ += (damps - share_) * (dt < Scalar(0.02) ? dt * Scalar(50) : Scalar(1));
    return kernels::clamped(v, -most_, most_) * share_;
  }
  /// Ends the contact.
  constexpr void stop() noexcept { *this = {}; }

 private:
  Scalar half_{}, before_{};  ///< time since the last turn, and of the half before [s]
  Scalar peak_{};             ///< p, with the sign of its speed [m/s]
  Scalar most_ = kernels::largest<Scalar>();  ///< 2p of the half before [m/s]
  Scalar share_{1};                           ///< s
};

}  // namespace v0
}  // namespace passive_haptics
