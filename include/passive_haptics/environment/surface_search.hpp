// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The closest point of a large surface without looking at all of it.
//
//   surface_search         a surface_graph with a tree of boxes:
//     closest_point        the same answer as the linear search of surface.hpp, ties included
//     closest_near         a search from one triangle over its neighbours, to follow a contact
//     refit                fits the boxes to nodes that have moved; the tree stays the same
//
// The tree (mesh/box_tree.hpp) is a median split of the triangles' centres at rest. Its answers stay right however
// the body deforms, and it stays fast as long as neighbours stay neighbours. Queries do not allocate. Positions of
// another number of nodes are refused by a std::invalid_argument, and the boxes stay as they were.

#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/surface_graph.hpp>
#include <passive_haptics/mesh/box_tree.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class surface_search : public surface_graph {
 public:
  /// Builds the tree for these positions [m], one for each node.
  surface_search(std::vector<surface_triangle> surface, nodes_view nodes)
      : surface_graph(std::move(surface), nodes.size()),
        tree_(centres(triangles(), nodes)),
        boxes_(tree_.branches().size()) {
    refit(nodes);
  }

  /// Fits all boxes to the positions [m] of the nodes.
  void refit(nodes_view nodes) {
    check_count(nodes);
    tree_.fit(boxes_, around{*this, nodes});
  }
  /// Fits the boxes of the triangles `moved`; all others must be where they were.
  void refit(nodes_view nodes, std::span<const int> moved) {
    check_count(nodes);
    tree_.fit(boxes_, moved, around{*this, nodes});
  }

  /// The result of closest_point(triangles(), nodes, x), for nodes that the tree has been refitted to. A triangle
  /// `likely` to be close, such as the last one, saves time; −1: none.
  [[nodiscard]] std::optional<surface_point> closest_point(nodes_view nodes,
                                                           const Eigen::Vector3d& x,
                                                           int likely = -1) const {
    check_count(nodes);
    if (boxes_.empty() || !is_finite(triple_of(x))) return std::nullopt;
    std::optional<surface_point> best;
    if (likely >= 0 && likely < static_cast<int>(size())) offer(best, nodes, x, likely);
    const mesh::triple at = triple_of(x);
    // Positions are rounded, so a box may seem farther than its triangles by up to `slack` [m], 90 roundings of 2⁻⁵³.
    const double slack =
        1e-14 * (mesh::length(boxes_[0].low) + mesh::length(boxes_[0].high) + mesh::length(at));
    tree_.walk([&](int b) { return boxes_[slot(b)].squared_distance(at); },
               [&](double distance2) {
                 const double reach = best ? best->distance + slack : mesh::box::infinity;
                 return !(distance2 > reach * reach);
               },
               [&](int t) { offer(best, nodes, x, t); });
    return faced(best, nodes, x);
  }

  /// The closest point found from triangle `from` by going to a closer one of its neighbours as long as there is
  /// one. It is the closest of the whole surface if the surface is not folded in between. before(i) is called
  /// before triangle i is looked at, and may still move its nodes.
  template <class Before>
  [[nodiscard]] std::optional<surface_point> closest_near(nodes_view nodes,
                                                          const Eigen::Vector3d& x, int from,
                                                          const Before& before) const {
    check_count(nodes);
    std::optional<surface_point> best;
    before(from);
    offer(best, nodes, x, from);
    for (int last = -1, at = from; at != last;) {
      last = at;
      for (const int node : (*this)[slot(at)].nodes) {
        for (const int i : triangles_at(node)) {
          before(i);
          offer(best, nodes, x, i);
        }
      }
      if (best) at = best->triangle;
    }
    return faced(best, nodes, x);
  }

 private:
  void check_count(nodes_view nodes) const {
    if (nodes.size() == node_count()) return;
    refuse_argument("surface_search: news of ", static_cast<int>(nodes.size()),
                    " nodes for a surface of ", node_count(),
                    "; make another surface_search of them");
  }
  [[nodiscard]] static std::vector<mesh::triple> centres(surface_view surface, nodes_view nodes) {
    std::vector<mesh::triple> all;
    all.reserve(surface.size());
    for (const surface_triangle& t : surface) {
      const mesh::corners shape = triples_of(corners(t, nodes));
      all.push_back((shape[0] + shape[1] + shape[2]) * (1.0 / 3.0));
    }
    return all;
  }
  /// Makes a box large enough for a triangle; one with a node that is not finite is degenerate.
  struct around {
    const surface_graph& of;
    nodes_view nodes;
    void operator()(int t, mesh::box& b) const {
      for (const int node : of[slot(t)].nodes) {
        const mesh::triple at = triple_of(nodes[slot(node)]);
        if (is_finite(at)) b.grow(at);
      }
    }
  };

  /// Takes triangle `number` for `best` if it is closer, or as close with a lower number, so the order does not matter.
  void offer(std::optional<surface_point>& best, nodes_view nodes, const Eigen::Vector3d& x,
             int number) const {
    const auto found = point_on(triangles(), nodes, number, x);
    if (!found) return;
    if (!best || found->distance < best->distance ||
        (found->distance == best->distance && number < best->triangle)) {
      best = found;
    }
  }

  [[nodiscard]] std::optional<surface_point> faced(const std::optional<surface_point>& found,
                                                   nodes_view nodes,
                                                   const Eigen::Vector3d& x) const {
    if (!found) return found;
    const int node = (*this)[slot(found->triangle)].nodes[heaviest(found->weights)];
    return facing(triangles(), nodes, x, *found, [&](const auto& visit) {
      for (const int i : triangles_at(node)) visit(i);
    });
  }

  mesh::box_tree tree_;
  std::vector<mesh::box> boxes_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
