// SPDX-License-Identifier: BSD-3-Clause
// published: what papers say of stiff walls, and what we get on the same model with the same numbers, in simulation.
//
//     published --out DIR              writes published.{json,md}, plots and index.html
//     published --quick --out DIR      fewer attacks and rates
//     published --only limits          of the sections that program.cpp lists

#include "../common/interruptible.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, [](const auto& arguments, const auto& stop) {
    return papers::run(arguments, stop);
  });
}
