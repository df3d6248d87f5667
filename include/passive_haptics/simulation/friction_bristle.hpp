// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Frictions without a memory of reversals; the menu is in friction.hpp.
// They are negative controls: a dither lowers the energy that they take, so no ledger is right and they claim() none.

#include <passive_haptics/simulation/friction_model.hpp>

#include <cmath>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// F = σ₀ z + σ₁ ż,   dz/dx = 1 − (z/g) sgn ẋ,   g(v) = (c_k + (c_s − c_k) exp(−(v/v_s)²))/σ₀
/// with σ₀ = c_s/p [N/m]; the viscous term is the device's b. Canudas de Wit, Olsson, Åström, Lischinsky
/// (1995). It is exact along a piece of way at constant velocity, where z is an exponential. With a bristle
/// damper σ₁ it is not passive by itself; without one the dissipated energy is never negative.
///
/// Near c the deflection hardly grows on the way forward, and falls by up to twice the way on the way back.
/// So a dither of 2 a forward, a back, a ≪ p, settles where 2 (1 − z/p) = 1 + z/p, at z = p/3, and takes c/3 [J] for
/// each metre gained. A spring and a slider take c.
struct lugre_friction {
  using state = double;  ///< z [m]

  double kinetic = 0.0;          ///< c_k [N]
  double static_level = 0.0;     ///< c_s [N], ≥ c_k
  double stribeck_speed = 0.0;   ///< v_s [m/s], > 0
  double presliding = 0.0;       ///< p [m], the bristle's deflection at c_s
  double bristle_damping = 0.0;  ///< σ₁ [N·s/m]
  double start = 0.0;            ///< deflection at the start, as a share of p

  [[nodiscard]] state begin() const noexcept { return start * presliding; }

  friction_work slide(state& z, double /*from*/, double way, double time) const noexcept {
    const double speed = way / time;
    const double ratio = speed / stribeck_speed;
    const double level = kinetic + (static_level - kinetic) * std::exp(-ratio * ratio);
    const double k = stiffness();
    const double most = level / k;
    const double sign = way < 0.0 ? -1.0 : 1.0;
    const double length = kernels::magnitude(way);
    const double before = sign * z;
    const double closer = -std::expm1(-length / most);  // share of the way to `most`
    const double deflected = (most - before) * closer;
    z = sign * (before + deflected);
    const double bristle = k * most * (length - deflected);
    const double stored = k * (before + deflected / 2.0) * deflected;
    const double damped = bristle_damping * (length / time) * deflected;
    return {bristle + damped, kernels::larger(bristle - stored, 0.0) + damped};
  }
  [[nodiscard]] double stiffness() const noexcept { return static_level / presliding; }
  [[nodiscard]] friction_claim claim() const noexcept { return {}; }
  [[nodiscard]] parameter_fault check() const noexcept {
    if (!(kinetic > 0.0 && static_level >= kinetic && kernels::is_finite(static_level))) {
      return {"static level", static_level, "finite and ≥ the kinetic one, which is > 0 N"};
    }
    if (!(stribeck_speed > 0.0)) return {"stribeck_speed", stribeck_speed, "> 0 m/s"};
    if (!passive_haptics::detail::not_negative(bristle_damping)) {
      return {"bristle_damping", bristle_damping, "finite and ≥ 0 N·s/m"};
    }
    return detail::friction_fault(kinetic, presliding, start);
  }
};

/// dF/dx = (c/p) (1 − (F/c) sgn ẋ): LuGre's friction with one level and no bristle damper (Dahl, 1968).
struct dahl_friction {
  using state = double;  ///< z = F p/c [m]

  double level = 0.0;       ///< c [N]
  double presliding = 0.0;  ///< p [m]: the first slope is c/p
  double start = 0.0;       ///< deflection at the start, as a share of p

  [[nodiscard]] state begin() const noexcept { return start * presliding; }
  friction_work slide(state& z, double from, double way, double time) const noexcept {
    return bristle().slide(z, from, way, time);
  }
  [[nodiscard]] double stiffness() const noexcept { return level / presliding; }
  [[nodiscard]] friction_claim claim() const noexcept { return {}; }
  [[nodiscard]] parameter_fault check() const noexcept { return bristle().check(); }

 private:
  [[nodiscard]] lugre_friction bristle() const noexcept {
    return {.kinetic = level,
            .static_level = level,
            .stribeck_speed = 1.0,
            .presliding = presliding,
            .start = start};
  }
};

static_assert(friction_model<dahl_friction> && friction_model<lugre_friction>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
