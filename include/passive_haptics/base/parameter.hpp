// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parameters: a user states them in double, check() refuses them with a sentence, and a port computes with
// them in its scalar.
//
// A part of a composition is a plain struct of numbers, its parameters, which knows no scene:
//     ph::reachable_bound{.mass = 0.1, .hand_force = 5.0}
// Its `on<Port>` is what computes at a port: the same numbers in the port's scalar, and its state.

#include <passive_haptics/base/kernels.hpp>

#include <array>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {

/// Why a parameter is refused. Converts to true when there IS a fault:
///
///     static_assert(!ph::reachable_bound{.mass = 0.1, .hand_force = 5.0}.check());
///     if (const auto fault = touch.check()) complain(fault.parameter, fault.value, fault.remedy);
struct parameter_fault {
  const char* parameter = nullptr;  ///< its name, null when all is well
  double value = 0.0;               ///< the value refused
  const char* remedy = "";          ///< the range allowed

  constexpr explicit operator bool() const noexcept { return parameter != nullptr; }
};

namespace detail {

/// The default of a parameter that limits nothing unless it is stated.
inline constexpr double no_limit = std::numeric_limits<double>::infinity();

[[nodiscard]] constexpr bool positive(double x) noexcept {
  return x > 0.0 && kernels::is_finite(x);
}
[[nodiscard]] constexpr bool not_negative(double x) noexcept {
  return x >= 0.0 && kernels::is_finite(x);
}

/// A parameter in the scalar that computes with it. A finite number stays finite and one that is not zero
/// does not become zero, so a value that check() has passed is still in its range.
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

/// The same of an array of them; of doubles, back to what a user states.
template <real To, real From, std::size_t N>
[[nodiscard]] constexpr std::array<To, N> numbers(const std::array<From, N>& all) noexcept {
  std::array<To, N> same{};
  for (std::size_t i = 0; i < N; ++i) same[i] = number<To>(static_cast<double>(all[i]));
  return same;
}

/// The type that computes at a port: Part::on<Port>, or the part itself where it is written for one port.
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

/// The first parameter of a part at its port that is out of its range, if any.
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

/// Puts a part's state back to where it began; its parameters stay.
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
