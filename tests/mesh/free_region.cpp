// SPDX-License-Identifier: BSD-3-Clause
// The shortest way into half-spaces: it is in all of them, and no shorter one is.
#include "mesh/shapes.hpp"
#include <passive_haptics/mesh/free_region.hpp>

using namespace meshes;

TEST_CASE("the shortest way rests on what presses, and on nothing that would have to pull",
          "[mesh]") {
  std::mt19937 random(3);
  std::normal_distribution<> any;
  int three = 0;
  for (int run = 0; run < 20000; ++run) {
    const int count = 1 + run % 8;
    std::vector<triple> n;
    std::vector<double> missing;
    const triple free{any(random), any(random), any(random)};  // a point in all of them
    for (int i = 0; i < count; ++i) {
      triple v{any(random), any(random), any(random)};
      if (i > 0 && run % 5 == 0) v = n[0] + v * 1e-5;  // nearly the same
      n.push_back(v * (1.0 / length(v)));
      missing.push_back(dot(n.back(), free) - std::abs(any(random)));
    }
    ph::mesh::support s;
    REQUIRE(ph::mesh::shortest_way([&](int i) { return n[std::size_t(i)]; },
                                   [&](int i) { return missing[std::size_t(i)]; }, count, 1e-9, s));
    triple sum;
    for (std::size_t j = 0; j < std::size_t(s.count); ++j) {
      const auto i = std::size_t(s.of[j]);
      CHECK(s.share[j] >= -1e-9);
      CHECK(std::abs(dot(n[i], s.way) - missing[i]) < 1e-6);
      sum = sum + n[i] * s.share[j];
    }
    for (std::size_t i = 0; i < n.size(); ++i) CHECK(dot(n[i], s.way) >= missing[i] - 2e-9);
    CHECK(length(sum - s.way) < 1e-6);  // Karush, Kuhn, Tucker: so it is the shortest
    three += s.count == 3 ? 1 : 0;
  }
  CHECK(three > 100);
}

TEST_CASE("there is no way into half-spaces that do not meet", "[mesh]") {
  const triple n[] = {{0, 0, 1}, {0, 0, -1}};
  ph::mesh::support s;
  const auto of = [&](int i) { return n[i]; };
  CHECK_FALSE(ph::mesh::shortest_way(
      of, [](int) { return 1.0; }, 2, 1e-12, s));
  CHECK(ph::mesh::shortest_way(
      of, [](int i) { return i == 0 ? 1.0 : -1.0; }, 2, 1e-12, s));
  CHECK(length(s.way - triple{0, 0, 1}) < 1e-12);
  CHECK(ph::mesh::shortest_way(
      of, [](int) { return -1.0; }, 2, 1e-12, s));
  CHECK(s.count == 0);
}
