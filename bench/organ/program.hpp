// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program without main(), so that a test can run it.

#include "../common/rows.hpp"
#include "../common/sections.hpp"

#include <atomic>
#include <string>
#include <vector>

namespace organ {

namespace ex = experiments;

struct settings : ex::section_settings {
  bool large = false;
  std::string mesh{};  ///< another organ
  double unit = 1e-3;  ///< of its coordinates [m]
  struct {
    int seconds = 60, side = 32, rate = 100;
    bool solve = false, planes = false;
  } chain{};
};

/// The settings of a command line. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: a figure was missed, or something could not be written. 2: an argument is
/// wrong. 130: stopped; nothing is half written.
[[nodiscard]] int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop);

}  // namespace organ
