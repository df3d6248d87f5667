// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The surfaces that a mesh publishes at a contact, beside its tangent plane and its triangle.
//
//   quadric_at   the smooth surface through its nodes, with its curvatures    for bodies that bulge
//   patch_at     its triangles around the contact, unchanged                  for dents and edges
//   yielding     any of them at rest, with the stiffness K/(1 + K C) of spring and body in series, so that it gives
//                way under the finger between two updates as the body does
//   ahead        where to ask it: not where the finger is, but where it will be while the answer counts
//
// All return plain values for a supply's update(), which prepares them and refuses one that cannot be used:
//     touch.update(env::quadric_at(body, {.thickness = 0.005}))
// The shortest way to touch a body that gives way:
//     env::ahead where;                                              // once
//     touch.update(env::yielding(body, where, position, force));     // at every update

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/patch.hpp>
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/environment/curvature.hpp>
#include <passive_haptics/environment/refuse.hpp>
#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/surface_contact.hpp>
#include <passive_haptics/environment/surface_graph.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

struct quadric_options {
  double thickness = 0.005;  ///< deepest contact [m]
  double reach = 0.02;       ///< radius in which the quadric is used [m], about a mesh edge
};

/// True if a point is on a triangle of a surface of so many.
[[nodiscard]] inline bool is_on(const surface_point& on, std::size_t triangles) noexcept {
  return on.triangle >= 0 && static_cast<std::size_t>(on.triangle) < triangles;
}

/// The quadric at a point of the surface, of stiffness `stiffness` [N/m]. Its curvatures are limited to
/// ±1/(2 thickness) [1/m], so that it does not fold: a sharper edge or dent is felt with that curvature.
/// At a point that is on no triangle of it, as surface_point{} is, it is a quadric that every supply refuses.
template <class Surface>
[[nodiscard]] quadric<space<double, 3>> quadric_at(const Surface& surface, nodes_view nodes,
                                                   const surface_point& on, double stiffness,
                                                   const quadric_options& options = {}) {
  if (!is_on(on, surface.size())) return {};
  const surface_shape shape = shape_at(surface, nodes, on.triangle, on.weights);
  const double sharpest = 0.5 / options.thickness;
  const auto kept = [&](double c) { return (std::max)(-sharpest, (std::min)(c, sharpest)); };
  return {.point = shape.point,
          .normal = shape.normal,
          .tangent = shape.tangent,
          .curvature = kept(shape.curvature),
          .cross_curvature = kept(shape.cross_curvature),
          .stiffness = stiffness,
          .thickness = options.thickness,
          .reach = options.reach};
}

[[nodiscard]] inline surface_view triangles_of(surface_view surface) {
  return surface;
}
[[nodiscard]] inline surface_view triangles_of(const surface_graph& surface) {
  return surface.triangles();
}

/// Calls visit(i) for every triangle that may share an edge with a triangle of `taken`.
template <class Visit>
void for_triangles_beside(surface_view surface, std::span<const int> /*taken*/,
                          const Visit& visit) {
  for (int i = 0; i < static_cast<int>(surface.size()); ++i) visit(i);
}
template <class Visit>
void for_triangles_beside(const surface_graph& surface, std::span<const int> taken,
                          const Visit& visit) {
  for (const int number : taken) {
    const auto& t = surface[slot(number)].nodes;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int i : surface.triangles_at(t[k])) {
        const auto& other = surface[slot(i)].nodes;
        if (std::find(other.begin(), other.end(), t[(k + 1) % 3]) != other.end()) visit(i);
      }
    }
  }
}

/// The M triangles closest to a point of the surface that are connected to its triangle by whole edges. A
/// triangle that would be the third at an edge is left out. In a surface_view every triangle is looked at; for
/// a large surface take a surface_graph, which knows the neighbours of a triangle. At a point that is on no triangle of
/// it, it is a patch that every supply refuses.
template <std::size_t M = 16, class Surface>
[[nodiscard]] patch<space<double, 3>, M> patch_at(
    const Surface& surface, nodes_view nodes, const surface_point& on, double stiffness,
    double thickness = (std::numeric_limits<double>::max)()) {
  using result_type = patch<space<double, 3>, M>;
  result_type result;
  result.stiffness = stiffness;
  result.thickness = thickness;
  std::array<int, M> taken{};                          // numbers of triangles
  std::array<int, result_type::node_capacity> used{};  // numbers of nodes
  const auto has_edge = [&](int from, int to) {
    for (std::size_t i = 0; i < result.triangle_count; ++i) {
      const auto& t = surface[static_cast<std::size_t>(taken[i])].nodes;
      for (std::size_t k = 0; k < 3; ++k) {
        if (t[k] == from && t[(k + 1) % 3] == to) return true;
      }
    }
    return false;
  };
  const auto local_number = [&](int node) {
    const auto end = used.begin() + result.node_count;
    const auto at = std::find(used.begin(), end, node);
    if (at == end) {
      *at = node;
      result.nodes[result.node_count++] = nodes[static_cast<std::size_t>(node)];
    }
    return static_cast<std::uint8_t>(at - used.begin());
  };
  /// True if t shares an edge with the patch, and none that has two triangles already.
  const auto fits = [&](const surface_triangle& t) {
    bool touches_patch = result.triangle_count == 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = t.nodes[k], to = t.nodes[(k + 1) % 3];
      if (has_edge(from, to)) return false;
      touches_patch = touches_patch || has_edge(to, from);
    }
    return touches_patch;
  };
  int next = is_on(on, surface.size()) ? on.triangle : -1;
  while (next >= 0) {
    const surface_triangle& t = surface[static_cast<std::size_t>(next)];
    check_nodes(t, nodes.size());
    for (std::size_t k = 0; k < 3; ++k) {
      result.triangles[result.triangle_count][k] = local_number(t.nodes[k]);
    }
    taken[result.triangle_count++] = next;
    if (result.triangle_count == M) break;
    next = -1;
    double shortest = std::numeric_limits<double>::infinity();
    const auto so_far = std::span<const int>(taken).first(result.triangle_count);
    for_triangles_beside(surface, so_far, [&](int i) {
      if (!fits(surface[static_cast<std::size_t>(i)])) return;
      const auto candidate = point_on(triangles_of(surface), nodes, i, on.point);
      if (!candidate || candidate->distance > shortest) return;
      if (candidate->distance == shortest && i > next) return;  // so the order does not matter
      shortest = candidate->distance;
      next = i;
    });
  }
  return result;
}

/// The contact of a body as a point of its surface.
[[nodiscard]] inline surface_point point_of(const surface_contact& contact) {
  return {.triangle = contact.triangle,
          .point = contact.point,
          .weights = contact.weights,
          .normal = contact.normal,
          .distance = 0.0,
          .depth = contact.depth};
}

/// The quadric at the last contact of a body, with the stiffness that the body reported there. Before the
/// first contact it returns a quadric that every supply refuses.
template <touched_body Body>
[[nodiscard]] quadric<space<double, 3>> quadric_at(const Body& body,
                                                   const quadric_options& options = {}) {
  if (body.contact().triangle < 0) return {};
  return quadric_at(body.search(), body.nodes(), point_of(body.contact()), body.contact().stiffness,
                    options);
}

/// The patch at the last contact of a body; before the first contact a patch that every supply refuses.
template <std::size_t M = 16, touched_body Body>
[[nodiscard]] patch<space<double, 3>, M> patch_at(
    const Body& body, double thickness = (std::numeric_limits<double>::max)()) {
  if (body.contact().triangle < 0) return {};
  return patch_at<M>(body.search(), body.nodes(), point_of(body.contact()),
                     body.contact().stiffness, thickness);
}

/// The tangent plane at the last contact; before the first contact a plane that every supply refuses.
template <touched_body Body>
[[nodiscard]] half_space<space<double, 3>> plane_at(const Body& body) {
  if (body.contact().triangle < 0) return {};
  return {body.contact().point, body.contact().normal, body.contact().stiffness};
}

/// A surface that gives way between two updates as its body does. The body was solved under a force F₀ [N]; under a
/// force f its surface lies C (f − F₀) deeper, where C is the compliance of the body [m/N]. With d [m] the depth in the
/// surface of the last update, the law
///
///     f = K (d − C (f − F₀))    is the same as    f = K/(1 + K C) · (d + C F₀)
///
/// and d + C F₀ is the depth in the surface at rest. So the surface at rest is returned with the stiffness K/(1 + K C).
/// That surface does not depend on the force, so a late update does no harm, and the loop of force and surface that
/// deformable_body.hpp describes does not arise.
///     touch.update(env::yielding(env::plane_at(body), body.contact()));
template <class Surface>
[[nodiscard]] Surface yielding(Surface surface, const surface_contact& contact) {
  const mesh::triple back = triple_of(contact.rest) - triple_of(contact.point);
  if constexpr (requires { surface.node_count; }) {
    for (std::size_t i = 0; i < surface.node_count; ++i) {
      surface.nodes[i] = vector_of(triple_of(surface.nodes[i]) + back);
    }
  } else {
    surface.point = vector_of(triple_of(surface.point) + back);
  }
  const double K = surface.stiffness, body = contact.stiffness;
  if (K > 0.0 && body > 0.0) surface.stiffness = K * body / (K + body);
  return surface;
}

/// How far ahead of a finger its body is asked.
struct foresight {
  /// In times from one update to the next, at most 1000: ½ is the middle of the time that news count. News that come
  /// L [s] late at R [Hz] want ½ + L R. 0: where the finger is.
  double periods = 0.5;
  double most = 0.005;  ///< [m], however fast the finger is
};

/// Where to ask a body. News count from their arrival to the next ones, and so they are made for the middle of that
/// time: with x the finger and x' the finger of the last update, for
///
///     x + periods (x − x'),      at most `most` from x.
///
/// It needs no clock, and goes to x as updates come faster. Such news are made for what is to come: tell no age of
/// them. The port pays for what a surface does, and not for where it was asked, so a guess that is wrong costs truth and
/// no energy. Figures: docs/design/error.md.
class ahead {
 public:
  /// Throws std::invalid_argument for what is not finite, negative, or too many periods.
  explicit ahead(const foresight& f = {}) : far_(f) {
    if (!(f.periods >= 0.0 && f.periods <= 1000.0)) {
      refuse_argument("ahead: ", f.periods,
                      " periods are refused; give 0 to 1000, 0.5 + latency × rate");
    }
    if (!(f.most >= 0.0) || !std::isfinite(f.most)) {
      refuse_argument("ahead: at most ", f.most,
                      " m is refused; give a finite distance, 0: never ahead");
    }
  }
  /// Where the finger will be [m], for a finger [m] at this update. One that is not finite comes back as it is, and
  /// is not remembered; the first one comes back as it is, too.
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& finger) noexcept {
    const mesh::triple here = triple_of(finger);
    if (!is_finite(here)) return finger;
    const mesh::triple way = known_ ? (here - last_) * far_.periods : mesh::triple{};
    const double length = mesh::length(way);
    known_ = true;
    last_ = here;
    if (!std::isfinite(length)) return finger;
    return vector_of(here + (length > far_.most ? way * (far_.most / length) : way));
  }
  /// Forgets the last finger: the next one is where it is.
  void reset() noexcept { known_ = false; }

 private:
  foresight far_;
  mesh::triple last_;
  bool known_ = false;
};

/// The news of a body for a finger [m] and the force on it [N], asked ahead of the finger: its plane as it gives way.
/// Before the first contact it is a plane that every supply refuses.
template <touched_body Body>
[[nodiscard]] half_space<space<double, 3>> yielding(Body& body, ahead& where,
                                                    const Eigen::Vector3d& finger,
                                                    const Eigen::Vector3d& force) {
  const surface_contact contact = body.update(where(finger), force);
  return yielding(plane_at(body), contact);
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
