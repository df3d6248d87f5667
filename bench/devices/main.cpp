// SPDX-License-Identifier: BSD-3-Clause
// devices: what a promise is worth on devices as they are, whose transmissions give and whose forces lag.
//
//     devices --out DIR                writes devices.{json,md}, plots and index.html
//     devices --quick --out DIR        a first look
//     devices --only compliance        of the sections that program.cpp lists

#include "../common/interruptible.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, [](const auto& arguments, const auto& stop) {
    return devices::run(arguments, stop);
  });
}
