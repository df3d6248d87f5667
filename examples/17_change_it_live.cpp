// SPDX-License-Identifier: BSD-3-Clause
// A session with a device: how late is its loop? Then touch a wall, change it while it is touched, let
// it go, and start anew. The controller is an ordinary class member.

#include <passive_haptics/identification/measure_latency.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;
using simulated = sim::device<scene, sim::constant_hand<scene>>;

class session {
 public:
  explicit session(simulated& device) : device_(device) {}

  void press(const char* what, int ticks) {
    ph::tick_result<scene> out{};
    double position = 0.0;
    for (int n = 0; n < ticks; ++n) {
      const auto sample = device_.exchange(force_);
      out = touch_.tick(sample);
      force_ = out.force;
      position = sample.position;
    }
    std::printf("%-22s %5.2f N at %5.2f mm, %s\n", what, out.force, 1e3 * position,
                ph::to_string(out.what));
  }
  ph::touch<scene>& touch() { return touch_; }

 private:
  simulated& device_;
  double force_ = 0.0;
  ph::touch<scene> touch_ = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.03, .force_limit = 9.0, .longest_tick = 1e-3}, {.force = 5.0});
};

int main() {
  simulated loose{{.mass = 0.1, .quantum = 1e-5, .latency = 2}, {}};
  const auto found = ph::measure_latency<scene>(loose);
  std::printf("held %d ticks late, a sensor as fast as the loop: %s\n", found.ticks,
              found.sensor_ticks == 1 ? "yes" : "no");

  simulated device{{.mass = 0.1, .start = 1e-3}, {.push = -3.0}};
  session now(device);
  (void)now.touch().update({0.0, 1.0, 1000.0});  // a point, its normal, N/m
  now.press("3 N on 1000 N/m", 2000);

  const auto fault = now.touch().set(ph::actuator_limit{.most = -1.0});
  std::printf("refused: %s = %g, must be %s\n", fault.parameter, fault.value, fault.remedy);
  (void)now.touch().set(ph::actuator_limit{.most = 2.0});  // weaker motors: 3 N go through
  now.press("motors of 2 N", 50);

  now.touch().release();  // the environment has nothing there any more
  now.press("released", 200);
  now.touch().reset();  // for another hand, elsewhere
  std::printf("anew: E1 = %g J\n", now.touch().energy());
}
