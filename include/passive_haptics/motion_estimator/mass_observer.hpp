// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A motion estimator for encoders with coarse steps, with a model of the mass (the menu is in last_difference.hpp).

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A state observer per axis, of x [m] and v [m/s], for encoders that show only the step [x̂, x̂ + q] (ours):
///     predict   x⁻ = x + v dt + a dt²/2,   v⁻ = v + a dt,   a = f_held/m + w
///     correct   x = x⁻ clamped to [x̂, x̂ + q],   c = x − x⁻
///               v = v⁻ + c/(64 dt),   w += c/(8 · 64² dt²)
///     follow    when corrections c of one sign sum to S, |S| > 4/3 q, within t seconds:
///               v += S/t,   w += S/(2 t²)
/// w [m/s²] is the acceleration by all forces but the motors': hand, weight, friction. Inside a step the model is
/// not corrected, so at rest the contact force does not hunt between two steps; a motion that quantisation cannot
/// explain is followed at once. With q = 0 every correction is followed.
///
/// docs/design/settling.md has the reasons for 64 and 4/3, and what else was tried. An encoder that rounds to the
/// nearest step instead of truncating moves every surface by q/2 and has no other effect.
struct mass_observer {
  double mass{};     ///< m, apparent mass of the device [kg]; an error of 30 % still settles
  double quantum{};  ///< q, one step of the measured position [m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(mass)) return {"mass", mass, "finite and > 0 kg"};
    if (!detail::not_negative(quantum)) return {"quantum", quantum, "finite and ≥ 0 m"};
    return {};
  }

  template <port P>
  class on;
};

template <port P>
class mass_observer::on {
 public:
  using scalar = typename P::scalar;
  using vector = typename P::pose;

  struct seen {
    vector position;  ///< [m]
    vector velocity;  ///< [m/s]
    [[nodiscard]] constexpr scalar along(const vector& n) const noexcept {
      return P::dot(velocity, n);
    }
  };

  constexpr explicit on(const mass_observer& p) noexcept { set(p); }
  constexpr void set(const mass_observer& p) noexcept {
    mass_ = detail::number<scalar>(p.mass);
    quantum_ = detail::number<scalar>(p.quantum);
  }
  [[nodiscard]] constexpr mass_observer parameters() const noexcept {
    return {.mass = static_cast<double>(mass_), .quantum = static_cast<double>(quantum_)};
  }
  constexpr void reset() noexcept {
    for (auto* zero : {&position_, &velocity_, &push_, &corrected_, &since_}) *zero = P::zero();
  }

  [[nodiscard]] constexpr seen estimate(const vector& shown, const vector& /*travel*/,
                                        const vector& held, scalar dt, bool known) noexcept {
    for (int i = 0; i < P::dof; ++i) {
      const scalar step = P::component(shown, i);
      if (known) {
        follow(i, step, P::component(held, i) / mass_, dt);
      } else {
        start(i, step + quantum_ / scalar(2));
      }
    }
    return {position_, velocity_};
  }
  [[nodiscard]] constexpr vector position() const noexcept { return position_; }  ///< x [m]

 private:
  using coordinates = typename P::coordinates;

  constexpr void start(int i, scalar x) noexcept {
    P::component(position_, i) = x;
    for (coordinates* zero : {&velocity_, &push_, &corrected_, &since_}) {
      P::component(*zero, i) = scalar(0);
    }
  }

  constexpr void follow(int i, scalar step, scalar driven, scalar dt) noexcept {
    scalar& x = P::component(position_, i);
    scalar& v = P::component(velocity_, i);
    scalar& w = P::component(push_, i);
    scalar& S = P::component(corrected_, i);
    scalar& t = P::component(since_, i);
    const scalar gain = scalar(1) / scalar(64);

    const scalar a = driven + w;
    const scalar predicted = x + (v + a * dt / scalar(2)) * dt;
    x = kernels::clamped(predicted, step, step + quantum_);
    const scalar c = x - predicted;
    v += a * dt + gain * c / dt;
    w += gain * gain * c / (scalar(8) * dt * dt);

    const bool turned = c * S < scalar(0);
    S = turned ? c : S + c;
    t = turned ? dt : t + dt;
    if (kernels::magnitude(S) * scalar(3) > quantum_ * scalar(4)) {
      v += S / t;
      w += S / (scalar(2) * t * t);
      S = t = scalar(0);
    }
    if (!kernels::is_finite(x + v + w))
      start(i, step + quantum_ / scalar(2));  // after a force that overflows
  }

  scalar mass_{}, quantum_{};
  coordinates position_{}, velocity_{}, push_{};  ///< x [m], v [m/s], w [m/s²]
  coordinates corrected_{}, since_{};             ///< S [m] and t [s] of each axis
};

static_assert(motion_estimator_for<mass_observer, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
