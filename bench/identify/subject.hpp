// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated device of one axis whose truth is drawn at random, and what is found of it.

#include <passive_haptics/identification.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction.hpp>

#include <cstdint>

namespace identify {

namespace ph = passive_haptics;
namespace sim = passive_haptics::simulation;
namespace identification = passive_haptics::identification;

using line = ph::space<double, 1>;

enum class rubbing : std::uint8_t { rigid, one_spring, three_springs, dupont, stribeck, rippled };
[[nodiscard]] const char* to_string(rubbing like);

/// The truth.
struct subject {
  std::uint64_t seed = 0;
  rubbing like = rubbing::rigid;
  double mass = 0.1;             ///< m, 0.03 to 1, evenly by its logarithm [kg]
  double damping = 0.1;          ///< b, 0.01 to 5, as well [N·s/m]
  double friction = 0.0;         ///< c, the least level anywhere: 0 to 0.5 [N]
  double presliding = 0.0;       ///< p, 0 to 50e-6 [m]
  double quantum = 10e-6;        ///< q, 1e-6 to 100e-6, evenly by its logarithm [m]
  double load = 0.0;             ///< 0 to 1 [N]
  int latency = 0;               ///< 0 to 3 [ticks]
  double static_share = 1.0;     ///< static over kinetic level, 1 to 1.5
  double stribeck_speed = 5e-3;  ///< 2e-3 to 10e-3 [m/s]
  double ripple = 0.0;           ///< 0 to 0.3
  double wavelength = 1e-3;      ///< 0.2e-3 to 5e-3 [m]
  double start = 0.0;            ///< [m]
};
[[nodiscard]] subject draw(std::uint64_t seed);

/// Which bounds hold. A device without friction to rely on asks for no presliding.
struct verdict {
  subject truth{};
  identification::axis_found found{};
  double seconds = 0.0;  ///< that the device was busy

  [[nodiscard]] bool identified() const { return found.problem == nullptr; }
  [[nodiscard]] bool mass() const { return found.mass > 0.0 && found.mass <= truth.mass; }
  [[nodiscard]] bool damping() const { return found.damping <= truth.damping; }
  [[nodiscard]] bool damping_max() const { return found.damping_max >= truth.damping; }
  [[nodiscard]] bool friction() const { return found.friction <= truth.friction; }
  [[nodiscard]] bool presliding() const {
    return found.friction == 0.0 || found.presliding >= truth.presliding;
  }
  [[nodiscard]] bool presliding_near() const {
    const double p = truth.presliding;
    return found.friction == 0.0 || found.presliding - p <= std::max(truth.quantum, 2.0 * p);
  }
  [[nodiscard]] bool quantum() const { return found.quantum >= truth.quantum; }
  [[nodiscard]] bool noise() const { return found.noise >= 0.0; }
  [[nodiscard]] bool latency() const { return found.latency >= truth.latency; }
  [[nodiscard]] bool longest_tick() const { return found.longest_tick >= 1e-3; }
  [[nodiscard]] bool all() const {
    return identified() && mass() && damping() && damping_max() && friction() && presliding() &&
           quantum() && noise() && latency() && longest_tick();
  }
};
[[nodiscard]] verdict identified(const subject& s,
                                 const identification::identification_parameters& p = {});

}  // namespace identify
