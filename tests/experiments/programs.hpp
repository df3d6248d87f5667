// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the programs of the benches as their users do: with arguments, into a folder.

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace programs {

namespace fs = std::filesystem;

/// A folder of its own for each run, gone afterwards.
class folder {
 public:
  explicit folder(const std::string& name)
      : path_(fs::temp_directory_path() / ("passive_haptics_bench_" + name)) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  folder(const folder&) = delete;
  folder& operator=(const folder&) = delete;
  ~folder() { fs::remove_all(path_); }
  [[nodiscard]] std::string operator/(const std::string& file) const {
    return (path_ / file).string();
  }

 private:
  fs::path path_;
};

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
