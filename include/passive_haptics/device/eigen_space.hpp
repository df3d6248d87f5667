// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Eigen vectors, for space<Scalar, 2>, space<Scalar, 3> and every joint_space. No other core header names Eigen.

#include <passive_haptics/device/space.hpp>

#include <Eigen/Core>  // libeigen3-dev, or firmware.hpp for one degree of freedom

#include <array>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// A vector to store and to send: it is trivially copyable, which Eigen's vectors are not. It converts from
/// any Eigen expression of its shape, and to space::vector.
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
    const auto& all = v.eval();  // copies nothing where v is a vector already
    for (int i = 0; i < Dof; ++i) values[static_cast<std::size_t>(i)] = all(i);
  }

  [[nodiscard]] constexpr Scalar operator[](std::size_t i) const noexcept { return values[i]; }

  operator Eigen::Matrix<Scalar, Dof, 1>() const noexcept {  // NOLINT: a view of the same thing
    Eigen::Matrix<Scalar, Dof, 1> all;
    for (int i = 0; i < Dof; ++i) all(i) = values[static_cast<std::size_t>(i)];
    return all;
  }
};

namespace detail {

template <real Scalar, int Dof>
requires(Dof >= 2) struct vectors<Scalar, Dof> {
  using scalar = Scalar;
  using vector = Eigen::Matrix<Scalar, Dof, 1>;
  using coordinates = stored_vector<Scalar, Dof>;
  static constexpr int dof = Dof;

  [[nodiscard]] static vector zero() noexcept {
    vector all;
    for (int i = 0; i < Dof; ++i) all(i) = Scalar(0);
    return all;
  }
  /// a·b, summed from the first component to the last, because Eigen's order depends on scalar and target.
  [[nodiscard, gnu::always_inline]] static Scalar dot(const vector& a, const vector& b) noexcept {
    Scalar sum = a(0) * b(0);
    for (int i = 1; i < Dof; ++i) sum += a(i) * b(i);
    return sum;
  }
  [[nodiscard, gnu::always_inline]] static Scalar norm(const vector& a) noexcept {
    return kernels::square_root(dot(a, a));
  }
  /// a − b and a·s, number by number, because Eigen would pack two numbers at a time and unpack them again.
  [[nodiscard, gnu::always_inline]] static vector difference(const auto& a,
                                                             const auto& b) noexcept {
    return numbers([&](int i) { return component(a, i) - component(b, i); });
  }
  [[nodiscard, gnu::always_inline]] static vector scaled(const auto& a, Scalar by) noexcept {
    return numbers([&](int i) { return component(a, i) * by; });
  }
  [[nodiscard, gnu::always_inline]] static bool is_finite(const vector& a) noexcept {
    bool all = kernels::is_finite(a(0));
    for (int i = 1; i < Dof; ++i) all = all && kernels::is_finite(a(i));
    return all;
  }
  [[nodiscard]] static Scalar component(const vector& a, int i) noexcept { return a(i); }
  [[nodiscard]] static Scalar& component(vector& a, int i) noexcept { return a(i); }
  [[nodiscard]] static Scalar component(const coordinates& a, int i) noexcept {
    return a.values[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] static Scalar& component(coordinates& a, int i) noexcept {
    return a.values[static_cast<std::size_t>(i)];
  }

  /// The vector (of(0), …, of(Dof − 1)), written without a loop, so that even little optimisation leaves none.
  [[nodiscard, gnu::always_inline]] static vector numbers(const auto& of) noexcept {
    return [&]<int... I>(std::integer_sequence<int, I...>) {
      vector r;
      ((r(I) = of(I)), ...);
      return r;
    }
    (std::make_integer_sequence<int, Dof>{});
  }

  /// A unit vector orthogonal to the unit vector n; the choice is fixed, so it is repeatable (A19).
  [[nodiscard]] static vector orthogonal(const vector& n) noexcept {
    const vector size = numbers([&](int i) { return kernels::magnitude(n(i)); });
    int least = 0;
    for (int i = 1; i < Dof; ++i) least = size(i) < size(least) ? i : least;
    vector u = scaled(n, -n(least));
    u(least) += Scalar(1);
    return numbers([&, length = norm(u)](int i) { return u(i) / length; });
  }

  [[nodiscard, gnu::always_inline]] static vector cross(const vector& a, const vector& b) noexcept
      requires(Dof == 3) {
    return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
  }
};

}  // namespace detail

}  // namespace v0
}  // namespace passive_haptics
