// SPDX-License-Identifier: BSD-3-Clause
// A plate of 2 mm that heaves and bends, 30 times a second, under a finger that hits it with 1 m/s and presses
// with 10 N: it is felt where it is, and never passed through.
#include <passive_haptics/mesh.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

int main() {
  std::vector<ph::mesh::triangle> triangles;
  std::vector<ph::mesh::triple> nodes;
  for (const double z : {0.0, -0.002}) {  // two sheets of 10 × 10 squares, 100 mm wide
    const int first = static_cast<int>(nodes.size());
    for (int i = 0; i < 121; ++i) nodes.push_back({0.01 * (i % 11 - 5), 0.01 * (i / 11 - 5), z});
    for (int i = first; i < first + 109; ++i) {
      if ((i - first) % 11 == 10) continue;
      triangles.push_back({i, i + 1, i + 12});
      triangles.push_back({i, i + 12, i + 11});
    }
  }
  ph::mesh::surface plate(triangles, nodes);

  auto touch = ph::make_mesh_touch<scene>(
      ph::exact_device{.mass = 0.1, .damping = 1.0, .force_limit = 20.0, .longest_tick = 0.0011},
      {.force = 10.0}, {.stiffness = 2000.0});
  touch.source().touch(plate);

  scene::vector x(0.003, 0.002, 0.02), v(0.0, 0.0, -1.0);
  for (int tick = 0; tick < 1000; ++tick) {
    if (tick % 33 == 0) {  // in a program of two threads this is the other one
      auto bent = nodes;
      for (auto& p : bent)
        p.z += 0.005 * std::sin(0.01 * tick) * (1.0 - 200.0 * (p.x * p.x + p.y * p.y));
      if (!plate.update(bent)) std::puts(plate.fault().c_str());
    }
    const auto out = touch.tick(x, ph::seconds{1e-3});
    // A hand presses with 10 N and steadies 0.1 kg sideways.
    const scene::vector hand(-200.0 * x(0), -200.0 * x(1), -10.0);
    v += 1e-3 / 0.1 * (hand + out.force - 1.0 * v);
    x += 1e-3 * v;
    if (tick % 100 == 99) {
      std::printf("t %.1f s  finger %6.2f mm  held at %5.2f mm  force %5.2f N\n", 1e-3 * (tick + 1),
                  x(2) * 1e3, touch.source().ball().place().z * 1e3, out.force(2));
    }
  }
}
