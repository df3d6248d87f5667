// SPDX-License-Identifier: BSD-3-Clause
// contacts: what several contacts at once, curved ones, rough ones and tools do to a hand and to a ledger.
//
//     contacts --out DIR               writes contacts.{json,md}, plots and index.html
//     contacts --quick --out DIR       a first look
//     contacts --only settling,news    some of the sections

#include "../common/interruptible.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, contacts::run);
}
