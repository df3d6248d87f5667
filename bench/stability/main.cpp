// SPDX-License-Identifier: BSD-3-Clause
// stability: every controller where it is stiff, slow, far away, tiny, late or no number at all.
//
//     stability --out DIR              writes stability.{json,csv,md}, plots and index.html
//     stability --quick --out DIR      seconds
//     stability --soak 1000000000      the long run in full

#include "program.hpp"

int main(int argc, char** argv) {
  return stability::run({argv + 1, argv + argc}, controllers::catalogue());
}
