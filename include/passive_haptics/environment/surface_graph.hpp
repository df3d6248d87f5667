// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangles of a surface, and for every node the triangles that meet there. curvature.hpp and contact_surface.hpp
// look for neighbours in it; surface_search.hpp adds a tree of boxes.

#include <passive_haptics/environment/node_graph.hpp>
#include <passive_haptics/environment/surface.hpp>

#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class surface_graph {
 public:
  /// Throws std::invalid_argument if `node_count` does not exceed the number of every node of a triangle.
  surface_graph(std::vector<surface_triangle> surface, std::size_t node_count)
      : surface_(std::move(surface)), begin_(node_count + 1, 0) {
    for (const auto& t : surface_) {
      check_nodes(t, node_count);
      for (const int node : t.nodes) ++begin_[slot(node) + 1];
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
  [[nodiscard]] std::size_t node_count() const noexcept { return begin_.size() - 1; }
  [[nodiscard]] const surface_triangle& operator[](std::size_t i) const { return surface_[i]; }

 private:
  std::vector<surface_triangle> surface_;
  std::vector<std::size_t> begin_;
  std::vector<int> at_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
