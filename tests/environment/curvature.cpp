// SPDX-License-Identifier: BSD-3-Clause
// Curvature against the truth, on tessellations of bodies that have one.
#include "environment/shapes.hpp"
#include "support/curved.hpp"
#include <passive_haptics/environment/curvature.hpp>

namespace {

struct mesh {
  std::vector<Vector3d> nodes;
  std::vector<env::surface_triangle> surface;
};
mesh ball_of(int times) {
  const auto ball = curved::icosphere(times);
  mesh m{ball.nodes, {}};
  for (const auto& t : ball.triangles) m.surface.push_back({t});
  return m;
}
/// Semi-axes 50, 40 and 30 mm.
const Vector3d axes(0.05, 0.04, 0.03);
mesh ellipsoid_of(int times) {
  mesh m = ball_of(times);
  for (auto& x : m.nodes) x = x.cwiseProduct(axes) / curved::radius;
  return m;
}
/// Of radius 50 mm along z, its ends left out; every other ring is turned.
mesh cylinder_of(int around) {
  mesh m;
  const double turn = 2.0 * std::acos(-1.0) / around, height = curved::radius * turn;
  const int rings = 6;
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = turn * (i + 0.5 * (j % 2));
      m.nodes.emplace_back(curved::radius * std::cos(angle), curved::radius * std::sin(angle),
                           height * j);
    }
  }
  for (int j = 0; j + 1 < rings; ++j) {
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around, c = a + around,
                d = b + around;
      if (j % 2 == 0) {
        m.surface.push_back({{a, b, c}});
        m.surface.push_back({{b, d, c}});
      } else {
        m.surface.push_back({{a, d, c}});
        m.surface.push_back({{a, b, d}});
      }
    }
  }
  return m;
}

struct principal {
  Vector3d normal;
  double first, second;  ///< first ≥ second [1/m]
};
/// An implicit quadric x²/a² + y²/b² + z²/c² = 1 at the point where the ray through x leaves it.
principal of_ellipsoid(Vector3d x) {
  x /= std::sqrt(x.cwiseQuotient(axes).squaredNorm());
  const Eigen::Matrix3d H = axes.cwiseAbs2().cwiseInverse().asDiagonal();
  const Vector3d g = H * x, n = g.normalized();
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - n * n.transpose();
  const Vector3d k =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(P * H * P / g.norm(), Eigen::EigenvaluesOnly)
          .eigenvalues();
  return {n, k(2), k(1)};  // k(0) = 0 is along n
}

struct errors {
  double normal = 0.0;     ///< worst [rad]
  double curvature = 0.0;  ///< worst [1/m]
  double place = 0.0;      ///< of the point off the true surface, worst [m]
};
/// At random points of triangles that `counts`.
errors against(const mesh& m, const auto& truth, const auto& off, const auto& counts) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> in(0.0, 1.0);
  errors worst;
  for (int i = 0; i < 500; ++i) {
    const auto number = static_cast<int>(random() % m.surface.size());
    Vector3d w(in(random), in(random), in(random));
    w /= w.sum();
    const Vector3d on =
        env::point_at(env::corners(m.surface[static_cast<std::size_t>(number)], m.nodes), w);
    if (!counts(on)) continue;
    const auto found = env::shape_at(m.surface, m.nodes, number, w);
    const principal right = truth(on);
    worst.normal = std::max(worst.normal, (found.normal - right.normal).norm());
    worst.curvature = std::max({worst.curvature, std::abs(found.curvature - right.first),
                                std::abs(found.cross_curvature - right.second)});
    worst.place = std::max(worst.place, std::abs(off(found.point)));
  }
  return worst;
}
const auto anywhere_on = [](const Vector3d& /*x*/) { return true; };

}  // namespace

TEST_CASE("the curvature of a ball is found from its triangles", "[environment][curvature]") {
  const auto truth = [](const Vector3d& x) { return principal{x.normalized(), 20.0, 20.0}; };
  const auto off = [](const Vector3d& x) { return x.norm() - curved::radius; };
  const auto coarse = against(ball_of(2), truth, off, anywhere_on);  // 320 triangles
  CHECK(coarse.normal < 1e-12);
  CHECK(coarse.curvature < 1e-10);
  CHECK(coarse.place < 1e-5);
  const auto fine = against(ball_of(3), truth, off, anywhere_on);
  CHECK(fine.place < 0.1 * coarse.place);
  double chord = 0.0;  // the control: how far the facets are off
  const mesh m = ball_of(2);
  for (const auto& t : m.surface) {
    chord =
        std::max(chord, -off(env::point_at(env::corners(t, m.nodes), Vector3d::Constant(1.0 / 3))));
  }
  CHECK(chord > 6e-4);
}

TEST_CASE("the principal curvatures of an ellipsoid are found", "[environment][curvature][long]") {
  const auto off = [](const Vector3d& x) {
    return (std::sqrt(x.cwiseQuotient(axes).squaredNorm()) - 1.0) * axes.z();
  };
  const auto coarse = against(ellipsoid_of(3), of_ellipsoid, off, anywhere_on);  // 1280 triangles
  CHECK(coarse.normal < 0.01);
  CHECK(coarse.curvature < 2.5);  // of 12 to 56/m
  CHECK(coarse.place < 1e-5);
  const auto fine = against(ellipsoid_of(4), of_ellipsoid, off, anywhere_on);
  CHECK(fine.normal < 0.6 * coarse.normal);
  CHECK(fine.curvature < 0.7 * coarse.curvature);
}

TEST_CASE("a cylinder is curved one way only", "[environment][curvature]") {
  const auto truth = [](const Vector3d& x) {
    return principal{Vector3d(x.x(), x.y(), 0.0).normalized(), 20.0, 0.0};
  };
  const auto off = [](const Vector3d& x) { return x.head<2>().norm() - curved::radius; };
  const auto middle = [](const mesh& m) {  // two rings from the ends
    return [height = m.nodes.back().z()](const Vector3d& x) {
      return std::abs(x.z() - 0.5 * height) < 0.1 * height;
    };
  };
  const mesh m = cylinder_of(24);
  const auto found = against(m, truth, off, middle(m));
  CHECK(found.normal < 1e-12);
  CHECK(found.curvature < 0.03);
  CHECK(found.place < 3e-6);
  const auto shape = env::shape_at(m.surface, m.nodes, 24 * 2 * 2, Vector3d::Constant(1.0 / 3));
  CHECK(std::abs(shape.tangent.z()) < 0.02);  // around, not along
}

TEST_CASE("a shape where some triangles are degenerate is that of the others",
          "[environment][curvature]") {
  mesh m = ball_of(2);
  const auto before = env::shape_at(m.surface, m.nodes, 0, Vector3d::Constant(1.0 / 3));
  const int node = m.surface[0].nodes[0];
  m.surface.push_back({{node, node, m.surface[0].nodes[1]}});
  const auto after = env::shape_at(m.surface, m.nodes, 0, Vector3d::Constant(1.0 / 3));
  CHECK(after.normal == before.normal);
  CHECK(after.curvature == before.curvature);
}
