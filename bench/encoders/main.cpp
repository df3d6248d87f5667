// SPDX-License-Identifier: BSD-3-Clause
// encoders: what a hand feels of a guaranteed wall on devices with encoder steps and elastic friction.
//
//     encoders --out DIR               writes encoders.{json,md}, plots and index.html
//     encoders --quick --out DIR       a first look
//     encoders --only gentle_touch     of gentle_touch, endurance, guarantee

#include "program.hpp"

#include <csignal>

namespace {

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, [](int) { stop = true; });
  return encoders::run({argv + 1, argv + argc}, encoders::compositions(), stop);
}
