// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One axis of a device under a constant force, integrated exactly.
//
//     m ẍ + b ẋ = F − f_c sign(ẋ),     lower ≤ x ≤ upper                       F held for a time h
//
//   flow          the linear part over a time h, in closed form, for any b h/m ≥ 0
//   axis          adds Coulomb friction with stiction and inelastic end stops, event by event
//   axis_motion   the displacement, and where the energy went
//
// A constant force leaves at most three events: the axis comes to rest, it turns or hits a stop, it
// hits the other stop. Not offered: a step size, elastic stops. For friction that is elastic or has a
// Stribeck curve see friction_axis.hpp.

#include <passive_haptics/base/language.hpp>

#include <cmath>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// The solution of m v̇ + b v = F, F constant, over a time h. With r = b/m [1/s], z = r h, a = F/m [m/s²]:
///     v(h) = v + v (e⁻ᶻ − 1) + a h φ₁(z)    φ₁(z) = (1 − e⁻ᶻ)/z
///     Δx   = v h φ₁(z) + a h² φ₂(z)         φ₂(z) = (1 − φ₁)/z
///     ∫v²  = A (v + C a)² + D a²            A = h φ₁(2z),  C = h φ₁/(1 + e⁻ᶻ),
///                                           D = h³ (ψ − φ₁³/(2 + 2e⁻ᶻ)),  ψ = (φ₂ − φ₁²/2)/z
/// Rounding acts on the change of v and not on the factor e⁻ᶻ, so the errors of many steps do not add up
/// to a drift. The integral is a sum of squares, so it is never negative, and its form is well conditioned
/// for all z (2 × 2 Hilbert matrix at z = 0): unlike F Δx − ½ m Δ(v²) it does not cancel.
class flow {
 public:
  flow() noexcept = default;
  flow(double rate, double duration) noexcept : duration_(duration) {
    const double z = rate * duration;
    change_ = std::expm1(-z);
    const double phi1 = z > 0.0 ? -change_ / z : 1.0;
    double phi2 = 0.0;
    double psi = 0.0;
    if (z < 1.0) {
      // φ₂ = Σ (−z)ᵏ/(k+2)!,  ψ = Σ (−z)ᵏ (2ᵏ⁺² − 2)/((k+2)! (k+3)): the closed forms cancel here
      double term = 0.5;
      double power = 4.0;
      for (int k = 0; k < 32 && std::abs(term) * power > 1e-20; ++k) {
        phi2 += term;
        psi += term * (power - 2.0) / (k + 3);
        term *= -z / (k + 3);
        power *= 2.0;
      }
    } else {
      phi2 = (1.0 - phi1) / z;
      psi = (phi2 - phi1 * phi1 / 2.0) / z;
    }
    const double decay = std::exp(-z);
    reach_ = duration * phi1;
    swing_ = duration * duration * phi2;
    square_ = reach_ * (1.0 + decay) / 2.0;
    shift_ = reach_ / (1.0 + decay);
    rest_ = duration * duration * duration * (psi - phi1 * phi1 * phi1 / (2.0 * (1.0 + decay)));
  }

  [[nodiscard]] double duration() const noexcept { return duration_; }  ///< h [s]
  [[nodiscard]] double velocity(double v, double a) const noexcept {
    return v + (v * change_ + a * reach_);
  }
  [[nodiscard]] double displacement(double v, double a) const noexcept {
    return v * reach_ + a * swing_;
  }
  /// ∫ v² dt [m²/s]
  [[nodiscard]] double squared_speed(double v, double a) const noexcept {
    const double w = v + shift_ * a;
    return square_ * w * w + rest_ * a * a;
  }

 private:
  double duration_ = 0.0, change_ = 0.0, reach_ = 0.0, swing_ = 0.0;
  double square_ = 0.0, shift_ = 0.0, rest_ = 0.0;
};

struct axis_state {
  double position = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
};

/// Δx [m] and the energy [J] that went into the damper (∫ b v² dt), into dry friction (here ∫ f_c|v| dt)
/// and into the end stops, each ≥ 0, and into the springs of elastic friction; that part is < 0 if they give it back.
///     F Δx = Δ(½ m v²) + damping + friction + stops + stored
struct axis_motion {
  double displacement = 0.0;
  double damping = 0.0;
  double friction = 0.0;
  double stops = 0.0;
  double stored = 0.0;
};

struct axis {
  double mass = 0.1;                                        ///< m [kg]
  double damping = 0.03;                                    ///< b [N·s/m]
  double friction = 0.0;                                    ///< f_c [N]
  double lower = -std::numeric_limits<double>::infinity();  ///< end stop [m]
  double upper = std::numeric_limits<double>::infinity();   ///< end stop [m]

  /// The linear part over h [s]. Make it once and use it for every interval of that length.
  [[nodiscard]] flow over(double h) const noexcept { return {damping / mass, h}; }

  axis_motion advance(axis_state& state, double force, double h) const noexcept {
    return advance(state, force, over(h));
  }

  /// Moves `state` through whole.duration() under `force` [N].
  axis_motion advance(axis_state& state, double force, const flow& whole) const noexcept {
    axis_motion done;
    const double h = whole.duration();
    const double a = force / mass;
    const double farthest = (std::abs(state.velocity) + std::abs(a) * h / 2.0) * h;
    if (friction == 0.0 && state.position + farthest < upper && state.position - farthest > lower) {
      const double dx = whole.displacement(state.velocity, a);
      done = {dx, damping * whole.squared_speed(state.velocity, a), 0.0, 0.0, 0.0};
      state = {state.position + dx, whole.velocity(state.velocity, a)};
      return done;
    }
    double left = h;
    for (int piece = 0; piece < 5 && left > 0.0; ++piece) {
      left -= advance_to_event(state, force, left, left == h ? whole : over(left), done);
    }
    return done;
  }

 private:
  [[nodiscard]] double kinetic(double v) const noexcept { return mass * v * v / 2.0; }

  /// Moves up to the next event or the end of `ahead`; returns the time that this takes [s].
  double advance_to_event(axis_state& s, double force, double left, flow ahead,
                          axis_motion& done) const noexcept {
    const bool resting = s.velocity == 0.0;
    if (resting && std::abs(force) <= friction) return left;
    const double way = (resting ? force : s.velocity) > 0.0 ? 1.0 : -1.0;
    const double stop = way > 0.0 ? upper : lower;
    if ((stop - s.position) * way <= 0.0) {
      if (resting) return left;
      done.stops += kinetic(s.velocity);
      s.velocity = 0.0;
      return 0.0;
    }
    const double a = (force - friction * way) / mass;
    const bool comes_to_rest = a * way < 0.0 && ahead.velocity(s.velocity, a) * way <= 0.0;
    if (comes_to_rest) ahead = over(std::fmin(left, time_to_rest(s.velocity, a)));
    double dx = ahead.displacement(s.velocity, a);
    const bool hits = (s.position + dx - stop) * way >= 0.0;
    if (hits) {
      dx = stop - s.position;
      ahead = over(time_to_travel(dx, s.velocity, a, ahead.duration()));
    }
    const double last = comes_to_rest && !hits ? 0.0 : ahead.velocity(s.velocity, a);
    done.displacement += dx;
    done.damping += damping * ahead.squared_speed(s.velocity, a);
    done.friction += friction * std::abs(dx);
    if (hits) done.stops += kinetic(last);
    s = {hits ? stop : s.position + dx, hits ? 0.0 : last};
    return ahead.duration();
  }

  /// t [s] at which v e⁻ʳᵗ + a t φ₁(r t) = 0:  t = ln(1 + q)/r with q = −r v/a ≥ 0
  [[nodiscard]] double time_to_rest(double v, double a) const noexcept {
    const double q = -(damping / mass) * v / a;
    return -v / a * (q > 0.0 ? std::log1p(q) / q : 1.0);
  }

  /// The time [s] in [0, latest] at which a motion that does not turn has gone `distance` [m], by Newton's
  /// iteration in a bracket, which is halved whenever an iterate would leave it.
  [[nodiscard]] double time_to_travel(double distance, double v, double a,
                                      double latest) const noexcept {
    const double way = distance > 0.0 ? 1.0 : -1.0;
    double early = 0.0;
    double late = latest;
    double t = latest;
    for (int i = 0; i < 200; ++i) {
      const flow until = over(t);
      const double beyond = (until.displacement(v, a) - distance) * way;
      (beyond > 0.0 ? late : early) = t;
      double next = t - beyond / (until.velocity(v, a) * way);
      if (!(next >= early && next <= late)) next = early + (late - early) / 2.0;
      if (next == t || late - early <= std::numeric_limits<double>::epsilon() * late) return next;
      t = next;
    }
    return t;
  }
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
