// SPDX-License-Identifier: BSD-3-Clause
// A soft ball of finite elements is stroked, and solved 30 times a second. Its plane alone is where the ball was
// under the last force and under the last place of the finger. Told as it gives way, and asked where the finger will
// be while the answer counts, it is off by about half as much, and the force steps by less than half.
#include <passive_haptics/environment/ball.hpp>
#include <passive_haptics/environment/contact_surface.hpp>
#include <passive_haptics/environment/deformable_body.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace ph = passive_haptics;
namespace env = ph::environment;
using scene = ph::space<double, 3>;
using vector = scene::vector;

using plane = ph::half_space<scene>;
using news_of = plane (*)(env::deformable_body&, env::ahead&, const vector&, const vector&);

/// The forces [N] of a stroke of 30 mm to and fro in 2 s, up to 4 mm deep.
std::vector<vector> stroke(int ticks_between_news, news_of news) {
  env::deformable_body body(env::ball(0.05), {.young = 2e4, .poisson = 0.3},
                            env::ball_fixed_nodes());
  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9.0, .longest_tick = 1e-3}, {.force = 5.0});
  env::ahead where;
  std::vector<vector> forces{vector::Zero()};
  for (int tick = 0; tick < 2500; ++tick) {
    const double t = 1e-3 * tick, angle = 0.3 * std::sin(3.0 * t);
    const double r = 0.052 - 0.006 * std::min(2.0 * t, 1.0);
    const vector finger(r * std::sin(angle), 0.0, r * std::cos(angle));
    if (tick % ticks_between_news == 0) touch.update(news(body, where, finger, forces.back()));
    forces.push_back(touch.tick(finger, ph::seconds{1e-3}).force);
  }
  return forces;
}

int main() {
  const news_of bare = [](auto& body, auto& /*where*/, const vector& finger, const vector& force) {
    body.update(finger, force);
    return env::plane_at(body);
  };
  const news_of foreseen = [](auto& body, auto& where, const vector& finger, const vector& force) {
    return env::yielding(body, where, finger, force);
  };
  const auto show = [truth = stroke(1, foreseen)](const char* by, const auto& forces) {
    double off = 0.0, step = 0.0;
    for (std::size_t n = 600; n < forces.size(); ++n) {
      off += (forces[n] - truth[n]).squaredNorm() / double(forces.size() - 600);
      step = std::max(step, (forces[n] - forces[n - 1]).norm());
    }
    std::printf("%-24s off by %3.0f mN rms, largest step %3.0f mN\n", by, 1e3 * std::sqrt(off),
                1e3 * step);
  };
  show("its plane, 30 Hz:", stroke(33, bare));
  show("yielding, ahead, 30 Hz:", stroke(33, foreseen));
}
