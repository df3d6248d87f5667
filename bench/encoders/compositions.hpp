// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is compared: a wall with a fixed surface, composed as today, and what comes after.

#include "../controllers/model.hpp"
#include <passive_haptics/design/stiffness_budget.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/presets.hpp>

#include <string>
#include <vector>

namespace encoders {

namespace ph = passive_haptics;
namespace sim = passive_haptics::simulation;
namespace design = passive_haptics::design;

using line = ph::space<double, 1>;
using wall = controllers::model<line>;

/// The most the hand pushes with, as every model is told [N].
inline constexpr double hand_force = 5.0;

/// A device, and how far its friction gives way before it slips [m].
struct machine {
  sim::device_preset preset{};
  double presliding = 0.0;

  [[nodiscard]] bool rubs_elastically() const noexcept {
    return preset.friction > 0.0 && presliding > 0.0;
  }
  /// What is stated of it: half of its damping and friction, the rest as it is.
  [[nodiscard]] design::stated_device stated() const noexcept {
    return {.mass = preset.mass,
            .damping = preset.damping / 2.0,
            .friction = preset.friction / 2.0,
            .presliding = rubs_elastically() ? presliding : 0.0,
            .quantum = preset.quantum,
            .force_limit = preset.force_limit};
  }
  [[nodiscard]] design::budget budget() const noexcept {
    return design::stiffness_budget(stated());
  }
  /// The static stiffness that damped_spring displays of a wall K [N/m].
  [[nodiscard]] double displayed(double K) const noexcept {
    return ph::kernels::sampled_stiffness(K, 0.1, preset.mass, 1e-3);
  }
};

/// Is it one of the two of a quick run?
[[nodiscard]] inline bool is_quick(const sim::device_preset& p) {
  return p.name == std::string(sim::touch_like.name) || p.name == std::string(sim::ideal.name);
}

/// What a composition does not count on is true of the device or not.
struct composition {
  const char* name = "";
  bool takes_positions_as_exact = false;
  bool takes_friction_as_rigid = false;
  bool promises = true;
  bool is_capped = false;  ///< its law is no stiffer than the budget
  bool follows = false;    ///< and softer where the ledger runs low
  wall (*make)(const design::stated_device&,
               double most) = nullptr;  ///< if capped, at `most` [N/m]

  /// Does its promise hold on that machine?
  [[nodiscard]] bool covers(const machine& m) const noexcept {
    return promises && !(takes_positions_as_exact && m.preset.quantum > 0.0) &&
           !(takes_friction_as_rigid && m.rubs_elastically());
  }
  /// Does it make a wall for that machine at all?
  [[nodiscard]] bool fits(const machine& m) const noexcept {
    return !is_capped || m.budget().stiffness > 0.0;
  }
  /// Is it there for the section on tremor only, to be compared with?
  [[nodiscard]] bool is_control() const noexcept { return is_capped && !follows; }
  /// The static stiffness that its law displays of a wall K [N/m].
  [[nodiscard]] double displayed(const machine& m, double K) const noexcept {
    return m.displayed(is_capped ? std::min(K, m.budget().stiffness) : K);
  }
};

/// The recommended one first.
[[nodiscard]] const std::vector<composition>& compositions();

/// use(device) of a machine under a hand that follows a target.
[[nodiscard]] auto with_device(const machine& m, double start,
                               const sim::impedance_hand<line>& fingers, auto use) {
  using hand = sim::impedance_hand<line>;
  if (m.rubs_elastically()) {
    auto p = m.preset.without_friction<line>();
    p.start = start;
    sim::device<line, hand, sim::slider_and_spring> device(p, fingers,
                                                           m.preset.friction_of(m.presliding));
    return use(device);
  }
  auto p = m.preset.parameters<line>();
  p.start = start;
  sim::device<line, hand> device(p, fingers);
  return use(device);
}

/// The same under a hand of 150 g, 300 N/m, 5 N·s/m.
[[nodiscard]] auto with_device(const machine& m, double start, auto use) {
  return with_device(m, start, {.stiffness = 300.0, .damping = 5.0, .own_mass = 0.15}, use);
}

inline constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A wall of stiffness K [N/m], no stiffer than `most`: the device is in it where x > surface_of(m).
[[nodiscard]] wall wall_of(const composition& c, const machine& m, double K, double most);

/// Where its surface is [m]: somewhere within a step of encoders that cut off.
[[nodiscard]] inline double surface_of(const machine& m) noexcept {
  return 0.37 * m.preset.quantum;
}

}  // namespace encoders
