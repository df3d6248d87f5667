// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An organ: any tetrahedral mesh, and where a hand strokes it.

#include "volume.hpp"
#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/tetrahedral_stiffness.hpp>

#include <Eigen/Geometry>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace experiments {

/// The organ for those who bring none, which tests/data/make_organ.py makes, and its unit [m].
inline constexpr const char* our_organ = PASSIVE_HAPTICS_TEST_DATA "/organ.msh";
inline constexpr double millimetre = 1e-3;

/// What every organ is made of.
inline constexpr env::material flesh{.young = 2e4, .poisson = 0.45};

/// A mesh in metres, and where it is from.
struct organ {
  env::tetrahedral_mesh mesh;
  std::string file;
  double unit = millimetre;          ///< [m] of the file's coordinates
  std::vector<std::string> notes{};  ///< what the reader had to say of the file
};

/// An organ that the experiment cannot use: "<file>: <what is wrong>; <what to do>".
struct unusable_organ : std::runtime_error {
  unusable_organ(const organ& which, const std::string& problem, const std::string& remedy)
      : std::runtime_error(which.file + ": " + problem + "; " + remedy) {}
};

[[nodiscard]] organ read_organ(const std::string& file, double unit);

/// "98 x 68 x 42 mm": the box around it.
[[nodiscard]] std::string size_of(const organ& which);
/// "with --unit 0.001 it measures 98 x 68 x 42 mm".
[[nodiscard]] std::string measured(const organ& which);
/// "give the unit of its coordinates, as --unit 1, which makes it ..." if there is one that makes it an
/// organ.
[[nodiscard]] std::string other_unit(const organ& which);

/// Where the hand goes, and what holds the organ. Up is the axis along which it is thinnest; its
/// lowest 15 % is fixed; the stroke runs over the middle 40 % of its longest axis, beside its middle
/// if that is a hole.
class stroke_scene {
 public:
  /// Throws unusable_organ if it cannot be held, or if there is nothing to stroke.
  explicit stroke_scene(organ which);

  static constexpr double approach = 0.3, stroke = 2.0, leave = 0.3;  ///< [s]
  static constexpr double total = approach + stroke + leave;

  /// Where the hand is at t [s]: 5 mm above the surface, then 1-3 mm below it, then away.
  [[nodiscard]] vector3 position(double t) const;
  [[nodiscard]] static bool stroking(double t) { return t >= approach && t <= approach + stroke; }
  [[nodiscard]] const organ& stroked() const { return organ_; }
  [[nodiscard]] const env::tetrahedral_mesh& mesh() const { return organ_.mesh; }
  [[nodiscard]] const std::vector<int>& fixed() const { return fixed_; }

 private:
  struct point_on_surface {
    vector3 point, normal;
  };
  void hold();
  void find_path();
  [[nodiscard]] std::vector<point_on_surface> path_beside(double aside) const;
  [[nodiscard]] std::optional<point_on_surface> top_over(const vector3& foot) const;
  [[nodiscard]] std::string axis(Eigen::Index which) const { return {"xyz"[which]}; }

  organ organ_;
  std::vector<env::surface_triangle> surface_;
  std::vector<int> fixed_;
  std::vector<vector3> vertex_normals_;
  std::vector<point_on_surface> path_;
  Eigen::AlignedBox3d box_;
  Eigen::Index up_ = 2, along_ = 0;
};

}  // namespace experiments
