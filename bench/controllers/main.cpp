// SPDX-License-Identifier: BSD-3-Clause
// controllers: every controller of the library on the same walls, under the same adversaries.
//
//     controllers --out DIR                    everything: a few minutes on two cores
//     controllers --quick --only adversaries   a first look
//     controllers --shard 2/8 --out DIR        a part of the Z-width sweep, for a job array
//     controllers --merge DIR/z_width_*.csv --out DIR

#include "program.hpp"

#include <csignal>

namespace {

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, [](int) { stop = true; });
  return controllers::run({argv + 1, argv + argc}, controllers::catalogue(), stop);
}
