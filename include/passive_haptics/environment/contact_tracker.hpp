// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Chooses the triangle that is touched, with hysteresis from update to update.
//
// The closest triangle flips from one to its neighbour and back when the point trembles over their
// common edge, and with it the normal of the force. The tracker holds on to the present triangle
// until another is closer by more than a margin [m] (docs/design/audit.md A26).

#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/surface_search.hpp>

#include <Eigen/Core>

#include <cmath>
#include <optional>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class contact_tracker {
 public:
  /// `margin` ≥ 0 [m]: more than the noise of the position, much less than an edge of the surface.
  explicit contact_tracker(double margin) : margin_(margin) {
    if (!(margin >= 0.0) || !std::isfinite(margin)) {
      refuse_argument("contact_tracker: margin ", margin, " m is refused; give a finite one, ≥ 0");
    }
  }

  /// The contact for x [m]. It stays on the present triangle unless that is degenerate, or has x on the other
  /// side (the sign of depth always tells inside from outside), or another triangle is closer by more than
  /// the margin. Where closest_point() returns none, it returns none and the present triangle stays.
  [[nodiscard]] std::optional<surface_point> find(surface_view surface, nodes_view nodes,
                                                  const Eigen::Vector3d& x) {
    return held_or(closest_point(surface, nodes, x), surface, nodes, x);
  }
  /// The same for a large surface whose tree has been refitted to the nodes.
  [[nodiscard]] std::optional<surface_point> find(const surface_search& surface, nodes_view nodes,
                                                  const Eigen::Vector3d& x) {
    return held_or(surface.closest_point(nodes, x, triangle_), surface.triangles(), nodes, x);
  }
  /// The same, but searched from the present triangle over its neighbours, and by the tree if there is no present
  /// one. So it follows a contact, and misses a part of the surface that comes close elsewhere. before(i) is
  /// called before triangle i is looked at, and may still move its nodes.
  template <class Before>
  [[nodiscard]] std::optional<surface_point> follow(const surface_search& surface, nodes_view nodes,
                                                    const Eigen::Vector3d& x,
                                                    const Before& before) {
    if (triangle_ < 0 || triangle_ >= static_cast<int>(surface.size()) ||
        !is_finite(triple_of(x))) {
      return find(surface, nodes, x);
    }
    return held_or(surface.closest_near(nodes, x, triangle_, before), surface.triangles(), nodes,
                   x);
  }

  /// The present triangle, −1 before the first contact.
  [[nodiscard]] int triangle() const noexcept { return triangle_; }
  [[nodiscard]] double margin() const noexcept { return margin_; }

  /// Forgets the present triangle, for use after a jump of the device or with another surface.
  void reset() noexcept { triangle_ = -1; }

 private:
  [[nodiscard]] std::optional<surface_point> held_or(const std::optional<surface_point>& closest,
                                                     surface_view surface, nodes_view nodes,
                                                     const Eigen::Vector3d& x) {
    if (!closest) return std::nullopt;
    if (triangle_ >= 0 && triangle_ < static_cast<int>(surface.size())) {
      const auto held = point_on(surface, nodes, triangle_, x);
      const bool close_enough = held && held->distance <= closest->distance + margin_;
      if (close_enough && (held->depth > 0.0) == (closest->depth > 0.0)) return held;
    }
    triangle_ = closest->triangle;
    return closest;
  }

  double margin_;
  int triangle_ = -1;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
