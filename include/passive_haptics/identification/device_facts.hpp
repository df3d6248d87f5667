// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The known numbers of commercial haptic devices, each with its source.
//
//     constexpr auto touch = design::devices::touch;
//     static_assert(touch.friction && !touch.friction.verified());       // quoted from memory
//     if (!touch.damping) ...                                            // it is not published
//
//   evidence       measured, a data sheet, a paper, the source of a program; or unverified
//   fact           a number that may be missing
//   device_facts   the numbers that the maker, users and drivers of a device state
//   devices::      falcon, touch, omni, desktop, premium_1_5, premium_3_0, omega, delta_3, sigma_7,
//                  lambda_7, inverse3, virtuose_6d, maglev_200, smart_knob; all of them in a list
//
// Viscous damping and presliding are published for none of them, mass and friction for few, and CHAI3D's
// "maximum damping" is the largest for a controller, not a property of the device. Identify on your own device
// the numbers that your composition states; these facts are first values only.

#include <passive_haptics/base/language.hpp>

#include <array>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {
namespace design {

enum class evidence : std::uint8_t {
  none,        ///< not known
  measured,    ///< measured on the device by the source named
  datasheet,   ///< a data sheet of its maker
  paper,       ///< published and reviewed
  software,    ///< in the source of a program that drives it
  unverified,  ///< a data sheet, from memory: look it up before you use it
};

[[nodiscard]] constexpr const char* to_string(evidence from) noexcept {
  switch (from) {
    case evidence::none:
      return "not known";
    case evidence::measured:
      return "measured";
    case evidence::datasheet:
      return "data sheet";
    case evidence::paper:
      return "paper";
    case evidence::software:
      return "software";
    case evidence::unverified:
      return "unverified";
  }
  return "unknown evidence";
}

/// A number in SI units, if it is known.
struct fact {
  double value = 0.0;
  evidence from = evidence::none;
  const char* source = "";

  constexpr explicit operator bool() const noexcept { return from != evidence::none; }
  /// True if we have read the number in its source.
  [[nodiscard]] constexpr bool verified() const noexcept {
    return from != evidence::none && from != evidence::unverified;
  }
};

/// Metres and newtons; radians and newton metres where it is rotary.
struct device_facts {
  const char* name = "";
  bool rotary = false;
  fact mass{};                    ///< apparent, smallest over all directions [kg]
  fact damping{};                 ///< b, physical [N·s/m]
  fact friction{};                ///< dry friction that a hand overcomes in moving it [N]
  fact presliding{};              ///< p, over which that friction is elastic [m]
  std::array<fact, 3> quantum{};  ///< step of the position on each axis [m]
  fact peak_force{};              ///< largest force, for a short time [N]
  fact continuous_force{};        ///< largest force without time limit [N]
  fact stiffness{};               ///< largest recommended stiffness of a wall [N/m]
  fact rate{};                    ///< highest rate of its loop [Hz]
  fact latency{};                 ///< time from a command to its holding [ticks]
  fact workspace_radius{};        ///< radius of a sphere within its reach [m]
};

namespace detail {

[[nodiscard]] constexpr fact unverified(double value) noexcept {
  return {value, evidence::unverified, "the maker's data sheet, from memory"};
}
[[nodiscard]] constexpr fact chai3d(double value) noexcept {
  return {value, evidence::software, "CHAI3D 3.3.0, cHapticDeviceInfo of the device"};
}
[[nodiscard]] constexpr std::array<fact, 3> alike(const fact& on_any_axis) noexcept {
  return {on_any_axis, on_any_axis, on_any_axis};
}

}  // namespace detail

namespace devices {

/// Its three encoders have one count to 5.13/140.8 of a degree (falcon/kinematics.hpp): 38 µm at the hinge
/// of a thigh of 60 mm. The step at the grip depends on its position.
inline constexpr device_facts falcon{
    .name = "Novint Falcon",
    .quantum = detail::alike({63.5e-6, evidence::datasheet,
                              "400 dpi and more: Novint, as the wiki of H3D API quotes it"}),
    .peak_force = detail::chai3d(8.0),
    .stiffness = detail::chai3d(3000.0),
    .rate = {1000.0, evidence::software, "open drivers: its bridge flushes once a millisecond"},
    .latency = {1.0, evidence::software, "open drivers: a reply is to the packet before"},
    .workspace_radius = detail::chai3d(0.04)};

inline constexpr device_facts touch{.name = "3D Systems Touch",
                                    .mass = detail::unverified(0.045),
                                    .friction = detail::unverified(0.26),
                                    .quantum = detail::alike(detail::unverified(55e-6)),
                                    .peak_force = detail::chai3d(3.3),
                                    .continuous_force = detail::unverified(0.88),
                                    .stiffness = detail::chai3d(400.0),
                                    .workspace_radius = detail::chai3d(0.075)};

inline constexpr device_facts omni{.name = "SensAble PHANTOM Omni",
                                   .mass = detail::unverified(0.045),
                                   .friction = detail::unverified(0.26),
                                   .quantum = detail::alike(detail::unverified(55e-6)),
                                   .peak_force = detail::chai3d(3.3),
                                   .continuous_force = detail::unverified(0.88),
                                   .stiffness = detail::chai3d(700.0),
                                   .workspace_radius = detail::chai3d(0.10)};

inline constexpr device_facts desktop{.name = "SensAble PHANTOM Desktop, 3D Systems Touch X",
                                      .mass = detail::unverified(0.045),
                                      .friction = detail::unverified(0.06),
                                      .quantum = detail::alike(detail::unverified(23e-6)),
                                      .peak_force = detail::chai3d(7.9),
                                      .stiffness = detail::chai3d(1000.0),
                                      .workspace_radius = detail::chai3d(0.10)};

inline constexpr device_facts premium_1_5{.name = "SensAble PHANTOM Premium 1.5",
                                          .mass = detail::unverified(0.075),
                                          .friction = detail::unverified(0.04),
                                          .quantum = detail::alike(detail::unverified(30e-6)),
                                          .peak_force = detail::chai3d(8.5),
                                          .stiffness = detail::chai3d(800.0),
                                          .workspace_radius = detail::chai3d(0.12)};

inline constexpr device_facts premium_3_0{.name = "SensAble PHANTOM Premium 3.0",
                                          .peak_force = detail::chai3d(22.0),
                                          .stiffness = detail::chai3d(1000.0),
                                          .workspace_radius = detail::chai3d(0.25)};

/// omega.3, omega.6 and omega.7. Mass: from the SDK, as a matrix over the joint angles.
inline constexpr device_facts omega{.name = "Force Dimension omega",
                                    .quantum = detail::alike(detail::unverified(10e-6)),
                                    .peak_force = detail::chai3d(12.0),
                                    .stiffness = detail::chai3d(5000.0),
                                    .workspace_radius = detail::chai3d(0.075)};

inline constexpr device_facts delta_3{.name = "Force Dimension delta.3",
                                      .quantum = detail::alike(detail::unverified(20e-6)),
                                      .peak_force = detail::chai3d(20.0),
                                      .stiffness = detail::chai3d(5000.0),
                                      .workspace_radius = detail::chai3d(0.15)};

inline constexpr device_facts sigma_7{.name = "Force Dimension sigma.7",
                                      .quantum = detail::alike(detail::unverified(1.5e-6)),
                                      .peak_force = detail::chai3d(12.0),
                                      .stiffness = detail::chai3d(4000.0),
                                      .workspace_radius = detail::chai3d(0.075)};

inline constexpr device_facts lambda_7{.name = "Force Dimension lambda.7",
                                       .peak_force = detail::chai3d(12.0),
                                       .stiffness = detail::chai3d(8000.0),
                                       .workspace_radius = detail::chai3d(0.1125)};

inline constexpr device_facts inverse3{
    .name = "Haply Inverse3",
    .quantum = detail::alike(detail::unverified(10e-6)),
    .peak_force = detail::unverified(10.0),
    .latency = {1.0, evidence::unverified, "a command is answered with a state: a round trip"}};

inline constexpr device_facts virtuose_6d{.name = "Haption Virtuose 6D",
                                          .peak_force = detail::unverified(31.0),
                                          .continuous_force = detail::unverified(8.5),
                                          .stiffness = detail::unverified(2000.0)};

/// It levitates, so nothing rubs; its damping is not known.
inline constexpr device_facts maglev_200{.name = "Butterfly Haptics Maglev 200",
                                         .friction = detail::unverified(0.0),
                                         .quantum = detail::alike(detail::unverified(2e-6)),
                                         .peak_force = detail::unverified(40.0),
                                         .stiffness = detail::unverified(50000.0)};

/// A magnetic encoder of 14 bit: 2π/16384.
inline constexpr device_facts smart_knob{
    .name = "SmartKnob", .rotary = true, .quantum = {detail::unverified(3.834952e-4)}};

inline constexpr std::array all{falcon,      touch,       omni,       desktop,   premium_1_5,
                                premium_3_0, omega,       delta_3,    sigma_7,   lambda_7,
                                inverse3,    virtuose_6d, maglev_200, smart_knob};

}  // namespace devices

}  // namespace design
}  // namespace v0
}  // namespace passive_haptics
