// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The adversaries of a challenge, and the true circumstances in which they attack.
//
//   adversary       one of the twelve of all_adversaries, or of the five of encoder_adversaries, which
//                   move less than an encoder step; to_string, is_force_limited
//   circumstances   the true device, clock and encoders, and the bounds of what the surface does

#include <passive_haptics/simulation/driver.hpp>
#include <passive_haptics/simulation/friction_kind.hpp>

#include <array>
#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

enum class adversary : std::uint8_t {
  nyquist,          ///< in by δ, out by δ, in turn
  random_walk,      ///< anywhere, near the surface
  greedy,           ///< presses, leaves by the worst Δx
  jumping_surface,  ///< a slow hand on a surface that jumps and changes its stiffness
  flipping_normal,  ///< the surface turns anywhere, often to the opposite side of the device
  jitter,           ///< periods of 0.5 to 1 longest ticks
  overruns,         ///< now and then a period of 2 to 20 longest ticks
  rocking,          ///< across an encoder step and back: false credit, if there is a quantum
  dropouts,         ///< samples that never arrive
  tapping,          ///< a force-limited hand that reverses exactly at the surface
  random_tapping,   ///< the same hand, anywhere and at any moment
  kitchen_sink,     ///< everything but the hands, at once
  in_step,          ///< inside an encoder step, or within the noise, in phase with the force
  presliding,       ///< the same, by up to 2 p, over which friction is elastic
  worst_step,       ///< presses, leaves by that of a dozen small steps that costs least energy
  dither,           ///< 2 a forward and a back, a ≤ p, then greedy
  trembling,        ///< a force-limited hand, in phase with the force
};

inline constexpr std::array all_adversaries{
    adversary::nyquist,         adversary::random_walk,     adversary::greedy,
    adversary::jumping_surface, adversary::flipping_normal, adversary::jitter,
    adversary::overruns,        adversary::rocking,         adversary::dropouts,
    adversary::tapping,         adversary::random_tapping,  adversary::kitchen_sink};

/// The adversaries that move less than an encoder step, the noise or the presliding displacement. On a device with
/// none of these they move by some micrometres.
inline constexpr std::array encoder_adversaries{adversary::in_step, adversary::presliding,
                                                adversary::worst_step, adversary::dither,
                                                adversary::trembling};

[[nodiscard]] constexpr const char* to_string(adversary by) noexcept {
  switch (by) {
    case adversary::nyquist:
      return "nyquist";
    case adversary::random_walk:
      return "random walk";
    case adversary::greedy:
      return "greedy";
    case adversary::jumping_surface:
      return "jumping surface";
    case adversary::flipping_normal:
      return "flipping normal";
    case adversary::jitter:
      return "jitter";
    case adversary::overruns:
      return "overruns";
    case adversary::rocking:
      return "rocking";
    case adversary::dropouts:
      return "dropouts";
    case adversary::tapping:
      return "tapping";
    case adversary::random_tapping:
      return "random tapping";
    case adversary::kitchen_sink:
      return "kitchen sink";
    case adversary::in_step:
      return "in step";
    case adversary::presliding:
      return "presliding";
    case adversary::worst_step:
      return "worst step";
    case adversary::dither:
      return "dither";
    case adversary::trembling:
      return "trembling";
  }
  return "unknown adversary";
}

/// True for a hand of at most circumstances::hand_force on a device of circumstances::mass. Its periods do
/// not vary, and no sample is lost.
[[nodiscard]] constexpr bool is_force_limited(adversary by) noexcept {
  return by == adversary::tapping || by == adversary::random_tapping || by == adversary::trembling;
}

/// The true device, clock and encoders, and the bounds of what the surface does. The model under test must state at
/// most this damping, mass and friction, at least this hand force, longest tick, presliding and quantum + noise, and
/// exactly this latency and watchdog.
struct circumstances {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double damping = 0.03;    ///< b [N·s/m]
  double mass = 0.1;        ///< apparent, hand included [kg]; counts for force-limited hands only
  double friction = 0.0;    ///< f_c, per axis [N]
  double presliding = 0.0;  ///< p, over which friction is elastic; 0: rigid [m]
  friction_kind rubs_like = friction_kind::one_spring;  ///< model of elastic friction
  double hand_force = 5.0;                              ///< largest force of the hands [N]
  double quantum = 0.0;                                 ///< positions are floored to multiples [m]
  double noise = 0.0;             ///< positions are off by up to half of this, per axis [m]
  double force_limit = infinity;  ///< largest force of the actuators [N]
  double longest_tick = 1e-3;     ///< the period, unless the adversary varies it [s]
  int latency = 0;                ///< ticks from a command to its holding
  bool watchdog = true;           ///< the driver drops a force after longest_tick
  double softest = 2e3;           ///< least stiffness of a surface [N/m]
  double stiffest = 22e3;         ///< largest stiffness of a surface [N/m]
  double jump = 2e-3;             ///< farthest the surface jumps, either way [m]
  int ticks = 600;                ///< length of a run

  [[nodiscard]] parameter_fault check() const noexcept {
    if (!(softest > 0.0)) return {"softest", softest, "> 0 N/m"};
    if (!(stiffest >= softest) || !kernels::is_finite(stiffest)) {
      return {"stiffest", stiffest, "finite and ≥ softest"};
    }
    if (!(hand_force >= 0.0) || !kernels::is_finite(hand_force)) {
      return {"hand_force", hand_force, "finite and ≥ 0 N"};
    }
    if (!(jump >= 0.0) || !kernels::is_finite(jump)) return {"jump", jump, "finite and ≥ 0 m"};
    if (!(damping > 0.0)) return {"damping", damping, "> 0 N·s/m"};
    if (!(noise >= 0.0) || !kernels::is_finite(noise)) return {"noise", noise, "finite and ≥ 0 m"};
    if (!(presliding >= 0.0)) return {"presliding", presliding, "finite and ≥ 0 m"};
    if (ticks < 1) return {"ticks", double(ticks), "≥ 1"};
    if (rubs_elastically()) {
      if (const auto fault = elastic_friction().check()) return fault;
    }
    return device_of<space<double, 1>>().check();
  }
  [[nodiscard]] bool rubs_elastically() const noexcept {
    return friction > 0.0 && presliding > 0.0;
  }
  [[nodiscard]] friction_like elastic_friction() const noexcept {
    return {rubs_like, friction, presliding};
  }
  template <class Space>
  [[nodiscard]] device_parameters<Space> device_of() const noexcept {
    device_parameters<Space> p;
    p.mass = mass;
    p.damping = damping;
    if (!rubs_elastically()) p.friction = friction;
    p.force_limit = force_limit;
    p.quantum = quantum;
    p.period = longest_tick;
    p.latency = latency;
    if (watchdog) p.watchdog = longest_tick;
    return p;
  }
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
