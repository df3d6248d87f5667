// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Simulated devices named after the devices that they resemble, for tests and benches.
//
//     sim::device<scene> grip(sim::falcon_like.parameters<scene>());
//     sim::device<scene, sim::no_hand<scene>, sim::slider_and_spring> soft(
//         sim::falcon_like.without_friction<scene>(), {}, sim::falcon_like.friction_of(15e-6));
//
// Their numbers are chosen by us in the range of such devices, and none is measured. Known facts of the real devices
// are in identification/device_facts.hpp.

#include <passive_haptics/simulation/driver.hpp>
#include <passive_haptics/simulation/friction_elastic.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

struct device_preset {
  const char* name = "";
  double mass = 0.1;         ///< m [kg]
  double damping = 0.03;     ///< b [N·s/m]
  double friction = 0.0;     ///< f_c [N]
  double quantum = 0.0;      ///< step of the encoders [m]
  double force_limit = 0.0;  ///< largest force of the actuators [N]

  /// The parameters of a device with rigid friction.
  template <class Space>
  [[nodiscard]] device_parameters<Space> parameters() const noexcept {
    auto p = without_friction<Space>();
    p.friction = friction;
    return p;
  }
  /// The parameters of a device with a friction model of its own, such as friction_of().
  template <class Space>
  [[nodiscard]] device_parameters<Space> without_friction() const noexcept {
    device_parameters<Space> p;
    p.mass = mass;
    p.damping = damping;
    p.quantum = quantum;
    p.force_limit = force_limit;
    return p;
  }
  /// The friction of this preset, elastic over `presliding` > 0 [m].
  [[nodiscard]] slider_and_spring friction_of(double presliding) const noexcept {
    return {.level = {friction}, .presliding = {presliding}};
  }
};

inline constexpr device_preset falcon_like{"Falcon", 0.25, 1.0, 0.3, 60e-6, 9.0};
inline constexpr device_preset touch_like{"Touch", 0.045, 0.1, 0.26, 55e-6, 3.3};
inline constexpr device_preset omega_like{"omega", 0.28, 0.5, 0.05, 10e-6, 12.0};
inline constexpr device_preset ideal{"ideal", 0.1, 0.03, 0.0, 1e-6, 12.0};
inline constexpr device_preset frictionless_10um{
    "frictionless, 10 µm", 0.1, 0.03, 0.0, 10e-6, 12.0};
inline constexpr device_preset heavy_1kg{"heavy, 1 kg", 1.0, 2.0, 0.5, 20e-6, 30.0};

/// A direct-drive steering wheel with an encoder of 14 bits a turn.
struct wheel_preset {
  double inertia = 0.03;         ///< [kg·m²]
  double damping = 0.05;         ///< [N·m·s/rad]
  double friction = 0.05;        ///< dry friction [N·m]
  double quantum = 3.834952e-4;  ///< 2π/2¹⁴ [rad]
  double torque_limit = 8.0;     ///< [N·m]
  double radius = 0.15;          ///< radius of the rim [m]

  /// The wheel as the hand meets it at the rim, in metres and newtons.
  [[nodiscard]] constexpr device_preset at_rim() const noexcept {
    return {"wheel, at its rim",
            inertia / (radius * radius),
            damping / (radius * radius),
            friction / radius,
            quantum * radius,
            torque_limit / radius};
  }
};
inline constexpr wheel_preset wheel_rotary{};

inline constexpr std::array all_presets{falcon_like,       touch_like, omega_like,           ideal,
                                        frictionless_10um, heavy_1kg,  wheel_rotary.at_rim()};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
