// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Falcon's device over a scripted far side, homed and at full strength. The far side holds the
// last motor words it got, so `box.last.motor` is what the hand feels.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/falcon/device.hpp>

using falcon::code;
using falcon::state;
using grip = falcon::device<falcon::in_memory_transport<scripted_falcon>>;

inline constexpr double k = falcon::cautious_gain<double>;
inline const d3::vector push(1.0, -0.5, 2.0);  // N
inline constexpr falcon::dac_words nothing{};

/// A device on the far side that runs and is homed, or what `legs` says.
struct falcon_bench {
  explicit falcon_bench(falcon::byte legs = 7, const falcon::settings<double>& setup = {})
      : device(k, setup), box(device.line().peer()) {
    box.now = scripted_falcon::mode::running;
    box.homed = legs;
    REQUIRE(device.open());
    REQUIRE(device.start());
  }

  auto exchange(const d3::vector& force = push) { return device.exchange(force); }

  /// Homed, and the ramp over.
  void warm_up() {
    for (int n = 0; n < 700; ++n) (void)exchange();
    REQUIRE(device.where() == state::homed);
    REQUIRE_THAT(device.latest().strength, Catch::Matchers::WithinAbs(1.0, 0.0));
    REQUIRE(box.last.motor != nothing);
  }

  /// After a disturbance: zero in the next packets, then forces again, without help.
  void recovers(int within = 700) {
    (void)exchange();
    CHECK(box.last.motor == nothing);
    int n = 0;
    while (n < within && device.latest().strength < 1.0) {
      (void)exchange();
      ++n;
    }
    CHECK(device.where() == state::homed);
    CHECK(device.latest().what == code::ok);
    CHECK(box.last.motor != nothing);
  }

  grip device;
  scripted_falcon& box;
};

/// Spoils the next reply only.
inline void spoil_once(scripted_falcon& box, std::function<void(std::vector<falcon::byte>&)> how) {
  box.on_reply = [how](scripted_falcon& self, std::vector<falcon::byte>& bytes) {
    how(bytes);
    self.on_reply = nullptr;
  };
}
