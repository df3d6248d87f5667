// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The number of rigid motions that fixed nodes leave to a mesh; each makes its stiffness matrix singular.
//
//   fixed nodes of one connected part     none   1   2 or any on a line   3 not on a line
//   rigid motions left                     6     3           1                   0
//
// Parts that share no node move on their own, so each part needs three fixed nodes (audit.md A24).

#include <passive_haptics/environment/mesh.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// The parts of a mesh that share no node.
struct connected_parts {
  std::vector<int> of_node;  ///< part of each node, counted from 0 in the order of the nodes
  int count = 0;
};

[[nodiscard]] inline connected_parts find_parts(const tetrahedral_mesh& mesh) {
  std::vector<int> parent(mesh.nodes.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto up = [&](int node) -> int& { return parent[static_cast<std::size_t>(node)]; };
  const auto root = [&](int node) {
    while (up(node) != node) node = up(node) = up(up(node));
    return node;
  };
  for (const auto& tetrahedron : mesh.tetrahedra) {
    for (const int node : tetrahedron) up(root(node)) = root(tetrahedron[0]);
  }
  connected_parts parts{std::vector<int>(mesh.nodes.size(), -1), 0};
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
    int& part = parts.of_node[static_cast<std::size_t>(root(node))];
    if (part < 0) part = parts.count++;
    parts.of_node[static_cast<std::size_t>(node)] = part;
  }
  return parts;
}

/// The number of rigid motions that leave these points [m] in place: 6 without a point, 3 about one place, 1 about
/// a line, 0 if three are not on a line. A point closer to a line than 1e-6 of their extent counts as on it.
[[nodiscard]] inline int rigid_modes_left(std::span<const Eigen::Vector3d> held) {
  if (held.empty()) return 6;
  const auto from_first = [&](const Eigen::Vector3d& x) {
    return triple_of(x) - triple_of(held[0]);
  };
  mesh::triple along;  // from the first to the one farthest from it
  for (const auto& x : held) {
    if (squared(from_first(x)) > squared(along)) along = from_first(x);
  }
  if (along == mesh::triple{}) return 3;
  const double extent = length(along);
  const bool on_line = std::all_of(held.begin(), held.end(), [&](const Eigen::Vector3d& x) {
    return length(cross(from_first(x), along * (1.0 / extent))) <= 1e-6 * extent;
  });
  return on_line ? 1 : 0;
}

/// The parts of a mesh that its fixed nodes do not hold.
struct loose_parts {
  int modes = 0;               ///< rigid motions, summed over all parts
  int parts = 0;               ///< number of connected parts, held or not
  int node = -1;               ///< the first node of the first part that is not held, or −1
  std::size_t part_nodes = 0;  ///< number of nodes of that part
};

[[nodiscard]] inline loose_parts find_loose_parts(const tetrahedral_mesh& mesh,
                                                  std::span<const int> fixed_nodes) {
  const connected_parts parts = find_parts(mesh);
  std::vector<std::vector<Eigen::Vector3d>> held(static_cast<std::size_t>(parts.count));
  for (const int node : fixed_nodes) {
    const auto part = parts.of_node.at(static_cast<std::size_t>(node));
    held[static_cast<std::size_t>(part)].push_back(mesh.nodes[static_cast<std::size_t>(node)]);
  }
  loose_parts found{.parts = parts.count};
  for (int part = 0; part < parts.count; ++part) {
    const std::span<const Eigen::Vector3d> points(held[static_cast<std::size_t>(part)]);
    const int modes = rigid_modes_left(points);
    found.modes += modes;
    if (modes == 0 || found.node >= 0) continue;
    const auto first = std::find(parts.of_node.begin(), parts.of_node.end(), part);
    found.node = static_cast<int>(first - parts.of_node.begin());
    found.part_nodes = static_cast<std::size_t>(std::count(first, parts.of_node.end(), part));
  }
  return found;
}

/// The number of rigid motions of a mesh with fixed nodes, summed over its connected parts.
[[nodiscard]] inline int rigid_modes_left(const tetrahedral_mesh& mesh,
                                          std::span<const int> fixed_nodes) {
  return find_loose_parts(mesh, fixed_nodes).modes;
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
