// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a boot is told, and what it tells.

#include <passive_haptics/falcon/ftdi.hpp>
#include <passive_haptics/falcon/result.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

enum class firmware_policy : byte {
  probe_then_load,  ///< load only if nothing answers
  always_load,      ///< probing an empty device is said to spoil the next load
  never_load,       ///< probe only
  assume_running,   ///< not even that: for replays
};

enum class boot_step : byte { probe, hello, loader, image, program };

[[nodiscard]] constexpr const char* to_string(boot_step s) noexcept {
  switch (s) {
    case boot_step::probe:
      return "probe";
    case boot_step::hello:
      return "hello";
    case boot_step::loader:
      return "loader";
    case boot_step::image:
      return "image";
    case boot_step::program:
      return "program";
  }
  return "unknown step";
}

struct boot_options {
  firmware_policy policy = firmware_policy::probe_then_load;
  int attempts = 10;                                    ///< to load the image; users report 1 to 10
  int hellos = 10;                                      ///< in each attempt
  int probes = 10;                                      ///< packets to send until one is answered
  nanoseconds answer = std::chrono::milliseconds(100);  ///< to wait for monitor and loader
  nanoseconds reply = std::chrono::milliseconds(30);    ///< to wait for a packet
  nanoseconds clear_to_send = std::chrono::milliseconds(200);  ///< to wait for CTS
  bool flush_on_closing = false;  ///< '>' as event character: may beat 1 kHz, never tried
};

struct boot_report {
  result how{};
  boot_step step = boot_step::probe;  ///< the last one taken
  int attempts = 0;                   ///< to load
  std::size_t echoed = 0;             ///< bytes of the image, in the last attempt
  bool clear_to_send = false;         ///< was CTS seen before the loader was called?
};

/// Takes any callable bool(boot_step, done, all); false cancels.
struct no_progress {
  constexpr bool operator()(boot_step /*step*/, std::size_t /*done*/,
                            std::size_t /*all*/) const noexcept {
    return true;
  }
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
