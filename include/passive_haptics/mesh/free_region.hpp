// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The half-spaces that a point may go to, and the shortest way into all of them.

#include <passive_haptics/mesh/triple.hpp>

#include <array>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

/// The half-space n·p ≥ level, all of which is at least a radius away from `triangle`; `weights` are the barycentric
/// ones of the point of the triangle that was closest.
struct half_space_of {
  triple normal;  ///< n, unit
  double level;   ///< [m]
  int triangle;
  triple weights;  ///< barycentric
  int mesh = 0;    ///< number of its mesh among those that are touched
};

/// A way out of the half-spaces' complements, Σ λ n: it rests on at most three of them, with λ ≥ 0 along each normal.
struct support {
  triple way;                     ///< Σ λ n [m]
  std::array<int, 3> of{};        ///< numbers of half-spaces
  std::array<double, 3> share{};  ///< λ [m]
  int count = 0;
};

namespace detail {

/// The parts of a unit vector n along up to three others, n = Σ r_j basis_j + z, with z perpendicular to all of them.
struct parts {
  std::array<double, 3> r{};
  triple z;
};
[[nodiscard]] constexpr parts parts_of(const triple& n, const std::array<triple, 3>& basis,
                                       int count) noexcept {
  parts p{{}, n};
  if (count == 1) {
    p.r[0] = dot(basis[0], n);
    p.z = n - basis[0] * p.r[0];
  } else if (count == 2) {
    const double a = dot(basis[0], basis[1]), u = dot(basis[0], n), v = dot(basis[1], n);
    const double det = 1.0 - a * a;
    p.r[0] = (u - a * v) / det;
    p.r[1] = (v - a * u) / det;
    p.z = n - basis[0] * p.r[0] - basis[1] * p.r[1];
  } else if (count == 3) {
    const triple c = cross(basis[1], basis[2]);
    const double det = dot(basis[0], c);
    p.r = {dot(n, c) / det, dot(n, cross(basis[2], basis[0])) / det,
           dot(n, cross(basis[0], basis[1])) / det};
    p.z = {};
  }
  return p;
}

}  // namespace detail

/// Finds the shortest way y with n_i·y ≥ missing(i) [m], up to `slack` [m], for i < count; returns false if there is
/// none. The method is the dual one of Goldfarb and Idnani (1983), from memory: in each round the half-space that y
/// misses by most joins those that press, and any that would have to pull leaves them.
[[nodiscard]] constexpr bool shortest_way(auto normal, auto missing, int count, double slack,
                                          support& s) noexcept {
  constexpr double parallel = 1e-8;  // |z|² of normals that count as one
  s = {};
  std::array<triple, 3> basis{};
  for (int change = 0; change < 8 * (count + 1); ++change) {
    int worst = -1;
    double most = slack;
    for (int i = 0; i < count; ++i) {
      const double lacks = missing(i) - dot(normal(i), s.way);
      if (lacks > most) {
        most = lacks;
        worst = i;
      }
    }
    if (worst < 0) return true;
    const triple n = normal(worst);
    double gained = 0.0;
    for (;; ++change) {
      const detail::parts p = detail::parts_of(n, basis, s.count);
      const double square = squared(p.z);
      const bool turns = s.count < 3 && square > parallel;
      double t = turns ? (missing(worst) - dot(n, s.way)) / square : box::infinity;
      int leaves = -1;
      for (std::size_t j = 0; j < std::size_t(s.count); ++j) {
        if (p.r[j] > 1e-12 && s.share[j] < t * p.r[j]) {
          t = s.share[j] / p.r[j];
          leaves = int(j);
        }
      }
      if (!(t < box::infinity) || change > 8 * (count + 1)) return false;
      for (std::size_t j = 0; j < std::size_t(s.count); ++j) s.share[j] -= t * p.r[j];
      gained += t;
      if (turns) s.way = s.way + p.z * t;
      if (leaves < 0) break;
      --s.count;
      for (std::size_t j = std::size_t(leaves); j < std::size_t(s.count); ++j) {
        s.share[j] = s.share[j + 1];
        s.of[j] = s.of[j + 1];
        basis[j] = basis[j + 1];
      }
    }
    const auto last = std::size_t(s.count++);
    basis[last] = n;
    s.of[last] = worst;
    s.share[last] = gained;
  }
  return false;
}

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
