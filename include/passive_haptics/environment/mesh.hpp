// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tetrahedral meshes, the faults that make one unusable, and the text for each fault.
//
//   tetrahedral_mesh       nodes [m] and four node numbers per element
//   find_fault, check      the first fault of a mesh, as a value or as a mesh_error
//   bounds                 the box around it [m], which shows whether the unit of length is right
//   oriented               turns a mesh whose elements are ALL inverted, which is another convention
//   scaled                 changes the unit of length: scaled(mesh, 1e-3) takes mm to m
//
// Nodes and elements are numbered from 0. This room is the slow side: it may use the heap and throw
// (refuse.hpp says how, and what happens without exceptions); nothing in it belongs into the haptic tick.

#include <passive_haptics/base/language.hpp>
#include <passive_haptics/environment/refuse.hpp>
#include <passive_haptics/environment/triangle_weights.hpp>

#include <Eigen/Core>

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

/// A fault of a mesh, from which check() and msh_content make their texts.
struct mesh_fault {
  int node = -1;         ///< the node at fault, or −1
  int tetrahedron = -1;  ///< the element at fault, or −1
  int other = -1;        ///< the other element of an overlap, or −1
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
  const passive_haptics::mesh::triple a = triple_of(node(0));
  const passive_haptics::mesh::triple b = triple_of(node(1)), c = triple_of(node(2)),
                                      d = triple_of(node(3));
  return passive_haptics::mesh::dot(passive_haptics::mesh::cross(b - a, c - a), d - a) / 6.0;
}

/// V/L³ with L the longest edge: 0.118 for a regular element, below flat_element for a flat one.
[[nodiscard]] inline double relative_volume(const tetrahedral_mesh& mesh,
                                            const std::array<int, 4>& tetrahedron) {
  double longest = 0.0;
  for (const int a : tetrahedron) {
    for (const int b : tetrahedron) {
      const passive_haptics::mesh::triple from =
          triple_of(mesh.nodes.at(static_cast<std::size_t>(a)));
      const passive_haptics::mesh::triple to =
          triple_of(mesh.nodes.at(static_cast<std::size_t>(b)));
      longest = (std::max)(longest, passive_haptics::mesh::length(to - from));
    }
  }
  return signed_volume(mesh, tetrahedron) / (longest * longest * longest);
}

/// A face of an element. Two elements that share a face have one key and opposite cycles of nodes.
struct element_face {
  std::array<int, 3> key;    ///< the nodes, sorted
  std::array<int, 3> nodes;  ///< counter-clockwise from outside, the smallest number first
  int number;                ///< 4 · element + face

  [[nodiscard]] int tetrahedron() const noexcept { return number / 4; }
};

/// The four faces of every element, sorted by key and then by number.
[[nodiscard]] inline std::vector<element_face> sorted_faces(const tetrahedral_mesh& mesh) {
  // Outward faces of the upright element 0123.
  constexpr std::array<std::array<std::size_t, 3>, 4> corners{
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  std::vector<element_face> all;
  all.reserve(4 * mesh.tetrahedra.size());
  for (const auto& element : mesh.tetrahedra) {
    for (const auto& corner : corners) {
      int a = element[corner[0]], b = element[corner[1]], c = element[corner[2]];
      while (a > b || a > c) a = std::exchange(b, std::exchange(c, a));  // turns the cycle
      all.push_back(
          {{a, (std::min)(b, c), (std::max)(b, c)}, {a, b, c}, static_cast<int>(all.size())});
    }
  }
  std::sort(all.begin(), all.end(), [](const element_face& a, const element_face& b) {
    return a.key != b.key ? a.key < b.key : a.number < b.number;
  });
  return all;
}

/// The fault of two elements on the same side of a face (an element that is in the mesh twice) or of a
/// third element at a face; none if there is no such face. `sorted` comes from sorted_faces().
[[nodiscard]] inline std::optional<mesh_fault> find_overlap(
    const std::vector<element_face>& sorted) {
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto last = std::find_if(first, sorted.end(),
                                   [&](const element_face& f) { return f.key != first->key; });
    if (last - first > 2 || (last - first == 2 && first->nodes == std::next(first)->nodes)) {
      return mesh_fault{.tetrahedron = std::prev(last)->tetrahedron(),
                        .other = first->tetrahedron(),
                        .problem = "overlap at a common face",
                        .remedy = "keep one of them, or mesh the volume again"};
    }
    first = last;
  }
  return std::nullopt;
}

inline constexpr double flat_element = 1e-9;  ///< an element of a relative volume ≤ this is flat

/// The first fault of a mesh, or none if it can be used. A usable mesh has nodes and elements and finite
/// coordinates; every element has four different nodes that exist, a volume > 0 and is upright; every node
/// belongs to an element; no two elements overlap at a face.
[[nodiscard]] inline std::optional<mesh_fault> find_fault(const tetrahedral_mesh& mesh) {
  const auto count = static_cast<int>(mesh.nodes.size());
  if (mesh.nodes.empty()) {
    return mesh_fault{.problem = "has no nodes", .remedy = "load or build a mesh first"};
  }
  if (mesh.tetrahedra.empty()) {
    return mesh_fault{.problem = "has no tetrahedra",
                      .remedy = "mesh the volume, not only the surface"};
  }
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d& x = mesh.nodes[static_cast<std::size_t>(i)];
    if (!is_finite(triple_of(x))) {
      return mesh_fault{.node = i,
                        .problem = sentence("is not finite: ", x[0], " ", x[1], " ", x[2]),
                        .remedy = "mend its coordinates"};
    }
  }

  std::vector<char> used(mesh.nodes.size(), 0);
  std::size_t inverted = 0;
  int first_inverted = -1;
  for (int e = 0; e < static_cast<int>(mesh.tetrahedra.size()); ++e) {
    const auto& tetrahedron = mesh.tetrahedra[static_cast<std::size_t>(e)];
    for (const int node : tetrahedron) {
      if (node < 0 || node >= count) {
        return mesh_fault{.tetrahedron = e,
                          .problem = sentence("names node ", node, " of ", count, " nodes"),
                          .remedy = "node numbers count from 0"};
      }
      if (std::count(tetrahedron.begin(), tetrahedron.end(), node) > 1) {
        return mesh_fault{.tetrahedron = e,
                          .problem = sentence("names node ", node, " twice"),
                          .remedy = "remove the element"};
      }
      used[static_cast<std::size_t>(node)] = 1;
    }
    const double volume = relative_volume(mesh, tetrahedron);
    if (!(std::abs(volume) > flat_element)) {
      return mesh_fault{
          .tetrahedron = e,
          .problem = sentence("has no volume (", volume, " of its longest edge cubed)"),
          .remedy = "remove it or mesh the volume again"};
    }
    if (volume < 0.0 && inverted++ == 0) first_inverted = e;
  }
  if (inverted == mesh.tetrahedra.size()) {
    return mesh_fault{.tetrahedron = first_inverted,
                      .problem = "is inverted, and so are all: the other node order",
                      .remedy = "pass the mesh through oriented()"};
  }
  if (inverted > 0) {
    return mesh_fault{
        .tetrahedron = first_inverted,
        .problem = sentence("is inverted, as are ", inverted, " of ", mesh.tetrahedra.size()),
        .remedy = "swap two of its nodes if the order is wrong, else mesh the volume again"};
  }
  if (const auto loose = std::find(used.begin(), used.end(), 0); loose != used.end()) {
    return mesh_fault{.node = static_cast<int>(loose - used.begin()),
                      .problem = "belongs to no tetrahedron",
                      .remedy = "remove it: nothing holds it in place"};
  }
  return find_overlap(sorted_faces(mesh));
}

/// Throws a mesh_error for the first fault; its text begins with `name`.
inline void check(const tetrahedral_mesh& mesh, std::string_view name = "mesh") {
  const auto fault = find_fault(mesh);
  if (!fault) return;
  std::string subject;
  if (fault->node >= 0) subject = sentence("node ", fault->node, " ");
  if (fault->tetrahedron >= 0) subject = sentence("tetrahedron ", fault->tetrahedron, " ");
  if (fault->other >= 0) subject += sentence("and tetrahedron ", fault->other, " ");
  refuse(mesh_error(name, subject + fault->problem, fault->remedy));
}

/// The smallest box along the axes that holds every node [m]. (A template, so that only programs that ask for it
/// need Eigen/Geometry, which they include.)
template <class Box = Eigen::AlignedBox<double, 3>>
[[nodiscard]] Box bounds(const tetrahedral_mesh& mesh) {
  Box box;
  for (const auto& node : mesh.nodes) box.extend(node);
  return box;
}

/// The mesh with two nodes of every element swapped if all elements are inverted, otherwise the mesh
/// unchanged: check() refuses a mixture.
[[nodiscard]] inline tetrahedral_mesh oriented(tetrahedral_mesh mesh) {
  const bool all = std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(),
                               [&](const auto& t) { return signed_volume(mesh, t) < 0.0; });
  if (all) {
    for (auto& tetrahedron : mesh.tetrahedra) std::swap(tetrahedron[2], tetrahedron[3]);
  }
  return mesh;
}

/// The mesh with every coordinate times `factor` > 0. Throws std::invalid_argument for any other factor.
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
