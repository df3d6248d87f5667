// SPDX-License-Identifier: BSD-3-Clause
#include "environment/bodies.hpp"
#include <passive_haptics/environment/rigid_modes.hpp>

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
  const auto text = [&](const std::vector<int>& fixed) {
    return text_of<env::singular_stiffness>([&] { env::tetrahedral_fem(mesh, soft, fixed); });
  };
  CHECK(
      contains(text({9, 5, 6}),
               "6 rigid modes left by 3 fixed nodes in 2 connected part(s), the first in the part "
               "of node 11, 11 nodes large; fix at least three nodes"));
  CHECK(contains(text({}),
                 "12 rigid modes left by 0 fixed nodes in 2 connected part(s), the first in "
                 "the part of node 0, 11 nodes large"));
}
