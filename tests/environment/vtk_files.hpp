// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers as VTK and VTU files have them, and what must hold of a reader whatever the bytes.
#include "environment/shapes.hpp"
#include <passive_haptics/environment/mesh_file.hpp>
#include <passive_haptics/environment/vtk_writer.hpp>

#include <bit>
#include <cstdint>
#include <sstream>

namespace vtk_files {

using load = env::loaded_mesh (*)(std::istream&, std::string_view);

inline std::string fault(load read, const std::string& bytes) {
  std::istringstream in(bytes);
  const auto loaded = read(in, "body");
  return loaded.fault ? loaded.fault->what() : "";
}

/// Five points, the last one in no tetrahedron.
inline const std::vector<double> five_points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1.25, 9, 9, 9};

/// Numbers of a type by either of its names: "text", or bytes in "big" or "little" order.
inline std::string numbers(const std::string& type, const std::string& how,
                           const std::vector<double>& values) {
  const auto are = env::vtk_numbers::of(type, env::vtk_numbers::encoding::text);
  REQUIRE(are.bytes > 0);
  std::string result;
  for (const double value : values) {
    if (how == "text") {
      result += env::sentence(value, ' ');
      continue;
    }
    std::uint64_t word = 0;
    if (are.is != env::vtk_numbers::kind::real) {
      word = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
    } else if (are.bytes == 8) {
      word = std::bit_cast<std::uint64_t>(value);
    } else {
      word = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    }
    for (std::size_t i = 0; i < are.bytes; ++i) {
      const std::size_t at = how == "big" ? are.bytes - 1 - i : i;
      result += static_cast<char>(word >> (8 * at) & 255U);
    }
  }
  return result;
}

/// Cut off before `needed` bytes it is refused; with any byte changed it is refused, or makes a mesh without
/// a fault.
inline void survives_damage(load read, const std::string& good, std::size_t needed) {
  REQUIRE(fault(read, good).empty());
  for (std::size_t size = 0; size < needed; size += 1 + size / 40) {
    CHECK_FALSE(fault(read, good.substr(0, size)).empty());
  }
  std::mt19937 random(41);
  int refused = 0;
  for (int run = 0; run < 100; ++run) {
    std::string bad = good;
    bad[random() % bad.size()] = static_cast<char>(random() % 256);
    std::istringstream in(bad);
    const auto loaded = read(in, "body");
    refused += loaded.fault ? 1 : 0;
    if (!loaded.fault) CHECK_FALSE(env::find_fault(loaded.mesh));
  }
  CHECK(refused > 5);
}

}  // namespace vtk_files
