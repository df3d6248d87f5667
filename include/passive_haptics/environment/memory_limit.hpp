// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The memory that a body may take. It is predicted from the pattern of its matrix and refused before use.

#include <passive_haptics/environment/refuse.hpp>
#include <passive_haptics/environment/stiffness_solver.hpp>

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// The memory that the system can give without swapping [B]; none where it does not say (other than Linux).
[[nodiscard]] inline std::optional<double> available_memory() {
#ifdef __linux__
  std::ifstream info("/proc/meminfo");
  for (std::string name; info >> name;) {
    double kibibytes = 0.0;
    if (name == "MemAvailable:" && info >> kibibytes) return 1024.0 * kibibytes;
    info.ignore(200, '\n');
  }
#endif
  return std::nullopt;
}

/// Throws memory_refused if `bytes` exceed `limit` [B]. A limit of 0 stands for available_memory(), or 8 GB where
/// the system does not say.
inline void check_memory(std::string_view what, double bytes, double limit, std::size_t nodes) {
  const double most = limit > 0.0 ? limit : available_memory().value_or(8e9);
  if (bytes <= most) return;
  refuse(memory_refused(
      sentence(what, ": ", nodes, " free nodes need ", bytes * 1e-9, " GB and ", most * 1e-9,
               " GB are allowed; give a coarser mesh, or a larger memory_limit"),
      bytes));
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
