// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A folder for the files of a test. Tests run at the same time, so each has a folder of its own.

#include <filesystem>
#include <random>
#include <string>

/// A new empty folder, which is removed with the object.
class scratch_folder {
 public:
  scratch_folder() {
    std::random_device draw;
    do {
      path_ = std::filesystem::temp_directory_path() /
              ("passive_haptics_" + std::to_string(draw()) + "_" + std::to_string(draw()));
    } while (!std::filesystem::create_directory(path_));  // another test has that one
  }
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;
  ~scratch_folder() {
    std::error_code gone_already;
    std::filesystem::remove_all(path_, gone_already);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::string operator/(const std::string& file) const {
    return (path_ / file).string();
  }

 private:
  std::filesystem::path path_;
};
