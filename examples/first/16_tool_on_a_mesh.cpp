// SPDX-License-Identifier: BSD-3-Clause
// The same tool on a mesh, which is told 30 times a second and heaves by 3 mm: no foot passes through it.
#include <passive_haptics/mesh/mesh_tool.hpp>
#include <passive_haptics/mesh/surface.hpp>
#include <passive_haptics/simulation/rigid_device.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace ph = passive_haptics;
using body = ph::rigid_body<double>;
using point = std::array<double, 3>;

/// The nodes of a sheet of 0.1 x 0.1 m at the height z [m].
std::vector<point> sheet(double z) {
  std::vector<point> nodes;
  for (int i = 0; i < 121; ++i) {
    nodes.push_back({0.01 * (i % 11 - 5), 0.01 * (i / 11 - 5), z});
  }
  return nodes;
}

int main() {
  std::vector<ph::mesh::triangle> triangles;
  for (int i = 0; i < 110; ++i) {
    if (i % 11 == 10) continue;
    triangles.push_back({i, i + 1, i + 12});
    triangles.push_back({i, i + 12, i + 11});
  }
  ph::mesh::surface mesh(triangles, sheet(0));
  const std::array<point, 3> feet{
      {{0.03, 0, -0.04}, {-0.02, 0.03, -0.04}, {-0.02, -0.03, -0.04}}};  // from the handle [m]
  auto tool = ph::make_mesh_tool({.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},
                                  .damping = {.linear = 0.03, .angular = 1e-4},
                                  .damping_most = {.linear = 0.06, .angular = 2e-4},
                                  .force_limit = 9,
                                  .torque_limit = 0.5},
                                 {.force = 5, .torque = 0.1}, feet, {.stiffness = 2000});
  tool.source().touch(mesh);

  ph::simulation::rigid_device device({}, {.position = {0, 0, 0.045}, .orientation = {}});
  device.push(body::join({0, 0, -2}, {0, 0.01, 0}));  // the hand: N, N·m
  auto sample = device.exchange(body::zero());
  double lowest = 1, highest = 0;
  for (int ms = 0; ms < 4000; ++ms) {
    const double z = 0.003 * std::sin(0.0031 * ms);
    if (ms % 33 == 0) mesh.update(sheet(z));
    sample = device.exchange(tool.tick(sample).force);
    lowest = std::fmin(lowest, device.at().position.values[2] - z);
    if (ms > 1000) highest = std::fmax(highest, device.at().position.values[2] - z);
  }
  std::printf("the handle was %.1f to %.1f mm over the sheet, %.1f mJ paid in\n", 1e3 * lowest,
              1e3 * highest, 1e3 * device.energy());
  return device.energy() >= 0 && lowest > 0.036 && highest < 0.041 ? 0 : 1;
}
