// SPDX-License-Identifier: BSD-3-Clause
// thesis_experiments: the thesis's system, end to end, on a simulated device.
//
//     thesis_experiments --out DIR                      wall, sweep, ball and an organ
//     thesis_experiments --mesh FILE.msh --out DIR      the 3-DOF part on your mesh

#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::run_thesis_experiments({argv + 1, argv + argc});
}
