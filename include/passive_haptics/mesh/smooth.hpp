// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Facets that are felt as the smooth surface which their nodes were taken from.
//
//     ph::mesh::surface organ(triangles, nodes, ph::mesh::smooth{});  // creases from 0.7 rad on
//
// Each corner i of a triangle at p_i has a unit normal n_i, one for all triangles round its node up to the next creases,
// and the triangle has a rounded surface s over it. With barycentric b in the plane of the triangle
//     N = Σ b_i n_i,  n = N/|N|,  h = 2 q/(1 + |N|),  q = Σ_{i<j} b_i b_j ½(n_j − n_i)·(p_j − p_i)
//     s = Σ b_i p_i + (h + lift) n
// The device x has its foot where x − s is along n; foot and n go over smooth edges without a step. The half-space
// n·y ≥ n·s + r joins those of the facets that hold the ball (mesh/proxy.hpp), so what these promise stays true, and
// friction, materials and motion are as without it. The lift is one length for a side of a mesh: where nodes are hollow
// h < 0, and what is felt lies above the facets by it, so that they are not felt.
//
// What a loop gives. The force K D n, D how deep x is below s + r n, is the gradient of ½K D² where n·ds = 0. On a sphere
// of any fineness it is: its normals are found exactly, and s is the sphere. Elsewhere the n_i are fitted so that
// ∫ n·dp along each edge is small, and a closed loop gets K ∮ D n·ds out of the mesh, or loses it: on an ellipsoid
// with half axes of 35, 50 and 70 mm no more than 2 % of the mean force times the length of the loop with 80 triangles,
// 0.3 % with 320 and 0.04 % with 1280 (1 kN/m, 1.5 mm deep, 15 mm across: 1.5, 0.2 and 0.03 mJ). Facets give nothing.
// The ledger of the port pays for what is given, or its bound takes that much force away.
//
// Sources, from memory: the foot is the Phong projection of Panozzo, Baran, Diamanti and Sorkine-Hornung (2013), the
// normals of a sphere's nodes are N. Max's (1999). h, and that it makes the force a gradient, is derived here:
// docs/design/meshes.md.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/mesh/triple.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

/// Which edges of a mesh are smooth: those between two triangles of one sense of rotation whose normals are less than
/// `crease` apart in the shape in which the mesh was made. An edge of one triangle or of three is sharp, and so are
/// those of triangles without an area, and of triangles that share places but no numbers of nodes.
struct smooth {
  double crease = 0.7;  ///< edges that turn by more stay sharp [rad]; 0.7 is 40°

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(crease > 0.0 && crease <= 1.2)) return {"crease", crease, "in (0, 1.2] rad"};
    return {};
  }
};

namespace detail {

/// The neighbours of triangles over smooth edges, and which of their corners have one normal.
struct neighbours {
  std::vector<std::array<int, 3>> normal;  ///< the number of the normal at each corner
  std::vector<std::array<int, 3>> beside;  ///< over the edge across from it; −1: a sharp one
  std::size_t normals = 0;

  [[nodiscard]] bool none() const noexcept { return normal.empty(); }
};

[[nodiscard]] inline neighbours neighbours_of(std::span<const std::array<int, 3>> triangles,
                                              std::span<const triple> nodes, double crease) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  struct half_edge {
    int least, most, triangle, across;
    bool along;  ///< from the node of the smaller number
  };
  std::vector<half_edge> edges;
  std::vector<triple> facing(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& c = triangles[t];
    const triple n = cross(nodes[at(c[1])] - nodes[at(c[0])], nodes[at(c[2])] - nodes[at(c[0])]);
    const double size = length(n);
    if (!(size > 0.0)) continue;
    facing[t] = n * (1.0 / size);
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      edges.push_back(
          {(std::min)(a, b), (std::max)(a, b), static_cast<int>(t), static_cast<int>(k), a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const half_edge& a, const half_edge& b) {
    return std::pair(a.least, a.most) < std::pair(b.least, b.most);
  });

  neighbours all;
  all.beside.assign(triangles.size(), {-1, -1, -1});
  std::vector<int> same(3 * triangles.size());  // corners of one normal point to one of them
  std::iota(same.begin(), same.end(), 0);
  const auto first_of = [&](int corner) {
    while (same[at(corner)] != corner) {
      same[at(corner)] = same[at(same[at(corner)])];
      corner = same[at(corner)];
    }
    return corner;
  };
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next].least == edges[i].least &&
           edges[next].most == edges[i].most) {
      ++next;
    }
    if (next - i != 2 || edges[i].along == edges[i + 1].along) continue;
    const half_edge &a = edges[i], &b = edges[i + 1];
    const triple &u = facing[at(a.triangle)], &v = facing[at(b.triangle)];
    if (!(dot(u, v) > std::cos(crease))) continue;
    all.beside[at(a.triangle)][at(a.across)] = b.triangle;
    all.beside[at(b.triangle)][at(b.across)] = a.triangle;
    for (const int end : {1, 2}) {  // the other triangle has its ends the other way round
      const int one = 3 * a.triangle + (a.across + end) % 3;
      const int other = 3 * b.triangle + (b.across + 3 - end) % 3;
      same[at(first_of(one))] = first_of(other);
    }
  }
  std::vector<int> number(same.size(), -1);
  all.normal.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      int& its = number[at(first_of(static_cast<int>(3 * t + k)))];
      if (its < 0) its = static_cast<int>(all.normals++);
      all.normal[t][k] = its;
    }
  }
  return all;
}

/// The least-squares problem of a normal n: Σ (e·(n + n_j))²/e² over the edges e to its neighbours' n_j.
struct normal_problem {
  std::array<double, 6> squares{};  ///< Σ e eᵀ/e²: xx, yy, zz, xy, xz, yz
  triple wanted{};                  ///< −Σ e (e·n_j)/e²
  triple first{};                   ///< n of Max

  constexpr void add(const triple& e, double share) noexcept {
    const triple s = e * share;
    const std::array<double, 6> more{e.x * s.x, e.y * s.y, e.z * s.z,
                                     e.x * s.y, e.x * s.z, e.y * s.z};
    for (std::size_t i = 0; i < more.size(); ++i) squares[i] += more[i];
  }
  /// The solution that stays close to the first one, too.
  [[nodiscard]] constexpr triple solved() const noexcept {
    const auto& [xx, yy, zz, xy, xz, yz] = squares;
    const double hold = 0.05 * (xx + yy + zz);
    const triple a{xx + hold, xy, xz}, b{xy, yy + hold, yz}, c{xz, yz, zz + hold};
    const triple right = wanted + first * hold, bc = cross(b, c);
    const double det = dot(a, bc);
    if (!(det > 0.0)) return first;
    return (bc * right.x + cross(c, a) * right.y + cross(a, b) * right.z) * (1.0 / det);
  }
};
[[nodiscard]] constexpr triple unit_or_none(const triple& n) noexcept {
  const double size = length(n);
  return size > 0.0 && kernels::is_finite(size) ? n * (1.0 / size) : triple{};
}

/// Unit normals, or none where triangles have no area. It allocates where a vector has another size.
inline void fit_normals(const neighbours& all, std::span<const std::array<int, 3>> triangles,
                        std::span<const triple> nodes, std::vector<triple>& normals,
                        std::vector<normal_problem>& problems) {
  constexpr int sweeps = 3;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const auto each_edge = [&](const auto& of) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t k = 0, next = 1; k < 3; ++k, next = (next + 1) % 3) {
        const triple e = nodes[at(triangles[t][next])] - nodes[at(triangles[t][k])];
        const double square = squared(e);
        if (square > 0.0) of(t, k, next, e, 1.0 / square);
      }
    }
  };
  problems.assign(all.normals, {});
  normals.resize(all.normals);
  each_edge([&](std::size_t t, std::size_t k, std::size_t next, const triple& e, double share) {
    normal_problem &one = problems[at(all.normal[t][k])],
                   &other = problems[at(all.normal[t][next])];
    one.add(e, share);
    other.add(e, share);
    const triple back = nodes[at(triangles[t][3 - k - next])] - nodes[at(triangles[t][k])];
    const double both = squared(back);
    if (both > 0.0) one.first = one.first + cross(e, back) * (share / both);
  });
  for (std::size_t i = 0; i < normals.size(); ++i) {
    normals[i] = problems[i].first = unit_or_none(problems[i].first);
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    each_edge([&](std::size_t t, std::size_t k, std::size_t next, const triple& e, double share) {
      const std::size_t i = at(all.normal[t][k]), j = at(all.normal[t][next]);
      problems[i].wanted = problems[i].wanted - e * (share * dot(e, normals[j]));
      problems[j].wanted = problems[j].wanted - e * (share * dot(e, normals[i]));
    });
    for (std::size_t i = 0; i < normals.size(); ++i) {
      normals[i] = unit_or_none(normals[i] + problems[i].solved());
      problems[i].wanted = {};
    }
  }
}

/// ½(n_j − n_i)·(p_j − p_i) of the edge across from each corner [m].
[[nodiscard]] constexpr triple sags(const corners& p, const corners& n) noexcept {
  return {0.5 * dot(n[2] - n[1], p[2] - p[1]), 0.5 * dot(n[0] - n[2], p[0] - p[2]),
          0.5 * dot(n[1] - n[0], p[1] - p[0])};
}

/// How the rounded surface lies to the facets.
struct bulge {
  double out = 0.0;           ///< how far it goes out of them on the side of their normals [m]
  double in = 0.0;            ///< and on the other side [m]
  double least_cosine = 1.0;  ///< of corners' normals and their triangles', or 0.8

  constexpr void include(const corners& p, const corners& n) noexcept {
    const triple sag = sags(p, n), facing = cross(p[1] - p[0], p[2] - p[0]);
    const double size = length(facing);
    if (!(size > 0.0)) return;
    // Σ b_i b_j is ⅓ at most, and 2/(1 + |N|) is largest in the middle.
    const double share = 2.0 / (3.0 + length(n[0] + n[1] + n[2]));
    out = (std::max)({out, sag.x * share, sag.y * share, sag.z * share});
    in = (std::max)({in, -sag.x * share, -sag.y * share, -sag.z * share});
    for (const triple& one : n) {
      least_cosine = (std::max)((std::min)(least_cosine, dot(one, facing) / size), 0.8);
    }
  }
  /// The lift on a side [m]: a ball of radius r that rests on the rounded surface is then no closer to the facets.
  [[nodiscard]] constexpr double lift(double side, double r) const noexcept {
    return (side > 0.0 ? in : out) + r * (1.0 / least_cosine - 1.0);
  }
};

/// The foot of a point on the rounded surface without its lift.
struct foot {
  int triangle;
  triple weights;  ///< barycentric
  triple normal;   ///< n, unit, on the side of the triangle's own
  double level;    ///< n·s [m]
  triple beyond;   ///< how far beside it x lies, where a sharp edge ends the surface [m]
};

/// Finds the foot of x by Newton's steps in its height, over smooth edges from triangle to triangle, beginning at the
/// triangle t. It returns false where there is none, or where the normals are no use.
[[nodiscard]] inline bool find_foot(const neighbours& all, const auto& corners_of,
                                    const auto& normals_of, int t, const triple& x,
                                    foot& f) noexcept {
  constexpr int most_steps = 48, most_returns = 4;
  constexpr double rounding = 1e-9;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  corners p = corners_of(t);
  corners n = normals_of(t);
  const triple start = closest_weights(p, x);
  // x lies that many N above the triangle.
  double high = dot(x - point_at(p, start), point_at(n, start));
  int came_from = -1, returns = 0;
  for (int step = 0; step < most_steps; ++step) {
    const corners q{p[0] + n[0] * high, p[1] + n[1] * high, p[2] + n[2] * high};
    const triple ab = q[1] - q[0], ac = q[2] - q[0], off = x - q[0], normal = cross(ab, ac);
    const double area = squared(normal), edges = squared(ab) + squared(ac);
    if (!(area > 1e-18 * edges * edges)) return false;
    const double b1 = dot(cross(off, ac), normal) / area, b2 = dot(cross(ab, off), normal) / area;
    const std::array<double, 3> b{1.0 - b1 - b2, b1, b2};
    const bool inside = b[0] >= -rounding && b[1] >= -rounding && b[2] >= -rounding;
    f.weights = inside ? triple{b[0], b[1], b[2]} : closest_weights(q, x);
    const double size = kernels::square_root(area);
    const double slope = dot(point_at(n, f.weights), normal) / size;
    if (!(slope > 0.25))
      return false;  // none, or of triangles that turned since creases were found
    const double by = dot(off, normal) / (size * slope);
    high += by;
    bool ends = inside, sharp = false;
    if (!inside) {
      int over = -1;
      for (std::size_t k = 0; k < 3; ++k) {
        if (b[k] < -rounding && all.beside[at(t)][k] >= 0 && (over < 0 || b[k] < b[at(over)])) {
          over = static_cast<int>(k);
        }
      }
      ends = sharp = over < 0;
      if (!ends) {
        const int next = all.beside[at(t)][at(over)];
        ends = next == came_from && ++returns > most_returns;
        if (!ends) {
          came_from = std::exchange(t, next);
          p = corners_of(t);
          n = normals_of(t);
          continue;
        }
      }
    }
    if (!(by * by <= 1e-14 * edges)) continue;
    const triple up = point_at(n, f.weights);
    const double tall = length(up);
    const triple sag = sags(p, n), c = point_at(p, f.weights);
    const double over = f.weights.y * f.weights.z * sag.x + f.weights.z * f.weights.x * sag.y +
                        f.weights.x * f.weights.y * sag.z;
    f.triangle = t;
    f.normal = up * (1.0 / tall);
    f.level = dot(f.normal, c) + 2.0 * over / (1.0 + tall);
    f.beyond = x - c;
    f.beyond = !sharp ? triple{} : f.beyond - f.normal * dot(f.normal, f.beyond);
    return kernels::is_finite(f.level) && is_finite(f.normal);
  }
  return false;
}

}  // namespace detail
}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
