// SPDX-License-Identifier: BSD-3-Clause
// replay: what a recording of a real axis says, of the axis and of what a ledger is told about it.
//
//     replay --read log.csv --position q --force tau             what it is, and what may be stated of it
//     replay --read log.mat --told grip.json                     is that description refuted?
//     replay                                                     the same on a recording that the simulator makes

#include "../common/interruptible.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, replaying::run);
}
