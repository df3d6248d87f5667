// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// seconds<Scalar> is a length of time as a type of its own, so it cannot stand in the place of a position or force.
//
//     touch.tick(x, now - before);            // two time points: any std::chrono::duration converts
//     touch.tick(x, ph::seconds{dt});         // a number of your own [s]
//     port.tick(x, ph::seconds{dt}, wanted);
//
// In one degree of freedom a position and a force are plain numbers. If dt were a plain number too, the slip
// tick(x, wanted, dt) would compile and take a force of 2 N for a tick of 2 s. <chrono> is not included: a
// duration is recognised by its members, so a microcontroller without clocks does not pay for them.

#include <passive_haptics/base/language.hpp>

#include <concepts>

namespace passive_haptics {
inline namespace v0 {

namespace detail {

/// A std::chrono::duration, or anything that has its members.
template <class D>
concept duration = requires(const D& d) {
  typename D::rep;
  D::period::num;
  D::period::den;
  d.count();
};

}  // namespace detail

/// A number of seconds in the port's scalar. It converts from other scalars and from std::chrono durations, but
/// never implicitly to a number: count() returns that [s].
template <class Scalar>
class seconds {
 public:
  constexpr explicit seconds(Scalar count) noexcept : count_(count) {}
  template <class Other>
  constexpr seconds(const seconds<Other>& s) noexcept  // NOLINT: the same time
      : count_(static_cast<Scalar>(s.count())) {}
  template <detail::duration D>
  constexpr seconds(const D& d) noexcept  // NOLINT: it says its unit
      : count_(static_cast<Scalar>(d.count()) * static_cast<Scalar>(D::period::num) /
               static_cast<Scalar>(D::period::den)) {}

  [[nodiscard]] constexpr Scalar count() const noexcept { return count_; }

 private:
  Scalar count_;
};
template <detail::duration D>
seconds(const D&) -> seconds<double>;

namespace detail {

/// The compile-time error of a function that takes `seconds` and is given a plain number.
template <class Number>
constexpr void refuse_bare_time() noexcept {
  static_assert(!std::same_as<Number, Number>,
                "passive_haptics: say what dt is, as in tick(x, ph::seconds{dt}), or give a "
                "std::chrono::duration such as now - before");
}

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
