// SPDX-License-Identifier: BSD-3-Clause
// A probe is pulled over an organ of 180 triangles, which tells what is under it 30 times a second.
//
// One triangle ends at its edges, and the next news are up to 33 ms away: the probe falls in. A quadric
// has the curvatures of the mesh and goes on; but it is one point's, and 4 mm deep in an organ of 300 N/m
// it steps as much. Creases and dents want a patch (env::patch_at). Run at the root, or name the organ.msh.

#include <passive_haptics/environment/curvature.hpp>
#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <cstdio>

namespace ph = passive_haptics;
namespace env = ph::environment;
namespace sim = ph::simulation;
using scene = ph::space<double, 3>;
using vector = scene::vector;

/// 60 mm at 45 mm/s; `told` is what the organ tells of its point that is the closest to the probe.
template <class Surface>
void pull(const char* name, const env::tetrahedral_mesh& organ, auto told) {
  const auto surface = env::boundary(organ);
  auto touch = ph::make_contacts<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5},
      ph::slots<Surface, 1>{});
  sim::device<scene, sim::impedance_hand<scene>> device{
      {.mass = 0.1, .damping = 0.1, .start = {-0.03, 0.003, 0.021}}, {.stiffness = 100}};
  auto sample = device.exchange(vector::Zero());
  vector last = vector::Zero();
  double step = 0, deepest = 0;
  for (int ms = -495; ms < 1300; ++ms) {
    const auto on = env::closest_point(surface, organ.nodes, sample.position);
    if (ms % 33 == 0) touch.source().update(0, told(surface, *on));
    device.hand().target = {-0.03 + 45e-6 * std::max(ms, 0), 0.003, 0.008};
    const vector force = touch.tick(sample).force;
    if (ms > 0) step = std::max(step, (force - last).norm());
    deepest = std::max(deepest, on->depth);
    last = force;
    sample = device.exchange(force);
  }
  std::printf("%-9s largest step %4.2f N, at most %3.1f mm deep\n", name, step, 1e3 * deepest);
}

int main(int argc, char** argv) {
  const auto organ = env::scaled(env::read_msh(argc > 1 ? argv[1] : "tests/data/organ.msh"), 1e-3);
  pull<ph::triangle<scene>>("triangle:", organ, [&](const auto& surface, const auto& on) {
    const auto [a, b, c] = env::corners(surface[std::size_t(on.triangle)], organ.nodes);
    return ph::triangle<scene>{a, b, c, 1000};  // N/m
  });
  pull<ph::quadric<scene>>("quadric:", organ, [&](const auto& surface, const auto& on) {
    const auto [point, n, t, one, two, rise] =
        env::shape_at(surface, organ.nodes, on.triangle, on.weights);
    return ph::quadric<scene>{point, n, t, one, two, 1000, 0.008};  // curvatures 1/m, N/m, m deep
  });
}
