// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The shared test vectors of the Falcon. The exact_ columns were computed apart, in another
// language; the lib_ columns are what another driver answers, bugs included.
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
  std::array<double, 3> theta{};                      ///< as the other driver has it [rad]
  std::array<double, 3> theta2{}, theta3{};           ///< of each leg [rad]
  passive_haptics::falcon::force<double> force{};     ///< [N]
  passive_haptics::falcon::point<double> position{};  ///< exact [m]
  passive_haptics::falcon::torques<double> torque{};  ///< exact [N·m]
  std::array<int, 3> words{};          ///< exact, at 10⁴ counts per N·m, unlimited
  std::array<int, 3> library_words{};  ///< of the other driver
};

/// None when there is no such file.
inline std::vector<falcon_vector> read_falcon_vectors(const std::string& path) {
  std::ifstream file(path);
  std::vector<falcon_vector> all;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
    falcon_vector v;
    v.has_counts = !row.at("enc0").empty();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string leg = std::to_string(i);
      const std::string axis(1, static_cast<char>('x' + i));
      if (v.has_counts) v.counts[i] = std::stoi(row.at("enc" + leg));
      v.theta[i] = std::stod(row.at("theta" + leg + "_rad"));
      v.theta2[i] = std::stod(row.at("ik_t2_leg" + leg));
      v.theta3[i] = std::stod(row.at("ik_t3_leg" + leg));
      v.force[i] = std::stod(row.at("f" + axis + "_N"));
      v.position[i] = std::stod(row.at("exact_" + axis + "_m"));
      v.torque[i] = std::stod(row.at("exact_tau" + leg + "_Nm"));
      v.words[i] = std::stoi(row.at("exact_dac" + leg + "_1e4"));
      v.library_words[i] = std::stoi(row.at("lib_dac" + leg));
    }
    all.push_back(v);
  }
  return all;
}
