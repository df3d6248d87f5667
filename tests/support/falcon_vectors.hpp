// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The test vectors of the Falcon in tests/data/. The exact_ columns were computed independently, in another
// language; the other_ columns are the answers of another driver, with its bugs.
#include "support/catch.hpp"
#include <passive_haptics/falcon/force.hpp>

#include <array>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

struct falcon_vector {
  bool has_counts = false;
  passive_haptics::falcon::counts counts{};
  std::array<double, 3> theta{}, theta2{}, theta3{};  ///< of each leg [rad]
  passive_haptics::falcon::force<double> force{};     ///< [N]
  passive_haptics::falcon::point<double> position{};  ///< [m]
  passive_haptics::falcon::torques<double> torque{};  ///< [N·m]
  std::array<int, 3> words{};                         ///< at 10⁴ counts per N·m, unlimited
  std::array<int, 3> other_words{};                   ///< of the other driver
};

/// Reads a table: each line after the line of names, as names and cells.
inline std::vector<std::map<std::string, std::string>> read_table(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream text(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

inline const std::vector<falcon_vector>& falcon_vectors() {
  static const auto all = [] {
    std::vector<falcon_vector> made;
    for (const auto& row : read_table(PASSIVE_HAPTICS_TEST_DATA "/falcon_vectors.csv")) {
      falcon_vector v;
      v.has_counts = !row.at("enc0").empty();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::string leg = std::to_string(i);
        const std::string axis(1, static_cast<char>('x' + i));
        if (v.has_counts) v.counts[i] = std::stoi(row.at("enc" + leg));
        v.theta[i] = std::stod(row.at("exact_theta1_leg" + leg));
        v.theta2[i] = std::stod(row.at("exact_theta2_leg" + leg));
        v.theta3[i] = std::stod(row.at("exact_theta3_leg" + leg));
        v.force[i] = std::stod(row.at("f" + axis + "_N"));
        v.position[i] = std::stod(row.at("exact_" + axis + "_m"));
        v.torque[i] = std::stod(row.at("exact_tau" + leg + "_Nm"));
        v.words[i] = std::stoi(row.at("exact_dac" + leg + "_1e4"));
        v.other_words[i] = std::stoi(row.at("other_dac" + leg));
      }
      made.push_back(v);
    }
    return made;
  }();
  REQUIRE(all.size() == 120);
  return all;
}
