// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motion estimators: where the device is and how fast it moves, from what the encoders show.
//
//   last_difference   x̂ and Δx̂/dt                       the default; for fine encoders
//   mass_observer     a mass under the force held,       for encoders whose steps are felt; needs
//                     kept within the step shown         the mass; settles on ideal devices
//
// Geometry and contact law look at the estimate. Ledger and bound never do: they count what was
// measured, so no estimate, however wrong, costs the guarantee.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The position shown, and the speed between the last two.
template <class Space>
struct last_difference {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;

  struct motion {
    const vector& position;  ///< [m]
    const vector& displacement;
    scalar dt;
    /// Speed along a unit vector [m/s].
    [[nodiscard]] constexpr scalar along(const vector& n) const noexcept {
      return Space::dot(displacement, n) / dt;
    }
  };
  [[nodiscard]] constexpr motion estimate(const vector& position, const vector& displacement,
                                          const vector& /*held*/, scalar dt,
                                          bool /*known*/) const noexcept {
    return {position, displacement, dt};
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

/// A state observer per axis for encoders that show only the step [x̂, x̂ + q] the device is in:
///     predict   x⁻ = x + v dt + a dt²/2,   v⁻ = v + a dt,   a = f_held/m + w
///     correct   x = x⁻ clamped to [x̂, x̂ + q],   c = x − x⁻
///               v = v⁻ + c/(64 dt),   w += c/(8 · 64² dt²)
///     believe   when the c of one direction add up to S, |S| > 4/3 q, in t seconds:
///               v += S/t,   w += S/(2 t²)
/// w [m/s²] is all that pushes besides the motors: hand, weight, friction. Inside a step the model
/// runs free, so at rest the contact force does not hunt between two steps; a real motion, which
/// quantisation cannot explain, is taken over at once. With q = 0 every correction is believed.
///
/// Why these numbers, and what else was tried: docs/design/settling.md. An encoder that rounds
/// instead of cutting off moves every surface by q/2 and changes nothing else.
template <class Space>
struct mass_observer {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using coordinates = typename Space::coordinates;
  static constexpr guarantee passivity = guarantee::strict;

  scalar mass{};     ///< m, apparent mass of the device [kg]; 30 % off still settles
  scalar quantum{};  ///< q, one step of the position shown [m]
  coordinates position{}, velocity{}, push{};  ///< x [m], v [m/s], w [m/s²]
  coordinates corrected{}, since{};            ///< S [m] and t [s] of each axis

  struct motion {
    vector position;  ///< [m]
    vector velocity;  ///< [m/s]
    [[nodiscard]] constexpr scalar along(const vector& n) const noexcept {
      return Space::dot(velocity, n);
    }
  };

  [[nodiscard]] constexpr motion estimate(const vector& shown, const vector& /*displacement*/,
                                          const vector& held, scalar dt, bool known) noexcept {
    for (int i = 0; i < Space::dof; ++i) {
      const scalar step = Space::component(shown, i);
      if (known) {
        follow(i, step, Space::component(held, i) / mass, dt);
      } else {
        start(i, step + quantum / scalar(2));
      }
    }
    return {position, velocity};
  }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(mass > scalar(0)) || !kernels::is_finite(mass)) {
      return {"mass", mass, "finite and > 0 kg"};
    }
    if (!(quantum >= scalar(0)) || !kernels::is_finite(quantum)) {
      return {"quantum", quantum, "finite and ≥ 0 m"};
    }
    return {};
  }

 private:
  constexpr void start(int i, scalar x) noexcept {
    Space::component(position, i) = x;
    for (coordinates* zero : {&velocity, &push, &corrected, &since}) {
      Space::component(*zero, i) = scalar(0);
    }
  }

  constexpr void follow(int i, scalar step, scalar driven, scalar dt) noexcept {
    scalar& x = Space::component(position, i);
    scalar& v = Space::component(velocity, i);
    scalar& w = Space::component(push, i);
    scalar& S = Space::component(corrected, i);
    scalar& t = Space::component(since, i);
    const scalar gain = scalar(1) / scalar(64);

    const scalar a = driven + w;
    const scalar predicted = x + (v + a * dt / scalar(2)) * dt;
    x = kernels::smaller(kernels::larger(predicted, step), step + quantum);
    const scalar c = x - predicted;
    v += a * dt + gain * c / dt;
    w += gain * gain * c / (scalar(8) * dt * dt);

    const bool turned = c * S < scalar(0);
    S = turned ? c : S + c;
    t = turned ? dt : t + dt;
    if (kernels::magnitude(S) * scalar(3) > quantum * scalar(4)) {
      v += S / t;
      w += S / (scalar(2) * t * t);
      S = t = scalar(0);
    }
    if (!kernels::is_finite(x + v + w)) start(i, step + quantum / scalar(2));  // an absurd force
  }
};

static_assert(motion_estimator_for<last_difference<space<float, 1>>, space<float, 1>>);
static_assert(motion_estimator_for<mass_observer<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
