// SPDX-License-Identifier: BSD-3-Clause
// A force that is spread over a fingertip: shared out rightly, and no softer for a finer mesh.
#include "../bench/organ/sparse_ldlt.hpp"
#include "environment/bodies.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/environment/compliance_table.hpp>
#include <passive_haptics/environment/deformable_body.hpp>

#include <numeric>

namespace {

/// A cube of 0.1 m in n³ blocks, held below.
struct cube {
  explicit cube(int n) : mesh(env::scaled(blocks(n, [](int, int, int) { return true; }), 0.1 / n)) {
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      if (mesh.nodes[i].z() < 1e-6) held.push_back(static_cast<int>(i));
    }
  }
  env::tetrahedral_mesh mesh;
  std::vector<int> held;
};

/// Pressed 2 mm deep beside the middle of its top, until that has settled [N/m].
double stiffness_of(int n, double radius) {
  const cube made(n);
  env::deformable_body body(made.mesh, soft, made.held, {.radius = radius});
  const Vector3d device(0.052, 0.049, 0.098);
  auto contact = body.update(device, Vector3d::Zero());
  for (int i = 0; i < 4; ++i) {
    contact = body.update(device, contact.stiffness * contact.depth * contact.normal);
  }
  return contact.stiffness;
}

}  // namespace

TEST_CASE("a fingertip's force is shared out to the nodes within its radius",
          "[environment][body]") {
  cube made(8);
  for (auto& x : made.mesh.nodes) x.x() *= 1.0 + 3.0 * x.x();  // triangles of several sizes
  const env::surface_graph surface(env::boundary(made.mesh), made.mesh.nodes.size());
  env::contact_area area(surface, made.mesh.nodes);
  std::mt19937 random(5);
  const auto longest_edge = [&](const env::surface_triangle& t) {
    const auto c = env::corners(t, made.mesh.nodes);
    return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
  };
  const auto area_of = [&](int node) {
    double sum = 0.0;
    for (const auto& t : surface.triangles()) {
      if (std::find(t.nodes.begin(), t.nodes.end(), node) == t.nodes.end()) continue;
      sum += env::area_vector(env::corners(t, made.mesh.nodes)).norm();
    }
    return sum;
  };
  for (const double radius : {0.001, 0.02, 0.035, 1.0}) {
    for (int run = 0; run < 20; ++run) {
      const auto& t = surface[random() % surface.size()];
      const double reach = std::max(radius, longest_edge(t));
      const Vector3d some = anything(random).cwiseAbs();
      const Vector3d weights =
          run == 0 && radius > 0.03 ? Vector3d(0, 1, 0) : Vector3d(some / some.sum());
      area.gather(surface, made.mesh.nodes, t, weights, radius);
      const Vector3d centre = env::point_at(env::corners(t, made.mesh.nodes), weights);
      const auto inside = [&](int node) {
        return 1.0 - (made.mesh.nodes[std::size_t(node)] - centre).squaredNorm() / (reach * reach);
      };
      const auto formula = [&](int node) { return area_of(node) * std::pow(inside(node), 2); };
      double sum = 0.0;
      std::set<int> seen;
      for (std::size_t i = 0; i < area.nodes().size(); ++i) {
        const int node = area.nodes()[i];
        CHECK(area.shares()[i] > 0.0);
        CHECK(inside(node) > 0.0);
        CHECK(seen.insert(node).second);
        CHECK_THAT(area.shares()[i] * formula(area.nodes()[0]),
                   WithinRel(area.shares()[0] * formula(node), 1e-9));
        sum += area.shares()[i];
      }
      CHECK_THAT(sum, WithinAbs(1.0, 1e-12));
      std::size_t within = 0;
      for (int node = 0; node < static_cast<int>(made.mesh.nodes.size()); ++node) {
        within += !surface.triangles_at(node).empty() && inside(node) > 0.0 ? 1 : 0;
      }
      CHECK(area.nodes().size() == within);  // a cube has no other side as near
    }
  }
}

TEST_CASE("a finer mesh is hardly softer under a fingertip, and ever softer under a point",
          "[environment][body][long]") {
  const double coarse = stiffness_of(6, 0.03), middle = stiffness_of(9, 0.03),
               fine = stiffness_of(14, 0.03);
  CHECK(middle < coarse);
  CHECK(fine > 0.88 * middle);
  CHECK(stiffness_of(14, 0.0) < 0.75 * stiffness_of(9, 0.0));  // the control
}

TEST_CASE("a fingertip feels the same by any solver and out of a table", "[environment][body]") {
  const cube made(5);
  const scratch_folder folder;
  const env::body_options spread{.radius = 0.035};
  const auto patch =
      env::patch_around(env::boundary(made.mesh), made.mesh.nodes, {0.05, 0.05, 0.1}, 1000);
  const auto id = env::fingerprint_of(made.mesh, soft, made.held);
  const env::tetrahedral_fem fem(made.mesh, soft, made.held, {.touched = patch});
  env::compute_table<double>(folder / "cube.table", fem, id, patch);
  env::deformable_body fronts(made.mesh, soft, made.held, spread);
  env::basic_deformable_body<env::basic_tetrahedral_fem<organ::sparse_ldlt>> columns(
      made.mesh, soft, made.held, spread);
  env::basic_deformable_body<env::compliance_table<double>> table(
      made.mesh, env::read_table<double>(folder / "cube.table", id, made.mesh.nodes.size()),
      spread);
  auto contact = fronts.update({0.03, 0.04, 0.098}, Vector3d::Zero());
  (void)columns.update({0.03, 0.04, 0.098}, Vector3d::Zero());
  (void)table.update({0.03, 0.04, 0.098}, Vector3d::Zero());
  for (int i = 0; i < 25; ++i) {
    const Vector3d device(0.03 + 0.002 * i, 0.04 + 0.001 * i, 0.098 - 2e-4 * i);
    const Vector3d force = contact.stiffness * std::max(0.0, contact.depth) * contact.normal;
    contact = fronts.update(device, force);
    REQUIRE(contact.fresh);
    for (const auto& other : {columns.update(device, force), table.update(device, force)}) {
      CHECK_THAT(other.stiffness, WithinRel(contact.stiffness, 1e-8));
      CHECK_THAT(other.depth, WithinAbs(contact.depth, 1e-10));
      CHECK((other.point - contact.point).norm() < 1e-10);
    }
  }
  CHECK(contact.depth > 1e-3);
}

TEST_CASE("under a fingertip a surface settles at once below a device that stands still",
          "[environment][body]") {
  const cube made(8);
  env::deformable_body body(made.mesh, soft, made.held, {.radius = 0.03});
  const Vector3d device(0.05, 0.05, 0.0995);
  auto contact = body.update(device, Vector3d::Zero());
  const double first = contact.depth;
  for (int i = 0; i < 3; ++i) {
    contact = body.update(device, contact.stiffness * contact.depth * contact.normal);
    CHECK_THAT(contact.depth, WithinRel(0.5 * first, 1e-3));  // as stiff outside as inside
  }
  const auto refused = text_of<std::invalid_argument>(
      [&] { env::deformable_body(made.mesh, soft, made.held, {.radius = -1.0}); });
  CHECK(contains(refused, "a fingertip of radius -1 m is refused"));
}
