// SPDX-License-Identifier: BSD-3-Clause
// The cache says what the finite elements say, computes a node once, and keeps within its memory.
#include "environment/touch_alike.hpp"
#include <passive_haptics/environment/compliance_cache.hpp>
#include <passive_haptics/environment/several_contacts.hpp>

namespace {

struct scene {
  env::tetrahedral_mesh mesh = env::scaled(blocks(4, [](int, int, int) { return true; }), 0.02);
  std::vector<int> held;
  std::vector<int> patch = env::patch_around(env::boundary(mesh), mesh.nodes, {0, 0, 0}, 1000);

  scene() {
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      if (mesh.nodes[i].z() < 1e-6) held.push_back(static_cast<int>(i));
    }
  }
  [[nodiscard]] env::tetrahedral_fem fem() const { return {mesh, soft, held}; }
  /// Bytes of so many nodes, in double.
  [[nodiscard]] double room(double nodes) const {
    return nodes * 72.0 * static_cast<double>(patch.size());
  }
};

}  // namespace

TEST_CASE("a body on a compliance cache is the body of finite elements, however little is kept",
          "[environment][cache]") {
  const scene s;
  for (const double nodes : {3.0, 5.9, 1000.0}) {
    auto cache = env::cache_compliance<double>(s.fem(), s.patch, s.room(nodes));
    CHECK(cache.columns().places() == std::min(s.patch.size(), static_cast<std::size_t>(nodes)));
    env::deformable_body elements(s.mesh, soft, s.held);
    env::basic_deformable_body<env::compliance_cache<double>> cached(s.mesh, std::move(cache));
    CHECK(touch_alike(elements, cached, 100, 51) > 25);
  }
}

TEST_CASE("a compliance cache computes a node once, and again only when it was given up",
          "[environment][cache]") {
  const scene s;
  const auto cache = env::cache_compliance<double>(s.fem(), s.patch, s.room(4));
  auto fem = s.fem();
  std::vector<int> free;
  for (const int node : s.patch) {
    if (fem.moves(node)) free.push_back(node);
  }
  const auto ask = [&](std::size_t first) {
    const std::array<int, 3> nodes{free[first], free[first + 1], free[first + 2]};
    const Vector3d shares(0.2, 0.3, 0.5);
    const Eigen::Matrix3d right = fem.compliance(nodes, shares);
    CHECK((cache.compliance(nodes, shares) - right).norm() < 1e-10 * right.norm());
    return cache.columns().computed();
  };
  CHECK(cache.columns().computed() == 0);
  CHECK(ask(0) == 3);
  CHECK(ask(0) == 3);  // the second touch
  CHECK(ask(1) == 4);  // the fourth place: 0 1 2 3
  CHECK(ask(0) == 4);
  CHECK(ask(2) == 5);  // 4 instead of 0 or 1
  CHECK(ask(2) == 5);
  CHECK(ask(20) == 8);  // three instead of 1 and two of 2 3 4
  CHECK(ask(2) == 10);  // of which one was left
  // Held nodes move nowhere, and two contacts know of each other.
  const std::array<int, 3> held{s.held[0], s.held[1], s.held[2]};
  CHECK(cache.compliance(held, {0.2, 0.3, 0.5}).isZero(0.0));
  const std::vector<env::contact_point> two{
      {{free[0], free[1], free[2]}, {0.2, 0.3, 0.5}, Vector3d::UnitX()},
      {{free[20], free[21], free[22]}, {0.2, 0.3, 0.5}, Vector3d::UnitZ()}};
  const auto G = env::capacitance(cache, two);
  const auto all = env::cache_compliance<double>(s.fem(), s.patch);
  CHECK(G.isApprox(env::capacitance(all, two), 1e-10));
  CHECK(G.llt().info() == Eigen::Success);
}

TEST_CASE("a compliance cache refuses what it cannot hold", "[environment][cache]") {
  const scene s;
  const auto make = [&](const std::vector<int>& patch, double bytes) {
    return text_of<std::invalid_argument>(
        [&] { (void)env::cache_compliance<double>(s.fem(), patch, bytes); });
  };
  CHECK(make(s.patch, s.room(3)).empty());
  for (const double bad : {s.room(2.99), 0.0, -1.0, not_a_number}) {
    CHECK(contains(make(s.patch, bad), "do not hold the three nodes of a contact"));
  }
  CHECK(contains(make({}, 1e6), "the patch has no nodes"));
  CHECK(contains(make({3, 125}, 1e6), "node 125 is refused; the mesh has nodes 0 to 124"));
  CHECK(contains(make({-1}, 1e6), "node -1 is refused"));
}

TEST_CASE("a compliance cache has room for all nodes that one contact presses",
          "[environment][cache]") {
  const scene s;
  auto cache = env::cache_compliance<double>(s.fem(), s.patch, s.room(3));
  REQUIRE(cache.columns().places() == 3);
  const std::vector<int> nodes(s.patch.end() - 12, s.patch.end());
  const std::vector<double> shares(nodes.size(), 1.0 / 12.0);
  (void)cache.press(nodes, shares);
  cache.load({1, 2, 3});
  env::tetrahedral_fem fem = s.fem();
  (void)fem.press(nodes, shares);
  fem.load({1, 2, 3});
  for (const int node : s.patch) {
    const Vector3d u = fem.displacement(node);
    CHECK((cache.displacement(node) - u).norm() <= 1e-10 * (u.norm() + 1e-3));
  }
  CHECK(cache.columns().places() == 12);
  CHECK(cache.columns().computed() == 12);  // and none of them again
}
