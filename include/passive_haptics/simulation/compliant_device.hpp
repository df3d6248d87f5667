// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated device whose transmission gives: a motor with its encoder, a cable, and the handle behind it.
//
//   command ─▶ held for T ─▶ rotor m_r, b ──(k_c, d_c)── load m_L ◀── hand
//                              └─▶ encoder, meter
//
//     sim::compliant_device<scene, sim::impedance_hand<scene>> arm{{.mass = 0.1, .share = 0.3, .mode = 80.0}, {.limit = 5.0}};

#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/simulation/driver.hpp>
#include <passive_haptics/simulation/hand.hpp>

#include <numbers>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// Along every axis the same two masses: m_r = share·mass and m_L = mass − m_r, μ = m_r m_L/mass, and between them
///     k_c = μ ω²      d_c = 2 ζ ω μ      ω = 2π mode
template <class Space>
struct compliant_parameters {
  double mass = 0.1;      ///< of both together [kg]
  double share = 0.5;     ///< of it that moves with the encoder, in (0, 1)
  double mode = 100.0;    ///< frequency of the free resonance [Hz]
  double loss = 0.03;     ///< ζ of it
  double damping = 0.1;   ///< b, on the rotor [N·s/m]
  double friction = 0.0;  ///< dry, on the rotor and per axis; it falls linearly below 0.1 mm/s [N]
  double force_limit = std::numeric_limits<double>::infinity();  ///< most ‖f‖ [N]
  double quantum = 0.0;                                          ///< of the encoder [m]
  typename physical<Space>::coordinates start{};                 ///< [m]
  double period = 1e-3;                                          ///< T [s]
  int substeps = 60;  ///< times per period the hand is asked; ω T/substeps ≤ 0.5
  int latency = 0;    ///< periods from a command to its holding

  [[nodiscard]] parameter_fault check() const noexcept {
    if (!(share > 0.0 && share < 1.0)) return {"share", share, "in (0, 1)"};
    if (!(loss >= 0.0 && loss < 1.0)) return {"loss", loss, "in [0, 1)"};
    const double step = 2.0 * std::numbers::pi * mode * period / substeps;
    if (!(mode > 0.0 && step <= 0.5)) return {"mode", mode, "> 0 Hz, with substeps enough for it"};
    return as_driver().check();
  }
  /// What a stiff device has as well.
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
};

/// Models haptic_device_for<Space>. Leapfrog: what acts within a step does so at its middle, so each step has one
/// acceleration, and the rotor's travel and what its damper takes are exact for it. energy() is that of the port, which
/// is the motor's: E = ∫ b v_r² dt − Σ f·Δx_r.
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
        rotor_(parameters.start),
        load_(parameters.start),
        rotor_speed_(physical<Space>::zero()),
        load_speed_(physical<Space>::zero()),
        period_(parameters.period),
        sound_(!check()) {}

  /// As device::exchange().
  device_sample<Space> exchange(const vector& force) noexcept {
    if (!sound_) return {};
    const vector held = driver_.next(force);
    const state f = to_physical<Space>(held);
    const double h = period_ / p_.substeps;
    for (int i = 0; i < p_.substeps; ++i) step(f, time_ + i * h, h);
    time_ += period_;
    return {measured<Space>(rotor_, p_.quantum), held, static_cast<typename Space::scalar>(period_),
            true};
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
  [[nodiscard]] const state& position() const noexcept { return rotor_; }  ///< of the rotor [m]
  [[nodiscard]] const state& handle() const noexcept { return load_; }     ///< of the load [m]
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] Hand& hand() noexcept { return hand_; }
  [[nodiscard]] double energy() const noexcept { return energy_; }  ///< through the port so far [J]
  [[nodiscard]] double minimum() const noexcept {
    return minimum_;
  }  ///< the least of it so far [J]
  /// All that moves and is bent, less what came through the port and from the hand, and what was lost: zero to rounding
  /// and to the squares of the steps [J].
  [[nodiscard]] double residual() const noexcept {
    const state bent = load_ - rotor_;
    const double stored =
        0.5 * rotor_mass() * physical<Space>::dot(rotor_speed_, rotor_speed_) +
        0.5 * (p_.mass - rotor_mass()) * physical<Space>::dot(load_speed_, load_speed_) +
        0.5 * stiffness() * physical<Space>::dot(bent, bent);
    return stored - passed_;
  }

 private:
  [[nodiscard]] double rotor_mass() const noexcept { return p_.share * p_.mass; }
  [[nodiscard]] double reduced() const noexcept { return rotor_mass() * (1.0 - p_.share); }
  [[nodiscard]] double omega() const noexcept { return 2.0 * std::numbers::pi * p_.mode; }
  [[nodiscard]] double stiffness() const noexcept { return reduced() * omega() * omega(); }
  [[nodiscard]] double loss() const noexcept { return 2.0 * p_.loss * omega() * reduced(); }

  void step(const state& f, double t, double h) noexcept {
    const state x = rotor_ + rotor_speed_ * (h / 2.0), y = load_ + load_speed_ * (h / 2.0);
    const state asked = hand_.force(t, y, load_speed_);
    const state push = physical<Space>::is_finite(asked) ? asked : physical<Space>::zero();
    const state slip = load_speed_ - rotor_speed_;
    const state cable = (y - x) * stiffness() + slip * loss();
    state rubbing = physical<Space>::zero();
    for (int i = 0; i < Space::dof; ++i) {
      const double v = component(rotor_speed_, i) / 1e-4;
      component(rubbing, i) = p_.friction * (v > 1.0 ? 1.0 : v < -1.0 ? -1.0 : v);
    }
    const state others = cable - rotor_speed_ * p_.damping - rubbing;
    const state v = rotor_speed_, u = load_speed_;
    rotor_speed_ = v + (f + others) * (h / rotor_mass());
    load_speed_ = u + (push - cable) * (h / (p_.mass - rotor_mass()));
    const state moved = (v + rotor_speed_) * (h / 2.0);
    const state handled = (u + load_speed_) * (h / 2.0);
    rotor_ = rotor_ + moved;
    load_ = load_ + handled;
    using space = physical<Space>;
    const double square =
        space::dot(v, v) + space::dot(v, rotor_speed_) + space::dot(rotor_speed_, rotor_speed_);
    energy_ += p_.damping * h * square / 3.0 - space::dot(f, moved);
    minimum_ = energy_ < minimum_ ? energy_ : minimum_;
    passed_ += space::dot(f, moved) + space::dot(push, handled) -
               space::dot(state(v * p_.damping + rubbing), moved) -
               loss() * space::dot(slip, state(handled - moved));
  }

  parameters_type p_;
  Hand hand_;
  driver<Space> driver_;
  state rotor_, load_, rotor_speed_, load_speed_;
  double period_, time_ = 0.0, energy_ = 0.0, minimum_ = 0.0, passed_ = 0.0;
  bool sound_;
};

static_assert(haptic_device_for<compliant_device<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
