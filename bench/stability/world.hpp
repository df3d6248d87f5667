// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One cell of the sweep: what is true of the device, the wall and the clock.

#include <cstdint>
#include <string>
#include <vector>

namespace stability {

enum class clockwork : std::uint8_t {
  steady,
  jitter,  ///< ticks of half to one longest tick
  missed,  ///< one in fifty lasts 2 to 20 longest ticks; the driver drops the force in time
  missed_and_held,  ///< the same, and the force is held to the end
  switching,        ///< T and T/100 by turns, fifty ticks each
  lost_samples,     ///< one sample in twenty-five never arrives
};
[[nodiscard]] const char* to_string(clockwork c) noexcept;

/// All numbers are floats, so float and double controllers are told the same truth.
struct world {
  std::string axis = "base";  ///< what the cell varies
  std::string value = "-";    ///< and its value there
  double stiffness = 1e4;     ///< K of the wall; at updates K or K/10 [N/m]
  double damping = 0.03;      ///< b of the device [N·s/m]
  double tick = 1e-3;         ///< T, the longest tick [s]
  double mass = 0.1;          ///< of the device [kg]
  double offset = 0.0;        ///< of the whole scene from the origin, every axis [m]
  double size = 1e-3;         ///< of motions and of the surface's jumps [m]
  clockwork clock = clockwork::steady;
};

/// One axis at a time, the rest at its base; then the corners.
[[nodiscard]] std::vector<world> cells(bool quick);
/// Any combination at all; repeatable.
[[nodiscard]] world anywhere(std::uint64_t seed);
/// The same cell with each number moved by up to a factor of three.
[[nodiscard]] world nearby(const world& w, std::uint64_t seed);

}  // namespace stability
