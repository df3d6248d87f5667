// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is played back on host and target alike: numbers as their bits, so that nothing is read or
// printed on the way. record.cpp writes it.

#include <bit>
#include <cstddef>
#include <cstdint>

namespace replay {

/// The bits of a float. Widened to double where the scene computes in double: exact.
using bits = std::uint32_t;

struct sample {
  bits x[3];  ///< position [m]
  bits dt;    ///< length of the tick [s]
  int news;   ///< which surface the environment has just published; −1: none
};

/// A half-space: point a, normal b. A triangle: nodes a, b, c.
struct surface {
  bits a[3], b[3], c[3];
  bits stiffness;
};

struct recording {
  const char* scene;
  const sample* samples;
  std::uint32_t ticks;
  const surface* surfaces;
};

template <class Real>
[[nodiscard]] constexpr Real number(bits b) {
  return static_cast<Real>(std::bit_cast<float>(b));
}

}  // namespace replay
