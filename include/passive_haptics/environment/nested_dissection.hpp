// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The order in which the nodes of a mesh are eliminated so that its factor stays small.
//
//   ┌───────┬─┬───────┐    A separator S cuts the body in two, and no element joins A and B. A is eliminated,
//   │   A   │S│   B   │    then B, then S, and A and B are cut in the same way. This gives a tree of dense
//   └───────┴─┴───────┘    fronts, O(n^4/3) entries and O(n²) operations for a compact body of n nodes.
//
// A. George, "Nested dissection of a regular finite element mesh", SIAM J. Numer. Anal. 10(2), 1973. The
// cut is the plane through the median of the longest axis; the separator is the set of nodes next to it, on the
// side that has fewer of them.
//
// The nodes that contacts are on come last, in one front: the body is condensed to a dense matrix of their size
// (M. Bro-Nielsen, S. Cotin, Computer Graphics Forum 15(3), 1996).

#include <passive_haptics/environment/node_graph.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// A set of nodes that is eliminated at once, and the later nodes that its elimination couples.
struct elimination_front {
  int first = 0;              ///< the position of its first node in the order
  int pivots = 0;             ///< how many nodes are eliminated here, one after the other
  std::vector<int> bound;     ///< the positions of the later nodes that they are coupled to, sorted
  std::vector<int> children;  ///< fronts whose parent this one is
  int parent = -1;            ///< the front of its first bound node; −1 if the bound is empty
};

/// The order of elimination, and the cost of a factorisation with three unknowns per node.
struct elimination_tree {
  std::vector<int> position;              ///< position of each node in the order
  std::vector<elimination_front> fronts;  ///< children before parents
  std::vector<int> front_of;              ///< the front of each position
  double operations = 0.0;                ///< multiplications and additions
  double factor_bytes = 0.0;              ///< size of the factor in doubles [B]
  double peak_bytes = 0.0;                ///< the most that the factorisation holds at a time [B]
};

/// Dissects a graph; use dissect().
class dissection {
 public:
  dissection(const node_graph& graph, int leaf) : graph_(graph), leaf_(leaf) {
    side_.assign(slot(graph.size()), 0);
    order_.reserve(slot(graph.size()));
    std::vector<int> last = graph.touched;
    std::sort(last.begin(), last.end());
    last.erase(std::unique(last.begin(), last.end()), last.end());
    std::vector<int> others;
    for (int i = 0; i < graph.size(); ++i) {
      if (!std::binary_search(last.begin(), last.end(), i)) others.push_back(i);
    }
    split(std::move(others));
    eliminate(std::move(last));
  }

  [[nodiscard]] elimination_tree tree() && {
    tree_.position.resize(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
      tree_.position[slot(order_[k])] = static_cast<int>(k);
    }
    for (std::size_t t = 0; t < tree_.fronts.size(); ++t) {
      tree_.front_of.insert(tree_.front_of.end(), slot(tree_.fronts[t].pivots),
                            static_cast<int>(t));
    }
    couple();
    predict();
    return std::move(tree_);
  }

 private:
  /// Appends the nodes in ascending order, so that the result does not depend on the library's nth_element.
  void eliminate(std::vector<int> nodes) {
    if (nodes.empty()) return;
    std::sort(nodes.begin(), nodes.end());
    tree_.fronts.push_back(
        {static_cast<int>(order_.size()), static_cast<int>(nodes.size()), {}, {}, -1});
    order_.insert(order_.end(), nodes.begin(), nodes.end());
  }

  void split(std::vector<int> nodes) {
    if (nodes.size() <= slot(leaf_)) return eliminate(std::move(nodes));
    Eigen::Index axis = 0;
    double longest = -1.0;
    for (Eigen::Index a = 0; a < 3; ++a) {
      double low = graph_.points[slot(nodes[0])][a], high = low;
      for (const int i : nodes) {
        low = (std::min)(low, graph_.points[slot(i)][a]);
        high = (std::max)(high, graph_.points[slot(i)][a]);
      }
      if (!(high - low > longest)) continue;
      longest = high - low;
      axis = a;
    }
    const auto middle = nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2);
    std::nth_element(nodes.begin(), middle, nodes.end(), [&](int a, int b) {
      const double left = graph_.points[slot(a)][axis], right = graph_.points[slot(b)][axis];
      return left < right || (left == right && a < b);
    });
    const int low = ++stamp_, high = ++stamp_;
    for (auto i = nodes.begin(); i != middle; ++i) side_[slot(*i)] = low;
    for (auto i = middle; i != nodes.end(); ++i) side_[slot(*i)] = high;
    const auto borders = [&](int node, int on) {
      const auto beside = graph_.neighbours_of(node);
      return std::any_of(beside.begin(), beside.end(), [&](int n) { return side_[slot(n)] == on; });
    };
    std::vector<int> low_side, high_side, low_border, high_border;
    for (const int i : nodes) {
      const bool is_low = side_[slot(i)] == low;
      auto& inner = is_low ? low_side : high_side;
      auto& border = is_low ? low_border : high_border;
      (borders(i, is_low ? high : low) ? border : inner).push_back(i);
    }
    nodes = {};  // frees the memory before the recursion
    const bool cut_low = low_border.size() <= high_border.size();
    auto& kept = cut_low ? high_side : low_side;
    const auto& border = cut_low ? high_border : low_border;
    kept.insert(kept.end(), border.begin(), border.end());
    split(std::move(low_side));
    split(std::move(high_side));
    eliminate(std::move(cut_low ? low_border : high_border));
  }

  /// Finds the bound of each front: the later neighbours of its nodes, and later nodes of its children's bounds.
  void couple() {
    std::vector<int> seen(order_.size(), -1);
    for (std::size_t t = 0; t < tree_.fronts.size(); ++t) {
      elimination_front& front = tree_.fronts[t];
      const int end = front.first + front.pivots;
      const auto add = [&](int position) {
        if (position < end || seen[slot(position)] == static_cast<int>(t)) return;
        seen[slot(position)] = static_cast<int>(t);
        front.bound.push_back(position);
      };
      for (int k = front.first; k < end; ++k) {
        for (const int n : graph_.neighbours_of(order_[slot(k)])) add(tree_.position[slot(n)]);
      }
      for (const int child : front.children) {
        for (const int position : tree_.fronts[slot(child)].bound) add(position);
      }
      std::sort(front.bound.begin(), front.bound.end());
      if (front.bound.empty()) continue;
      front.parent = tree_.front_of[slot(front.bound.front())];
      tree_.fronts[slot(front.parent)].children.push_back(static_cast<int>(t));
    }
  }

  void predict() {
    double waiting = 0.0;  // bytes of the update matrices that wait for their parents
    for (const elimination_front& front : tree_.fronts) {
      const double p = 3.0 * front.pivots, u = 3.0 * static_cast<double>(front.bound.size());
      tree_.operations += p * p * p / 3.0 + p * p * u + p * u * u;
      tree_.factor_bytes += 8.0 * p * (p + u);
      waiting += 8.0 * u * u;
      tree_.peak_bytes = (std::max)(tree_.peak_bytes, tree_.factor_bytes + waiting);
      for (const int child : front.children) {
        const double left = 3.0 * static_cast<double>(tree_.fronts[slot(child)].bound.size());
        waiting -= 8.0 * left * left;
      }
    }
  }

  const node_graph& graph_;
  int leaf_;
  std::vector<int> side_;  ///< for each node the stamp of the half that it was in last
  int stamp_ = 0;
  std::vector<int> order_;
  elimination_tree tree_;
};

/// The elimination tree of a graph. Sets of up to `leaf` ≥ 1 nodes are not cut any further: a larger `leaf` costs
/// memory, a smaller one makes the dense products short.
[[nodiscard]] inline elimination_tree dissect(const node_graph& graph, int leaf = 60) {
  return dissection(graph, leaf).tree();
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
