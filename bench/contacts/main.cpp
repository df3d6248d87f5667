// SPDX-License-Identifier: BSD-3-Clause
// contacts: what several contacts at once, curved ones, rough ones and tools do to a hand and to a ledger.
//
//     contacts --out DIR               writes contacts.{json,md}, plots and index.html
//     contacts --quick --out DIR       a first look
//     contacts --only settling,news    some of the sections

#include "program.hpp"

#include <csignal>

namespace {

std::atomic<bool> stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, [](int) { stop = true; });
  return contacts::run({argv + 1, argv + argc}, stop);
}
