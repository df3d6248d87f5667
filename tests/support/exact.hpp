// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks in exact arithmetic whether a rounded force keeps its promise. Products of floats are exact in double;
// where they are not, and for doubles, the lost part is added back (two-product by fma). So no rounding here can
// hide an overdraft.

#include <passive_haptics/laws.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace exact {

/// A product without error, high + low, if low is a normal number.
struct product {
  double high, low;
  product(double a, double b) noexcept : high(a * b), low(std::fma(a, b, -high)) {}
};

[[nodiscard]] inline bool at_most(const product& a, const product& b) noexcept {
  return a.high < b.high || (a.high == b.high && a.low <= b.low);
}

/// True if f² ≤ 4 B E1.
template <class Scalar>
[[nodiscard]] bool covered(Scalar f, Scalar E1, Scalar B) noexcept {
  const auto wide = [](Scalar x) { return static_cast<double>(x); };
  return at_most({wide(f), wide(f)}, {4.0 * wide(B), wide(E1)});
}

/// True if T f² ≤ 4 b E1, in floats.
[[nodiscard]] inline bool covered(float f, float E1, float b, float T) noexcept {
  const auto wide = [](float x) { return static_cast<double>(x); };
  const double credit = 4.0 * wide(b) * wide(E1);  // 48 bits
  const product cost(wide(f) * wide(f), wide(T));
  return cost.high < credit || (cost.high == credit && cost.low <= 0.0);
}

/// True only if F s − B s² ≤ E1 for every 0 ≤ s ≤ δ. It is computed in `Wide` with every rounding against the
/// force.
template <class Wide, class Scalar>
[[nodiscard]] bool reach_covered(Scalar F, Scalar E1, Wide B, Scalar reach) noexcept {
  const Wide margin = Wide(8) * std::numeric_limits<Wide>::epsilon();
  const Wide f = Wide(F), E = Wide(E1), delta = Wide(reach);
  if (!(reach > Scalar(0)) || !(f > Wide(0))) return true;
  if (f <= Wide(2) * B * delta) return f * f * (Wide(1) + margin) <= Wide(4) * B * E;
  return (f * delta) * (Wide(1) + margin) <= E + B * delta * delta * (Wide(1) - margin);
}

/// A float of any magnitude, subnormals included, each exponent as likely as the next.
[[nodiscard]] inline float any_positive_float(passive_haptics::laws::samples& random) noexcept {
  return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits() % 0x7f800000U));
}

}  // namespace exact
