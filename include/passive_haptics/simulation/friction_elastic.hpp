// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Frictions that remember where they were reversed; the menu is in friction.hpp.
// They dissipate at least c times the way slipped [J], which is the way of the device less a deflection ≤ p.

#include <passive_haptics/simulation/friction_model.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

namespace detail {

/// The work [J] of pulling a slider by `way` [m] through a spring k [N/m]; it slips at the deflection `most` [m].
/// It is exact, and loses no digits by cancellation for short ways.
[[nodiscard]] inline friction_work pull_slider(double& deflection, double k, double most,
                                               double way) noexcept {
  const double sign = way < 0.0 ? -1.0 : 1.0;
  const double room = most - sign * deflection;
  const double elastic = kernels::smaller(kernels::magnitude(way), room);
  const double slipped = kernels::magnitude(way) - elastic;
  const double before = sign * deflection;
  deflection = slipped > 0.0 ? sign * most : deflection + sign * elastic;
  const double dissipated = k * most * slipped;
  return {k * (before + elastic / 2.0) * elastic + dissipated, dissipated};
}

}  // namespace detail

/// N sliders, each behind its own spring cᵢ/pᵢ, in parallel. Claims c = Σ cᵢ and p = Σ cᵢpᵢ/c.
template <int N>
struct maxwell_slip {
  static constexpr auto count = static_cast<std::size_t>(N);
  using state = std::array<double, count>;  ///< deflections [m]

  std::array<double, count> level{};       ///< cᵢ [N]
  std::array<double, count> presliding{};  ///< pᵢ [m], > 0
  double start = 0.0;  ///< every deflection at the start, as a share of its pᵢ, −1 to 1

  [[nodiscard]] state begin() const noexcept {
    state z = presliding;
    for (double& deflection : z) deflection *= start;
    return z;
  }
  friction_work slide(state& z, double /*from*/, double way, double /*time*/) const noexcept {
    friction_work sum;
    for (std::size_t i = 0; i < count; ++i) {
      const auto took = detail::pull_slider(z[i], level[i] / presliding[i], presliding[i], way);
      sum.work += took.work;
      sum.dissipated += took.dissipated;
    }
    return sum;
  }
  [[nodiscard]] double stiffness() const noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += level[i] / presliding[i];
    return sum;
  }
  [[nodiscard]] friction_claim claim() const noexcept {
    double c = 0.0;
    double moment = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      c += level[i];
      moment += level[i] * presliding[i];
    }
    return {c, c > 0.0 ? moment / c : 0.0};
  }
  [[nodiscard]] parameter_fault check() const noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      if (const auto fault = detail::friction_fault(level[i], presliding[i], start)) return fault;
    }
    return {};
  }
};

/// F = (c/p) z [N], |z| ≤ p: Prandtl's element, the elasto-plastic friction with one spring.
using slider_and_spring = maxwell_slip<1>;

/// One bristle that follows the way up to z_ba, creeps from there on, and slips without following at p:
///     F = σ₀ z,   dz/dx = 1 − α(z) |z|/p,   α = 0 for |z| ≤ z_ba and on the way back,
///     α = ½ + ½ sin(π (|z| − (p + z_ba)/2)/(p − z_ba)) up to p
/// with σ₀ = c/z_ba [N/m]; slipping, it takes c p/z_ba ≥ c [N]. Dupont, Hayward, Armstrong, Altpeter (2002),
/// with a steady level that does not depend on speed. Its force has no corner, unlike that of a spring and a
/// slider. After an oscillation within z_ba it is at the same z again, unlike LuGre's friction. The
/// differential equation is integrated by Runge and Kutta's fourth-order rule in steps of (p − z_ba)/16.
struct dupont_friction {
  using state = double;  ///< z [m]

  double level = 0.0;       ///< c = σ₀ z_ba [N], the force at which it begins to creep
  double breakaway = 0.0;   ///< z_ba [m], > 0
  double presliding = 0.0;  ///< p [m], the largest deflection, > z_ba
  double start = 0.0;       ///< deflection at the start, as a share of p

  [[nodiscard]] state begin() const noexcept { return start * presliding; }

  friction_work slide(state& z, double /*from*/, double way, double /*time*/) const noexcept {
    const double sign = way < 0.0 ? -1.0 : 1.0;
    double left = kernels::magnitude(way);
    double u = sign * z;  // deflection along the way
    friction_work sum;
    if (u < breakaway) {
      const double elastic = kernels::smaller(left, breakaway - u);
      sum.work = stiffness() * (u + elastic / 2.0) * elastic;
      u += elastic;
      left -= elastic;
    }
    if (left > 0.0) {
      const double step = (presliding - breakaway) / 16.0;
      while (left > 0.0 && presliding - u > 1e-13 * presliding) {
        const double piece = kernels::smaller(left, step);
        creep(u, sum, piece);
        left -= piece;
      }
      sum.dissipated += stiffness() * u * left;
      sum.work += stiffness() * u * left;
    }
    z = sign * u;
    return sum;
  }
  [[nodiscard]] double stiffness() const noexcept { return level / breakaway; }
  [[nodiscard]] friction_claim claim() const noexcept { return {level, presliding}; }
  [[nodiscard]] parameter_fault check() const noexcept {
    if (!(breakaway > 0.0 && breakaway < presliding)) {
      return {"breakaway", breakaway, "> 0 m and < presliding"};
    }
    return detail::friction_fault(level, presliding, start);
  }

 private:
  /// The share of the way that slips, 1 − dz/dx.
  [[nodiscard]] double slip(double u) const noexcept {
    if (u <= breakaway) return 0.0;
    if (u >= presliding) return u / presliding;
    const double middle = (presliding + breakaway) / 2.0;
    const double alpha = 0.5 + 0.5 * std::sin(pi * (u - middle) / (presliding - breakaway));
    return alpha * u / presliding;
  }
  /// Creeps by `way` [m]: the share that slips dissipates σ₀ u for each metre, the rest is stored.
  void creep(double& u, friction_work& sum, double way) const noexcept {
    const double k = stiffness();
    const double s1 = slip(u);
    const double u2 = u + (1.0 - s1) * way / 2.0;
    const double s2 = slip(u2);
    const double u3 = u + (1.0 - s2) * way / 2.0;
    const double s3 = slip(u3);
    const double u4 = u + (1.0 - s3) * way;
    const double s4 = slip(u4);
    const double dissipated = k * (u * s1 + 2.0 * (u2 * s2 + u3 * s3) + u4 * s4) * (way / 6.0);
    const double deflected = way - (s1 + 2.0 * (s2 + s3) + s4) * (way / 6.0);
    sum.dissipated += dissipated;
    sum.work += dissipated + k * (u + deflected / 2.0) * deflected;
    u += deflected;
  }

  static constexpr double pi = 3.14159265358979323846;
};

/// A spring and a slider whose level falls with the speed and ripples along the way, as with gears and cables:
///     level(x, v) = (c_k + (c_s − c_k) exp(−(v/v_s)²)) (1 + r sin(2π x/λ))      [N]
/// The spring's stiffness is constant, so the deflection at which it slips is proportional to the level; where the
/// level falls below the spring's force, the spring's excess energy is lost. It claims the least kinetic level,
/// c_k (1 − r), and the deflection at the largest level.
struct stribeck_friction {
  using state = double;  ///< z [m]

  double kinetic = 0.0;         ///< c_k [N]
  double static_level = 0.0;    ///< c_s [N], ≥ c_k
  double stribeck_speed = 0.0;  ///< v_s [m/s], > 0
  double presliding = 0.0;      ///< p [m], the deflection at the largest level
  double ripple = 0.0;          ///< r, 0 to 1
  double wavelength = 0.0;      ///< λ [m], > 0 if there is a ripple
  double start = 0.0;           ///< deflection at the start, as a share of p

  [[nodiscard]] state begin() const noexcept { return start * presliding; }

  [[nodiscard]] double level(double x, double speed) const noexcept {
    const double ratio = speed / stribeck_speed;
    const double smooth = kinetic + (static_level - kinetic) * std::exp(-ratio * ratio);
    return ripple > 0.0 ? smooth * (1.0 + ripple * std::sin(2.0 * pi * x / wavelength)) : smooth;
  }
  friction_work slide(state& z, double from, double way, double time) const noexcept {
    const double speed = way / time;
    const double longest = ripple > 0.0 ? wavelength / 64.0 : kernels::magnitude(way);
    return detail::slide_in_pieces(way, longest, [&](double gone, double piece) {
      const double along = way < 0.0 ? -piece : piece;
      return pull(z, level(from + gone + along / 2.0, speed), along);
    });
  }
  [[nodiscard]] double stiffness() const noexcept {
    return static_level * (1.0 + ripple) / presliding;
  }
  [[nodiscard]] friction_claim claim() const noexcept {
    return {kinetic * (1.0 - ripple), presliding};
  }
  [[nodiscard]] parameter_fault check() const noexcept {
    if (!(static_level >= kinetic && kernels::is_finite(static_level))) {
      return {"static level", static_level, "finite and ≥ the kinetic one"};
    }
    if (!(static_level > 0.0)) return {"static level", static_level, "> 0 N"};
    if (!(stribeck_speed > 0.0)) return {"stribeck_speed", stribeck_speed, "> 0 m/s"};
    if (!(ripple >= 0.0 && ripple <= 1.0)) return {"ripple", ripple, "0 to 1"};
    if (ripple > 0.0 && !(wavelength > 0.0)) return {"wavelength", wavelength, "> 0 m"};
    return detail::friction_fault(kinetic, presliding, start);
  }

 private:
  [[nodiscard]] friction_work pull(double& z, double now, double way) const noexcept {
    const double k = stiffness();
    const double most = now / k;
    double relaxed = 0.0;
    if (kernels::magnitude(z) > most) {
      relaxed = k * (kernels::magnitude(z) - most) * (kernels::magnitude(z) + most) / 2.0;
      z = z < 0.0 ? -most : most;
    }
    friction_work took = detail::pull_slider(z, k, most, way);
    took.dissipated += relaxed;
    return took;
  }

  static constexpr double pi = 3.14159265358979323846;
};

static_assert(friction_model<slider_and_spring> && friction_model<maxwell_slip<4>>);
static_assert(friction_model<dupont_friction> && friction_model<stribeck_friction>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
