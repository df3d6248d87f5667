// SPDX-License-Identifier: BSD-3-Clause
// A local model is a value: copy it, store it as bytes, bring it back, and the same motion gives
// the same forces to the last bit. And its parameters can be asked what is wrong with them.

#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <cstdio>
#include <cstring>
#include <type_traits>

namespace ph = passive_haptics;
using scene = ph::space<float, 3>;

auto make(double damping) {
  // By hand: few parts, so that what is stored is short.
  return ph::local_model{scene{},
                         ph::followed<ph::half_space<scene>>{},
                         ph::turn_limited{.rate = 4.0},
                         ph::spring{},
                         ph::reduced_energy{.damping = damping},
                         ph::strict_bound{},
                         ph::loop_limits{.longest_tick = 1e-3}};
}
using model = decltype(make(0));
static_assert(std::is_trivially_copyable_v<model>);

/// Presses the tilted plane deeper by 0.1 mm a tick.
std::array<scene::vector, 20> press(model& touch, float start) {
  std::array<scene::vector, 20> forces{};
  for (auto& force : forces) force = touch.tick({0, 0, start -= 1e-4F}, ph::seconds{1e-3F}).force;
  return forces;
}

int main() {
  model touch = make(0.5);
  touch.update({.point = {0, 0, 0}, .normal = {0.3F, 0.1F, 1}, .stiffness = 2000});
  press(touch, 0.001F);

  std::array<std::byte, sizeof(model)> snapshot{};
  std::memcpy(snapshot.data(), &touch, sizeof touch);
  const auto first = press(touch, -0.001F);

  std::memcpy(&touch, snapshot.data(), sizeof touch);
  const auto again = press(touch, -0.001F);
  std::printf("replay is bit-identical: %s\n", first == again ? "yes" : "no");
  std::printf("last force %.3f N\n", static_cast<double>(again.back().norm()));

  // A parameter read from a file, say. The model made of it is harmless: it ticks with force zero.
  model broken = make(-0.03);
  if (const auto fault = broken.check()) {
    std::printf("%s = %g is refused: it must be %s\n", fault.parameter, fault.value, fault.remedy);
  }
  std::printf("a tick of it: %s\n", ph::to_string(broken.tick({0, 0, 0}, ph::seconds{1e-3F}).what));
}
