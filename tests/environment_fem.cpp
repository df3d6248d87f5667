// SPDX-License-Identifier: BSD-3-Clause
// Elastic bodies: the patch test, the rigid modes, the bar, the springs; and the body that is
// touched.

#include "support/catch.hpp"
#include <passive_haptics/environment/ball.hpp>
#include <passive_haptics/environment/deformable_body.hpp>
#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/environment/rigid_modes.hpp>
#include <passive_haptics/environment/spring_wall.hpp>
#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/tetrahedral_fem.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace env = passive_haptics::environment;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Eigen::Vector3d;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr env::material soft{.young = 5e3, .poisson = 0.3};

// A box of n cubes along x, six upright tetrahedra in each, cubes of 1 m.
env::tetrahedral_mesh bar(int n) {
  env::tetrahedral_mesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int corner = 0; corner < 4; ++corner) mesh.nodes.emplace_back(i, corner / 2, corner % 2);
  }
  for (int i = 0; i < n; ++i) {
    std::array<int, 3> axis{1, 2, 4};  // node steps in z, y, x
    do {
      std::array<int, 4> t{4 * i, 4 * i + axis[0], 4 * i + axis[0] + axis[1], 4 * i + 7};
      if (env::signed_volume(mesh, t) < 0.0) std::swap(t[2], t[3]);
      mesh.tetrahedra.push_back(t);
    } while (std::next_permutation(axis.begin(), axis.end()));
  }
  return mesh;
}

// The nodal forces of a constant stress: σ n A/3 for each corner of each face of the surface.
std::vector<Vector3d> tractions(const env::tetrahedral_mesh& mesh, const Eigen::Matrix3d& stress) {
  std::vector<Vector3d> forces(mesh.nodes.size(), Vector3d::Zero());
  for (const auto& t : env::boundary(mesh)) {
    const Vector3d force = stress * env::area_vector(env::corners(t, mesh.nodes));
    for (const int node : t.nodes) forces[static_cast<std::size_t>(node)] += force / 3.0;
  }
  return forces;
}

Vector3d anything(std::mt19937& random) {
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  const double x = in(random);
  const double y = in(random);
  return {x, y, in(random)};
}

int zero_eigenvalues(const env::tetrahedral_mesh& mesh, const std::vector<int>& fixed) {
  const Eigen::MatrixXd K = env::stiffness_matrix(mesh, soft, fixed);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
  CHECK(values.minCoeff() > -1e-10 * values.maxCoeff());
  return static_cast<int>((values.array() < 1e-10 * values.maxCoeff()).count());
}

template <class Error>
std::string text_of(const std::function<void()>& act) {
  try {
    act();
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("stiffness_matrix is symmetric and resists no rigid motion", "[environment][fem]") {
  const auto mesh = env::ball(0.05);
  const Eigen::MatrixXd K = env::stiffness_matrix(mesh, soft);
  REQUIRE(K.rows() == 33);
  CHECK((K - K.transpose()).norm() <= 1e-13 * K.norm());
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd shift(33);
    Eigen::VectorXd turn(33);
    for (int i = 0; i < 11; ++i) {
      shift.segment<3>(3 * i) = Vector3d::Unit(axis);
      turn.segment<3>(3 * i) = Vector3d::Unit(axis).cross(mesh.nodes[std::size_t(i)]);
    }
    CHECK((K * shift).norm() < 1e-12 * K.norm());
    CHECK((K * turn).norm() < 1e-12 * K.norm() * turn.norm());
  }
  CHECK_THAT(env::scaled(mesh, 2.0).nodes[0].z(), WithinRel(0.1, 1e-12));
  const Eigen::MatrixXd twice = env::stiffness_matrix(env::scaled(mesh, 2.0), soft);
  CHECK((twice - 2.0 * K).norm() < 1e-12 * K.norm());  // stiffness grows with length
}

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

TEST_CASE("tetrahedral_fem counts the rigid modes that the fixed nodes leave",
          "[environment][fem]") {
  const auto mesh = env::ball(0.05);
  const auto expect = [&](const std::vector<int>& fixed, int modes) {
    CHECK(env::rigid_modes_left(mesh, fixed) == modes);
    CHECK(zero_eigenvalues(mesh, fixed) == modes);  // A24, the other way
    if (modes == 0) {
      CHECK_NOTHROW(env::tetrahedral_fem(mesh, soft, fixed));
      return;
    }
    try {
      env::tetrahedral_fem fem(mesh, soft, fixed);
      FAIL("a singular matrix was accepted");
    } catch (const env::singular_stiffness& e) {
      CHECK(e.rigid_modes() == modes);
      CHECK(contains(e.what(), env::sentence(modes, " rigid modes left")));
      CHECK(contains(e.what(), "fix at least three nodes, not on one line"));
    }
  };
  expect({}, 6);
  expect({4}, 3);
  expect({4, 4}, 3);
  for (int a = 0; a < 11; ++a) {
    for (int b = a + 1; b < 11; ++b) expect({a, b}, 1);
  }
  expect({0, 9, 10}, 1);  // three on the axis
  expect({9, 5, 6}, 0);
  expect({0, 3, 10}, 0);
}

TEST_CASE("tetrahedral_fem wants three nodes of every connected part", "[environment][fem]") {
  auto mesh = env::ball(0.05);
  const auto second = env::ball(0.05);
  for (const auto& x : second.nodes) mesh.nodes.emplace_back(x + Vector3d(0.2, 0, 0));
  for (auto t : second.tetrahedra) {
    for (int& node : t) node += 11;
    mesh.tetrahedra.push_back(t);
  }
  CHECK(env::find_parts(mesh).count == 2);
  const auto left = [&](const std::vector<int>& fixed) {
    CHECK(zero_eigenvalues(mesh, fixed) == env::rigid_modes_left(mesh, fixed));
    return env::rigid_modes_left(mesh, fixed);
  };
  CHECK(left({}) == 12);
  CHECK(left({9, 5, 6}) == 6);
  CHECK(left({9, 5, 6, 11}) == 3);
  CHECK(left({9, 5, 6, 11, 12}) == 1);
  CHECK(left({9, 5, 6, 11, 12, 13}) == 0);
  CHECK_NOTHROW(env::tetrahedral_fem(mesh, soft, std::vector{9, 5, 6, 11, 12, 13}));
  CHECK(contains(text_of<env::singular_stiffness>([&] {
                   env::tetrahedral_fem(mesh, soft, std::vector{9, 5, 6});
                 }),
                 "6 rigid modes left by the fixed nodes in 2 connected part(s)"));
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

TEST_CASE("spring_wall is its springs in series", "[environment][wall]") {
  const env::spring_wall thesis;
  CHECK_THAT(thesis.stiffness(), WithinRel(10e3, 1e-12));
  CHECK_THAT(thesis.surface(5.0), WithinRel(0.5e-3, 1e-12));
  const env::spring_wall wall{1e3, 4e3, 2e2, 1e6};
  const double compliance = 1 / 1e3 + 1 / 4e3 + 1 / 2e2 + 1 / 1e6;
  CHECK_THAT(wall.stiffness(), WithinRel(1.0 / compliance, 1e-12));
  const Eigen::VectorXd x = wall.displacements(2.0);
  REQUIRE(x.size() == 4);
  const std::array<double, 4> springs{1e3, 4e3, 2e2, 1e6};
  for (Eigen::Index i = 0; i < 4; ++i) {  // every spring carries the whole force
    const double next = i < 3 ? x[i + 1] : 0.0;
    CHECK_THAT(springs[std::size_t(i)] * (x[i] - next), WithinRel(2.0, 1e-9));
  }
  CHECK(wall.surface(2.0) == x[0]);
  CHECK_THAT(env::spring_wall{7.0}.stiffness(), WithinRel(7.0, 1e-12));
  CHECK_THROWS_AS(env::spring_wall(std::span<const double>{}), std::invalid_argument);
  for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
    CHECK_THROWS_AS((env::spring_wall{1e3, bad}), std::invalid_argument);
  }
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

namespace {

// A device that stands still `depth` below face 0 of the ball; the local model is a spring K_LM.
struct fixed_device {
  env::deformable_body body;
  Vector3d device = Vector3d::Zero();
  double local_stiffness = 0.0;  // 0: the one reported at the first contact
  env::surface_contact contact;

  fixed_device(double depth, const env::body_options& options, double ratio)
      : body(env::ball(0.05), {.young = 1e4, .poisson = 0.3}, env::ball_fixed_nodes(), options) {
    const auto face = env::corners(body.surface()[0], body.nodes());
    device = env::point_at(face, Vector3d(0.4, 0.3, 0.3)) - depth * env::unit_normal(face);
    contact = body.update(device, Vector3d::Zero());
    local_stiffness = ratio * contact.stiffness;
  }
  void step() {
    const double force = local_stiffness * std::max(0.0, contact.depth);
    contact = body.update(device, force * contact.normal);
  }
};

}  // namespace

TEST_CASE("deformable_body swings for ever with equal stiffness and no relaxation",
          "[environment][body]") {
  constexpr double depth = 1e-6;  // small against the ball: the eigenvalue is of the linear loop
  env::body_options thesis;
  thesis.relaxation = env::force_relaxation::none;
  fixed_device scene(depth, thesis, 1.0);
  REQUIRE_THAT(scene.contact.depth, WithinRel(depth, 1e-9));
  for (int update = 0; update < 400; ++update) {
    const double before = scene.contact.depth;
    scene.step();
    REQUIRE(std::abs(scene.contact.depth - before) > 0.9 * depth);  // eigenvalue −1 (A12)
  }
  // Positive controls: a softer local model settles without relaxation, at d = K_VE/(K_VE + K_LM).
  fixed_device softer(depth, thesis, 0.5);
  for (int update = 0; update < 60; ++update) softer.step();
  CHECK_THAT(softer.contact.depth, WithinRel(depth / 1.5, 0.01));
}

TEST_CASE("deformable_body settles in one update with the dead-beat relaxation",
          "[environment][body]") {
  constexpr double depth = 1e-6;  // small against the ball: the eigenvalue is of the linear loop
  for (const double ratio : {0.2, 1.0, 5.0, 50.0}) {
    env::body_options options;
    if (ratio != 1.0) {
      fixed_device probe(depth, {}, 1.0);
      options.local_stiffness = ratio * probe.contact.stiffness;
    }
    fixed_device scene(depth, options, ratio);
    const double expected = depth / (1.0 + ratio);  // equilibrium: K_LM d = K_VE (depth − d)
    scene.step();
    CHECK_THAT(scene.contact.depth, WithinRel(expected, 0.1));
    scene.step();
    CHECK_THAT(scene.contact.depth, WithinRel(expected, 0.02));
    for (int update = 0; update < 100; ++update) {
      const double before = scene.contact.depth;
      scene.step();
      CHECK(std::abs(scene.contact.depth - before) < 0.01 * depth);
    }
  }
}

TEST_CASE("deformable_body is consistent in what it reports", "[environment][body]") {
  for (const auto selection :
       {env::contact_selection::closest_point, env::contact_selection::normal_match}) {
    for (const auto split : {env::force_split::barycentric, env::force_split::by_distance}) {
      env::body_options options;
      options.selection = selection;
      options.split = split;
      fixed_device scene(2e-3, options, 1.0);
      std::mt19937 random(6);
      for (int update = 0; update < 300; ++update) {
        scene.device += 5e-4 * anything(random);
        scene.step();
        const auto& c = scene.contact;
        REQUIRE(c.fresh);
        const env::triangle shape = c.nodes;
        CHECK_THAT(c.normal.norm(), WithinAbs(1.0, 1e-12));
        CHECK((env::unit_normal(shape) - c.normal).norm() < 1e-12);
        CHECK((env::point_at(shape, c.weights) - c.point).norm() < 1e-12);
        CHECK_THAT(c.depth, WithinAbs((c.point - scene.device).dot(c.normal), 1e-12));
        CHECK(c.stiffness > 0.0);
        CHECK(c.triangle == scene.body.contact().triangle);
        if (selection == env::contact_selection::closest_point) {
          CHECK((c.depth > 0.0) ==
                env::is_inside(scene.body.surface(), scene.body.nodes(), scene.device));
        }
      }
    }
  }
}

TEST_CASE("deformable_body gives way by force over the stiffness it reports",
          "[environment][body]") {
  env::body_options thesis;
  thesis.relaxation = env::force_relaxation::none;
  fixed_device scene(0.0, thesis, 1.0);
  const auto before = scene.contact;
  const double force = 0.01;
  const auto after = scene.body.update(scene.device, force * before.normal);
  const Vector3d moved = env::point_at(after.nodes, before.weights) - before.point;
  REQUIRE(after.triangle == before.triangle);
  CHECK_THAT(-moved.dot(before.normal), WithinRel(force / before.stiffness, 1e-9));
}

TEST_CASE("deformable_body comes to rest when the device has left", "[environment][body]") {
  const auto rest = env::ball(0.05).nodes;
  fixed_device scene(5e-3, {}, 1.0);
  scene.step();
  CHECK((scene.body.nodes()[0] - rest[0]).norm() > 1e-4);
  scene.device = {0, 0.01, 0.08};
  for (int update = 0; update < 60; ++update) {
    scene.step();
    CHECK(scene.contact.fresh);
    CHECK(scene.contact.depth <= 0.0);
    CHECK(scene.contact.triangle >= 0);
  }
  for (std::size_t i = 0; i < rest.size(); ++i) {
    CHECK((scene.body.nodes()[i] - rest[i]).norm() < 1e-15);
  }
}

TEST_CASE("deformable_body keeps its state through input that cannot be used",
          "[environment][body]") {
  fixed_device scene(2e-3, {}, 1.0);
  for (int update = 0; update < 5; ++update) scene.step();
  const auto good = scene.contact;
  REQUIRE(good.fresh);
  const auto nodes = scene.body.nodes();
  for (const double bad : {not_a_number, infinity, -infinity}) {
    for (const auto& c : {scene.body.update({0, bad, 0}, Vector3d::Zero()),
                          scene.body.update(scene.device, {bad, 0, 0}),
                          scene.body.update({bad, bad, bad}, {bad, bad, bad})}) {
      CHECK_FALSE(c.fresh);
      CHECK(c.triangle == good.triangle);
      CHECK(c.point == good.point);
      CHECK(c.depth == good.depth);
    }
  }
  CHECK_FALSE(scene.body.update(scene.device, {0, 0, 1e300}).fresh);  // finite, but out of bounds
  CHECK(scene.body.nodes() == nodes);
  CHECK(scene.body.force().allFinite());
  scene.step();
  CHECK(scene.contact.fresh);
  CHECK_THAT(scene.contact.depth, WithinRel(good.depth, 0.01));

  env::deformable_body untouched(env::ball(1), soft, env::ball_fixed_nodes());
  const auto none = untouched.update({0, 0, not_a_number}, Vector3d::Zero());
  CHECK_FALSE(none.fresh);
  CHECK(none.triangle == -1);
  // Before the first contact there is nothing for a force to act on.
  CHECK(untouched.update({0, 0, 0.9}, {0, 0, 5}).fresh);
  CHECK(untouched.nodes() == env::ball(1).nodes);
}

TEST_CASE("deformable_body stays finite whatever the device does", "[environment][body]") {
  for (const auto selection :
       {env::contact_selection::closest_point, env::contact_selection::normal_match}) {
    env::body_options options;
    options.selection = selection;
    fixed_device scene(1e-3, options, 1.0);
    std::mt19937 random(7);
    int stale = 0;
    for (int update = 0; update < 2000; ++update) {
      const double reach = std::pow(10.0, static_cast<double>(random() % 8) - 4.0);
      const auto c = scene.body.update(0.1 * anything(random), reach * anything(random));
      REQUIRE((c.point.allFinite() && c.normal.allFinite() && std::isfinite(c.depth)));
      REQUIRE((c.stiffness > 0.0 && c.stiffness <= options.max_stiffness));
      stale += c.fresh ? 0 : 1;
    }
    CHECK(stale == 0);
  }
}

TEST_CASE("deformable_body refuses options out of range", "[environment][body]") {
  const auto build = [](const env::body_options& options) {
    return text_of<std::invalid_argument>(
        [&] { env::deformable_body(env::ball(1), soft, env::ball_fixed_nodes(), options); });
  };
  CHECK(build({}).empty());
  for (const double bad : {-1.0, not_a_number, infinity}) {
    CHECK(contains(build({.margin = bad}), "margin"));
    CHECK(contains(build({.local_stiffness = bad}), "local stiffness"));
    CHECK(contains(build({.max_stiffness = bad}), "greatest stiffness"));
  }
  CHECK(contains(build({.max_stiffness = 0.0}), "greatest stiffness 0 N/m"));
}

TEST_CASE("a real liver can be laid down and pressed", "[environment][body]") {
#ifdef PASSIVE_HAPTICS_SHARED_DATA
  const auto path = std::filesystem::path(PASSIVE_HAPTICS_SHARED_DATA) / "liver.msh";
#else
  const std::filesystem::path path;
#endif
  if (!std::filesystem::exists(path)) {
    WARN("skipped: PASSIVE_HAPTICS_SHARED_DATA has no liver.msh");
    return;
  }
  const auto mesh = env::scaled(env::read_msh(path), 0.02);
  std::vector<int> by_height(mesh.nodes.size());
  std::iota(by_height.begin(), by_height.end(), 0);
  std::sort(by_height.begin(), by_height.end(), [&](int a, int b) {
    return mesh.nodes[std::size_t(a)].z() < mesh.nodes[std::size_t(b)].z();
  });
  CHECK(env::find_parts(mesh).count == 1);
  env::deformable_body body(mesh, {.young = 5e3, .poisson = 0.45}, std::span(by_height).first(20));
  env::triangle top = env::corners(body.surface()[0], mesh.nodes);
  for (const auto& t : body.surface()) {
    const auto other = env::corners(t, mesh.nodes);
    if (env::point_at(other, {1, 1, 1}).z() > env::point_at(top, {1, 1, 1}).z()) top = other;
  }
  const Vector3d device =
      env::point_at(top, Vector3d::Constant(1.0 / 3.0)) - 1e-3 * env::unit_normal(top);
  auto contact = body.update(device, Vector3d::Zero());
  CHECK_THAT(contact.depth, WithinRel(1e-3, 1e-6));
  for (int update = 0; update < 30; ++update) {
    contact =
        body.update(device, contact.stiffness * std::max(0.0, contact.depth) * contact.normal);
    REQUIRE(contact.fresh);
  }
  CHECK_THAT(contact.depth, WithinRel(0.5e-3, 0.2));  // both give way alike
  CHECK(contact.stiffness > 1.0);
  CHECK(contact.stiffness < 1e4);
}
