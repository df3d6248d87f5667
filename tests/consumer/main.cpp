// SPDX-License-Identifier: BSD-3-Clause
// A consumer's program: it presses a wall, and is less careful about warnings than the library.

#include <passive_haptics/passive_haptics.hpp>

#include <cstdio>

static_assert(__cplusplus >= 202002L, "linking to passive_haptics raises the standard to C++20");

namespace ph = passive_haptics;
using scene = ph::space<float, 3>;

int main() {
  double x = -0.001;
  int unused = 0;
  float narrowed = x;  // -Wconversion -Werror would refuse this line, and the one before
  ph::local_model wall{
      scene{},
      ph::fixed{ph::half_space<scene>{.point = {0, 0, 0}, .normal = {0, 0, 1}, .stiffness = 500}},
      ph::turn_at_once{},
      ph::spring{},
      ph::reduced_energy{.damping = 1, .loan = 0.001},
      ph::strict_bound{},
      ph::loop_limits{.longest_tick = 0.001}};
  const auto out = wall.tick({0, 0, narrowed}, ph::seconds{1e-3});
  std::printf("passive_haptics %d.%d.%d: %.2f N\n", ph::version_major, ph::version_minor,
              ph::version_patch, static_cast<double>(out.force(2)));
  return out.force(2) > 0.4F ? 0 : 1;
}
