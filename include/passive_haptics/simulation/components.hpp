// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The bridge between a Space of any scalar and the simulated physics, which is computed in double.
//
//   physical<Space>       space<double, Dof>: its vector is a double for Dof 1
//   component(v, i)       component i of a number, a vector or coordinates
//   to_physical<Space>    from the port to the physics          to_port<Space>    and back
//   clamp_norm            a vector shortened to a length, without overflow
//
// This header includes no Eigen, because a Space of two or more degrees of freedom has included it.

#include <passive_haptics/device/space.hpp>

#include <cmath>
#include <cstddef>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

template <class Space>
using physical = space<double, Space::dof>;

/// Component i of anything that has components; a number is its own only component.
template <class Vector>
[[nodiscard]] constexpr decltype(auto) component(Vector& v, int i) noexcept {
  if constexpr (requires { v.values; }) {
    return (v.values[static_cast<std::size_t>(i)]);
  } else if constexpr (requires { v(i); }) {
    return v(i);
  } else {
    return (v);
  }
}

/// The same number on every axis.
template <class Space>
[[nodiscard]] constexpr typename physical<Space>::coordinates every_axis(double x) noexcept {
  typename physical<Space>::coordinates v{};
  for (int i = 0; i < Space::dof; ++i) component(v, i) = x;
  return v;
}

template <class Space, class Vector>
[[nodiscard]] constexpr typename physical<Space>::vector to_physical(const Vector& v) noexcept {
  auto result = physical<Space>::zero();
  for (int i = 0; i < Space::dof; ++i) component(result, i) = static_cast<double>(component(v, i));
  return result;
}

template <class Space, class Vector>
[[nodiscard]] constexpr typename Space::vector to_port(const Vector& v) noexcept {
  auto result = Space::zero();
  for (int i = 0; i < Space::dof; ++i) {
    component(result, i) = static_cast<typename Space::scalar>(component(v, i));
  }
  return result;
}

/// v, or the vector of length `length` along v if v is longer. It is exact on one axis, and finite for every
/// finite v, even where ‖v‖ overflows.
template <class Space>
[[nodiscard]] constexpr typename physical<Space>::vector clamp_norm(
    const typename physical<Space>::vector& v, double length) noexcept {
  if (!(physical<Space>::norm(v) > length)) return v;
  double largest = 0.0;
  for (int i = 0; i < Space::dof; ++i) {
    largest = kernels::larger(largest, std::abs(component(v, i)));
  }
  const typename physical<Space>::vector unit = v / largest;
  return unit * (length / physical<Space>::norm(unit));
}

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
