// SPDX-License-Identifier: BSD-3-Clause
// A wheel on encoders of 57 µm at its rim. If its mass and the hand may be counted on, an edge that is crossed says
// more of where it is, and so a wall and detents are stiffer for the same promise. A Touch is too light for that.
#include <passive_haptics/identification/crossed_compositions.hpp>

#include <chrono>
#include <cstdio>

namespace ph = passive_haptics;
using rim = ph::space<double, 1>;  // m, N, 0 outside the wall
using namespace std::chrono_literals;

constexpr ph::encoder_device wheel{.mass = 1.33,
                                   .damping = 1.1,
                                   .friction = 0.17,
                                   .presliding = 5e-6,
                                   .quantum = 57e-6,
                                   .force_limit = 10.0};
constexpr ph::encoder_device stylus{.mass = 0.045,
                                    .damping = 0.05,
                                    .friction = 0.13,
                                    .presliding = 15e-6,
                                    .quantum = 20e-6,
                                    .force_limit = 3.3};
constexpr ph::known_hand hand{.force = 5.3};  // N

int main() {
  const auto show = [](const char* what, auto port) {
    (void)port.update({.point = 0.0, .normal = 1.0, .stiffness = 10e3});
    (void)port.tick(0.0, 1ms);
    const auto said = port.explain();
    const char* then = *said.crossings == '\0' ? "" : ": ";
    std::printf("%-18s%5.0f N/m%s%s\n", what, said.shown, then, said.crossings);
  };
  show("wheel", ph::make_touch<rim>(wheel, hand));
  show("wheel, crossings", ph::make_touch<rim>(wheel, ph::known_crossings{}, hand));
  show("stylus", ph::make_touch<rim>(stylus, hand));
  show("stylus, crossings", ph::make_touch<rim>(stylus, ph::known_crossings{}, hand));

  const ph::detents clicks{.pitch = 0.02, .stiffness = 10e3};
  auto plain = ph::make_detents<rim>(wheel, hand, clicks);
  auto known = ph::make_detents<rim>(wheel, ph::known_crossings{}, hand, clicks);
  (void)plain.tick(0.001, 1ms);
  (void)known.tick(0.001, 1ms);
  std::printf("detents: %.0f N/m, and %.0f\n", plain.explain().shown, known.explain().shown);
}
