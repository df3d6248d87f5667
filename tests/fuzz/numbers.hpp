// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fuzz/reader.hpp"

#include <cmath>
#include <iterator>
#include <limits>

namespace fuzz {

/// Numbers, of any size or of one that gets far into a port.
class numbers : public reader {
 public:
  using reader::reader;

  /// `usual` times a power of two from 2^-4 to 2^3, in a third of all cases.
  double about(double usual) noexcept {
    const unsigned how = one();
    if (how < 160) return usual * std::ldexp(1.0 + one() / 256.0, static_cast<int>(how % 8) - 4);
    if (how < 200) return usual;
    if (how < 224) return usual * std::ldexp(1.0, 8 * (one() - 128));
    if (how < 240) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      constexpr double telling[]{0.0,     -0.0,   1.0,    -1.0,   infinity, -infinity,
                                 1e308,   -1e308, 1e-308, 5e-324, 3.4e38,   -3.4e38,
                                 1.2e-38, 1e-45,  1e154,  1e19};
      return telling[one() % std::size(telling)];
    }
    return any<double>();
  }
  /// From −size to size in half of all cases, else any.
  template <class Scalar>
  Scalar around(double size) noexcept {
    const unsigned how = one();
    if (how < 200) return static_cast<Scalar>(size * (one() - 127.5) / 127.5);
    if (how < 220) return any<Scalar>();
    return static_cast<Scalar>(about(size));
  }
};

}  // namespace fuzz
