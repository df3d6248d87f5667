// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A knob or a slider with detents and end stops that come to rest, from the stated numbers of its device. It needs no
// Eigen and is fit for firmware.
//
//     constexpr ph::exact_device motor{.mass = 5e-5, .damping = 1e-3, .force_limit = 0.2,   // kg·m², N·m·s/rad, N·m
//                                      .longest_tick = 1e-3, .rotary = true};
//     auto knob = ph::make_detents<ph::space<float, 1>>(motor, {.force = 0.15}, {.pitch = 0.26, .stiffness = 0.1});

#include <passive_haptics/compositions.hpp>
#include <passive_haptics/knob/detents.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A port with detents: port.tick(sample). Their stiffness is limited to one that comes to rest and, on encoders, to
/// the one that dry friction pays for; port.explain() says which. The guarantee is that of make_guard.
template <class Space, class Limits = loop_limits, detail::described Device = exact_device,
          detail::stated_hand Hand = known_hand>
[[nodiscard]] constexpr auto make_detents(const Device& device, const Hand& hand,
                                          detents shape) noexcept {
  shape.rest.mass = device.mass;
  shape.rest.force_limit = device.force_limit;
  shape.rest.softens = false;  // because the stiffness is known
  shape.most = kernels::smaller(shape.most, detail::budget_of(device, hand, Limits::latency));
  const double steepest = kernels::larger(shape.stiffness, shape.stop_stiffness);
  const double shown = kernels::smaller(shape.most, steepest);
  shape.rest.damping_fraction = detail::braking(device, shown, shown);
  return passive_port{Space{},
                      shape,
                      detail::sums_of(device, hand),
                      detail::bounds_of(device, hand),
                      detail::limits_of<Limits>(device),
                      detail::eyes_of(device)};
}

/// The type that make_detents returns, for members of a class.
template <class Space, class Limits = loop_limits, class Device = exact_device,
          class Hand = known_hand>
using knob = decltype(make_detents<Space, Limits>(Device{}, Hand{}, detents{}));

}  // namespace v0
}  // namespace passive_haptics
