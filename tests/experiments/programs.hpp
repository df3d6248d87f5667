// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the programs of the benches as their users do: with arguments, into a folder.

#include "support/scratch_folder.hpp"

#include <atomic>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace programs {

inline std::string content(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}
inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

struct outcome {
  int code;
  std::string complaint;
};

/// What run() returns, its output kept.
outcome quietly(auto run) {
  std::ostringstream out, err;
  auto* const cout_buffer = std::cout.rdbuf(out.rdbuf());
  auto* const cerr_buffer = std::cerr.rdbuf(err.rdbuf());
  const int code = run();
  std::cout.rdbuf(cout_buffer);
  std::cerr.rdbuf(cerr_buffer);
  return {code, err.str()};
}

}  // namespace programs
