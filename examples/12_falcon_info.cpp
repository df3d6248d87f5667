// SPDX-License-Identifier: BSD-3-Clause
// Which Falcons are there, do they run a program, and where is the grip?
//     12_falcon_info [firmware.bin]      loads the image first if the device holds no program
//     12_falcon_info --simulate          needs no device: its output is the text beside this file

#include "falcon_ready.hpp"

void list() {
#if __has_include(<libusb-1.0/libusb.h>)
  std::array<falcon::listed_device, 8> found;
  const std::size_t n = falcon::list_devices(found);
  for (const auto& one : std::span(found).first(std::min(n, found.size()))) {
    std::printf("bus %d device %d serial '%s': %s\n", one.bus, one.address, one.serial.data(),
                falcon::to_string(one.openable.what));
  }
#endif
}

template <class Device>
int inspect(Device& grip) {
  for (int n = 0; n < 3; ++n) {
    const auto sample = grip.exchange(scene::zero());
    const auto& latest = grip.latest();
    const auto& counts = latest.received.encoder;
    std::printf("%s: counts %d %d %d, x %.4f y %.4f z %.4f m, dt %.2f ms, buttons %d\n",
                falcon::to_string(latest.where), counts[0], counts[1], counts[2],
                sample.position[0], sample.position[1], sample.position[2], sample.dt * 1e3,
                latest.received.buttons);
  }
  const auto& counts = grip.latest().counts;
  std::printf("%d replies, %d missed, %d late\n", static_cast<int>(counts.replies),
              static_cast<int>(counts.misses), static_cast<int>(counts.stale));
  return 0;
}

int main(int argc, char** argv) {
  list();
  return with_falcon(argc, argv, falcon::cautious_gain<double>, {.runs = true, .homed = true},
                     ph::simulation::no_hand<scene>{}, [](auto& grip) { return inspect(grip); });
}
