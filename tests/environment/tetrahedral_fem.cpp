// SPDX-License-Identifier: BSD-3-Clause
// Elastic bodies: the patch test, the bar, reciprocity, the hinge.
#include "environment/bodies.hpp"

#include <span>
#include <stdexcept>

static_assert(env::pressing_solver<env::multifrontal> &&
              !env::pressing_solver<env::tetrahedral_fem>);

namespace {

// The nodal forces of a constant stress: σ n A/3 for each corner of each face of the surface.
std::vector<Vector3d> tractions(const env::tetrahedral_mesh& mesh, const Eigen::Matrix3d& stress) {
  std::vector<Vector3d> forces(mesh.nodes.size(), Vector3d::Zero());
  for (const auto& t : env::boundary(mesh)) {
    const Vector3d force = stress * env::area_vector(env::corners(t, mesh.nodes));
    for (const int node : t.nodes) forces[static_cast<std::size_t>(node)] += force / 3.0;
  }
  return forces;
}

}  // namespace

TEST_CASE("tetrahedral_fem passes the patch test on an irregular mesh", "[environment][fem]") {
  std::mt19937 random(1);
  auto mesh = bar(3);
  for (auto& x : mesh.nodes) {
    if (x.x() > 0.0) x += 0.15 * anything(random);
  }
  REQUIRE_NOTHROW(env::check(mesh));
  // u = g x₁ vanishes on the plane x₁ = 0, where three nodes of four are held.
  const std::vector<int> fixed{0, 1, 3};
  for (const double poisson : {-0.5, 0.0, 0.3, 0.49}) {
    const env::material m{7e3, poisson};
    const Vector3d g = 0.1 * anything(random);
    const Eigen::Matrix3d gradient = g * Vector3d::UnitX().transpose();
    const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
    const Eigen::Matrix3d stress =
        m.lame() * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * m.shear() * strain;
    env::tetrahedral_fem fem(mesh, m, fixed);
    const auto& u = fem.displacements(tractions(mesh, stress));
    for (std::size_t i = 0; i < u.size(); ++i) {
      CHECK((u[i] - g * mesh.nodes[i].x()).norm() < 1e-12);
    }
  }
}

TEST_CASE("tetrahedral_fem stretches a bar by FL/(EA)", "[environment][fem]") {
  constexpr int length = 4;
  const auto mesh = bar(length);
  const env::material cork{2e4, 0.0};  // no lateral strain: exact with one end clamped
  env::tetrahedral_fem fem(mesh, cork, std::vector{0, 1, 2, 3});
  constexpr double pull = 100.0;
  auto forces = tractions(mesh, pull * Vector3d::UnitX() * Vector3d::UnitX().transpose());
  const auto& u = fem.displacements(forces);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Vector3d expected{pull / cork.young * mesh.nodes[i].x(), 0, 0};
    CHECK((u[i] - expected).norm() < 1e-14);
  }
  const auto moved = env::deform(mesh.nodes, u);
  CHECK_THAT(moved.back().x(), WithinRel(length * (1.0 + pull / cork.young), 1e-14));
  forces.pop_back();
  CHECK_THROWS_AS(fem.displacements(forces), std::invalid_argument);
  CHECK_THROWS_AS(env::deform(mesh.nodes, forces), std::invalid_argument);
}

TEST_CASE("tetrahedral_fem is reciprocal and its compliance is what displacements say",
          "[environment][fem]") {
  const auto mesh = env::ball(0.05);
  env::tetrahedral_fem fem(mesh, soft, env::ball_fixed_nodes());
  std::mt19937 random(2);
  std::vector<Vector3d> zero(11, Vector3d::Zero());
  for (int run = 0; run < 20; ++run) {
    const std::size_t a = random() % 11;
    const std::size_t b = random() % 11;
    auto at_a = zero;
    auto at_b = zero;
    at_a[a] = anything(random);
    at_b[b] = anything(random);
    const double work_ab = at_b[b].dot(fem.displacements(at_a)[b]);  // Maxwell and Betti
    const double work_ba = at_a[a].dot(fem.displacements(at_b)[a]);
    CHECK_THAT(work_ab, WithinAbs(work_ba, 1e-15));

    const auto t = env::boundary(mesh)[random() % 16];
    const Vector3d w = (anything(random) + Vector3d::Constant(1.5)).normalized();
    const Vector3d weights = w / w.sum();
    const Vector3d n = anything(random).normalized();
    auto forces = zero;
    for (std::size_t k = 0; k < 3; ++k) {
      forces[std::size_t(t.nodes[k])] = weights[Eigen::Index(k)] * n;
    }
    double give = 0.0;
    const auto& u = fem.displacements(forces);
    for (std::size_t k = 0; k < 3; ++k) {
      give += weights[Eigen::Index(k)] * n.dot(u[std::size_t(t.nodes[k])]);
    }
    CHECK_THAT(fem.compliance(t.nodes, weights, n), WithinRel(give, 1e-12));
    CHECK_THAT(fem.stiffness(t.nodes, weights, n), WithinRel(1.0 / give, 1e-12));
  }
  const auto held = env::ball_fixed_nodes();
  CHECK(fem.stiffness(held, {0.2, 0.3, 0.5}, Vector3d::UnitZ()) == infinity);
}

TEST_CASE("tetrahedral_fem finds a hinge by its pivot", "[environment][fem]") {
  // Two elements on a common edge 01: one part, no rigid mode of the whole, but a hinge.
  env::tetrahedral_mesh mesh{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
                             {{0, 2, 3, 1}, {0, 4, 5, 1}}};
  REQUIRE_NOTHROW(env::check(mesh));
  REQUIRE(env::find_parts(mesh).count == 1);
  const std::vector<int> fixed{0, 1, 2};
  CHECK(env::rigid_modes_left(mesh, fixed) == 0);
  CHECK(zero_eigenvalues(mesh, fixed) == 1);
  CHECK(contains(text_of<env::singular_stiffness>([&] { env::tetrahedral_fem(mesh, soft, fixed); }),
                 "smallest pivot"));
  CHECK_NOTHROW(env::tetrahedral_fem(mesh, soft, std::vector{0, 1, 2, 4}));
}

TEST_CASE("tetrahedral_fem refuses parameters that make no body", "[environment][fem]") {
  const auto build = [](env::material m, std::vector<int> fixed) {
    return text_of<std::invalid_argument>([&] { env::tetrahedral_fem(env::ball(1), m, fixed); });
  };
  const std::vector<int> good{9, 5, 6};
  CHECK(build({1.0, 0.3}, good).empty());
  CHECK(build({1.0, -0.99}, good).empty());
  CHECK(contains(build({0.0, 0.3}, good), "Young's modulus 0 Pa"));
  CHECK(contains(build({-5.0, 0.3}, good), "Young's modulus -5 Pa"));
  CHECK(contains(build({not_a_number, 0.3}, good), "above zero"));
  CHECK(contains(build({infinity, 0.3}, good), "Young's modulus inf"));
  for (const double bad : {0.5, -1.0, 0.7, not_a_number}) {
    CHECK(contains(build({1.0, bad}, good), "Poisson's ratio"));
  }
  CHECK(contains(build({1.0, 0.3}, {9, 5, 11}),
                 "fixed node 11 is refused; the mesh has nodes 0 to 10"));
  CHECK(contains(build({1.0, 0.3}, {9, 5, -1}), "fixed node -1"));
  CHECK(contains(build({1.0, 0.3}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}), "every node is fixed"));
  auto broken = env::ball(1);
  std::swap(broken.tetrahedra[3][0], broken.tetrahedra[3][1]);
  CHECK(contains(text_of<env::mesh_error>([&] { env::tetrahedral_fem(broken, soft, good); }),
                 "tetrahedron 3 is inverted"));
}

TEST_CASE("displacements are from rest: added to the current nodes the wall would creep",
          "[environment][regression]") {
  const auto mesh = env::ball(0.05);
  env::tetrahedral_fem fem(mesh, soft, env::ball_fixed_nodes());
  std::vector<Vector3d> forces(11, Vector3d::Zero());
  forces[0] = {0, 0, -1};
  auto creeping = mesh.nodes;
  Vector3d first = Vector3d::Zero();
  for (int update = 1; update <= 10; ++update) {
    const auto& u = fem.displacements(forces);
    const auto right = env::deform(mesh.nodes, u);
    creeping = env::deform(creeping, u);  // the last lines of the thesis's appendix A.2 (A13)
    if (update == 1) first = right[0];
    CHECK(right[0] == first);
    const Vector3d expected = mesh.nodes[0] + update * (first - mesh.nodes[0]);
    CHECK((creeping[0] - expected).norm() < 1e-12);
  }
}
