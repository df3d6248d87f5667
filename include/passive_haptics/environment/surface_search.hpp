// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The closest point of a large surface without looking at all of it.
//
//   surface_graph          the triangles that meet at each node
//   surface_search         the same with a tree of boxes:
//     closest_point        the same answer as the linear search of surface.hpp, ties included
//     closest_near         a search from one triangle over its neighbours, to follow a contact
//     refit                fits the boxes to nodes that have moved; the tree stays the same
//
// The tree is a median split of the triangles' centres at rest. Its answers stay right however the body deforms,
// and it stays fast as long as neighbours stay neighbours. Queries do not allocate.

#include <passive_haptics/environment/node_graph.hpp>
#include <passive_haptics/environment/surface.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class surface_graph {
 public:
  /// `node_count` must exceed the number of every node of a triangle.
  surface_graph(std::vector<surface_triangle> surface, std::size_t node_count)
      : surface_(std::move(surface)), begin_(node_count + 1, 0) {
    for (const auto& t : surface_) {
      for (const int node : t.nodes) ++begin_.at(slot(node) + 1);
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    at_.resize(3 * surface_.size());
    std::vector<std::size_t> next = begin_;
    for (std::size_t i = 0; i < surface_.size(); ++i) {
      for (const int node : surface_[i].nodes) at_[next[slot(node)]++] = static_cast<int>(i);
    }
  }

  /// Triangles that have this node, in ascending order.
  [[nodiscard]] std::span<const int> triangles_at(int node) const {
    const std::size_t from = begin_[slot(node)];
    return std::span(at_).subspan(from, begin_[slot(node) + 1] - from);
  }
  [[nodiscard]] const std::vector<surface_triangle>& triangles() const noexcept { return surface_; }
  [[nodiscard]] std::size_t size() const noexcept { return surface_.size(); }
  [[nodiscard]] const surface_triangle& operator[](std::size_t i) const { return surface_[i]; }

 private:
  std::vector<surface_triangle> surface_;
  std::vector<std::size_t> begin_;
  std::vector<int> at_;
};

class surface_search : public surface_graph {
 public:
  /// Builds the tree for these positions [m], one for each node.
  surface_search(std::vector<surface_triangle> surface, nodes_view nodes)
      : surface_graph(std::move(surface), nodes.size()), order_(size()), leaf_of_(size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::vector<Eigen::Vector3d> centres(size());
    for (std::size_t i = 0; i < size(); ++i) {
      const triangle shape = corners((*this)[i], nodes);
      centres[i] = (shape[0] + shape[1] + shape[2]) / 3.0;
      if (!centres[i].allFinite()) centres[i].setZero();  // degenerate: any place will do
    }
    if (size() > 0) split(centres, 0, static_cast<int>(size()), -1);
    dirty_.assign(boxes_.size(), false);
    dirty_list_.reserve(boxes_.size());
    refit(nodes);
  }

  /// Fits all boxes to the positions [m] of the nodes.
  void refit(nodes_view nodes) {
    for (std::size_t b = boxes_.size(); b-- > 0;) fit(b, nodes);
  }
  /// Fits the boxes of the triangles `moved`; all others must be where they were.
  void refit(nodes_view nodes, std::span<const int> moved) {
    dirty_list_.clear();
    for (const int i : moved) {
      for (int b = leaf_of_[slot(i)]; b >= 0 && !dirty_[slot(b)]; b = boxes_[slot(b)].parent) {
        dirty_[slot(b)] = true;
        dirty_list_.push_back(b);
      }
    }
    std::sort(dirty_list_.begin(), dirty_list_.end());
    for (std::size_t k = dirty_list_.size(); k-- > 0;) {
      fit(slot(dirty_list_[k]), nodes);
      dirty_[slot(dirty_list_[k])] = false;
    }
  }

  /// The result of closest_point(triangles(), nodes, x), for nodes that the tree has been refitted to. A triangle
  /// `likely` to be close, such as the last one, saves time; −1: none.
  [[nodiscard]] std::optional<surface_point> closest_point(nodes_view nodes,
                                                           const Eigen::Vector3d& x,
                                                           int likely = -1) const {
    if (boxes_.empty() || !x.allFinite()) return std::nullopt;
    std::optional<surface_point> best;
    if (likely >= 0 && likely < static_cast<int>(size())) offer(best, nodes, x, likely);
    // By rounding errors of the positions a box may seem farther than its triangles.
    const double slack = 1e-14 * (boxes_[0].low.norm() + boxes_[0].high.norm() + x.norm());
    const auto too_far = [&](double distance2) {
      const double reach = best ? best->distance + slack : infinity;
      return distance2 > reach * reach;
    };
    struct waiting {
      int box;
      double distance2;
    };
    std::array<waiting, 64> stack{};  // the tree is balanced: as deep as log₂ of an int at most
    std::size_t height = 0;
    stack[height++] = {0, distance2_to(0, x)};
    while (height > 0) {
      const waiting top = stack[--height];
      if (too_far(top.distance2)) continue;
      const box& b = boxes_[slot(top.box)];
      if (b.right < 0) {
        for (int k = b.begin; k < b.end; ++k) offer(best, nodes, x, order_[slot(k)]);
        continue;
      }
      waiting left{top.box + 1, distance2_to(top.box + 1, x)};
      waiting right{b.right, distance2_to(b.right, x)};
      if (left.distance2 > right.distance2) std::swap(left, right);
      if (!too_far(right.distance2)) stack[height++] = right;
      if (!too_far(left.distance2)) stack[height++] = left;  // the closer one first
    }
    return faced(best, nodes, x);
  }

  /// The closest point found from triangle `from` by going to a closer one of its neighbours as long as there is
  /// one. It is the closest of the whole surface if the surface is not folded in between. before(i) is called
  /// before triangle i is looked at, and may still move its nodes.
  template <class Before>
  [[nodiscard]] std::optional<surface_point> closest_near(nodes_view nodes,
                                                          const Eigen::Vector3d& x, int from,
                                                          const Before& before) const {
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
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int leaf_size = 4;

  /// The left child of a box comes right after it.
  struct box {
    Eigen::Vector3d low{0.0, 0.0, 0.0}, high{0.0, 0.0, 0.0};  ///< corners [m]
    int right = -1;                                           ///< −1: a leaf
    int begin, end;                                           ///< its triangles in order_
    int parent;
  };

  int split(const std::vector<Eigen::Vector3d>& centres, int begin, int end, int parent) {
    const int me = static_cast<int>(boxes_.size());
    boxes_.push_back({.begin = begin, .end = end, .parent = parent});
    if (end - begin <= leaf_size) {
      for (int k = begin; k < end; ++k) leaf_of_[slot(order_[slot(k)])] = me;
      return me;
    }
    Eigen::AlignedBox3d extent;
    for (int k = begin; k < end; ++k) extent.extend(centres[slot(order_[slot(k)])]);
    Eigen::Index axis = 0;
    extent.sizes().maxCoeff(&axis);
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int a, int b) { return centres[slot(a)][axis] < centres[slot(b)][axis]; });
    split(centres, begin, middle, me);
    boxes_[slot(me)].right = split(centres, middle, end, me);
    return me;
  }

  void fit(std::size_t number, nodes_view nodes) {
    box& b = boxes_[number];
    if (b.right >= 0) {
      const box &left = boxes_[number + 1], &right = boxes_[slot(b.right)];
      b.low = left.low.cwiseMin(right.low);
      b.high = left.high.cwiseMax(right.high);
      return;
    }
    b.low.setConstant(infinity);
    b.high.setConstant(-infinity);
    for (int k = b.begin; k < b.end; ++k) {
      for (const int node : (*this)[slot(order_[slot(k)])].nodes) {
        const Eigen::Vector3d& at = nodes[slot(node)];
        if (!at.allFinite()) continue;  // its triangles are degenerate
        b.low = b.low.cwiseMin(at);
        b.high = b.high.cwiseMax(at);
      }
    }
  }

  /// The squared distance [m²] from x to a box; infinite for an empty box.
  [[nodiscard]] double distance2_to(int number, const Eigen::Vector3d& x) const {
    const box& b = boxes_[slot(number)];
    return (b.low - x).cwiseMax(x - b.high).cwiseMax(0.0).squaredNorm();
  }

  /// best ← triangle `number` if closer, or as close and of a lower number: the search order has no effect.
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
    Eigen::Index heaviest = 0;
    found->weights.maxCoeff(&heaviest);
    const int node = (*this)[slot(found->triangle)].nodes[static_cast<std::size_t>(heaviest)];
    return facing(triangles(), nodes, x, *found, [&](const auto& visit) {
      for (const int i : triangles_at(node)) visit(i);
    });
  }

  std::vector<int> order_;    ///< triangles, those of a box side by side
  std::vector<int> leaf_of_;  ///< the leaf of each triangle
  std::vector<box> boxes_;    ///< parents before children
  std::vector<bool> dirty_;
  std::vector<int> dirty_list_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
