// SPDX-License-Identifier: BSD-3-Clause
// organ: how long large finite elements take to be factorised, pressed and touched, and what they hold.
//
//     organ --out DIR             cubes of 1 000 and 10 648 nodes, by every solver there is; error against
//                                 run time; and a minute of the whole chain in real threads
//     organ --only chain          one part: solvers, precision, between, chain, remote, deflections
//     organ --large --out DIR     97 336 nodes, too: 5 GB and 20 minutes
//     organ --quick --out DIR     a first look

#include "../common/interruptible.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, organ::run);
}
