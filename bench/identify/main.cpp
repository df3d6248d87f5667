// SPDX-License-Identifier: BSD-3-Clause
// identify: what a device is, measured on it.
//
//     identify --device Touch --write touch.txt     a simulated one, and the controller that rests on it
//     identify --read touch.txt                     the same from the file
//     identify --weigh-in 0.2 --gain 0.9            how much force motors deliver, by a mass of 0.2 kg
//     identify --weigh-in 0.2 --pose 0,-1/0.1,0.2/0,0.15 --pose ...   the same of motors behind a linkage
//     identify --study 1000 --out DIR               how often the bounds hold, on devices drawn at random
//
// A real device: examples/18_falcon_identify.cpp, or identification::identify() on your own.

#include "../common/interruptible.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, identify::run);
}
