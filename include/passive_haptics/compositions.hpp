// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The recommended composition for a device and a hand, from their stated numbers:
//
//   make_touch<Space>(device, hand)               one surface that the environment publishes
//   make_contacts<Space>(device, hand, slots…)    several surfaces: a corner, a groove, surfaces that come and go
//   make_guard<Space>(device, hand)               a force of your own or of a renderer, bounded and made to settle
//   make_tool(device, hand, slots…)               six degrees of freedom: six_dof.hpp
//   make_detents<Space>(device, hand, {…})        detents and end stops: knob/detents.hpp, a companion
//
// `device` is an exact_device, whose positions count as exact, or an encoder_device, whose steps can be felt and are
// paid for by its dry friction (design/described_device.hpp). With a known_hand the guarantee is conditional and
// walls are stiff; with any_hand it is strict, and walls are soft while the ledger is empty. All of them respect the
// motors' limit, recover from faults if they are conditional, and have explain().
//
//     class hand_loop {
//       ph::touch<scene> touch_ = ph::make_touch<scene>(
//           {.mass = 0.1, .damping = 0.03, .force_limit = 9.0, .longest_tick = 0.0011}, {.force = 5.0});

#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/capped.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/contact/damped_spring.hpp>
#include <passive_haptics/contact/eased.hpp>
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
#include <passive_haptics/force_bound/watched.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/motion_estimator/edge_observer.hpp>
#include <passive_haptics/motion_estimator/mass_observer.hpp>
#include <passive_haptics/normal_interpolation/turn_limited.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A hand that, with load and dry friction, pushes with at most `force` [N]. If the motion refutes that, or the stated
/// mass, the composition reports an event and falls back to the strict bound (force_bound/watched.hpp).
struct known_hand {
  double force{};              ///< largest force of hand, load and dry friction [N], > 0
  design::intended_use use{};  ///< motions under which a wall on encoders has to last

  /// A possible force that is almost surely a slip, on a device whose motors hold `force_limit` [N].
  [[nodiscard]] constexpr parameter_fault doubt(double force_limit) const noexcept {
    if (force > 0.02 * force_limit && force < 300.0) return {};
    return {"force", force, "above 2 % of what the motors hold, and below 300 N"};
  }
};
/// The same without the test against the motion, which saves 7 kB on a Cortex-M4 (docs/firmware.md).
struct trusted_hand : known_hand {};
/// A hand of which nothing is assumed.
struct any_hand_t {};
inline constexpr any_hand_t any_hand{};

namespace detail {
/// A device of design/described_device.hpp.
template <class Device>
concept described = std::same_as<Device, exact_device> || std::same_as<Device, encoder_device>;
/// A hand type of this header.
template <class Hand>
concept stated_hand = std::derived_from<Hand, known_hand> || std::same_as<Hand, any_hand_t>;
inline constexpr double unstated = std::numeric_limits<double>::quiet_NaN();
[[nodiscard]] constexpr double stated(double x) noexcept {
  return x != 0.0 ? x : unstated;
}
[[nodiscard]] constexpr double stated(const known_hand& hand) noexcept {
  return hand.force != 0.0 ? hand.force : no_hand;
}

// The ledger, the motors' limit and the motion estimator of each kind of device.
[[nodiscard]] constexpr reduced_energy ledger_of(const exact_device& d) noexcept {
  return {.damping = d.damping};
}
[[nodiscard]] constexpr dual_ledger ledger_of(const encoder_device& d) noexcept {
  return {.damping = {.coefficient = d.damping,
                      .coulomb = d.friction,
                      .presliding = d.friction == 0.0 ? 0.0 : d.presliding},
          .quantum = d.quantum};
}
[[nodiscard]] constexpr actuator_limit motors_of(const exact_device& d) noexcept {
  return {.most = stated(d.force_limit)};
}
[[nodiscard]] constexpr thermal_limit motors_of(const encoder_device& d) noexcept {
  return {.peak = stated(d.force_limit),
          .continuous = d.continuous_force,
          .time_constant = d.winding_time};
}
[[nodiscard]] constexpr last_difference eyes_of(const exact_device& /*d*/) noexcept {
  return {};
}
/// Within the presliding, friction may hold the device against several contacts, so the observer rests there, too.
[[nodiscard]] constexpr edge_observer eyes_of(const encoder_device& d) noexcept {
  return {.quantum = d.quantum, .presliding = d.friction > 0.0 ? d.presliding : 0.0};
}
[[nodiscard]] constexpr last_difference eyes_of_touch(const exact_device& /*d*/,
                                                      double /*most*/) noexcept {
  return {};
}
/// If friction's spring c/p is stiffer than the wall, it holds the device alone, and the observer rests within p.
[[nodiscard]] constexpr edge_observer eyes_of_touch(const encoder_device& d, double most) noexcept {
  return {.quantum = d.quantum,
          .presliding = d.friction > most * d.presliding ? d.presliding : 0.0};
}

/// The stiffness [N/m] that the dry friction pays for in a loop `late` ticks late. The law adds the limit by the mass.
[[nodiscard]] constexpr double budget_of(const exact_device& /*d*/, const auto& /*hand*/,
                                         int /*late*/) noexcept {
  return std::numeric_limits<double>::infinity();
}
[[nodiscard]] constexpr double budget_of(encoder_device d, const auto& hand, int late) noexcept {
  d.latency = d.latency < late ? late : d.latency;
  design::intended_use use{};
  if constexpr (requires { hand.use; }) use = hand.use;
  const auto [mass, slow, fast, holding] = design::stiffness_budget(d, use).limits;
  return kernels::smaller(holding, kernels::smaller(slow, fast));
}

// A conditional composition recovers from faults (forgiving); a strict one does not.
[[nodiscard]] constexpr auto sums_of(const auto& d, const known_hand& /*hand*/) noexcept {
  return forgiving{ledger_of(d), amends_for(d.force_limit)};
}
[[nodiscard]] constexpr auto sums_of(const auto& d, any_hand_t /*hand*/) noexcept {
  return ledger_of(d);
}
[[nodiscard]] constexpr reachable_bound reach_of(const auto& d, const known_hand& hand) noexcept {
  return {.mass = d.mass, .hand_force = stated(hand)};
}
[[nodiscard]] constexpr auto bounds_of(const auto& d, const known_hand& hand) noexcept {
  return bound_chain{watched{reach_of(d, hand)}, motors_of(d)};
}
[[nodiscard]] constexpr auto bounds_of(const auto& d, const trusted_hand& hand) noexcept {
  return bound_chain{reach_of(d, hand), motors_of(d)};
}
[[nodiscard]] constexpr auto bounds_of(const auto& d, any_hand_t /*hand*/) noexcept {
  return bound_chain{strict_bound{}, motors_of(d)};
}

/// If the device states another latency than the type Limits, longest_tick is NaN, which check() refuses.
template <class Limits>
[[nodiscard]] constexpr Limits limits_of(const auto& d) noexcept {
  Limits limits{.longest_tick = d.latency == Limits::latency ? d.longest_tick : unstated};
  if constexpr (requires { limits.top_speed; }) {
    double q = 0.0;
    if constexpr (requires { d.quantum; }) q = d.quantum;
    limits.top_speed = top_speed_of(d.top_speed, d.rotary, q, d.longest_tick);
    if (d.rotary) limits.workspace = std::numeric_limits<double>::infinity();
  }
  return limits;
}

/// The law of one surface. Updates change its force by at most 50 N/s, or by 5.5 times the torque limit per second.
[[nodiscard]] constexpr eased<damped_spring> settling(const auto& d) noexcept {
  const damped_spring law{.mass = d.mass, .force_limit = d.force_limit};
  if (!d.rotary) return eased{law};
  return eased{law, news_pace{.least_force_rate = 0.55 * d.force_limit,
                              .usual_force_rate = 2.2 * d.force_limit,
                              .most_force_rate = 5.5 * d.force_limit}};
}
[[nodiscard]] constexpr auto law_of(const exact_device& d, const auto& /*hand*/,
                                    double /*most*/) noexcept {
  return settling(d);
}
[[nodiscard]] constexpr auto law_of(const encoder_device& d, const auto& hand,
                                    double most) noexcept {
  design::intended_use use{};
  if constexpr (requires { hand.use; }) use = hand.use;
  return capped{settling(d), most, design::stiffness_budget(d, use).working_capital};
}
/// β of settled_force: the larger of the damping that settles a stiffness `most` [N/m] and the critical damping of the
/// stiffness `usual` [N/m], at most ¼. More would feel viscous: ¼ m/T = 250 N·s/m of 1 kg drag with 1.3 N at 5 mm/s.
[[nodiscard]] constexpr double braking(const auto& d, double most, double usual) noexcept {
  const double T = d.longest_tick, late = d.latency;
  const double steep = (1.0 + late) * (late + 1.5) * most * T * T / d.mass;
  const double critical = (1.0 + late) * 2.0 * T * kernels::square_root(usual / d.mass);
  const double enough = kernels::larger(steep, critical),
               usually = settled_force{}.damping_fraction;
  return enough > 0.0 && enough < usually ? enough : usually;
}
/// Fits a spring to this device, with a stiffness of at most `most` [N/m].
constexpr void fit(proxy_spring& spring, const auto& d, double most) noexcept {
  spring.mass = d.mass;
  spring.force_limit = d.force_limit;
  spring.most = most;
}
/// Surfaces in slots, as stiff as the device and its dry friction bear in a loop `late` ticks late.
[[nodiscard]] constexpr auto set_of(const auto& d, const auto& hand, int late,
                                    const auto&... room) noexcept {
  proxy_spring spring{};
  fit(spring, d, budget_of(d, hand, late));
  const pursuit turned{.speed = 0.5, .force_rate = 5.5 * d.force_limit};  // [rad/s], [N·m/s]
  return contact_set{spring, d.rotary ? turned : pursuit{}, room...};
}
/// A force of the user's own, as stiff as the device and its dry friction bear in a loop `late` ticks late.
[[nodiscard]] constexpr settled_force guard_of(const auto& d, const auto& hand, int late,
                                               double renderer_period) noexcept {
  const double budget = budget_of(d, hand, late);
  const double most = kernels::smaller(budget, d.rotary ? 50.0 * d.force_limit : 40e3);
  return {.mass = d.mass,
          .damping_fraction = braking(d, most, most / 40.0),
          .force_limit = d.force_limit,
          .most = budget,
          .renderer_period = renderer_period};
}
/// The port of a source that was made for this device.
template <class Space, class Limits>
[[nodiscard]] constexpr auto port_of(const auto& source, const auto& d, const auto& hand,
                                     const auto& bounds) noexcept {
  return passive_port{Space{}, source, sums_of(d, hand), bounds, limits_of<Limits>(d), eyes_of(d)};
}
}  // namespace detail

/// One surface: touch.update(plane), touch.tick(sample). Its normal turns with the rate of the updates, and catches
/// up with the rest by at most `turn_rate` [rad/s] or, under a small force, by as much as turns the force at half of
/// usual_force_rate. On encoders its stiffness is limited to the budget that dry friction pays for; without any,
/// check() refuses `most`. E ≥ 0, on encoders E ≥ −½ c p, for device and hand as stated, and without a fault.
template <class Space, class Constraint = half_space<Space>, class Limits = loop_limits,
          detail::described Device = exact_device, detail::stated_hand Hand = known_hand>
[[nodiscard]] constexpr auto make_touch(const Device& device, const Hand& hand,
                                        double turn_rate = 2.0) noexcept {
  const double most = detail::budget_of(device, hand, Limits::latency);
  return local_model{Space{},
                     followed<Constraint>{},
                     turn_limited{.rate = turn_rate},
                     detail::law_of(device, hand, most),
                     detail::sums_of(device, hand),
                     detail::bounds_of(device, hand),
                     detail::limits_of<Limits>(device),
                     detail::eyes_of_touch(device, most)};
}

/// Several surfaces in slots, with or without friction: port.source().update(i, plane), release(i);
/// contact/manifold.hpp fills the slots from the result of a collision search.
///     auto corner = ph::make_contacts<scene>(device, hand, ph::slots<ph::half_space<scene>, 3>{});
///     auto rough = ph::make_contacts<scene>(device, hand, ph::stick_slip{}, ph::slots<plane, 3>{});
template <class Space, class Limits = loop_limits, detail::described Device = exact_device,
          detail::stated_hand Hand = known_hand, class... Room>
[[nodiscard]] constexpr auto make_contacts(const Device& device, const Hand& hand,
                                           const Room&... room) noexcept {
  static_assert(sizeof...(Room) > 0,
                "passive_haptics: a set of contacts has slots, which come after the hand: "
                "slots<half_space<scene>, 3>{}");
  const auto source = detail::set_of(device, hand, Limits::latency, room...);
  return detail::port_of<Space, Limits>(source, device, hand, detail::bounds_of(device, hand));
}

/// For a force that you, a renderer, a simulator or an SDK compute: port.tick(sample, wanted). The contact comes to
/// rest when the hand does, for a renderer's stiffness of up to port.explain().shown [N/m]. A renderer that is slower than
/// the loop states its longest time from one force to the next, `renderer_period` [s]: 0.03 for 33 Hz. With any_hand the
/// guarantee holds for any hand, and a wall is soft: 2b/T [N/m], pressed slowly from an empty ledger.
template <class Space, class Limits = loop_limits, detail::described Device = exact_device,
          detail::stated_hand Hand = known_hand>
[[nodiscard]] constexpr auto make_guard(const Device& device, const Hand& hand,
                                        double renderer_period = 0.0) noexcept {
  return detail::port_of<Space, Limits>(
      detail::guard_of(device, hand, Limits::latency, renderer_period), device, hand,
      detail::bounds_of(device, hand));
}

// The types that they return, for members of a class.
template <class Space, class Constraint = half_space<Space>, class Limits = loop_limits,
          class Device = exact_device, class Hand = known_hand>
using touch = decltype(make_touch<Space, Constraint, Limits>(Device{}, Hand{}));
template <class Space, class Constraint = half_space<Space>, class Limits = loop_limits,
          class Hand = known_hand>
using encoder_touch = touch<Space, Constraint, Limits, encoder_device, Hand>;
template <class Space, class Limits = loop_limits, class Device = exact_device,
          class Hand = known_hand>
using force_guard = decltype(make_guard<Space, Limits>(Device{}, Hand{}));

/// The guard for any port, also joints, of which only damping and motors are known (actuator_limit, motor_limits). It is
/// strict, so a wall is soft while the ledger is empty: 2b/T [N/m], pressed slowly.
template <port P, class Motors, class Damping = isotropic_damping, class Limits = loop_limits>
using strict_guard = passive_port<P, given_force, basic_reduced_energy<Damping>,
                                  bound_chain<strict_bound, Motors>, Limits>;
template <port P, class Damping = isotropic_damping, class Motors = actuator_limit>
[[nodiscard]] constexpr strict_guard<P, Motors, Damping> make_strict_guard(
    const std::type_identity_t<Damping>& damping, const Motors& motors,
    double longest_tick) noexcept {
  return {P{}, given_force{}, basic_reduced_energy<Damping>{.damping = damping},
          bound_chain{strict_bound{}, motors}, loop_limits{.longest_tick = longest_tick}};
}

}  // namespace v0
}  // namespace passive_haptics
