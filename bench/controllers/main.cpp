// SPDX-License-Identifier: BSD-3-Clause
// controllers: every controller of the library on the same walls, under the same adversaries.
//
//     controllers --out DIR                    everything: a few minutes on two cores
//     controllers --quick --only adversaries   a first look
//     controllers --seed 2 --out DIR           the same, drawn anew
//     controllers --shard 2/8 --out DIR        a part of the Z-width sweep, for a job array
//     controllers --merge DIR/z_width_*.csv --out DIR

#include "../common/interruptible.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, [](const auto& arguments, const auto& stop) {
    return controllers::run(arguments, controllers::catalogue(), stop);
  });
}
