// SPDX-License-Identifier: BSD-3-Clause
// A triangle, as a mesh would publish it: press into it, slide along it, slide off its edge.
//
// The triangle counts as touched only while the device is below its face AND on the inner side of
// all three edges. The rule that shapes its force is the thesis's: it leaves the force alone
// while the device presses or slides. On the way out, and when the device comes back from beside
// the triangle, it allows no more than √(4 B E1): the local triangle then sinks below the published
// one, so that the depth in it is f/K.

#include <passive_haptics/passive_haptics.hpp>

#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
using vector = scene::vector;

int main() {
  // By hand: the thesis's own rule, which no composition of ours has.
  ph::local_model touch{scene{},
                        ph::followed<ph::triangle<scene>>{},
                        ph::turn_limited{.rate = 4.0},  // rad/s
                        ph::shaped{ph::spring{}, ph::thesis_rule{}},
                        ph::reduced_energy{.damping = 0.03},  // N·s/m
                        ph::no_bound{},
                        ph::loop_limits{.longest_tick = 1e-3}};
  // Stiff and quick, but not passive: 05_choose_a_bound.cpp shows the price.
  static_assert(decltype(touch)::passivity == ph::guarantee::none);

  // Counter-clockwise seen from outside; 40 mm along x, 30 mm along y, facing up.
  touch.update({.a = {0.0, 0.0, 0.0},
                .b = {0.04, 0.0, 0.0},
                .c = {0.0, 0.03, 0.0},
                .stiffness = 1500.0,
                .thickness = 0.01});

  vector x(0.0105, 0.0105, 0.0022);  // m
  int tick = 0;
  const auto move = [&](const char* what, const vector& step, int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick) {
      const auto out = touch.tick(x += step, ph::seconds{1e-3});
      if (tick % 5 != 4) continue;
      std::printf("%-6s x %5.1f mm  z %4.1f mm  depth %3.1f mm  force %5.3f N%s\n", what,
                  x(0) * 1e3, x(2) * 1e3, out.depth * 1e3, out.force(2),
                  out.limited ? "  limited" : "");
    }
  };
  move("press", {0.0, 0.0, -0.0004}, 10);
  move("slide", {0.0009, 0.0, 0.0}, 20);  // the edge b-c passes x = 26 mm
  move("back", {-0.0009, 0.0, 0.0}, 10);
  move("leave", {0.0, 0.0, 0.0002}, 10);
}
