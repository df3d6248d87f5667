// SPDX-License-Identifier: BSD-3-Clause
// The haptic loop itself: a runner calls your controller once a millisecond, in a thread of its own.
//     24_run_a_loop [--figures]    half a second; or 10 s, and how late it was, which longest_tick to state
//                                  and what that costs, and scope.csv: the ticks around the first late one

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/runner.hpp>
#include <passive_haptics/runner/scope.hpp>
#include <passive_haptics/simulation/device.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;
using simulated = ph::simulation::device<scene, ph::simulation::impedance_hand<scene>>;

/// A device of your own. This one is simulated as fast as time goes by, and holds a force a tick late.
struct my_device {
  my_device() : body({.damping = 0.3, .start = 0.002}, {.stiffness = 300, .target = -0.01}) {}
  ph::device_sample<scene> exchange(const double& force) noexcept {
    body.set_period(watch.lap());
    return body.exchange(std::exchange(held, force));
  }
  simulated body;
  ph::stopwatch watch;
  double held = 0;
};

int main(int argc, char**) {
  bool figures = argc > 1, felt = false;
  my_device device;
  auto wall = ph::make_touch<scene, ph::half_space<scene>, ph::late_loop_limits<1>>(
      {.mass = 0.1, .damping = 0.3, .force_limit = 9, .longest_tick = 2e-3, .latency = 1},
      {.force = 5});
  wall.update({.point = 0, .normal = 1, .stiffness = 500});
  static ph::scope<scene, 2000> seen{ph::event::late_tick};
  ph::runner touch{device, [&](const auto& sample) {
                     const auto out = wall.tick(sample);
                     seen.record(sample, out);
                     felt = felt || out.force > 1;
                     return out.force;
                   }};
  const auto started = touch.start({.priority = figures ? 80 : 0, .lock_memory = figures});
  if (!started) return std::puts(ph::to_string(started.what)), 1;
  std::this_thread::sleep_for(std::chrono::milliseconds(figures ? 10'000 : 500));
  std::puts(touch.take() != nullptr ? "there is news" : "no");  // the newest state, to be drawn
  touch.stop();
  std::puts(felt && device.held == 0 ? "the wall was felt, and the device is let go" : "no");
  if (!figures) return 0;
  std::array<char, 400> text{};
  std::puts(ph::describe(started.granted, text));
  std::puts(ph::describe(touch.timing(), text));
  for (const double share : {1e-2, 1e-3, 1e-5}) {  // of the ticks, may be longer
    std::puts(ph::describe(ph::offer_longest_tick(touch.timing().lengths, share,
                                                  {.mass = 0.1, .damping = 0.3, .force_limit = 9}),
                           text));
  }
  if (seen.triggered()) ph::save(seen, "scope.csv");
}
