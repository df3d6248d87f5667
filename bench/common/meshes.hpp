// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Meshes that are hard to hold a finger off, how they move between news, and a witness that knows nothing of
// the proxy: has a point gone through a triangle? Tests (tests/mesh) and bench/contacts try them.
#include <passive_haptics/mesh/mesh_contact.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/quiet.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace meshes {

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using ph::mesh::corners;
using ph::mesh::triangle;
using ph::mesh::triple;
using scene = ph::space<double, 3>;
using vector = scene::vector;
inline constexpr double T = 1e-3;
inline constexpr double pi = 3.141592653589793;

struct body {
  std::vector<triangle> triangles;
  std::vector<triple> nodes;
};
inline triple of(const vector& v) {
  return {v(0), v(1), v(2)};
}
inline vector of(const triple& t) {
  return {t.x, t.y, t.z};
}
inline triple turned(const triple& p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

/// Shows a judge of quiet a tick: the force, the place, and what presses the ball.
inline void show(sim::quiet_judge<scene>& judge, const ph::mesh::proxy& ball, const auto& now,
                 double dt = T) {
  std::array<vector, 3> pressing;
  const auto count = std::size_t(ball.pressed().count);
  for (std::size_t i = 0; i < count; ++i) pressing[i] = of(ball.normal(ball.pressed().of[i]));
  judge.add_at(now.force, now.sample.position, dt, std::span(pressing.data(), count));
}

/// A device of 0.1 kg in a hand of at most 10 N that wanders, with an even seed, or taps: inwards in the air, outwards
/// when it is pushed out.
class restless {
 public:
  explicit restless(unsigned seed) : random_(seed), wanders_(seed % 2 == 0) {}

  sim::device<scene, sim::impedance_hand<scene>> device{
      {.mass = 0.1, .start = vector(0.1, 0, 0)}, {.stiffness = 400, .damping = 2, .limit = 10}};

  void move(const auto& now) {
    if (wanders_ && now.tick % 200 == 0) {
      device.hand().target = vector(any_(random_), any_(random_), any_(random_));
    } else if (!wanders_) {
      const vector out = now.force;
      device.hand().target =
          out.norm() > 0.5 ? vector(now.position + out * 0.1) : vector(vector::Zero());
    }
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<> any_{-0.06, 0.06};
  bool wanders_;
};

/// A plate of 12 triangles, its upper side at z = 0.
inline body plate(double half = 0.05, double thickness = 0.002) {
  body b;
  for (const double z : {0.0, -thickness}) {
    for (const double y : {-half, half}) {
      for (const double x : {-half, half}) b.nodes.push_back({x, y, z});
    }
  }
  b.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7}, {0, 5, 1}, {0, 4, 5},
                 {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return b;
}

/// A sphere of 20·4^level triangles.
inline body sphere(int level, double radius) {
  body b;
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  const auto on = [&](const triple& p) { return p * (radius / length(p)); };
  for (const triple& p : {triple{-1, g, 0},
                          {1, g, 0},
                          {-1, -g, 0},
                          {1, -g, 0},
                          {0, -1, g},
                          {0, 1, g},
                          {0, -1, -g},
                          {0, 1, -g},
                          {g, 0, -1},
                          {g, 0, 1},
                          {-g, 0, -1},
                          {-g, 0, 1}}) {
    b.nodes.push_back(on(p));
  }
  b.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(i, j), int(b.nodes.size()));
      if (fresh) b.nodes.push_back(on(b.nodes[std::size_t(i)] + b.nodes[std::size_t(j)]));
      return at->second;
    };
    std::vector<triangle> finer;
    for (const auto& [p, q, r] : b.triangles) {
      const int a = middle(p, q), c = middle(q, r), d = middle(r, p);
      finer.insert(finer.end(), {{p, a, d}, {q, c, a}, {r, d, c}, {a, c, d}});
    }
    b.triangles = std::move(finer);
  }
  return b;
}
/// Both in one, the second beside the first.
inline body together(body a, const body& b, const triple& beside) {
  const int first = int(a.nodes.size());
  for (const triple& p : b.nodes) a.nodes.push_back(p + beside);
  for (const auto& [p, q, r] : b.triangles)
    a.triangles.push_back({p + first, q + first, r + first});
  return a;
}
/// A sphere of which every seventh node stands far out.
inline body star() {
  body b = sphere(2, 0.03);
  for (std::size_t i = 0; i < b.nodes.size(); i += 7) b.nodes[i] = b.nodes[i] * 2.5;
  return b;
}
/// 60 mm long, 1 mm thick.
inline body needle() {
  return {{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}},
          {{0, 0, 0.06}, {0.001, 0, 0}, {-0.0005, 0.0008, 0}, {-0.0005, -0.0008, 0}}};
}
/// Five pages at one back: open, and five triangles at an edge.
inline body book() {
  body b;
  for (int k = 0; k < 5; ++k) {
    for (const double z : {-0.04, 0.04}) {
      b.nodes.push_back({0.04 * std::cos(0.4 * pi * k), 0.04 * std::sin(0.4 * pi * k), z});
    }
  }
  b.nodes.push_back({0, 0, -0.04});
  b.nodes.push_back({0, 0, 0.04});
  for (int k = 0; k < 10; k += 2) {
    b.triangles.push_back({10, k, k + 1});
    b.triangles.push_back({10, k + 1, 11});
  }
  return b;
}
/// What is below the gyroid sin x cos y + sin y cos z + sin z cos x = 0 in a box of 50 mm, a period of it: closed, a
/// saddle nearly everywhere, one passage behind the other. Each edge of the tetrahedra, six to a cube, has a node.
inline body gyroid(int cubes) {
  body b;
  const int n = cubes + 1;
  const auto at = [&](int i) {
    return triple{double(i % n), double(i / n % n), double(i / n / n)} * (2.0 * pi / cubes) -
           triple{pi, pi, pi};
  };
  const auto level = [&](int i) {
    const auto [x, y, z] = at(i);
    const double farthest = std::max({std::abs(x), std::abs(y), std::abs(z)});
    return std::max(std::sin(x + 0.1) * std::cos(y) + std::sin(y) * std::cos(z) +
                        std::sin(z) * std::cos(x + 0.1),
                    2.0 * (farthest - 2.6));
  };
  std::map<std::pair<int, int>, int> crossed;
  const auto node = [&](int i, int j) {
    const auto [known, fresh] = crossed.try_emplace(std::minmax(i, j), int(b.nodes.size()));
    const double share = level(i) / (level(i) - level(j));
    if (fresh) b.nodes.push_back(between(at(i), at(j), share) * (0.03 / pi));
    return known->second;
  };
  const auto tetrahedron = [&](const std::array<int, 4>& its) {
    std::vector<int> out, in;
    for (const int c : its) (level(c) > 0.0 ? out : in).push_back(c);
    const auto add = [&](triangle t) {
      const triple &p = b.nodes[std::size_t(t[0])], &q = b.nodes[std::size_t(t[1])];
      const triple across = cross(q - p, b.nodes[std::size_t(t[2])] - p);
      if (dot(across, at(out[0]) - at(in[0])) < 0.0) std::swap(t[1], t[2]);
      b.triangles.push_back(t);
    };
    if (out.size() == 1) add({node(out[0], in[0]), node(out[0], in[1]), node(out[0], in[2])});
    if (in.size() == 1) add({node(in[0], out[0]), node(in[0], out[1]), node(in[0], out[2])});
    if (out.size() != 2) return;
    const int p = node(out[0], in[0]), q = node(out[1], in[1]);
    add({p, node(out[0], in[1]), q});
    add({p, q, node(out[1], in[0])});
  };
  const int x = 1, y = n, z = n * n;
  for (int i = 0; i < n * n * n; ++i) {
    if (i % n == cubes || i / n % n == cubes || i / n / n == cubes) continue;
    for (const auto& [u, v, w] :
         {std::array{x, y, z}, {x, z, y}, {y, x, z}, {y, z, x}, {z, x, y}, {z, y, x}})
      tetrahedron({i, i + u, i + u + v, i + u + v + w});
  }
  return b;
}
/// A sphere with triangles of no area and some that are there twice.
inline body with_degenerate() {
  body b = sphere(2, 0.04);
  for (int i = 0; i < 40; ++i) {
    b.triangles.push_back({i, i, i + 1});
    b.triangles.push_back({i, i + 1, i});
    b.triangles.push_back(b.triangles[std::size_t(i)]);
  }
  return b;
}

/// A mesh, and where its nodes are at a time [s].
struct moving {
  const char* name;
  body rest;
  std::function<triple(const triple&, std::size_t, double)> at;
  bool closed = true;

  [[nodiscard]] std::vector<triple> nodes(double t) const {
    std::vector<triple> all = rest.nodes;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = at(all[i], i, t);
    return all;
  }
};
inline triple still(const triple& p, std::size_t /*i*/, double /*t*/) {
  return p;
}
inline auto breathing(double share, double frequency) {
  return [=](const triple& p, std::size_t, double t) {
    return p * (1.0 + share * std::sin(2.0 * pi * frequency * t));
  };
}
inline auto shaken(const triple& by, double frequency) {
  return [=](const triple& p, std::size_t, double t) {
    return p + by * std::sin(2.0 * pi * frequency * t);
  };
}

/// The worst that we know of.
inline std::vector<moving> all_worst() {
  const body crossed = together(sphere(2, 0.03), sphere(2, 0.03), {0.03, 0, 0});
  body inverted = sphere(2, 0.04);
  for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
  return {
      {"plate", plate(), still},
      {"plate that heaves by 1 m/s", plate(), shaken({0, 0, 0.05}, 3.2)},
      {"plate that tumbles", plate(),
       [](const triple& p, std::size_t, double t) { return turned(p, 0.8 * std::sin(9 * t)); }},
      {"sphere that breathes", sphere(2, 0.04), breathing(0.3, 1.4)},
      {"sphere that breathes by 1 m/s", sphere(2, 0.04), breathing(0.6, 6.6)},
      {"sphere that is shaken by 1 m/s", sphere(2, 0.04), shaken({0.05, 0.03, 0}, 2.8)},
      {"needle", needle(), shaken({0.02, 0, 0}, 4.7)},
      {"star", star(), still},
      {"star that breathes", star(), breathing(0.3, 1.4)},
      {"spheres that cross", crossed,
       [half = crossed.nodes.size() / 2](const triple& p, std::size_t i, double t) {
         return i < half ? p : p + triple{0.04 * std::sin(12 * t), 0.01 * std::cos(5 * t), 0};
       }},
      {"degenerate and double triangles", with_degenerate(), breathing(0.1, 3.2)},
      {"inside out", inverted, breathing(0.2, 3.2)},
      {"noise", sphere(2, 0.04),
       [](const triple& p, std::size_t i, double t) {
         std::mt19937 random(unsigned(t * 30.0 + 0.5) * 7919U + unsigned(i));
         std::uniform_real_distribution<> off(-0.004, 0.004);
         return p + triple{off(random), off(random), off(random)};
       }},
      {"five pages, open", book(),
       [](const triple& p, std::size_t, double t) {
         const triple q = turned({p.z, p.x, p.y}, 0.6 * std::sin(9 * t));
         return triple{q.y, q.z, q.x};
       },
       false},
      {"gyroid that breathes", gyroid(6), breathing(0.1, 1.4)},
  };
}

/// How often a closed mesh goes round a point, by the angles that its triangles are seen at: whatever crosses
/// itself, it changes by a whole number where the point goes through, and nowhere else.
inline double winding(const std::vector<corners>& all, const triple& point) {
  double sum = 0.0;
  for (const corners& t : all) {
    const triple a = t[0] - point, b = t[1] - point, c = t[2] - point;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2.0 * std::atan2(dot(a, cross(b, c)),
                            la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4.0 * pi);
}

/// Of an open mesh: how often a point goes through a triangle between two looks, if both go straight, by many
/// small steps: its side changes, and its foot is within the triangle before and after.
class witness {
 public:
  int look(const std::vector<corners>& now, const triple& point) {
    int through = 0;
    for (std::size_t i = 0; seen_ && i < now.size(); ++i) {
      double side = 0.0;
      for (int s = 0; s <= steps; ++s) {
        const double share = double(s) / steps;
        corners c;
        for (std::size_t k = 0; k < 3; ++k) c[k] = between(last_[i][k], now[i][k], share);
        const triple p = between(at_, point, share), n = cross(c[1] - c[0], c[2] - c[0]);
        const double area = squared(n);
        const triple r = p - c[0];
        const double v = dot(cross(r, c[2] - c[0]), n) / area;
        const double w = dot(cross(c[1] - c[0], r), n) / area;
        const bool within = area > 1e-18 && v > 0 && w > 0 && v + w < 1;
        const double here = within ? dot(r, n) : 0.0;
        through += side * here < 0.0 ? 1 : 0;
        side = here;
      }
    }
    last_ = now;
    at_ = point;
    seen_ = true;
    return through;
  }

 private:
  static constexpr int steps = 16;
  std::vector<corners> last_;
  triple at_;
  bool seen_ = false;
};

inline std::vector<corners> shown(std::size_t triangles, const ph::mesh::proxy& ball) {
  std::vector<corners> all;
  for (std::size_t i = 0; i < triangles; ++i) all.push_back(ball.triangle(int(i)));
  return all;
}
inline std::vector<corners> shown(const ph::mesh::surface& s, const ph::mesh::proxy& ball) {
  return shown(s.triangles().size(), ball);
}

}  // namespace meshes
