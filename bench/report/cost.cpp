// SPDX-License-Identifier: BSD-3-Clause
#include "cost.hpp"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace experiments {
namespace {

/// A string as one word of the shell.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// "Collected : 123" of callgrind, or NaN.
double collected(const std::string& program, const std::string& name, long ticks) {
  const std::string command = "valgrind --tool=callgrind --callgrind-out-file=/dev/null " +
                              quoted(program) + " --replay " + quoted(name) + " --ticks " +
                              std::to_string(ticks) + " 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) return std::nan("");
  double count = std::nan("");
  char line[256];
  while (std::fgets(line, sizeof line, pipe.get()) != nullptr) {
    const std::string text = line;
    const auto found = text.find("Collected : ");
    if (found != std::string::npos) count = std::strtod(text.c_str() + found + 12, nullptr);
  }
  return count;
}

}  // namespace

double instructions_per_tick(const std::string& program, const std::string& name) {
  constexpr long few = 1000, many = 11000;
  return (collected(program, name, many) - collected(program, name, few)) / (many - few);
}

}  // namespace experiments
