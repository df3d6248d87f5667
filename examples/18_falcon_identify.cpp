// SPDX-License-Identifier: BSD-3-Clause
// What is your Falcon? A minute an axis, and it says its own mass, damping, friction and steps, and the
// controller that may rest on them. Let go of the grip when it says so; Ctrl-C lets it go at once.
//     18_falcon_identify [firmware.bin]
//     18_falcon_identify --simulate     a simulated Falcon of 0.25 kg and 1 N·s/m

#include "falcon_ready.hpp"
#include <passive_haptics/identification.hpp>

#include <atomic>
#include <csignal>

namespace identification = ph::identification;

std::atomic<bool> stop = false;

template <class Device>
int identify(Device& grip) {
  const identification::identification_parameters p{.force = 3, .stroke = 8e-3, .workspace = 30e-3};
  std::printf("up to %.0f N, %.0f mm to either side, a minute each along x, y, z: let go\n",
              p.force, 1e3 * p.stroke);
  const auto found = identification::identify<scene>(grip, p, [] { return stop.load(); });
  if (found.problem() != nullptr) return std::puts(found.problem()), 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::printf("%c\n%s", "xyz"[axis], identification::table_of(found.axes[axis]).c_str());
  }
  std::printf("\n%s", identification::composition_of(found).c_str());
  const auto fault = identification::save("falcon_identified.txt", found, "Novint Falcon");
  return fault.empty() ? 0 : (std::puts(fault.c_str()), 1);
}

int main(int argc, char** argv) {
  std::signal(SIGINT, [](int) { stop = true; });
  simulated_falcon simulated{.runs = true, .homed = true};
  simulated.body.mass = 0.25;
  simulated.body.damping = 1;
  return with_falcon(argc, argv, falcon::cautious_gain<double>, simulated,
                     ph::simulation::no_hand<scene>{}, [](auto& grip) { return identify(grip); });
}
