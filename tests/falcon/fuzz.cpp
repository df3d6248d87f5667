// SPDX-License-Identifier: BSD-3-Clause
// The fuzz targets with inputs of our own making, for compilers without a fuzzer.
#include "fuzz/targets.hpp"
#include "fuzz/try_hard.hpp"

TEST_CASE("no bytes upset the parser, which is in step with the next packet", "[falcon][fuzz]") {
  try_hard(fuzz::parser, "<>ABP");
}

TEST_CASE("no bytes upset a boot, which always ends", "[falcon][fuzz]") {
  try_hard(fuzz::boot, "\x03\x04\x06\x07\x01");
}

TEST_CASE("no bytes and no commands bring a force outside of homed", "[falcon][fuzz]") {
  try_hard(fuzz::device, "\x03\x04\x05\x02\x80");
}
