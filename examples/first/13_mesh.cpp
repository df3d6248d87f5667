// SPDX-License-Identifier: BSD-3-Clause
// The same organ whole: the mesh is told where its nodes are, and nothing lets the finger through.
#include "organ.hpp"
#include <passive_haptics/mesh.hpp>

int main() {
  const organ at_first(0.006);
  std::vector<ph::mesh::triangle> triangles;
  for (const auto& t : at_first.surface().triangles()) triangles.push_back(t.nodes);
  ph::mesh::surface mesh(triangles, at_first.nodes());
  auto touch = ph::make_mesh_touch<scene>(
      ph::exact_device{.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3},
      {.force = 5}, {.stiffness = 500});
  touch.source().touch(mesh);

  ph::mesh::surface every_tick(triangles, at_first.nodes());
  ph::mesh::proxy ball;
  ball.touch(every_tick);

  stroke hand(0.006);
  const int untrue = hand.over(
      {.error = 1, .step = 0.5, .above = ball.parameters().radius},
      [&](const organ& body, const env::surface_point&) { mesh.update(body.nodes()); },
      [&](const auto& sample) { return touch.tick(sample).force; },
      [&](const organ& now, const env::surface_point&, const vector& x) {
        every_tick.update(now.nodes());
        ball.step({x(0), x(1), x(2)}, 1e-3);
        const auto [a, b, c] = ball.place();
        return vector(500 * (vector(a, b, c) - x));
      });
  return hand.verdict(touch.explain()) + untrue;
}
