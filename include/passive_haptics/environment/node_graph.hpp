// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pairs of nodes of a mesh that share an element: the pattern of its stiffness matrix.

#include <passive_haptics/environment/mesh.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// A number that counts from 0, as an index of a standard container.
[[nodiscard]] constexpr std::size_t slot(int number) noexcept {
  return static_cast<std::size_t>(number);
}

/// The N free nodes of a mesh. The neighbours of node i are sorted and do not include i.
struct node_graph {
  std::vector<Eigen::Vector3d> points;  ///< N rest positions [m]
  std::vector<int> begin;  ///< N + 1 places in `neighbours` at which those of a node begin
  std::vector<int> neighbours;
  std::vector<int> touched =
      {};  ///< nodes that contacts will press: multifrontal eliminates them last

  [[nodiscard]] int size() const noexcept { return static_cast<int>(points.size()); }
  [[nodiscard]] std::span<const int> neighbours_of(int node) const {
    const auto from = slot(begin[slot(node)]), to = slot(begin[slot(node) + 1]);
    return std::span(neighbours).subspan(from, to - from);
  }
};

/// The graph of the nodes whose number is not −1 (tetrahedral_stiffness.hpp, free_numbers()). The mesh must pass
/// check().
[[nodiscard]] inline node_graph graph_of(const tetrahedral_mesh& mesh,
                                         const std::vector<int>& number) {
  node_graph graph;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] >= 0) graph.points.push_back(mesh.nodes[i]);
  }
  const auto for_pairs = [&](const auto& visit) {
    for (const auto& tetrahedron : mesh.tetrahedra) {
      for (const int a : tetrahedron) {
        for (const int b : tetrahedron) {
          const int from = number[slot(a)], to = number[slot(b)];
          if (from >= 0 && to >= 0 && from != to) visit(from, to);
        }
      }
    }
  };
  std::vector<std::size_t> next(graph.points.size() + 1, 0);
  for_pairs([&](int from, int /*to*/) { ++next[slot(from) + 1]; });
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  const std::vector<std::size_t> start = next;
  std::vector<int> all(start.back());
  for_pairs([&](int from, int to) { all[next[slot(from)]++] = to; });
  graph.begin.push_back(0);
  for (std::size_t i = 0; i + 1 < start.size(); ++i) {
    // An edge is in the list once for each element around it, so duplicates are dropped.
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(start[i]);
    const auto to = all.begin() + static_cast<std::ptrdiff_t>(start[i + 1]);
    std::sort(from, to);
    graph.neighbours.insert(graph.neighbours.end(), from, std::unique(from, to));
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
  }
  return graph;
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
