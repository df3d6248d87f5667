// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Shapes that the environment's tests share, and ways to ask for an error's text.
#include "support/catch.hpp"
#include <passive_haptics/environment/ball.hpp>
#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/surface.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace env = passive_haptics::environment;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Eigen::Vector3d;

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Error>
std::string text_of(const std::function<void()>& act) {
  try {
    act();
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

inline bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// A point of the cube from −size to size.
inline Vector3d anywhere(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> in(-size, size);
  const double x = in(random);
  const double y = in(random);
  return {x, y, in(random)};
}

/// Six tetrahedra per cube around its diagonal; cubes where solid() says so. Upright, conforming.
template <class Solid>
env::tetrahedral_mesh blocks(int n, Solid solid) {
  env::tetrahedral_mesh mesh;
  std::map<std::array<int, 3>, int> numbers;
  const auto node = [&](int i, int j, int k) {
    const auto [at, added] = numbers.try_emplace({i, j, k}, static_cast<int>(mesh.nodes.size()));
    if (added) mesh.nodes.emplace_back(i, j, k);
    return at->second;
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        if (!solid(i, j, k)) continue;
        std::array<int, 3> axis{0, 1, 2};
        do {
          std::array<int, 3> corner{i, j, k};
          std::array<int, 4> t{};
          t[0] = node(i, j, k);
          for (std::size_t s = 0; s < 3; ++s) {
            ++corner[static_cast<std::size_t>(axis[s])];
            t[s + 1] = node(corner[0], corner[1], corner[2]);
          }
          if (env::signed_volume(mesh, t) < 0.0) std::swap(t[2], t[3]);
          mesh.tetrahedra.push_back(t);
        } while (std::next_permutation(axis.begin(), axis.end()));
      }
    }
  }
  return mesh;
}

/// A ring around z: `pieces` prisms one after the other, their section a polygon of `corners`.
inline env::tetrahedral_mesh torus(double radius, double thickness, int pieces, int corners) {
  env::tetrahedral_mesh mesh;
  const double turn = 2.0 * std::acos(-1.0);
  for (int i = 0; i < pieces; ++i) {
    const double along = turn * i / pieces;
    for (int j = 0; j <= corners; ++j) {  // the first in the core
      const double around = turn * j / corners;
      const double out = radius + (j == 0 ? 0.0 : thickness * std::cos(around));
      mesh.nodes.emplace_back(out * std::cos(along), out * std::sin(along),
                              j == 0 ? 0.0 : thickness * std::sin(around));
    }
  }
  for (int i = 0; i < pieces; ++i) {
    for (int j = 0; j < corners; ++j) {
      const std::array<int, 3> section{0, std::min(j, (j + 1) % corners) + 1,
                                       std::max(j, (j + 1) % corners) + 1};
      std::array<int, 6> prism{};  // ordered alike in all of them, so that neighbours cut alike
      for (std::size_t k = 0; k < 3; ++k) {
        prism[k] = i * (corners + 1) + section[k];
        prism[k + 3] = (i + 1) % pieces * (corners + 1) + section[k];
      }
      for (std::size_t k = 0; k < 3; ++k) {
        std::array<int, 4> t{prism[k], prism[k + 1], prism[k + 2], prism[k + 3]};
        if (env::signed_volume(mesh, t) < 0.0) std::swap(t[2], t[3]);
        mesh.tetrahedra.push_back(t);
      }
    }
  }
  return mesh;
}

inline double volume(const env::tetrahedral_mesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.tetrahedra) sum += env::signed_volume(mesh, t);
  return sum;
}

/// Every edge has two triangles, the enclosed volume is that of the elements, Euler is right.
inline void check_closed(const env::tetrahedral_mesh& mesh, int euler) {
  const auto surface = env::boundary(mesh);
  std::set<int> nodes;
  std::map<std::pair<int, int>, int> directed;
  double enclosed = 0.0;  // divergence theorem: V = ⅓ ∮ x·n dA
  for (const auto& t : surface) {
    const auto shape = env::corners(t, mesh.nodes);
    enclosed += env::area_vector(shape).dot((shape[0] + shape[1] + shape[2]) / 3.0) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      nodes.insert(t.nodes[k]);
      ++directed[{t.nodes[k], t.nodes[(k + 1) % 3]}];
    }
  }
  for (const auto& [edge, times] : directed) {
    CHECK(times == 1);
    CHECK(directed.count({edge.second, edge.first}) == 1);
  }
  CHECK_THAT(enclosed, WithinRel(volume(mesh), 1e-12));
  const auto edges = static_cast<int>(directed.size()) / 2;
  CHECK(static_cast<int>(nodes.size()) - edges + static_cast<int>(surface.size()) == euler);
}
