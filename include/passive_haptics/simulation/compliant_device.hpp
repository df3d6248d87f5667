// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated device with an elastic transmission: a motor with its encoder, a cable, and the handle behind it, as two
// to four masses in a row.
//
//   command ─▶ held for T ─▶ rotor m_r, b ──(k_c, d_c)── load m_L ◀── hand
//                              └─▶ encoder, meter        (of one mass, or of two or three with springs between)
//
//     sim::compliant_device<scene, sim::impedance_hand<scene>> arm{{.mass = 0.1, .share = 0.3, .mode = 80.0}, {.limit = 5.0}};

#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/simulation/driver.hpp>
#include <passive_haptics/simulation/hand.hpp>

#include <array>
#include <cstddef>
#include <numbers>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// Along every axis a rotor m_r = share·mass and a load m_L = mass − m_r, with μ = m_r m_L/mass, and between them
///     k_c = μ ω² [N/m]      d_c = 2 ζ ω μ [N·s/m]      ω = 2π mode [1/s]
/// The load is `masses` − 1 equal masses, and two neighbours alone would ring with `inner_mode` and the same ζ.
template <class Space>
struct compliant_parameters {
  double mass = 0.1;          ///< of rotor and load [kg]
  double share = 0.5;         ///< share of the mass that moves with the encoder, in (0, 1)
  double mode = 100.0;        ///< frequency of the free resonance [Hz]
  double loss = 0.03;         ///< ζ, damping ratio of the resonances, in [0, 1)
  int masses = 2;             ///< number of masses with the rotor, 2 to 4
  double inner_mode = 300.0;  ///< resonance of two neighbours within the load [Hz]
  double damping = 0.1;       ///< b, on the rotor [N·s/m]
  double friction = 0.0;      ///< dry, on the rotor, per axis [N]; proportional to v below 0.1 mm/s
  double force_limit = std::numeric_limits<double>::infinity();  ///< most ‖f‖ [N]
  double quantum = 0.0;                                          ///< of the encoder [m]
  typename physical<Space>::coordinates start{};                 ///< [m]
  double period = 1e-3;                                          ///< T [s]
  int substeps = 60;  ///< steps of integration per period T; 2π mode T/substeps ≤ 0.5
  int latency = 0;    ///< periods from a command to its holding

  [[nodiscard]] parameter_fault check() const noexcept {
    if (!(share > 0.0 && share < 1.0)) return {"share", share, "in (0, 1)"};
    if (!(loss >= 0.0 && loss < 1.0)) return {"loss", loss, "in [0, 1)"};
    if (masses < 2 || masses > 4) return {"masses", static_cast<double>(masses), "2 to 4"};
    const auto is_resolved = [this](double f) {
      return f > 0.0 && 2.0 * std::numbers::pi * f * period / substeps <= 0.5;
    };
    if (!is_resolved(mode)) return {"mode", mode, "> 0 Hz, with substeps enough for it"};
    if (masses > 2 && !is_resolved(inner_mode)) {
      return {"inner_mode", inner_mode, "> 0 Hz, with substeps enough for it"};
    }
    return as_driver().check();
  }
  /// Mass i [kg], 0 being the rotor, and the spring [N/m] and the damper [N·s/m] between it and mass i + 1.
  [[nodiscard]] double mass_of(int i) const noexcept {
    return i == 0 ? share * mass : (1.0 - share) * mass / (masses - 1);
  }
  [[nodiscard]] double spring_of(int i) const noexcept { return reduced(i) * omega(i) * omega(i); }
  [[nodiscard]] double loss_of(int i) const noexcept { return 2.0 * loss * omega(i) * reduced(i); }
  /// The parameters that a rigid device has as well.
  [[nodiscard]] device_parameters<Space> as_driver() const noexcept {
    device_parameters<Space> p;
    p.mass = mass;
    p.damping = damping;
    p.friction = friction;
    p.force_limit = force_limit;
    p.quantum = quantum;
    p.start = start;
    p.period = period;
    p.substeps = substeps;
    p.latency = latency;
    return p;
  }

 private:
  [[nodiscard]] double reduced(int i) const noexcept {
    return i == 0 ? share * (1.0 - share) * mass : mass_of(i) / 2.0;
  }
  [[nodiscard]] double omega(int i) const noexcept {
    return 2.0 * std::numbers::pi * (i == 0 ? mode : inner_mode);
  }
};

/// Models haptic_device_for<Space>. In each step the springs and the hand act with the positions of its middle, dampers
/// and friction with the speeds of its beginning. So the acceleration is constant, and ∫ b v_r² dt and Δx_r are exact for
/// it. energy() is that of the port, which is the motor's: E = ∫ b v_r² dt − Σ f·Δx_r [J].
template <class Space, class Hand = no_hand<Space>>
class compliant_device {
 public:
  using vector = typename Space::vector;
  using state = typename physical<Space>::vector;
  using parameters_type = compliant_parameters<Space>;

  explicit compliant_device(const parameters_type& parameters = {}, const Hand& hand = {}) noexcept
      : p_(parameters),
        hand_(hand),
        driver_(parameters.as_driver()),
        period_(parameters.period),
        sound_(!check()) {
    at_.fill(parameters.start);
    speed_.fill(physical<Space>::zero());
  }

  /// Does what device::exchange() does.
  device_sample<Space> exchange(const vector& force) noexcept {
    if (!sound_) return {};
    const vector held = driver_.next(force);
    const state f = to_physical<Space>(held);
    const double h = period_ / p_.substeps;
    for (int i = 0; i < p_.substeps; ++i) step(f, time_ + i * h, h);
    time_ += period_;
    return {measured<Space>(position(), p_.quantum), held,
            static_cast<typename Space::scalar>(period_), true};
  }
  /// The length of the coming periods [s], for jitter.
  bool set_period(double T) noexcept {
    if (!(T > 0.0 && T <= 2.0 * p_.period)) return false;
    period_ = T;
    return true;
  }
  [[nodiscard]] parameter_fault check() const noexcept {
    if (const auto fault = p_.check()) return fault;
    return hand_.check();
  }
  [[nodiscard]] state position() const noexcept { return at_[0]; }  ///< of the rotor [m]
  /// The position of the last mass, which the hand holds [m].
  [[nodiscard]] state handle() const noexcept { return at_[last()]; }
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] Hand& hand() noexcept { return hand_; }
  [[nodiscard]] double energy() const noexcept { return energy_; }  ///< through the port so far [J]
  [[nodiscard]] double minimum() const noexcept {
    return minimum_;
  }  ///< the least of it so far [J]
  /// The largest force of the transmission on the rotor [N], and its largest rate of change [N/s].
  [[nodiscard]] double most_pull() const noexcept { return most_pull_; }
  [[nodiscard]] double most_slew() const noexcept { return most_slew_; }
  /// Kinetic and elastic energy, less the work of motor and hand, plus the losses in dampers and friction [J]. It is zero
  /// but for rounding and an error of second order in the step.
  [[nodiscard]] double residual() const noexcept {
    double stored = 0.0;
    for (int i = 0; i < p_.masses; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const state v = speed_[at];
      stored += 0.5 * p_.mass_of(i) * physical<Space>::dot(v, v);
      if (i + 1 == p_.masses) break;
      const state bent = state(at_[at + 1]) - state(at_[at]);
      stored += 0.5 * p_.spring_of(i) * physical<Space>::dot(bent, bent);
    }
    return stored - passed_;
  }

 private:
  static constexpr std::size_t most = 4;
  [[nodiscard]] std::size_t last() const noexcept {
    return static_cast<std::size_t>(p_.masses - 1);
  }

  void step(const state& f, double t, double h) noexcept {
    using space = physical<Space>;
    std::array<state, most> middle{}, before{}, force{};
    for (std::size_t i = 0; i <= last(); ++i) {
      before[i] = speed_[i];
      middle[i] = state(at_[i]) + before[i] * (h / 2.0);
      force[i] = space::zero();
    }
    const state asked = hand_.force(t, middle[last()], before[last()]);
    const state push = space::is_finite(asked) ? asked : space::zero();
    for (std::size_t i = 0; i < last(); ++i) {
      const int n = static_cast<int>(i);
      const state slip = before[i + 1] - before[i];
      const state pulls = (middle[i + 1] - middle[i]) * p_.spring_of(n) + slip * p_.loss_of(n);
      force[i] = force[i] + pulls;
      force[i + 1] = force[i + 1] - pulls;
    }
    see_pull(force[0], h);
    force[last()] = force[last()] + push;
    state rubbing = space::zero();
    for (int i = 0; i < Space::dof; ++i) {
      const double v = component(before[0], i) / 1e-4;
      component(rubbing, i) = p_.friction * (v > 1.0 ? 1.0 : v < -1.0 ? -1.0 : v);
    }
    force[0] = force[0] + f - before[0] * p_.damping - rubbing;
    std::array<state, most> moved{};
    for (std::size_t i = 0; i <= last(); ++i) {
      const state next = before[i] + force[i] * (h / p_.mass_of(static_cast<int>(i)));
      moved[i] = (before[i] + next) * (h / 2.0);
      speed_[i] = next;
      at_[i] = state(state(at_[i]) + moved[i]);
    }
    const state v = before[0], u = speed_[0];
    const double square = space::dot(v, v) + space::dot(v, u) + space::dot(u, u);
    energy_ += p_.damping * h * square / 3.0 - space::dot(f, moved[0]);
    minimum_ = energy_ < minimum_ ? energy_ : minimum_;
    passed_ += space::dot(f, moved[0]) + space::dot(push, moved[last()]) -
               space::dot(state(v * p_.damping + rubbing), moved[0]);
    for (std::size_t i = 0; i < last(); ++i) {
      passed_ -= p_.loss_of(static_cast<int>(i)) *
                 space::dot(state(before[i + 1] - before[i]), state(moved[i + 1] - moved[i]));
    }
  }

  void see_pull(const state& pull, double h) noexcept {
    const double size = physical<Space>::norm(pull);
    most_pull_ = size > most_pull_ ? size : most_pull_;
    if (time_ > 0.0) {
      const double slew = physical<Space>::norm(state(pull - state(pull_))) / h;
      most_slew_ = slew > most_slew_ ? slew : most_slew_;
    }
    pull_ = pull;
  }

  parameters_type p_;
  Hand hand_;
  driver<Space> driver_;
  std::array<typename physical<Space>::coordinates, most> at_{}, speed_{};
  typename physical<Space>::coordinates pull_{};
  double period_, time_ = 0.0, energy_ = 0.0, minimum_ = 0.0, passed_ = 0.0;
  double most_pull_ = 0.0, most_slew_ = 0.0;
  bool sound_;
};

static_assert(haptic_device_for<compliant_device<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
