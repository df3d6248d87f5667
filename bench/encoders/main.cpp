// SPDX-License-Identifier: BSD-3-Clause
// encoders: what a hand feels of a guaranteed wall on devices with encoder steps and elastic friction.
//
//     encoders --out DIR               writes encoders.{json,md}, plots and index.html
//     encoders --quick --out DIR       a first look
//     encoders --only gentle_touch     of gentle_touch, endurance, tremor, crossed, nearest, held, guarantee

#include "../common/interruptible.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, [](const auto& arguments, const auto& stop) {
    return encoders::run(arguments, encoders::compositions(), stop);
  });
}
