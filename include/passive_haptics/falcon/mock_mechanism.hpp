// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The arms of a simulated Falcon: motor words in, encoder counts out, a hand at the grip.
//
//   words ─▶ τ = −word/k ─▶ F = Aᵀτ at the true pose ─▶ m p̈ + b ṗ = F + F_hand ─▶ θ(p) ─▶ counts
//
// The motors hold torques, but the body is pushed by forces. So over each step F is the force that does the
// torques' work, F·Δp = τ·Δθ (force_over), and the energy meter of the body is exact for the motors. Mass,
// damping and homing angles are our choice, because those of a Falcon are not published.

#include <passive_haptics/base/ledger.hpp>
#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/falcon/force.hpp>
#include <passive_haptics/falcon/packet.hpp>

#include <algorithm>
#include <concepts>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// The body that the arms carry, a mass in three dimensions, such as simulation::device<space<double, 3>, Hand>.
/// The mechanism copies it to try a step.
template <class B>
concept mock_body = std::copyable<B> && requires(B body, const B still, typename B::vector force) {
  typename B::parameters_type;
  body.set_period(1e-3);  // the length of the coming step [s]
  body.exchange(force);   // one step under a force [N]
  still.position()[2];    // [m]
};

/// `Body` is the type of the body's parameters, simulation::device_parameters<space<double, 3>> for example. The
/// body's end stops keep every pose regular, and its period is the longest step.
template <class Body>
struct mock_parameters {
  Body body{.mass = 0.1,
            .damping = 0.03,
            .lower = {-0.035, -0.035, 0.080},
            .upper = {0.035, 0.035, 0.165},
            .period = 125e-6,
            .start = {0.0, 0.0, 0.125},
            .substeps = 2};
  double gain = cautious_gain<double>;  ///< k, of the simulated motors [counts per N·m]
  bool runs = false;                    ///< a program runs from the start
  bool homed = false;                   ///< all legs are homed from the start
  double out_angle = 0.96;              ///< a leg is homed when it has been beyond this [rad]
  double in_angle = 0.10;               ///< and after that below this [rad]

  [[nodiscard]] parameter_fault check() const noexcept {
    if (const auto fault = body.check()) return fault;
    if (!(gain > 0.0) || !kernels::is_finite(gain)) {
      return {"gain", gain, "finite and > 0 counts per N·m"};
    }
    if (!(out_angle > in_angle)) return {"out_angle", out_angle, "> in_angle"};
    return {};
  }
};

template <mock_body Body>
class mock_mechanism {
 public:
  using body_type = Body;
  using parameters_type = mock_parameters<typename Body::parameters_type>;

  /// The other arguments go to the body: simulation::device takes a hand.
  template <class... Arguments>
  explicit mock_mechanism(const parameters_type& parameters = {}, const Arguments&... left) noexcept
      : parameters_(parameters), body_(parameters.body, left...) {
    look();
    homed_ = parameters.homed ? from_device::all_legs : byte(0);
    at_power_up_ = to_counts(theta_);
  }

  /// The motors hold these words until the next ones come.
  void hold(const leg_words& words) noexcept {
    words_ = words;
    torque_ = decode(words, parameters_.gain);
  }

  /// Lets time pass [s].
  void elapse(double time) noexcept {
    while (time > 0.0) {
      const double step = (std::min)(time, parameters_.body.period);
      (void)body_.set_period(step);
      move();
      time -= step;
    }
  }

  /// The counts that the encoders show: relative to power-up, and absolute for a leg that is homed.
  [[nodiscard]] leg_words encoder() const noexcept {
    const counts now = to_counts(theta_);
    leg_words shown{};
    for (std::size_t i = 0; i < 3; ++i) {
      const bool knows = (homed_ >> i & 1) != 0;
      shown[i] = static_cast<std::int16_t>(knows ? now[i] : now[i] - at_power_up_[i]);
    }
    return shown;
  }

  [[nodiscard]] byte homed() const noexcept { return homed_; }  ///< bit i: leg i
  [[nodiscard]] const leg_words& words() const noexcept { return words_; }
  [[nodiscard]] const torques<double>& torque() const noexcept { return torque_; }  ///< [N·m]
  /// Σ τ·Δθ [J], the work of the motors.
  [[nodiscard]] double motor_work() const noexcept { return motor_work_; }
  [[nodiscard]] const angles<double>& theta() const noexcept { return theta_; }  ///< true [rad]
  [[nodiscard]] body_type& body() noexcept { return body_; }
  [[nodiscard]] const body_type& body() const noexcept { return body_; }

 private:
  [[nodiscard]] static point<double> position_of(const body_type& body) noexcept {
    return {{body.position()[0], body.position()[1], body.position()[2]}};
  }
  [[nodiscard]] static typename Body::vector vector_of(const force<double>& f) noexcept {
    return {f[0], f[1], f[2]};
  }

  /// Makes one step. Three fixed-point iterations find Δp and the force F with F·Δp = τ·Δθ.
  void move() noexcept {
    const point<double> from = position_of(body_);
    const angles<double> before = theta_;
    force<double> push{};
    if (words_ != leg_words{}) {
      push = force_from(rates(from, before), torque_);
      for (int trial = 0; trial < 3; ++trial) {
        body_type ahead = body_;
        (void)ahead.exchange(vector_of(push));
        push = force_along(from, position_of(ahead), before);
      }
    }
    (void)body_.exchange(vector_of(push));
    look();
    motor_work_ += dot(torque_, theta_ - before);
  }

  [[nodiscard]] force<double> force_along(const point<double>& from, const point<double>& to,
                                          const angles<double>& before) const noexcept {
    const point<double> middle = 0.5 * (from + to);
    const auto half_way = inverse(middle);
    const auto after = inverse(to);
    if (!half_way || !after) return force_from(rates(from, before), torque_);
    const auto f = force_from(rates(middle, half_way.value), torque_);
    return force_over(f, torque_, after.value - before, to - from);
  }

  /// Finds the angles of the legs, and whether they have made the motion that homes them.
  void look() noexcept {
    const auto seen = inverse(position_of(body_));
    if (!seen) return;
    theta_ = seen.value;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto leg = static_cast<byte>(1U << i);
      if (theta_[i] > parameters_.out_angle) been_out_ = static_cast<byte>(been_out_ | leg);
      if ((been_out_ & leg) != 0 && theta_[i] < parameters_.in_angle) {
        homed_ = static_cast<byte>(homed_ | leg);
      }
    }
  }

  parameters_type parameters_;
  body_type body_;
  leg_words words_{};
  torques<double> torque_{};
  angles<double> theta_{};
  counts at_power_up_{};
  byte homed_ = 0, been_out_ = 0;
  compensated_sum<double> motor_work_;
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
