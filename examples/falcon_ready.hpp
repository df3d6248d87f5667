// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the Falcon's examples have in common: the real device, or with --simulate one that is not
// there; a program loaded, homed, and then the example's own work.

#include <passive_haptics/falcon/boot.hpp>
#include <passive_haptics/falcon/in_memory_transport.hpp>
#include <passive_haptics/falcon/mock.hpp>
#include <passive_haptics/falcon_hid.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cstdio>
#include <string_view>

namespace ph = passive_haptics;
namespace falcon = passive_haptics::falcon;
using scene = ph::space<double, 3>;
using simulated_falcon = falcon::mock_parameters<ph::simulation::device_parameters<scene>>;

inline int complain(const falcon::result& fault) {
  std::array<char, 160> text{};
  std::puts(falcon::describe(fault, text));
  return 1;
}

/// closed → homed, forces at full strength. The image is used only if the device holds no program.
template <class Device>
falcon::result make_ready(Device& grip, const char* image_path) {
  static falcon::firmware image;
  if (image_path != nullptr) {
    if (const auto done = image.load(image_path); !done) return done;
  }
  if (const auto done = grip.open(); !done) return done;
  const auto report = falcon::boot(grip, image.bytes());
  if (!report.how) return report.how;
  std::puts(report.attempts > 0 ? "program loaded" : "a program is running");
  std::puts("pull the grip fully out, then push it fully in");
  if (const auto done = grip.home(std::chrono::minutes(1)); !done) return done;
  while (grip.where() == falcon::state::homed && grip.latest().strength < 1) {
    (void)grip.exchange(scene::zero());
  }
  return {};
}

/// While a reply is waited for, the last force is held: longest_tick has to cover that.
inline constexpr falcon::settings<double> patience{.reply = std::chrono::milliseconds(2)};

/// `use` gets the homed device and returns what main() returns.
///     program [FIRMWARE]      program --simulate      program --help
template <class Hand, class Use>
int with_falcon(int argc, char** argv, double gain, const simulated_falcon& simulated,
                const Hand& hand, const Use& use) {
  const auto run = [&use](auto& grip, const char* image_path) {
    if (const auto done = make_ready(grip, image_path); !done) return complain(done);
    const int code = use(grip);
    const auto closed = grip.close();
    return closed ? code : complain(closed);
  };
  const char* argument = argc > 1 ? argv[1] : nullptr;
  const std::string_view said = argument != nullptr ? argument : "";
  if (said == "--help" || said == "-h") {
    std::printf(
        "usage: %s [--simulate | FIRMWARE]\n"
        "  --simulate  a device that is not there\n"
        "  FIRMWARE    the image to load if the device holds no program: docs/falcon.md\n",
        argv[0]);
    return 0;
  }
  if (said == "--simulate") {
    using mock = falcon::mock<ph::simulation::device<scene, Hand>>;
    falcon::device<falcon::in_memory_transport<mock>> grip{gain, patience, simulated, hand};
    return run(grip, nullptr);
  }
#if __has_include(<libusb-1.0/libusb.h>)
  falcon::device<falcon::libusb_transport> grip{gain, patience};
  return run(grip, argument);
#else
  return std::puts("built without libusb: try --simulate"), 1;
#endif
}
