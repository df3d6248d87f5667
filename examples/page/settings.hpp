// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the sliders of the page set, in SI units, by name: the page asks for the names.

#include <array>

namespace page {

inline constexpr double tick_length = 1e-3;  ///< of every loop on the page, virtual [s]

struct settings {
  double stiffness = 10000;     ///< K of walls and planes [N/m]
  double young = 12000;         ///< of a deformable body [Pa]
  double rate = 30;             ///< news of the world per second [Hz]
  double latency = 0;           ///< of that news [s]
  double loss = 0;              ///< share of it that never arrives
  double damping = 0.3;         ///< b of the device [N·s/m]
  double mass = 0.1;            ///< m of the device [kg]
  double friction = 0;          ///< dry, of the device [N]
  double quantum = 0;           ///< step of the encoders [m]
  double motors = 9;            ///< the most they hold [N]
  double late = 0;              ///< from a command to its holding [ticks]
  double heave = 0;             ///< amplitude of the surface [m]
  double tilt = 0;              ///< its slope swings by so much
  double roughness = 0.6;       ///< static coefficient of friction of the surface
  double hand_stiffness = 200;  ///< of the hand that holds the device [N/m]
  double hand_force = 5;        ///< the most that hand pushes with [N]
  double mode = 0;  ///< resonance of the cable between motor and handle, 0: there is none [Hz]
};

struct parameter {
  const char* name;
  double settings::*value;
};

inline constexpr std::array parameters{
    parameter{"stiffness", &settings::stiffness},
    parameter{"young", &settings::young},
    parameter{"rate", &settings::rate},
    parameter{"latency", &settings::latency},
    parameter{"loss", &settings::loss},
    parameter{"damping", &settings::damping},
    parameter{"mass", &settings::mass},
    parameter{"friction", &settings::friction},
    parameter{"quantum", &settings::quantum},
    parameter{"motors", &settings::motors},
    parameter{"late", &settings::late},
    parameter{"heave", &settings::heave},
    parameter{"tilt", &settings::tilt},
    parameter{"roughness", &settings::roughness},
    parameter{"hand_stiffness", &settings::hand_stiffness},
    parameter{"hand_force", &settings::hand_force},
    parameter{"mode", &settings::mode},
};
static_assert(sizeof(settings) == parameters.size() * sizeof(double));

/// What a controller is told of the device and the hand; all of it is true on the page.
struct premises {
  double mass, damping, friction, quantum, motors, hand_force, roughness, mode, tick;
};
[[nodiscard]] constexpr premises told(const settings& s) noexcept {
  return {s.mass,       s.damping,   s.friction, s.quantum,  s.motors,
          s.hand_force, s.roughness, s.mode,     tick_length};
}

/// −1 … 1, of period 1: a sine of parabolas, so that every build computes the same bits.
[[nodiscard]] constexpr double wave(double phase) noexcept {
  phase -= static_cast<double>(static_cast<long long>(phase));
  const double half = phase < 0.5 ? phase : phase - 0.5;
  const double arch = 16 * half * (0.5 - half);
  return phase < 0.5 ? arch : -arch;
}

}  // namespace page
