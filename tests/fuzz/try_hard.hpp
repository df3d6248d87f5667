// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A fuzz target with inputs of our own making, for compilers without a fuzzer.
#include "support/catch.hpp"

#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

/// Noise, with a bias to bytes that mean something to a target.
inline std::vector<std::uint8_t> made_up(std::mt19937& random, std::string_view telling) {
  std::vector<std::uint8_t> bytes(random() % 600);
  const unsigned bias = random() % 4;
  for (auto& b : bytes) {
    const bool tells = random() % 4 < bias;
    b = tells ? static_cast<std::uint8_t>(telling[random() % telling.size()])
              : static_cast<std::uint8_t>(random() & 255);
  }
  return bytes;
}

template <class Target>
void try_hard(Target target, std::string_view telling) {
  constexpr unsigned seed = 20240607;
  std::mt19937 random(seed);
  for (int n = 0; n < 5000; ++n) {
    const auto bytes = made_up(random, telling);
    if (const char* broken = target(bytes)) FAIL(broken << ", input " << n << ", seed " << seed);
  }
  SUCCEED();
}
