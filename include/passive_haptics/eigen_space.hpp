// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// space<Scalar, Dof> for two and more degrees of freedom, on Eigen. The only core header that names
// it.

#include <passive_haptics/space.hpp>

#include <Eigen/Core>

#include <array>

namespace passive_haptics {
inline namespace v0 {

/// A vector at rest: trivially copyable (Eigen's are not), so it can cross threads and be
/// snapshotted. Converts from any Eigen expression of that shape, and to space::vector.
template <real Scalar, int Dof>
struct stored_vector {
  std::array<Scalar, static_cast<std::size_t>(Dof)> values{};

  constexpr stored_vector() noexcept = default;

  template <class... Numbers>
  requires(
      sizeof...(Numbers) == Dof &&
      (std::convertible_to<Numbers, Scalar> &&
       ...)) constexpr stored_vector(Numbers... numbers) noexcept  // NOLINT(google-explicit-constructor)
      : values{static_cast<Scalar>(numbers)...} {}

  template <class Expression>
  stored_vector(const Eigen::MatrixBase<Expression>& v) noexcept {  // NOLINT: a view of the same
    const auto& all = v.eval();  // no copy of what is a vector already
    for (int i = 0; i < Dof; ++i) values[static_cast<std::size_t>(i)] = all(i);
  }

  [[nodiscard]] constexpr Scalar operator[](std::size_t i) const noexcept { return values[i]; }

  operator Eigen::Matrix<Scalar, Dof, 1>() const noexcept {  // NOLINT: a view of the same thing
    Eigen::Matrix<Scalar, Dof, 1> all;
    for (int i = 0; i < Dof; ++i) all(i) = values[static_cast<std::size_t>(i)];
    return all;
  }
};

template <real Scalar, int Dof>
requires(Dof >= 2) struct space<Scalar, Dof> {
  using scalar = Scalar;
  using vector = Eigen::Matrix<Scalar, Dof, 1>;
  using coordinates = stored_vector<Scalar, Dof>;
  static constexpr int dof = Dof;

  [[nodiscard]] static vector zero() noexcept {
    vector all;
    for (int i = 0; i < Dof; ++i) all(i) = Scalar(0);
    return all;
  }
  /// Summed from the first to the last: Eigen's own order depends on the scalar and on the target.
  [[nodiscard, gnu::always_inline]] static Scalar dot(const vector& a, const vector& b) noexcept {
    Scalar sum = a(0) * b(0);
    for (int i = 1; i < Dof; ++i) sum += a(i) * b(i);
    return sum;
  }
  [[nodiscard, gnu::always_inline]] static Scalar norm(const vector& a) noexcept {
    return kernels::square_root(dot(a, a));
  }
  [[nodiscard, gnu::always_inline]] static bool is_finite(const vector& a) noexcept {
    bool all = kernels::is_finite(a(0));
    for (int i = 1; i < Dof; ++i) all = all && kernels::is_finite(a(i));
    return all;
  }

  [[nodiscard]] static Scalar weighted_square(const vector& w, const vector& a) noexcept {
    return a.cwiseAbs2().dot(w);
  }
  [[nodiscard]] static Scalar inversely_weighted_square(const vector& w, const vector& a) noexcept {
    return a.cwiseAbs2().cwiseQuotient(w).sum();
  }
  [[nodiscard]] static Scalar component(const vector& a, int i) noexcept { return a(i); }
  [[nodiscard]] static Scalar& component(vector& a, int i) noexcept { return a(i); }
  [[nodiscard]] static Scalar component(const coordinates& a, int i) noexcept {
    return a.values[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] static Scalar& component(coordinates& a, int i) noexcept {
    return a.values[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] static Scalar smallest(const vector& a) noexcept { return a.minCoeff(); }

  /// A unit vector orthogonal to the unit vector n; the choice is fixed, so it is repeatable (A19).
  [[nodiscard]] static vector orthogonal(const vector& n) noexcept {
    Eigen::Index least = 0;
    n.cwiseAbs().minCoeff(&least);
    vector u = -n(least) * n;
    u(least) += Scalar(1);
    return u / norm(u);
  }

  [[nodiscard, gnu::always_inline]] static vector cross(const vector& a, const vector& b) noexcept
      requires(Dof == 3) {
    return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
  }
};

}  // namespace v0
}  // namespace passive_haptics
