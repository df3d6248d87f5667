// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The recommended composition for a device with a compliant transmission, from its stated numbers:
//
//   make_touch<Space>(device, transmission, hand)            as in compositions.hpp, which assumes a stiff device
//   make_contacts<Space>(device, transmission, hand, slots…)
//   make_guard<Space>(device, transmission, hand)
//
// The type of the transmission selects the force bound: any_transmission selects strict_bound,
// observed_transmission observed_reach, and chain_transmission<N> modelled_reach<N>.
//
//     auto touch = ph::make_touch<scene>(
//         device, ph::chain_transmission<2>{ph::two_masses(0.1, 0.3, 160.0, 0.03, 0.1)}, {.force = 5.0});

#include <passive_haptics/compliant/late_force.hpp>
#include <passive_haptics/compliant/transmission.hpp>
#include <passive_haptics/compositions.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {

/// The force bound of a transmission, in a loop that is `Late` ticks late.
template <int Late>
[[nodiscard]] constexpr strict_bound bound_of(const auto& /*d*/, const any_transmission& /*t*/,
                                              const known_hand& /*hand*/) noexcept {
  return {};
}
template <int Late>
[[nodiscard]] constexpr observed_reach bound_of(const auto& /*d*/, const observed_transmission& t,
                                                const known_hand& /*hand*/) noexcept {
  return {t.rotor, t.rotor_above, t.slew, t.friction, t.damping_above, t.pull};
}
template <int Late, int N>
[[nodiscard]] constexpr modelled_reach<N, Late> bound_of(const auto& d,
                                                         const chain_transmission<N>& t,
                                                         const known_hand& hand) noexcept {
  return {t.device, stated(hand), t.friction, d.longest_tick, t.tolerance, t.loss_tolerance};
}
/// The same, and the motors' limit.
template <class Limits>
[[nodiscard]] constexpr auto bounds_through(const auto& d, const auto& transmission,
                                            const known_hand& hand) noexcept {
  return bound_chain{bound_of<Limits::latency>(d, transmission, hand), motors_of(d)};
}
/// The mass [kg] for which the contact law is designed: the mass that moves with the encoder within a tick.
[[nodiscard]] constexpr double rotor_of(const auto& d, const any_transmission& t) noexcept {
  return t.rotor == 0.0 ? d.mass : t.rotor;
}
[[nodiscard]] constexpr double rotor_of(const auto& /*d*/,
                                        const observed_transmission& t) noexcept {
  return t.rotor;
}
template <int N>
[[nodiscard]] constexpr double rotor_of(const auto& /*d*/,
                                        const chain_transmission<N>& t) noexcept {
  return t.device.masses[0] / (1.0 + t.tolerance);
}
/// The device with the rotor's mass. If that exceeds the whole mass by 5 %, it is NaN, which check() refuses.
template <class Device, class Transmission>
[[nodiscard]] constexpr Device seen_through(Device d, const Transmission& t) noexcept {
  const double rotor = rotor_of(d, t);
  d.mass = rotor <= d.mass * 1.05 ? rotor : unstated;
  return d;
}
[[nodiscard]] constexpr double fastest_of(const any_transmission& /*t*/) noexcept {
  return 0.0;
}
[[nodiscard]] constexpr double fastest_of(const observed_transmission& t) noexcept {
  return t.fastest_mode;
}
template <int N>
[[nodiscard]] constexpr double fastest_of(const chain_transmission<N>& t) noexcept {
  return v0::fastest_mode(t.device) * (1.0 + t.tolerance);
}
/// The device for whose mass the spring and the damper of surfaces are designed: half of the rotor's, if it may swing
/// faster than 3/(16 (k + 1) T) [Hz] in a loop k = `late` > 0 ticks late, where both feed what they are to damp. Half as
/// steep they feed less than most transmissions lose (docs/design/settling.md, measured).
template <class Device, class Transmission>
[[nodiscard]] constexpr Device for_surfaces(Device seen, const Transmission& t, int late) noexcept {
  const double turns = fastest_of(t) * (1 + late) * seen.longest_tick;
  if (late > 0 && !(turns > 0.0 && turns <= 3.0 / 16.0)) seen.mass /= 2.0;
  return seen;
}

/// Satisfied by a transmission that has a bound for a device and a hand.
template <class T>
concept stated_transmission = requires(const T& t, const exact_device& d, const known_hand& hand) {
  bound_of<0>(d, t, hand);
};

}  // namespace detail

/// One surface, felt through the transmission. The contact law is designed for the rotor's mass. On encoders, state
/// only the dry friction of the rotor itself.
template <class Space, class Constraint = half_space<Space>, class Limits = loop_limits,
          detail::described Device = exact_device, detail::stated_transmission Transmission>
[[nodiscard]] constexpr auto make_touch(const Device& device, const Transmission& transmission,
                                        const known_hand& hand, double turn_rate = 2.0) noexcept {
  const Device seen = detail::seen_through(device, transmission);
  const double most = detail::budget_of(seen, hand, Limits::latency);
  return local_model{
      Space{},
      followed<Constraint>{},
      turn_limited{.rate = turn_rate},
      detail::law_of(detail::for_surfaces(seen, transmission, Limits::latency), hand, most),
      detail::sums_of(seen, hand),
      detail::bounds_through<Limits>(seen, transmission, hand),
      detail::limits_of<Limits>(seen),
      detail::eyes_of_touch(seen, most)};
}

/// Several surfaces in slots, as in compositions.hpp.
template <class Space, class Limits = loop_limits, detail::described Device = exact_device,
          detail::stated_transmission Transmission, class... Room>
[[nodiscard]] constexpr auto make_contacts(const Device& device, const Transmission& transmission,
                                           const known_hand& hand, const Room&... room) noexcept {
  const Device seen = detail::seen_through(device, transmission);
  const auto source = detail::set_of(detail::for_surfaces(seen, transmission, Limits::latency),
                                     hand, Limits::latency, room...);
  return detail::port_of<Space, Limits>(source, seen, hand,
                                        detail::bounds_through<Limits>(seen, transmission, hand));
}

/// A force of your own, as in compositions.hpp.
template <class Space, class Limits = loop_limits, detail::described Device = exact_device,
          detail::stated_transmission Transmission>
[[nodiscard]] constexpr auto make_guard(const Device& device, const Transmission& transmission,
                                        const known_hand& hand,
                                        double renderer_period = 0.0) noexcept {
  const Device seen = detail::seen_through(device, transmission);
  const auto source = detail::guard_of(seen, hand, Limits::latency, renderer_period);
  return detail::port_of<Space, Limits>(source, seen, hand,
                                        detail::bounds_through<Limits>(seen, transmission, hand));
}

}  // namespace v0
}  // namespace passive_haptics
