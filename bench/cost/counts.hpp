// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Instructions per tick: the rows that callgrind has counted, the committed rows, and the growth between them.

#include "../common/text.hpp"

#include <filesystem>
#include <istream>
#include <map>
#include <string>
#include <vector>

namespace cost {

/// All ticks of one path of one scene on one side.
struct counted {
  std::string scene, scalar, side, path;
  long ticks = 0;
  long instructions = 0;

  [[nodiscard]] double per_tick() const {
    return static_cast<double>(instructions) / static_cast<double>(ticks);
  }
  [[nodiscard]] std::string name() const {
    return scene + ", " + scalar + ", " + side + ", " + path;
  }
};

/// The counts of one build.
struct counts {
  std::string compiler;  ///< with its version: another compiler makes other instructions
  std::vector<counted> rows;

  /// The row of that name, or null.
  [[nodiscard]] const counted* find(const std::string& name) const;
  /// Composed, all paths of a scene together.
  [[nodiscard]] double per_tick(const std::string& scene, const std::string& scalar) const;
  /// Composed over by hand, all paths of a scene together.
  [[nodiscard]] double ratio(const std::string& scene, const std::string& scalar) const;
};

/// Reads what callgrind wrote with --compress-strings=no: the calls from along<path> to
/// probe<scene, state>.
[[nodiscard]] std::vector<counted> read_callgrind(std::istream& in);

/// Runs `program`, one of the count programs, under valgrind. Throws std::runtime_error if that fails.
[[nodiscard]] counts count(const std::filesystem::path& program,
                           const std::filesystem::path& scratch);
[[nodiscard]] bool valgrind_works();

/// Ticks of a finger on one mesh, each counted by itself.
struct mesh_ticks {
  long triangles = 0;
  double speed = 0.0;  ///< of the finger [m/s]
  int news = 0;        ///< a second
  long ticks = 0, instructions = 0, largest = 0;

  [[nodiscard]] double mean() const {
    return static_cast<double>(instructions) / static_cast<double>(ticks);
  }
  /// The largest tick over the mean one.
  [[nodiscard]] double spread() const { return static_cast<double>(largest) / mean(); }
};
/// Reads the dumps of count_meshes.cpp, a tick each.
[[nodiscard]] std::vector<mesh_ticks> read_mesh_dumps(std::istream& in);
/// Runs a build of count_meshes.cpp under valgrind; no rows where it was built without valgrind's headers.
[[nodiscard]] std::vector<mesh_ticks> count_meshes(const std::filesystem::path& program,
                                                   const std::filesystem::path& scratch);

/// The committed counts by compiler, as CSV: compiler,scene,scalar,side,path,instructions per tick.
using baseline = std::map<std::string, std::map<std::string, double>>;
[[nodiscard]] baseline read_baseline(std::istream& in);
void write_baseline(std::ostream& out, const std::vector<counts>& all);

/// A sentence for each row that grew by more than `tolerance` or is gone. If `known` is false there is no
/// baseline for that compiler.
struct growth {
  bool known = false;
  std::vector<std::string> sentences;
};
[[nodiscard]] growth compare(const baseline& committed, const counts& now, double tolerance = 0.01);

}  // namespace cost
