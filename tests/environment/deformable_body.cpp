// SPDX-License-Identifier: BSD-3-Clause
// The body that is touched: equilibrium, relaxation, input that cannot be used.
#include "../bench/organ/sparse_ldlt.hpp"
#include "environment/bodies.hpp"
#include <passive_haptics/environment/deformable_body.hpp>
#include <passive_haptics/environment/msh_reader.hpp>

#include <numeric>
#include <span>
#include <stdexcept>

static_assert(env::elastic_solid<env::tetrahedral_fem>);
static_assert(env::elastic_solid<env::basic_tetrahedral_fem<organ::sparse_ldlt>>);
static_assert(!env::elastic_solid<organ::sparse_ldlt>);  // it solves, and knows no mesh

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

TEST_CASE("an organ can be laid down and pressed", "[environment][body]") {
  const auto mesh = env::scaled(env::read_msh(PASSIVE_HAPTICS_TEST_DATA "/organ.msh"), 1e-3);
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

TEST_CASE("deformable_body says the same by any solver", "[environment][body]") {
  const auto mesh = env::scaled(blocks(4, [](int, int, int) { return true; }), 0.02);
  std::vector<int> held;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (mesh.nodes[i].z() < 1e-6) held.push_back(static_cast<int>(i));
  }
  using by_columns = env::basic_tetrahedral_fem<organ::sparse_ldlt>;
  for (const auto split : {env::force_split::barycentric, env::force_split::by_distance}) {
    env::body_options options;
    options.split = split;
    env::deformable_body fronts(mesh, soft, held, options);
    env::basic_deformable_body<by_columns> columns(mesh, soft, held, options);
    options.moved = env::moved_nodes::around;
    env::deformable_body around(mesh, soft, held, options);
    std::mt19937 random(8);
    Vector3d device{0.033, 0.046, 0.078};
    int contacts = 0;
    for (int update = 0; update < 50; ++update) {
      device = (device + 2e-3 * anything(random))
                   .cwiseMax(Vector3d(0.01, 0.01, 0.07))
                   .cwiseMin(Vector3d(0.07, 0.07, 0.083));
      const auto last = fronts.contact();
      const Vector3d force = last.stiffness * std::max(0.0, last.depth) * last.normal;
      const auto a = fronts.update(device, force);
      const auto b = columns.update(device, force);
      const auto c = around.update(device, force);
      for (const auto& other : {b, c}) {
        REQUIRE((a.fresh && other.fresh));
        REQUIRE(other.triangle == a.triangle);
        REQUIRE((other.point - a.point).norm() < 1e-10);
        REQUIRE_THAT(other.depth, WithinAbs(a.depth, 1e-10));
        REQUIRE_THAT(other.stiffness, WithinRel(a.stiffness, 1e-8));
      }
      contacts += a.depth > 0.0 ? 1 : 0;
      double apart = 0.0;
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        apart = std::max(apart, (fronts.nodes()[i] - columns.nodes()[i]).norm());
      }
      // Two rings around the contact are where they are in the whole body; the rest is at rest.
      const auto& search = around.search();
      for (const int node : search[std::size_t(c.triangle)].nodes) {
        for (const int t : search.triangles_at(node)) {
          for (const int ring : search[std::size_t(t)].nodes) {
            for (const int i : search.triangles_at(ring)) {
              for (const int n : search[std::size_t(i)].nodes) {
                const auto at = std::size_t(n);
                apart = std::max(apart, (around.nodes()[at] - fronts.nodes()[at]).norm());
              }
            }
          }
        }
      }
      REQUIRE(apart < 1e-10);
    }
    CHECK(contacts > 20);
    const auto picture = around.picture();
    const auto whole = fronts.picture();
    double moved = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      CHECK((picture[i] - whole[i]).norm() < 1e-10);
      moved = std::max(moved, (whole[i] - mesh.nodes[i]).norm());
    }
    CHECK(moved > 1e-6);
  }
  const auto text = text_of<std::invalid_argument>([&] {
    env::deformable_body(
        mesh, soft, held,
        {.selection = env::contact_selection::normal_match, .moved = env::moved_nodes::around});
  });
  CHECK(contains(text, "choose closest_point"));
}
