// SPDX-License-Identifier: BSD-3-Clause
// Curved surfaces as a set of contacts follows them.
#include "support/catch.hpp"
#include "support/curved.hpp"
#include <passive_haptics/contact/contact_set.hpp>

using curved::Vector3d;

namespace {

/// What the stroke feels of surfaces published every 33 ticks, through a port without bound.
template <class Surface>
curved::feel through_a_set(const auto& next) {
  ph::passive_port port{d3{},
                        ph::contact_set{ph::proxy_spring{.mass = 0.1, .damping_ratio = 0.0},
                                        ph::pursuit{}, ph::slots<Surface, 1>{}},
                        ph::no_observer{}, ph::no_bound{}, thesis_loop};
  const Vector3d start = curved::stroke(0);
  REQUIRE(port.source().update(0, next(start)));
  for (int i = 100; i > 0; --i) (void)port.tick(start * (1.0 + 0.001 * i), 1ms);  // from outside
  return curved::stroked(
      [&](int i, const Vector3d& x) -> Vector3d {
        if (i % 33 == 0) REQUIRE(port.source().update(0, next(x)));
        return port.tick(x, 1ms).force;
      },
      3000);
}

}  // namespace

TEST_CASE("a set of contacts follows curved surfaces without a step", "[geometry][curved]") {
  const auto quadrics = through_a_set<ph::quadric<d3>>(curved::osculating<d3>);
  CHECK(quadrics.largest_step < 0.0023);
  CHECK(quadrics.mean_error < 0.00004);
  const auto planes = through_a_set<ph::half_space<d3>>([](const Vector3d& x) {  // the control
    return ph::half_space<d3>{x.normalized() * curved::radius, x, curved::stiffness};
  });
  CHECK(planes.largest_step > 0.01);
  CHECK(planes.mean_error > 0.01);
}
