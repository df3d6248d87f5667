// SPDX-License-Identifier: BSD-3-Clause
// organ: how long large finite elements take to be factorised, pressed and touched, and what they hold.
//
//     organ --out DIR             cubes of 1 000 and 10 648 nodes, by every solver there is; error against
//                                 run time; and a minute of the whole chain in real threads
//     organ --only chain          one part: solvers, precision, chain, remote, deflections
//     organ --large --out DIR     97 336 nodes, too: 5 GB and some minutes
//     organ --quick --out DIR     a first look

#include "program.hpp"

#include <csignal>

namespace {

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, [](int) { stop = true; });
  return organ::run({argv + 1, argv + argc}, stop);
}
