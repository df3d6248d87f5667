// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The unit circle, on which a sampled transfer function is evaluated, also in constant expressions.
//
//   complex          + − * / of pairs of double
//   frequency        z = e^{jθ}, θ = ωT in (0, π], and 1 − z⁻¹ without cancellation
//   frequency_grid   the θ at which a condition over all θ is evaluated
//   cos_sin          e^{jα} by range reduction and Taylor's series

#include <passive_haptics/base/language.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace design {

struct complex {
  double re = 0.0, im = 0.0;

  friend constexpr complex operator+(complex a, complex b) noexcept {
    return {a.re + b.re, a.im + b.im};
  }
  friend constexpr complex operator-(complex a, complex b) noexcept {
    return {a.re - b.re, a.im - b.im};
  }
  friend constexpr complex operator*(complex a, complex b) noexcept {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend constexpr complex operator/(complex a, complex b) noexcept {
    const double square = b.re * b.re + b.im * b.im;
    return {(a.re * b.re + a.im * b.im) / square, (a.im * b.re - a.re * b.im) / square};
  }
  friend constexpr complex operator+(double a, complex b) noexcept { return complex{a} + b; }
  friend constexpr complex operator+(complex a, double b) noexcept { return a + complex{b}; }
  friend constexpr complex operator-(double a, complex b) noexcept { return complex{a} - b; }
  friend constexpr complex operator-(complex a, double b) noexcept { return a - complex{b}; }
  friend constexpr complex operator*(double a, complex b) noexcept { return {a * b.re, a * b.im}; }
  friend constexpr complex operator*(complex a, double b) noexcept { return b * a; }
  friend constexpr complex operator/(double a, complex b) noexcept { return complex{a} / b; }
  friend constexpr complex operator/(complex a, double b) noexcept { return {a.re / b, a.im / b}; }
};

inline constexpr double pi = 3.141592653589793;

/// e^{jα} = cos α + j sin α, to 1e-15 for |α| ≤ 1000, the same at compile time and at run time.
[[nodiscard]] constexpr complex cos_sin(double alpha) noexcept {
  constexpr double quarter = 1.57079632673412561;  // π/2 in 33 bits: n · quarter is exact
  constexpr double quarter_rest = 6.07710050650619225e-11;  // π/2 − quarter
  const double turns = alpha / quarter;
  const long long n = static_cast<long long>(turns < 0.0 ? turns - 0.5 : turns + 0.5);
  const double whole = static_cast<double>(n);
  const double r = (alpha - whole * quarter) - whole * quarter_rest;
  const double square = r * r;
  double cosine = 1.0, sine = 1.0;
  for (int k = 18; k > 0; k -= 2) {
    cosine = 1.0 - square / ((k - 1) * k) * cosine;
    sine = 1.0 - square / (k * (k + 1)) * sine;
  }
  sine *= r;
  const complex turned[] = {{cosine, sine}, {-sine, cosine}, {-cosine, -sine}, {sine, -cosine}};
  return turned[n & 3];
}

/// One frequency. A transfer function H(z) is given as a function of it:
///     [](design::frequency w) { return K + D * w.difference() / T; }
struct frequency {
  double angle = pi;  ///< θ = ωT [rad], in (0, π]; π is the Nyquist frequency

  [[nodiscard]] constexpr complex z() const noexcept { return cos_sin(angle); }
  /// z⁻ⁿ, a delay of n ticks.
  [[nodiscard]] constexpr complex delay(int n) const noexcept { return cos_sin(-n * angle); }
  /// 1 − z⁻¹ = 2 sin²(θ/2) + j sin θ, the backward difference.
  [[nodiscard]] constexpr complex difference() const noexcept {
    const complex half = cos_sin(angle / 2.0);
    return {2.0 * half.im * half.im, 2.0 * half.im * half.re};
  }
};

/// θ = π i/points [rad] for i = 1 … points, and `octaves` more below them, each half the one before, because the
/// conditions are worst near 0 or π, or are smooth. A peak narrower than π/points may be missed. The least θ is
/// 2.4e-5 by default, which meets a limit at θ = 0 to a relative error of 3e-10.
struct frequency_grid {
  int points = 512;
  int octaves = 8;

  [[nodiscard]] constexpr int size() const noexcept { return points + octaves; }
  [[nodiscard]] constexpr frequency at(int i) const noexcept {
    if (i < points) return {pi * (i + 1) / points};
    return {pi / (static_cast<double>(points) * static_cast<double>(2LL << (i - points)))};
  }
};

}  // namespace design
}  // namespace v0
}  // namespace passive_haptics
