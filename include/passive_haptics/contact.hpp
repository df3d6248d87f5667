// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Contact laws: depth and speed to desired force. The bound decides what is left of it.
//
//   spring          f* = K d                         (2.18); faithful, rings on a bare device
//   damped_spring   f* = K_s d − B_s max(0, v_out)   (§ 9); settles; needs the device's mass
//
// Not offered: damping on the way in. It raises the force, and virtual damping costs passivity:
// Colgate's condition is b > KT/2 + |B|.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics::inline v0 {

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
template <class Space>
struct damped_spring {
  using scalar = typename Space::scalar;
  static constexpr guarantee passivity = guarantee::strict;

  scalar mass{};                            ///< m, apparent mass of the device [kg], a lower bound
  scalar stiffness_fraction = scalar(0.1);  ///< κ, of m/T²
  scalar damping_ratio = scalar(1);         ///< ζ
  scalar damping_fraction = scalar(0.5);    ///< β, of m/T
  scalar stiffness{};                       ///< K_s [N/m], set by adopt()
  scalar damping{};                         ///< B_s [N·s/m], set by adopt()

  constexpr void adopt(scalar K, scalar T) noexcept {
    stiffness = kernels::sampled_stiffness(K, stiffness_fraction, mass, T);
    damping = kernels::sampled_damping(stiffness, damping_ratio, damping_fraction, mass, T);
  }
  [[nodiscard]] constexpr scalar force(scalar depth, scalar outward_speed) const noexcept {
    if (!(depth > scalar(0))) return scalar(0);
    return kernels::larger(stiffness * depth - resistance(outward_speed), scalar(0));
  }
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
    return {};
  }

 private:
  [[nodiscard]] constexpr scalar resistance(scalar outward_speed) const noexcept {
    return damping * kernels::larger(outward_speed, scalar(0));
  }
};

static_assert(contact_law_for<spring<space<float, 1>>, space<float, 1>>);
static_assert(contact_law_for<damped_spring<space<float, 1>>, space<float, 1>>);

}  // namespace passive_haptics::inline v0
