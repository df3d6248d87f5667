// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The nodes of any mesh that share the force of a fingertip of radius r [m]:
//
//     wᵢ ∝ Aᵢ (1 − sᵢ²/r²)² for sᵢ < r,   Σ wᵢ = 1
//
// sᵢ [m] is the distance of node i from the contact at rest, Aᵢ [m²] a third of the area of the triangles around it.
// Under a point force the displacement of a solid is infinite (J. Boussinesq, 1885), so under a finger on three nodes
// a mesh grows softer without limit as it is refined; under an area it converges. If the longest edge of the triangle
// is larger than r, it is taken for r.

#include <passive_haptics/environment/marks.hpp>
#include <passive_haptics/environment/surface_search.hpp>
#include <passive_haptics/environment/triangle_weights.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class contact_area {
 public:
  contact_area() = default;
  /// Areas on the surface of a body whose nodes at rest are `rest` [m].
  contact_area(const surface_graph& surface, nodes_view rest)
      : areas_(rest.size(), 0.0), seen_(rest.size()) {
    for (const surface_triangle& t : surface.triangles()) {
      const double third = mesh::length(area_of(triples_of(corners(t, rest)))) / 3.0;
      for (const int node : t.nodes) areas_[slot(node)] += third;
    }
    nodes_.reserve(rest.size());
    shares_.reserve(rest.size());
  }

  /// Collects the nodes within `radius` [m] of the point of triangle `on` with these barycentric weights, as far
  /// as edges between nodes within the radius lead from that triangle to them. It does not allocate.
  void gather(const surface_graph& surface, nodes_view rest, const surface_triangle& on,
              const Eigen::Vector3d& weights, double radius) {
    const mesh::corners shape = triples_of(corners(on, rest));
    const mesh::triple centre = mesh::point_at(shape, triple_of(weights));
    for (std::size_t k = 0; k < 3; ++k) {
      radius = (std::max)(radius, mesh::length(shape[(k + 1) % 3] - shape[k]));
    }
    nodes_.clear();
    shares_.clear();
    seen_.clear();
    double sum = 0.0;
    const auto add = [&](int node) {
      if (!seen_.add(node)) return;
      const double off = mesh::squared(triple_of(rest[slot(node)]) - centre);
      const double inside = 1.0 - off / (radius * radius);
      if (!(inside > 0.0)) return;
      nodes_.push_back(node);
      shares_.push_back(areas_[slot(node)] * inside * inside);
      sum += shares_.back();
    };
    for (const int node : on.nodes) add(node);
    for (std::size_t next = 0; next < nodes_.size(); ++next) {
      for (const int i : surface.triangles_at(nodes_[next])) {
        for (const int node : surface[slot(i)].nodes) add(node);
      }
    }
    for (double& share : shares_) share /= sum;
  }

  [[nodiscard]] std::span<const int> nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::span<const double> shares() const noexcept { return shares_; }

 private:
  std::vector<double> areas_;  ///< of each node [m²]
  std::vector<int> nodes_;
  std::vector<double> shares_;
  marks seen_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
