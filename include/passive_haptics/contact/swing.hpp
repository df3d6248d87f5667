// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decides which part of a speed is a swing. Only a swing is to be damped: a damper against a hand's motion is an error
// of the force, at any update rate of the environment.
//
//     h = v − v̄,   v̄ ← v̄ + h W dt/3                   what is faster than the mean of the last 3/W seconds
//     q = (π/(W H))²,   W = min(22/s, ½√(K/m))        (Ω/W)² of a swing at Ω [1/s], whose halves last H [s]
//     g = 0 below q = ¼, then 4/3 (q − ¼), 1 from q = 1 on
//     s ← s + (g − s) dt/τ_s,   τ_s = 20 ms
//
// H is the longer one of the half before and of this one so far: a hand slower than W/2, 1.8 Hz, is not damped at all.
// A half ends when h comes back with a quarter of p, its peak, which fades within 0.1 s; noise of the samples does not
// end it. s is the share of h [m/s] that is damped, of no more than v itself, so that a device that stands still is
// never pulled, and of no more than 2p of the half before, because a damped swing does not grow. s lags behind g: a
// damper that changes within a tick is a step of the force. A contact begins with s = 1. A free mass on K, up to four
// times the stated m, swings at W or faster. Source: ours; docs/design/contacts.md § 6.

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {

template <class Scalar>
class swing {
 public:
  /// What is damped [m/s] of a speed v after a tick of dt [s], in a contact with √(K/m) = `natural` [1/s].
  [[nodiscard]] constexpr Scalar damped(Scalar v, Scalar natural, Scalar dt) noexcept {
    constexpr Scalar pi = Scalar(3.14159265358979324), none = Scalar(0), all = Scalar(1);
    const Scalar W = kernels::smaller(Scalar(22), natural / Scalar(2)), h = v - mean_;
    mean_ += h * kernels::smaller(dt * W / Scalar(3), all);
    half_ += dt;
    if (const Scalar square = peak_ * peak_; h * peak_ < square / Scalar(-4)) {
      most_ = Scalar(2) * kernels::magnitude(peak_);
      before_ = half_;
      half_ = none;
      peak_ = h;
    } else if (h * h > square) {
      peak_ = h;
    } else {
      peak_ -= peak_ * kernels::smaller(dt * Scalar(10), all);
    }
    const Scalar turn = W * kernels::larger(half_, before_) / pi;  // 1/√q
    const Scalar damps = turn > all ? (Scalar(4) / (turn * turn) - all) / Scalar(3) : all;
    share_ += (kernels::larger(damps, none) - share_) * kernels::smaller(dt * Scalar(50), all);
    const Scalar part = kernels::clamped(h, -most_, most_);
    return kernels::clamped(part, kernels::smaller(v, none), kernels::larger(v, none)) * share_;
  }
  /// Ends the contact.
  constexpr void stop() noexcept { *this = {}; }

 private:
  Scalar mean_{};             ///< v̄ [m/s]
  Scalar half_{}, before_{};  ///< time since the last turn, and of the half before [s]
  Scalar peak_{};             ///< p, with the sign of its h [m/s]
  Scalar most_ = kernels::largest<Scalar>();  ///< 2p of the half before [m/s]
  Scalar share_{1};                           ///< s
};

}  // namespace v0
}  // namespace passive_haptics
