// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parameters. A user states them in double, check() names one out of range, and a port computes in its own scalar.
//
// A part of a composition is a plain struct of its parameters, which does not depend on the port's type:
//     ph::reachable_bound{.mass = 0.1, .hand_force = 5.0}
// Its nested `on<Port>` computes: it has the same numbers in the port's scalar, and the part's state.

#include <passive_haptics/base/kernels.hpp>

#include <array>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {

/// The first parameter that is out of its range, if any. It converts to true when there IS a fault:
///
///     static_assert(!ph::reachable_bound{.mass = 0.1, .hand_force = 5.0}.check());
///     if (const auto fault = touch.check()) complain(fault.parameter, fault.value, fault.remedy);
struct parameter_fault {
  const char* parameter = nullptr;  ///< the name of the parameter; null if there is no fault
  double value = 0.0;               ///< the refused value, in the parameter's unit
  const char* remedy = "";          ///< the allowed range, with its unit

  constexpr explicit operator bool() const noexcept { return parameter != nullptr; }
};

namespace detail {

/// The default of a limit that does not apply unless it is stated.
inline constexpr double no_limit = std::numeric_limits<double>::infinity();

[[nodiscard]] constexpr bool positive(double x) noexcept {
  return x > 0.0 && kernels::is_finite(x);
}
[[nodiscard]] constexpr bool not_negative(double x) noexcept {
  return x >= 0.0 && kernels::is_finite(x);
}

/// Stands for the force of a hand that was left out, which is refused as 0 N where 0 N may be stated.
inline constexpr double no_hand = -0x1p100;
[[nodiscard]] constexpr parameter_fault fault_of_hand(double force) noexcept {
  if (force == no_hand) return {"hand_force", 0.0, "stated, finite, > 0 N"};
  if (!not_negative(force)) return {"hand_force", force, "stated, finite, ≥ 0 N"};
  return {};
}

/// Converts a parameter to the scalar S. A finite number stays finite and a nonzero one does not become zero, so
/// a value that check() has passed is still in its range.
template <real S>
[[nodiscard]] constexpr S number(double x) noexcept {
  if constexpr (std::same_as<S, float>) {
    constexpr auto most = double(kernels::largest<float>());
    constexpr auto least = double(kernels::smallest<float>());
    const double size = kernels::magnitude(x);
    if (size > most && kernels::is_finite(x)) return S(x < 0.0 ? -most : most);
    if (size > 0.0 && size < least) return S(x < 0.0 ? -least : least);
  }
  return static_cast<S>(x);
}

/// Converts every number of an array, from double to a port's scalar or back.
template <real To, real From, std::size_t N>
[[nodiscard]] constexpr std::array<To, N> numbers(const std::array<From, N>& all) noexcept {
  std::array<To, N> same{};
  for (std::size_t i = 0; i < N; ++i) same[i] = number<To>(static_cast<double>(all[i]));
  return same;
}

/// The type that computes at a port: Part::on<Port>, or `Part` itself if it has none.
template <class Part, class Port>
struct at_port {
  using type = Part;
};
template <class Part, class Port>
requires requires {
  typename Part::template on<Port>;
}
struct at_port<Part, Port> {
  using type = typename Part::template on<Port>;
};

/// The first parameter of a part that is out of its range, if any.
template <class Part>
[[nodiscard]] constexpr parameter_fault fault_in(const Part& part) noexcept {
  if constexpr (requires { part.parameters().check(); }) {
    return part.parameters().check();
  } else if constexpr (requires { part.check(); }) {
    return part.check();
  } else {
    return {};
  }
}

/// Resets a part's state, if it has one, and keeps its parameters.
template <class Part>
constexpr void restart(Part& part) noexcept {
  if constexpr (requires { part.reset(); }) part.reset();
}

}  // namespace detail

/// The type that computes at a port when `Part` is composed into it.
template <class Part, class Port>
using part_at = typename detail::at_port<Part, Port>::type;

}  // namespace v0
}  // namespace passive_haptics
