// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The contract of a haptic device: exchange() takes a force and returns a sample. Its type determines the port.
//
//     struct my_device {
//       ph::device_sample<scene> exchange(const scene::vector& force) noexcept {
//         sdk_set_force(force(0), force(1), force(2));
//         return {.position = sdk_position(), .held = force, .dt = watch_.lap(), .valid = sdk_ok()};
//       }
//       bool unplugged() const noexcept { return sdk_gone(); }   // optional
//       ph::stopwatch watch_;
//     };

#include <passive_haptics/port/concepts.hpp>

#include <concepts>
#include <type_traits>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

namespace detail {

template <class Member>
struct exchanged {};
template <class D, class P, class Effort>
struct exchanged<device_sample<P> (D::*)(Effort) noexcept> {
  using port = P;
};

struct no_reading {};

/// The type of latest(), the readings of a device besides its samples, if it has that function.
template <class D>
[[nodiscard]] constexpr auto reading_of(const D& device) noexcept {
  if constexpr (requires { device.latest(); }) {
    return device.latest();
  } else {
    return no_reading{};
  }
}

template <class D>
[[nodiscard]] constexpr bool is_unplugged(const D& device) noexcept {
  if constexpr (requires { device.unplugged(); }) {
    return device.unplugged();
  } else {
    return false;
  }
}

}  // namespace detail

/// The port of a device whose exchange() is one function, not overloaded, and noexcept.
template <class D>
using port_of_device = typename detail::exchanged<decltype(&D::exchange)>::port;

/// haptic_device_for the port that its exchange() names. Optional are unplugged(), true once the device is
/// gone until it is opened again, and latest(), which has readings besides the sample.
template <class D>
concept haptic_device = requires {
  typename port_of_device<D>;
  requires haptic_device_for<D, port_of_device<D>>;
};

}  // namespace v0
}  // namespace passive_haptics
