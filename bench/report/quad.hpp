// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scalar that all others are measured against: 113 bits, IEEE 754's binary128, by Boost. Any
// scalar that models `real` composes.

#include <Eigen/Core>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <limits>

namespace experiments {

/// Boost's number behind functions that stay functions: a tick inlines all it calls, and these are
/// hundreds of instructions each.
class quad {
 public:
  using number = boost::multiprecision::number<
      boost::multiprecision::cpp_bin_float<113, boost::multiprecision::digit_base_2, void,
                                           std::int16_t, -16382, 16383>,
      boost::multiprecision::et_off>;

  quad() = default;
  template <class Number>
  requires std::is_arithmetic_v<Number> quad(Number value)  // NOLINT(google-explicit-constructor)
      : value_(value) {}
  explicit quad(const number& value) : value_(value) {}
  template <class Number>
  requires std::is_arithmetic_v<Number>
  explicit operator Number() const { return static_cast<Number>(value_); }

  [[gnu::noinline]] quad& operator+=(const quad& b) { return value_ += b.value_, *this; }
  [[gnu::noinline]] quad& operator-=(const quad& b) { return value_ -= b.value_, *this; }
  [[gnu::noinline]] quad& operator*=(const quad& b) { return value_ *= b.value_, *this; }
  [[gnu::noinline]] quad& operator/=(const quad& b) { return value_ /= b.value_, *this; }
  friend quad operator+(quad a, const quad& b) { return a += b; }
  friend quad operator-(quad a, const quad& b) { return a -= b; }
  friend quad operator*(quad a, const quad& b) { return a *= b; }
  friend quad operator/(quad a, const quad& b) { return a /= b; }
  friend quad operator-(const quad& a) { return quad(number(-a.value_)); }

  [[gnu::noinline]] friend bool operator==(const quad& a, const quad& b) {
    return a.value_ == b.value_;
  }
  [[gnu::noinline]] friend std::partial_ordering operator<=>(const quad& a, const quad& b) {
    return a.value_ < b.value_    ? std::partial_ordering::less
           : a.value_ > b.value_  ? std::partial_ordering::greater
           : a.value_ == b.value_ ? std::partial_ordering::equivalent
                                  : std::partial_ordering::unordered;
  }
  [[gnu::noinline]] friend quad sqrt(const quad& a) { return quad(number(sqrt(a.value_))); }
  [[gnu::noinline]] friend quad abs(const quad& a) { return quad(number(abs(a.value_))); }

 private:
  number value_;
};

}  // namespace experiments

template <>
struct std::numeric_limits<experiments::quad> : std::numeric_limits<experiments::quad::number> {
  using quad = experiments::quad;
  using limits = std::numeric_limits<quad::number>;
  static quad min() { return quad(limits::min()); }
  static quad max() { return quad(limits::max()); }
  static quad lowest() { return quad(limits::lowest()); }
  static quad epsilon() { return quad(limits::epsilon()); }
};
