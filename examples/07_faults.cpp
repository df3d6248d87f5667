// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong in practice, and what a tick says about it. The loop never stops: every fault is
// an event in the result, and the force is always finite.

#include <passive_haptics/passive_haptics.hpp>

#include <cstdio>
#include <limits>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;
using wall = ph::half_space<scene>;

int main() {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float ms = 1e-3F;
  // By hand: a spring without damping and a loan, so that every force is round.
  ph::local_model touch{
      scene{},
      // Silent for more than 4.5 ms is stale; the contact then fades out over another 4 ms.
      ph::followed<wall>{{.stale_after = 4.5e-3, .fade = 4e-3}}, ph::turn_at_once{}, ph::spring{},
      ph::reduced_energy{.damping = 1.0, .loan = 0.01}, ph::strict_bound{},
      ph::loop_limits{.longest_tick = 1e-3}};

  const auto tick = [&touch](const char* what, float x, float dt) {
    const auto out = touch.tick(x, ph::seconds{dt});
    std::printf("%-32s force %4.2f N  %s\n", what, static_cast<double>(out.force),
                ph::to_string(out.what));
  };
  constexpr float inside = -2 * ms;
  const wall good{.point = 0, .normal = 1, .stiffness = 1000};

  tick("nothing published yet", inside, ms);
  touch.update(good);
  tick("a wall arrives", inside, ms);
  tick("a position is not a number", nan, ms);
  tick("the next is fine again", inside, ms);
  touch.update(good);
  tick("no time has passed", inside, 0);
  tick("fine again", inside, ms);
  tick("a jump of 1 m in 1 ms", inside + 1, ms);
  tick("fine again", inside, ms);
  tick("a tick longer than longest_tick", inside, 1.5F * ms);

  touch.update(good);
  touch.update(wall{.point = 0, .normal = 0, .stiffness = 1000});
  tick("a wall with no direction", inside, ms);
  touch.update(wall{.point = nan, .normal = 1, .stiffness = 1000});
  tick("a wall nowhere", inside, ms);

  touch.update(good);
  for (int silent = 1; silent <= 9; ++silent) tick("the environment falls silent", inside, ms);
}
