// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Compositions with a name, for the first hour and for class members:
//
//   touch<Space>   make_touch(device, longest_tick)   a surface that the environment publishes: it settles and
//                                                     is stiff, passive for the device and hand stated
//   encoder_touch<Space>  make_encoder_touch(device, hand)   the same on encoders whose steps are felt: as
//                                                     stiff as dry friction can pay for, so that it lasts
//   force_guard<Space>    make_force_guard(device, longest_tick)   force in, force out: what somebody else's
//                                                     renderer leaves ringing settles, and stays stiff
//   strict_guard<Port>    make_strict_guard(damping, T)   the same, strictly passive: any port, and soft
//
//     class hand_loop {
//       ph::touch<scene> touch_ = ph::make_touch<scene>({.mass = 0.1, .damping = 0.03,
//                                                        .hand_force = 5.0, .force_limit = 9.0}, 0.0011);

#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/capped.hpp>
#include <passive_haptics/contact/damped_spring.hpp>
#include <passive_haptics/contact/eased.hpp>
#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/contact/settled_force.hpp>
#include <passive_haptics/design/stiffness_budget.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/energy_observer/forgiving.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/force_bound/thermal_limit.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/motion_estimator/edge_observer.hpp>
#include <passive_haptics/normal_interpolation/turn_limited.hpp>

namespace passive_haptics {
inline namespace v0 {

/// What a promise rests on: the device and the hand on it.
struct known_device {
  double mass{};         ///< smallest apparent mass, over all directions and poses [kg]
  double damping{};      ///< b, a lower bound: half of what you identified [N·s/m]
  double hand_force{};   ///< the most that hand, load and dry friction push with [N]
  double force_limit{};  ///< the most that the motors hold [N]
};

/// What we recommend for a device of known mass. It is conditional, like reachable_bound, and gets over faults.
template <class Space, class Constraint = half_space<Space>, class Limits = loop_limits>
using touch =
    local_model<Space, followed<Constraint>, turn_limited, eased<damped_spring>,
                forgiving<reduced_energy>, bound_chain<reachable_bound, actuator_limit>, Limits>;

/// The normal turns by at most `turn_rate` [rad/s]; the longest tick is that of YOUR loop [s].
template <class Space, class Constraint = half_space<Space>>
[[nodiscard]] constexpr touch<Space, Constraint> make_touch(const known_device& device,
                                                            double longest_tick,
                                                            double turn_rate = 2.0) noexcept {
  return {Space{},
          followed<Constraint>{},
          turn_limited{.rate = turn_rate},
          eased{damped_spring{.mass = device.mass, .force_limit = device.force_limit}},
          forgiving{reduced_energy{.damping = device.damping}, amends_for(device.force_limit)},
          bound_chain{reachable_bound{.mass = device.mass, .hand_force = device.hand_force},
                      actuator_limit{.most = device.force_limit}},
          loop_limits{.longest_tick = longest_tick}};
}

/// What we recommend where the steps of the encoders are felt and dry friction is sure. It is conditional,
/// like reachable_bound, with E ≥ −½ c p for ever where there is no fault, else as forgiving says. A surface
/// stiffer than the device can pay for is displayed softer; law().is_capped() is true then.
template <class Space, class Constraint = half_space<Space>, class Limits = loop_limits>
using encoder_touch =
    local_model<Space, followed<Constraint>, turn_limited, capped<eased<damped_spring>>,
                forgiving<dual_ledger>, bound_chain<reachable_bound, thermal_limit>, Limits,
                edge_observer>;

/// `hand_force` is the most that hand, load and dry friction push with [N]. The stiffness is the budget for
/// the `latency` that the device states. If that is less than the latency of Limits, the contact is as
/// passive, but stiffer than what is sure to last. A device without dry friction has no budget, and check()
/// refuses `most`: take quantised_energy with a mass_observer there, which is soft at first.
template <class Space, class Constraint = half_space<Space>, class Limits = loop_limits>
[[nodiscard]] constexpr encoder_touch<Space, Constraint, Limits> make_encoder_touch(
    const design::stated_device& device, double hand_force, const design::intended_use& use = {},
    double turn_rate = 2.0) noexcept {
  const double stiffness = design::stiffness_budget(device, use).stiffness;
  const bool friction_is_stiffer = device.friction > stiffness * device.presliding;
  return {Space{},
          followed<Constraint>{},
          turn_limited{.rate = turn_rate},
          capped{eased{damped_spring{.mass = device.mass, .force_limit = device.force_limit}},
                 stiffness},
          forgiving{dual_ledger{.damping = {.coefficient = device.damping,
                                            .coulomb = device.friction,
                                            .presliding = device.presliding},
                                .quantum = device.quantum},
                    amends_for(device.force_limit)},
          bound_chain{reachable_bound{.mass = device.mass, .hand_force = hand_force},
                      thermal_limit{.peak = device.force_limit,
                                    .continuous = device.continuous_force,
                                    .time_constant = device.winding_time}},
          Limits{.longest_tick = device.longest_tick},
          edge_observer{.quantum = device.quantum,
                        .presliding = friction_is_stiffer ? device.presliding : 0.0}};
}

/// For a force that you compute yourself, or that a renderer, a simulator, an SDK does. It is conditional, like
/// reachable_bound, and rests when the hand does: of a renderer up to source().parameters().most_stiffness(T).
template <class Space, class Damping = isotropic_damping, class Limits = loop_limits>
using force_guard = passive_port<Space, settled_force, forgiving<basic_reduced_energy<Damping>>,
                                 bound_chain<reachable_bound, actuator_limit>, Limits>;

template <class Space, class Limits = loop_limits>
[[nodiscard]] constexpr force_guard<Space, isotropic_damping, Limits> make_force_guard(
    const known_device& device, double longest_tick) noexcept {
  return {Space{}, settled_force{.mass = device.mass, .force_limit = device.force_limit},
          forgiving{reduced_energy{.damping = device.damping}, amends_for(device.force_limit)},
          bound_chain{reachable_bound{.mass = device.mass, .hand_force = device.hand_force},
                      actuator_limit{.most = device.force_limit}},
          Limits{.longest_tick = longest_tick}};
}

/// The same for a device of which only the damping is known, joints among them. It is strict, so it is soft
/// while the ledger is empty, 2b/T pressed slowly; and it settles what it makes soft, no more.
template <port P, class Damping = isotropic_damping, class Limits = loop_limits>
using strict_guard =
    passive_port<P, given_force, basic_reduced_energy<Damping>, strict_bound, Limits>;

template <port P, class Damping = isotropic_damping>
[[nodiscard]] constexpr strict_guard<P, Damping> make_strict_guard(
    const std::type_identity_t<Damping>& damping, double longest_tick) noexcept {
  return {P{}, given_force{}, basic_reduced_energy<Damping>{.damping = damping}, strict_bound{},
          loop_limits{.longest_tick = longest_tick}};
}

}  // namespace v0
}  // namespace passive_haptics
