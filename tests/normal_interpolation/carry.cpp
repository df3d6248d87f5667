// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/normal_interpolation/carry.hpp>

TEMPLATE_TEST_CASE("carry turns as little as takes one normal to the other", "[normals]", d2, d3,
                   f2, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  ph::laws::samples random(1);
  const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < 1000; ++i) {
    const vector from = random.direction<TestType>(), to = random.direction<TestType>();
    const scalar together = TestType::dot(from, to);
    if (together < scalar(-0.9)) continue;
    CHECK((ph::carry<TestType>(from, from, to) - to).norm() <= scalar(16) * slack);
    const vector a = random.vector<TestType>(), b = random.vector<TestType>();
    const vector turned = ph::carry<TestType>(a, from, to);
    const scalar kept = TestType::dot(turned, ph::carry<TestType>(b, from, to));
    CHECK(std::abs(kept - TestType::dot(a, b)) <= scalar(64) * slack);  // an isometry
    if constexpr (TestType::dof == 3) {
      const vector axis = TestType::cross(from, to);  // what the turn is about stays
      CHECK((ph::carry<TestType>(axis, from, to) - axis).norm() <= scalar(16) * slack);
    }
  }
}

TEMPLATE_TEST_CASE("carry keeps lengths where normals are all but opposite", "[normals]", d3, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  scalar off(0);
  for (int i = 0; i < 1000; ++i) {
    const scalar angle = scalar(2e-6) * scalar(i);  // what rounding leaves of 1 + cos is no number
    const vector to(-std::cos(angle), std::sin(angle), scalar(0));
    const vector turned = ph::carry<TestType>(vector(vector::UnitY()), vector::UnitX(), to);
    off = std::max(off, std::abs(turned.norm() - scalar(1)));
  }
  CHECK(off < scalar(0.1));
}

TEMPLATE_TEST_CASE("carry leaves what has no shortest way as it is", "[normals]", d2, d3) {
  using vector = typename TestType::vector;
  const vector n = vector::UnitX(), a = vector::UnitY();
  CHECK(ph::carry<TestType>(a, n, vector(-n)) == a);
  CHECK(ph::carry<d1>(2.0, 1.0, -1.0) == 2.0);
}
