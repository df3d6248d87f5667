// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scalar that all others are measured against: 113 bits, IEEE 754's binary128, by Boost. Any
// scalar that models `real` composes; this is all that Eigen has to know of a new one.

#include <Eigen/Core>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <limits>

namespace experiments {
using quad = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<113, boost::multiprecision::digit_base_2, void,
                                         std::int16_t, -16382, 16383>,
    boost::multiprecision::et_off>;
}  // namespace experiments

template <>
struct Eigen::NumTraits<experiments::quad> : Eigen::GenericNumTraits<experiments::quad> {
  using Real = experiments::quad;
  using NonInteger = experiments::quad;
  using Nested = experiments::quad;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 20,
    AddCost = 30,
    MulCost = 40
  };
  static Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  static Real dummy_precision() { return 1000 * epsilon(); }
  static Real highest() { return (std::numeric_limits<Real>::max)(); }
  static Real lowest() { return std::numeric_limits<Real>::lowest(); }
  static Real infinity() { return std::numeric_limits<Real>::infinity(); }
  static Real quiet_NaN() { return std::numeric_limits<Real>::quiet_NaN(); }
  static int digits() { return std::numeric_limits<Real>::digits; }
  static int digits10() { return std::numeric_limits<Real>::digits10; }
};
