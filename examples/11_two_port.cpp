// SPDX-License-Identifier: BSD-3-Clause
// A hand presses on a stiff spring that is 25 ms away each way, over a network that loses every
// tenth packet. Both ends count their energy, so nothing in between can create any.

#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/simulation/channel.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/two_port.hpp>

#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;
using packet = ph::port_packet<double, double>;

constexpr double T = 1e-3, K = 2000.0, loan = 1e-3;
constexpr auto force_at = [](double tool) { return tool > 0 ? -K * tool : 0.0; };
constexpr auto stored_at = [](double tool) { return force_at(tool) * -tool / 2; };

void press(bool controlled) {
  std::puts(controlled ? "two-port, lent 0.0010 J:" : "bare:");
  ph::impedance_side hand_end{
      scene{}, ph::two_port_energy{.damping = 1.0, .share = 0.5}, ph::strict_bound{},
      ph::loop_limits{
          .longest_tick = T, .top_speed = 100.0, .workspace = 10.0}};  // `bare` goes far
  ph::admittance_side<scene> tool_end{{.stiffness = K, .drift_rate = 20.0, .loan = loan}};
  sim::channel<packet> up({.delay = 0.025, .loss = 0.1}, 1), down({.delay = 0.025, .loss = 0.1}, 2);
  sim::device<scene, sim::impedance_hand<scene>> device({.damping = 1.0},
                                                        {.stiffness = 500.0, .target = 0.02});
  double bare_force = 0.0, bare_position = 0.0, tool = 0.0, least = 0.0;
  auto sample = device.exchange(0.0);
  for (int n = 1; n <= 1000; ++n) {
    const double now = device.time();
    while (const packet* p = up.take(now)) hand_end.receive(*p), bare_force = p->payload;
    const double force = hand_end.tick(sample).force;
    down.send(hand_end.packet(), now);

    while (const packet* p = down.take(now)) tool_end.receive(*p), bare_position = p->payload;
    const double before = stored_at(tool);
    const double step = tool_end.step(force_at(tool), ph::seconds{T}).displacement;
    tool = controlled ? tool + step : bare_position;
    tool_end.settle(before - stored_at(tool));
    up.send(tool_end.packet(force_at(tool)), now);

    sample = device.exchange(controlled ? force : bare_force);
    least = std::min(least, device.meter().value() - stored_at(tool));  // of both ends together
    if (n % 200 == 0) {
      std::printf("%.1f s  hand %6.1f mm  tool %6.1f mm  force %6.1f N\n", now,
                  1e3 * device.position(), 1e3 * tool, sample.held);
    }
  }
  std::printf("created on the way: %.4f J\n", -least);
}

int main() {
  press(false);
  press(true);
}
