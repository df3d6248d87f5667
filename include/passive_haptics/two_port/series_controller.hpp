// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The published passivity controller of the impedance side, for comparison.

#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/two_port/packet.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// With the force f and the velocity v = Δx/dt of ONE sample (f here is the force on the device):
///     E_out += max(f·v dt, 0)      E_in += max(−f·v dt, 0)
///     E_out > E_in_rx and ‖v‖ > v_min:   α = (E_out − E_in_rx)/(dt v²) ≤ max_gain
///                                        f' = f − α v,   E_out −= α v² dt
/// (§ 2(d), from memory; thresholds as in public code.) A deficit beyond max_gain stays in E_out.
///
/// It would be passive if f and v were constant over the same sample. But f' is held during the NEXT displacement,
/// so on a sampled stiff wall these sums do not contain the leak of the hold (lemma L2). It is NOT passive; use
/// impedance_side for a guarantee.
struct two_port_series_parameters {
  double min_speed = 1e-3;  ///< v_min [m/s]; below it f' = f
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
  /// Takes new parameters and keeps the sums. If check() finds a fault, nothing changes.
  constexpr parameter_fault set(const two_port_series_parameters& p) noexcept {
    const auto fault = p.check();
    if (!fault) parameters_ = p;
    return fault;
  }

  /// Takes the other side's E_in [J] from a packet.
  constexpr void receive(scalar other) noexcept { static_cast<void>(received_.gain(other)); }
  [[nodiscard]] constexpr scalar in() const noexcept { return in_; }    ///< E_in [J]
  [[nodiscard]] constexpr scalar out() const noexcept { return out_; }  ///< E_out [J]

  struct ended_tick {
    vector desired = Space::zero();       ///< f, the force received [N]
    vector displacement = Space::zero();  ///< Δx, during the tick [m]
    scalar dt{};                          ///< its length, > 0 [s]
  };
  /// f', the force to command [N].
  [[nodiscard]] constexpr vector force(const ended_tick& tick) noexcept {
    const scalar min_speed = detail::number<scalar>(parameters_.min_speed);
    const scalar max_gain = detail::number<scalar>(parameters_.max_gain);
    const scalar gave = Space::dot(tick.desired, tick.displacement);
    (gave > scalar(0) ? out_ : in_) += kernels::magnitude(gave);
    const scalar square = Space::dot(tick.displacement, tick.displacement) / (tick.dt * tick.dt);
    const scalar excess = out_ - received_.newest;
    if (!(excess > scalar(0)) || !(square > min_speed * min_speed)) return tick.desired;
    const scalar alpha = kernels::smaller(excess / (tick.dt * square), max_gain);
    out_ += -alpha * square * tick.dt;
    return tick.desired - tick.displacement * (alpha / tick.dt);
  }

 private:
  two_port_series_parameters parameters_;
  scalar in_{}, out_{};
  received_energy<scalar> received_{};  ///< E_in_rx [J]
};

}  // namespace v0
}  // namespace passive_haptics
