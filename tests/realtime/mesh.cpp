// SPDX-License-Identifier: BSD-3-Clause
// A tick on a mesh takes nothing from the heap, nor does an update after the first few.
#include "mesh/shapes.hpp"
#include "support/allocations.hpp"
#include <passive_haptics/mesh/mesh_tool.hpp>

using namespace meshes;

TEST_CASE("a tick on a mesh allocates nothing, with news and without", "[mesh][realtime]") {
  const body b = sphere(3, 0.04);
  const auto smooth = GENERATE(std::optional<ph::mesh::smooth>(), ph::mesh::smooth{});
  ph::mesh::surface s(b.triangles, b.nodes, {}, smooth);
  ph::passive_port port{
      scene{}, ph::mesh_contact{.spring = {.mass = 0.1}}, ph::reduced_energy{.damping = 0.03},
      ph::reachable_bound{.mass = 0.1, .hand_force = 10}, ph::loop_limits{.longest_tick = T}};
  port.source().touch(s);
  auto nodes = b.nodes;
  long in_ticks = 0, in_late_news = 0;
  int pressed = 0;
  for (int k = 0; k < 2000; ++k) {
    if (k % 33 == 0) {
      for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes[i] = b.nodes[i] * (1.0 + 0.1 * std::sin(0.01 * k));
      const long before = allocations();
      CHECK(s.update(nodes));
      if (k > 400) in_late_news += allocations() - before;
    }
    const double angle = 0.002 * k;
    const long before = allocations();
    pressed +=
        port.tick(vector(0.036 * std::cos(angle), 0.036 * std::sin(angle), k < 20 ? 0.05 : 0.0),
                  ph::seconds{T})
                    .depth > 0.0
            ? 1
            : 0;
    in_ticks += allocations() - before;
  }
  CHECK(in_ticks == 0);
  CHECK(in_late_news == 0);
  CHECK(pressed > 500);
}

TEST_CASE("a tick of a tool on a mesh allocates nothing", "[mesh][realtime]") {
  const body b = sphere(3, 0.04);
  ph::mesh::surface s(b.triangles, b.nodes);
  auto port =
      ph::make_mesh_tool({.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},
                          .damping = {0.03, 1e-4},
                          .damping_most = {0.06, 2e-4},
                          .force_limit = 9,
                          .torque_limit = 0.5},
                         {.force = 8, .torque = 0.1},
                         std::array<std::array<double, 3>, 2>{{{0.01, 0, 0}, {-0.01, 0, 0}}});
  CHECK(port.source().touch(s));
  long in_ticks = 0;
  int pressed = 0;
  for (int k = 0; k < 1000; ++k) {
    const double angle = 0.002 * k, tilt = 0.2 * std::sin(0.05 * k);
    const long before = allocations();
    const auto out =
        port.tick({vector(0.036 * std::cos(angle), 0.036 * std::sin(angle), k < 20 ? 0.05 : 0.0),
                   {std::cos(tilt), std::sin(tilt), 0, 0}},
                  ph::seconds{T});
    in_ticks += allocations() - before;
    pressed += out.depth > 0.0 ? 1 : 0;
  }
  CHECK(in_ticks == 0);
  CHECK(pressed > 500);
}
