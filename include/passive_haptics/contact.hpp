// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Contact laws: depth and speed to desired force. The bound decides what is left of it.
//
//   spring            f* = K d                         (2.18); faithful, rings on a bare device
//   damped_spring     f* = K_s d − B_s max(0, v_out)   (§ 9); settles; needs the device's mass
//   virtual_coupling  f* = max(0, K_f d − B_c v_out)   (§ 2(g)); 1/K_f = 1/K_c + 1/K: soft, and
//                                                      passive on a fixed wall with no ledger
//
// Damping on the way in raises the force, and virtual damping costs passivity: Colgate's condition
// is b > KT/2 + |B|. Only virtual_coupling has it.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// f* = K d [N], d > 0. (2.18)
template <class Space>
struct spring {
  using scalar = typename Space::scalar;
  static constexpr guarantee passivity = guarantee::strict;  // whatever it asks, the bound answers

  scalar stiffness{};  ///< K [N/m], as the environment says; set by adopt()

  constexpr void adopt(scalar K, scalar /*longest_tick*/) noexcept { stiffness = K; }

  [[nodiscard]] constexpr scalar force(scalar depth, scalar /*outward_speed*/) const noexcept {
    return depth > scalar(0) ? stiffness * depth : scalar(0);
  }
  [[nodiscard]] constexpr scalar depth(scalar force, scalar /*outward_speed*/) const noexcept {
    return kernels::depth_bound(force, stiffness);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

/// f* = max(0, K_s d − B_s max(0, v_out)) [N]: damping on the way OUT only, so it never adds force.
///     K_s = min(K, κ m/T²)            what a mass sampled every T can be held with
///     B_s = min(2ζ√(K_s m), β m/T)    [N·s/m]
/// Static stiffness is K exactly, up to the cap κ m/T² (10 kN/m for 0.1 kg at 1 kHz). Source:
/// docs/design/mathematics.md § 9; the defaults settle on an ideal device, κ = 0.3 does not.
///
/// With a `force_limit` F, deeper than F/K_s, the motors cannot give K_s d, and a damper of that
/// stiffness would act only in the last millimetre. There the spring is the secant F/d:
///     f* = max(0, F − min(B_s, 2ζ√(F m/d)) max(0, v_out))
/// which lets a heavy device out at a speed it can be stopped from.
template <class Space>
struct damped_spring {
  using scalar = typename Space::scalar;
  static constexpr guarantee passivity = guarantee::strict;

  scalar mass{};                            ///< m, apparent mass of the device [kg], a lower bound
  scalar stiffness_fraction = scalar(0.1);  ///< κ, of m/T²
  scalar damping_ratio = scalar(1);         ///< ζ
  scalar damping_fraction = scalar(0.5);    ///< β, of m/T
  scalar force_limit = std::numeric_limits<scalar>::max();  ///< F, what the motors can hold [N]
  scalar stiffness{};                                       ///< K_s [N/m], set by adopt()
  scalar damping{};                                         ///< B_s [N·s/m], set by adopt()

  constexpr void adopt(scalar K, scalar T) noexcept {
    stiffness = kernels::sampled_stiffness(K, stiffness_fraction, mass, T);
    damping = kernels::sampled_damping(stiffness, damping_ratio, damping_fraction, mass, T);
  }
  [[nodiscard]] constexpr scalar force(scalar depth, scalar outward_speed) const noexcept {
    if (!(depth > scalar(0))) return scalar(0);
    const scalar pressed = stiffness * depth;
    if (pressed > force_limit) return saturated(depth, outward_speed);
    return kernels::larger(pressed - resistance(outward_speed), scalar(0));
  }
  /// Below the force limit the inverse of force(), above it F/K_s.
  [[nodiscard]] constexpr scalar depth(scalar force, scalar outward_speed) const noexcept {
    return force > scalar(0) ? kernels::depth_bound(force + resistance(outward_speed), stiffness)
                             : scalar(0);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(mass > scalar(0)) || !kernels::is_finite(mass))
      return {"mass", mass, "finite and > 0 kg"};
    if (!(stiffness_fraction > scalar(0) && stiffness_fraction <= scalar(1))) {
      return {"stiffness_fraction", stiffness_fraction, "in (0, 1]"};
    }
    if (!(damping_ratio >= scalar(0)) || !kernels::is_finite(damping_ratio)) {
      return {"damping_ratio", damping_ratio, "finite and ≥ 0"};
    }
    if (!(damping_fraction >= scalar(0) && damping_fraction <= scalar(1))) {
      return {"damping_fraction", damping_fraction, "in [0, 1]"};
    }
    if (!(force_limit > scalar(0))) return {"force_limit", force_limit, "> 0 N"};
    return {};
  }

 private:
  [[nodiscard]] constexpr scalar saturated(scalar depth, scalar outward_speed) const noexcept {
    const scalar secant =
        scalar(2) * damping_ratio * kernels::square_root(force_limit * mass / depth);
    const scalar speed = kernels::larger(outward_speed, scalar(0));
    return kernels::larger(force_limit - kernels::smaller(damping, secant) * speed, scalar(0));
  }
  [[nodiscard]] constexpr scalar resistance(scalar outward_speed) const noexcept {
    return damping * kernels::larger(outward_speed, scalar(0));
  }
};

/// f* = max(0, K_f d − B_c v_out) [N], d > 0, with 1/K_f = 1/K_c + 1/K: a spring K_c and a damper
/// B_c side by side between the device and a massless proxy that the wall K holds. With K_c
/// infinite it is the Kelvin-Voigt wall K, B_c.
///
/// Simplified. The proxy's own equation gives f/d = K (K_c + B_c s)/(K + K_c + B_c s): the same
/// static stiffness, but a damping that falls from B_c (K/(K + K_c))² at low frequencies to
/// nothing. Here B_c acts whole, whatever K is, which is exact on a rigid wall (K → ∞) and nowhere
/// else.
///
/// Without any ledger it is passive on a surface that stays put, sampled every T and held, if
///     K_f ≤ 2 (b − B_c)/T,      for which K_c ≤ 2 (b − B_c)/T is enough, whatever K is
/// (§ 2(g); Colgate's condition). With Δ = the change of d in a tick, the tick books b Δ²/T + f Δ,
/// and f Δ ≥ K_f/2 (change of max(d, 0)²) − K_f/2 Δ² − B_c/(2T) (Δ² + Δ'²), Δ' of the tick before;
/// max(0, ·) and the surface keep the sign. Nothing is asked of the hand. Ticks that vary, delay
/// and a surface that moves break it: then the bound has to answer. Nyquist motion in contact takes
/// (K_f/2 + B_c/T − b/T) Δ² a tick.
template <class Space>
struct virtual_coupling {
  using scalar = typename Space::scalar;
  static constexpr guarantee passivity = guarantee::strict;  // whatever it asks, the bound answers

  scalar stiffness = std::numeric_limits<scalar>::infinity();  ///< K_c [N/m], may be infinite
  scalar damping{};                                            ///< B_c [N·s/m]
  scalar felt{};                                               ///< K_f [N/m], set by adopt()

  constexpr void adopt(scalar K, scalar /*longest_tick*/) noexcept {
    felt = K / (scalar(1) + K / stiffness);
  }
  [[nodiscard]] constexpr scalar force(scalar depth, scalar outward_speed) const noexcept {
    if (!(depth > scalar(0))) return scalar(0);
    return kernels::larger(felt * depth - damping * outward_speed, scalar(0));
  }
  /// Zero for a force that the damper alone would give.
  [[nodiscard]] constexpr scalar depth(scalar force, scalar outward_speed) const noexcept {
    if (!(force > scalar(0))) return scalar(0);
    return kernels::larger(kernels::depth_bound(force + damping * outward_speed, felt), scalar(0));
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(stiffness > scalar(0))) return {"stiffness", stiffness, "> 0 N/m"};
    if (!(damping >= scalar(0)) || !kernels::is_finite(damping)) {
      return {"damping", damping, "finite and ≥ 0 N·s/m"};
    }
    return {};
  }
};

static_assert(contact_law_for<spring<space<float, 1>>, space<float, 1>>);
static_assert(contact_law_for<virtual_coupling<space<float, 1>>, space<float, 1>>);
static_assert(contact_law_for<damped_spring<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
