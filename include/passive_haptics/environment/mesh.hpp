// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tetrahedral meshes: what a mesh is, what makes one unusable, and the text that says so.
//
//   tetrahedral_mesh       nodes [m] and four node numbers per element
//   find_fault, check      the first thing wrong with it, as a value or as a mesh_error
//   oriented               turns a mesh whose elements are ALL inverted: a convention, not a fault
//   scaled                 another unit of length: scaled(mesh, 1e-3) takes mm to m
//
// Numbers of nodes and elements count from 0. This room is the slow side: it may use the heap and
// throw (refuse.hpp says how, and what stands for it where there are no exceptions); nothing in it
// belongs into the haptic tick.

#include <passive_haptics/environment/refuse.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// Linear (4-node) tetrahedra. Element (a, b, c, d) is upright when d lies on the side of the face
/// abc from which a→b→c turns counter-clockwise: signed_volume > 0.
struct tetrahedral_mesh {
  std::vector<Eigen::Vector3d> nodes;          ///< [m]
  std::vector<std::array<int, 4>> tetrahedra;  ///< indices into nodes
};

/// The fault that check() throws, before it is put into words for one kind of reader.
struct mesh_fault {
  int node = -1;         ///< the node at fault, or −1
  int tetrahedron = -1;  ///< the element at fault, or −1
  std::string problem;
  std::string remedy;
};

/// V = (b − a)×(c − a)·(d − a)/6 [m³], positive for an upright element. std::out_of_range for a
/// node that does not exist.
[[nodiscard]] inline double signed_volume(const tetrahedral_mesh& mesh,
                                          const std::array<int, 4>& tetrahedron) {
  const auto node = [&](std::size_t corner) -> const Eigen::Vector3d& {
    return mesh.nodes.at(static_cast<std::size_t>(tetrahedron[corner]));
  };
  return (node(1) - node(0)).cross(node(2) - node(0)).dot(node(3) - node(0)) / 6.0;
}

/// V/L³ with L the longest edge: 0.118 for a regular element, below flat_element for a flat one.
[[nodiscard]] inline double relative_volume(const tetrahedral_mesh& mesh,
                                            const std::array<int, 4>& tetrahedron) {
  double longest = 0.0;
  for (const int a : tetrahedron) {
    for (const int b : tetrahedron) {
      const auto edge =
          mesh.nodes.at(static_cast<std::size_t>(a)) - mesh.nodes.at(static_cast<std::size_t>(b));
      longest = (std::max)(longest, edge.norm());
    }
  }
  return signed_volume(mesh, tetrahedron) / (longest * longest * longest);
}

inline constexpr double flat_element = 1e-9;  ///< relative volume of an element that has none

/// The first fault of a mesh, none if it can be used: it has nodes and elements; coordinates are
/// finite; every element has four different nodes that exist, a volume, and stands upright; no
/// element occurs twice; every node belongs to an element.
[[nodiscard]] inline std::optional<mesh_fault> find_fault(const tetrahedral_mesh& mesh) {
  const auto count = static_cast<int>(mesh.nodes.size());
  if (mesh.nodes.empty()) return mesh_fault{-1, -1, "has no nodes", "load or build a mesh first"};
  if (mesh.tetrahedra.empty()) {
    return mesh_fault{-1, -1, "has no tetrahedra", "mesh the volume, not only the surface"};
  }
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d& x = mesh.nodes[static_cast<std::size_t>(i)];
    if (!x.allFinite()) {
      return mesh_fault{i, -1, sentence("is not finite: ", x.transpose()), "mend its coordinates"};
    }
  }

  std::vector<bool> used(mesh.nodes.size(), false);
  std::vector<std::pair<std::array<int, 4>, int>> sorted;
  std::size_t inverted = 0;
  int first_inverted = -1;
  for (int e = 0; e < static_cast<int>(mesh.tetrahedra.size()); ++e) {
    const auto& tetrahedron = mesh.tetrahedra[static_cast<std::size_t>(e)];
    for (const int node : tetrahedron) {
      if (node < 0 || node >= count) {
        return mesh_fault{-1, e, sentence("names node ", node, " of ", count, " nodes"),
                          "node numbers count from 0"};
      }
      used[static_cast<std::size_t>(node)] = true;
    }
    auto key = tetrahedron;
    std::sort(key.begin(), key.end());
    if (const auto twin = std::adjacent_find(key.begin(), key.end()); twin != key.end()) {
      return mesh_fault{-1, e, sentence("names node ", *twin, " twice"), "remove the element"};
    }
    const double volume = relative_volume(mesh, tetrahedron);
    if (!(std::abs(volume) > flat_element)) {
      return mesh_fault{-1, e, sentence("has no volume (", volume, " of its longest edge cubed)"),
                        "remove it or mesh the volume again"};
    }
    if (volume < 0.0 && inverted++ == 0) first_inverted = e;
    sorted.emplace_back(key, e);
  }
  if (inverted == mesh.tetrahedra.size()) {
    return mesh_fault{-1, first_inverted, "is inverted, and so are all: the other node order",
                      "pass the mesh through oriented()"};
  }
  if (inverted > 0) {
    return mesh_fault{-1, first_inverted,
                      sentence("is inverted, as are ", inverted, " of ", mesh.tetrahedra.size()),
                      "swap two of its nodes if the order is wrong, else mesh the volume again"};
  }
  std::sort(sorted.begin(), sorted.end());
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  if (const auto twin = std::adjacent_find(sorted.begin(), sorted.end(), same);
      twin != sorted.end()) {
    return mesh_fault{-1, std::next(twin)->second, "repeats an earlier element",
                      "keep one: a volume in two physical groups is saved twice"};
  }
  if (const auto loose = std::find(used.begin(), used.end(), false); loose != used.end()) {
    return mesh_fault{static_cast<int>(loose - used.begin()), -1, "belongs to no tetrahedron",
                      "remove it: nothing holds it in place"};
  }
  return std::nullopt;
}

/// Throws mesh_error for the first fault found; `name` opens its text.
inline void check(const tetrahedral_mesh& mesh, std::string_view name = "mesh") {
  const auto fault = find_fault(mesh);
  if (!fault) return;
  std::string subject;
  if (fault->node >= 0) subject = sentence("node ", fault->node, " ");
  if (fault->tetrahedron >= 0) subject = sentence("tetrahedron ", fault->tetrahedron, " ");
  refuse(mesh_error(name, subject + fault->problem, fault->remedy));
}

/// The mesh with two nodes of every element swapped if all are inverted, else the mesh as it is: a
/// mixture is left for check() to refuse.
[[nodiscard]] inline tetrahedral_mesh oriented(tetrahedral_mesh mesh) {
  const bool all = std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(),
                               [&](const auto& t) { return signed_volume(mesh, t) < 0.0; });
  if (all) {
    for (auto& tetrahedron : mesh.tetrahedra) std::swap(tetrahedron[2], tetrahedron[3]);
  }
  return mesh;
}

/// Every coordinate times `factor` > 0. std::invalid_argument for any other factor.
[[nodiscard]] inline tetrahedral_mesh scaled(tetrahedral_mesh mesh, double factor) {
  if (!(factor > 0.0) || !std::isfinite(factor)) {
    refuse_argument("scaled: factor ", factor, " is refused; give a finite number above zero");
  }
  for (auto& node : mesh.nodes) node *= factor;
  return mesh;
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
