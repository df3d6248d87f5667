// SPDX-License-Identifier: BSD-3-Clause
// A sheet of two triangles, felt along its normal by a handle behind a cable of 75 Hz (cable.hpp): 25 mJ are drawn
// from one that was told the mass alone, shaken at 80 Hz.
#include "cable.hpp"
#include <passive_haptics/mesh/through_transmission.hpp>

using space = ph::space<double, 3>;

double sheet(const char* told, auto touch) {
  const std::vector<ph::mesh::triple> nodes{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const ph::mesh::surface mesh({{0, 1, 2}, {0, 2, 3}}, nodes);
  if (!touch.source().touch(mesh)) return 1;
  struct along {
    double force;  // [N]
  };
  const double drawn = drawn_from(told, touch, {.rate = 500}, [&](const auto& sample) {
    const space::vector here(0, 0, sample.position);
    return along{touch.tick(here, ph::seconds{1e-3}).force.z()};
  });
  touch.source().let_go();
  return drawn;
}

int main() {
  const ph::mesh_contact skin{.stiffness = 8000};
  const double untold = sheet("the mass", ph::make_mesh_touch<space>(device, {.force = 5}, skin));
  const double is_told =
      sheet("the cable", ph::make_mesh_touch<space>(device, cable, {.force = 5}, skin));
  return untold > 1e-3 && is_told < 1e-9 ? 0 : 1;
}
