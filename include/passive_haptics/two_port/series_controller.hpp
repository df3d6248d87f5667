// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The published passivity controller of the impedance side, for comparison.

#include <passive_haptics/base/seconds.hpp>
#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/two_port/packet.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// With the force f and the velocity v = Δx/dt of ONE sample (f here is the force on the device):
///     E_out += max(f·v dt, 0)      E_in += max(−f·v dt, 0)
///     E_out > E_in_rx and ‖v‖ > v_min:   α = (E_out − E_in_rx)/(dt v²) ≤ max_gain
///                                        f' = f − α v,   E_out −= α v² dt
/// (§ 2(d), from memory; thresholds as seen in public code.) What max_gain leaves of E_out is carried on.
///
/// This would be passive if f and v were constant over one and the same sample. But f' is held during the
/// NEXT displacement, and on a sampled stiff wall this bookkeeping sees no leak at all (lemma L2).
/// impedance_side is the form that keeps the promise.
struct two_port_series_parameters {
  double min_speed = 1e-3;  ///< v_min; nothing is done below it [m/s]
  double max_gain =
      std::numeric_limits<double>::infinity();  ///< largest α [N·s/m]; stable up to 0.5 m/T

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(min_speed)) return {"min_speed", min_speed, "finite and ≥ 0 m/s"};
    if (!(max_gain >= 0.0)) return {"max_gain", max_gain, "≥ 0 N·s/m"};
    return {};
  }
};

template <class Space>
class two_port_series_controller {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  constexpr explicit two_port_series_controller(const two_port_series_parameters& p = {}) noexcept
      : parameters_(p) {}
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return parameters_.check(); }
  /// New parameters; the sums are kept. A fault changes nothing.
  constexpr parameter_fault set(const two_port_series_parameters& p) noexcept {
    const auto fault = p.check();
    if (!fault) parameters_ = p;
    return fault;
  }

  constexpr void receive(scalar other) noexcept { static_cast<void>(received_.gain(other)); }
  [[nodiscard]] constexpr scalar in() const noexcept { return in_; }    ///< E_in [J]
  [[nodiscard]] constexpr scalar out() const noexcept { return out_; }  ///< E_out [J]

  /// The force to command [N] for the force received [N] and the displacement [m] of the tick of
  /// that length, > 0, that has just ended.
  [[nodiscard]] constexpr vector force(const vector& desired, const vector& displacement,
                                       seconds<scalar> length) noexcept {
    const scalar dt = length.count();
    const scalar min_speed = detail::number<scalar>(parameters_.min_speed);
    const scalar max_gain = detail::number<scalar>(parameters_.max_gain);
    const scalar gave = Space::dot(desired, displacement);
    (gave > scalar(0) ? out_ : in_) += kernels::magnitude(gave);
    const scalar square = Space::dot(displacement, displacement) / (dt * dt);
    const scalar excess = out_ - received_.newest;
    if (!(excess > scalar(0)) || !(square > min_speed * min_speed)) return desired;
    const scalar alpha = kernels::smaller(excess / (dt * square), max_gain);
    out_ += -alpha * square * dt;
    return desired - displacement * (alpha / dt);
  }
  /// A number where the length belongs could be a force as well: this does not compile.
  template <std::convertible_to<scalar> Number>
  vector force(const vector& desired, const vector& /*displacement*/,
               const Number& /*length*/) noexcept {
    detail::refuse_bare_time<Number>();
    return desired;
  }

 private:
  two_port_series_parameters parameters_;
  scalar in_{}, out_{};
  received_energy<scalar> received_{};  ///< E_in_rx [J]
};

}  // namespace v0
}  // namespace passive_haptics
