// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The board: a timer, an encoder, a motor, a way to say something. On QEMU's mps2-an386 the timer
// is real, knob and hand are simulated in angle(), and the debugger listens. Replace it with yours.
#include <cstdint>
#include <limits>

namespace board {

inline volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}
inline void debugger(int request, const void* argument) {
  register int r0 asm("r0") = request;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}
inline void say(const char* text) {
  debugger(0x04, text);
}
inline void say(const char* what, unsigned number) {
  char digits[12] = {};
  char* end = digits + 11;
  do *--end = static_cast<char>('0' + number % 10);
  while ((number /= 10) != 0);
  say(what), say(": "), say(end), say("\n");
}
[[noreturn]] inline void stop(int code) {
  const std::uint32_t block[2] = {0x20026U, static_cast<std::uint32_t>(code)};
  for (;;) debugger(0x20, block);
}

inline void start_timer(std::uint32_t hertz) {
  at(0xE000E014) = 25000000 / hertz - 1;
  at(0xE000E018) = 0;
  at(0xE000E010) = 7;
}
inline void stop_timer() {
  at(0xE000E010) = 0;
}
inline void sleep() {
  asm volatile("wfi");
}

inline float applied = 0;
inline void torque(float newton_metres) {
  applied = newton_metres;
}

/// The encoder [rad]: a hand turns the knob against the stop and lets go, twice; one reading in the
/// middle is lost.
inline float angle() {
  static float at = 0.1F, speed = 0;
  static unsigned tick = 0;
  ++tick;
  const float hand = tick % 5000 < 3000 ? -0.02F : 0.01F;
  speed += (hand + applied - 2e-4F * speed) * (1e-4F / 1e-5F);
  at += speed * 1e-4F;
  if (at > 0.3F) at = 0.3F, speed = 0;
  return tick == 2000 ? std::numeric_limits<float>::quiet_NaN() : at;
}

}  // namespace board
