// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers that the scenes are built with, composed and by hand: a knob-sized device at 5 kHz.

namespace replay {

template <class Real>
struct parameters {
  static constexpr Real longest_tick = Real(0.00025F);  // s
  static constexpr Real top_speed = Real(100);          // m/s
  static constexpr Real workspace = Real(2);            // m
  static constexpr Real watchdog = longest_tick;        // s
  static constexpr Real damping = Real(0.5F);           // N·s/m
  static constexpr Real mass = Real(0.1F);              // kg
  static constexpr Real hand_force = Real(5);           // N
  static constexpr Real rate = Real(20);                // rad/s
  static constexpr Real stale_after = Real(0.02F);      // s
  static constexpr Real fade = Real(0.01F);             // s
  static constexpr Real wall_stiffness = Real(5000);    // N/m
};

}  // namespace replay
