// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One body that must be another.
#include "environment/bodies.hpp"
#include <passive_haptics/environment/deformable_body.hpp>

/// Touches both alike, about the top of a block of 0.08 m: how many updates were in contact.
template <class Other>
int touch_alike(env::deformable_body& elements, Other& other, int updates, unsigned seed) {
  std::mt19937 random(seed);
  Vector3d device{0.033, 0.046, 0.078};
  int contacts = 0;
  for (int update = 0; update < updates; ++update) {
    device = (device + 2e-3 * anything(random))
                 .cwiseMax(Vector3d(0.01, 0.01, 0.07))
                 .cwiseMin(Vector3d(0.07, 0.07, 0.083));
    const auto last = elements.contact();
    const Vector3d force = last.stiffness * std::max(0.0, last.depth) * last.normal;
    const auto a = elements.update(device, force);
    const auto b = other.update(device, force);
    REQUIRE((a.fresh && b.fresh));
    REQUIRE(a.triangle == b.triangle);
    REQUIRE((a.point - b.point).norm() < 1e-10);
    REQUIRE_THAT(b.stiffness, WithinRel(a.stiffness, 1e-8));
    contacts += a.depth > 0.0 ? 1 : 0;
  }
  return contacts;
}
