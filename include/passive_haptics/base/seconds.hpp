// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A length of time that says so: it cannot stand where a position or a force is meant.
//
//     touch.tick(x, now - before);            // two time points: any std::chrono::duration converts
//     touch.tick(x, ph::seconds{dt});         // a number of your own [s]
//     port.tick(x, ph::seconds{dt}, wanted);
//
// In one degree of freedom position, time and force are numbers alike: were dt one, too, then a slip,
// tick(x, wanted, dt), would compile and take a force of 2 N for a tick of 2 s. <chrono> is not included:
// a duration is known by its members, and a microcontroller without clocks does not pay for them.

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

/// A number of seconds, in the scalar of the port that takes it; other scalars and other units convert.
/// It never turns into a number by itself: ask count() [s].
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

/// What a function that takes `seconds` says to a number in their place. It does not compile.
template <class Number>
constexpr void refuse_bare_time() noexcept {
  static_assert(!std::same_as<Number, Number>,
                "passive_haptics: say what dt is, as in tick(x, ph::seconds{dt}), or give a "
                "std::chrono::duration such as now - before");
}

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
