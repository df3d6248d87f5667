// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A deformable body to be touched: a mesh, its finite elements and its surface, for a slow loop.
//
//     deformable_body body{ball(0.05), {.young = 2e4, .poisson = 0.3}, ball_fixed_nodes(), {}};
//     every 20-50 ms:  contact = body.update(device position, force on the device)
//
// For 10⁴ nodes and more, state the nodes that are touched and the fingertip's radius [m], and move nodes near it only.
//
//     deformable_body body{mesh, tetrahedral_fem(mesh, m, fixed, {.touched = patch}),
//                          {.radius = 0.005, .moved = moved_nodes::around}};
//
// The loop of local model (stiffness K_LM) and body (K_VE) has the eigenvalue −K_LM/K_VE from update to update: with
// equal stiffness the surface oscillates for ever under a device at rest (docs/design/audit.md A12). `relaxation`:
//   dead_beat   F ← F + w (F_LM − F), w = K_VE/(K_VE + K_LM): settles in one update
//   none        F ← F_LM, the thesis: only for K_LM well below K_VE

#include <passive_haptics/environment/contact_area.hpp>
#include <passive_haptics/environment/contact_tracker.hpp>
#include <passive_haptics/environment/marks.hpp>
#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/surface_contact.hpp>
#include <passive_haptics/environment/surface_search.hpp>
#include <passive_haptics/environment/tetrahedral_fem.hpp>
#include <passive_haptics/environment/triangle_weights.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

enum class contact_selection : std::uint8_t {
  closest_point,  ///< with hysteresis; for any shape
  normal_match,   ///< thesis A.1, for comparison: for balls only; depth is that of one plane
};

enum class force_relaxation : std::uint8_t { none, dead_beat };

/// Which nodes an update moves.
enum class moved_nodes : std::uint8_t {
  all,  ///< all nodes move, and the contact is the closest point of the whole body
  around,  ///< for large bodies: only the nodes that the contact passes, and two rings around it, move.
  ///< The contact goes from triangle to triangle, so it misses a part of the body that comes close
  ///< elsewhere; all other nodes of nodes() are at rest
};

struct body_options {
  double margin = 2e-4;                          ///< hysteresis of closest_point [m]
  force_split split = force_split::barycentric;  ///< rule for a force at a point, on three nodes
  double radius = 0.0;  ///< radius of a fingertip [m] (contact_area.hpp); 0: a point
  contact_selection selection = contact_selection::closest_point;
  force_relaxation relaxation = force_relaxation::dead_beat;
  double local_stiffness = 0.0;  ///< K_LM [N/m]; 0: the local model uses the stiffness reported
  double max_stiffness = 1e6;    ///< largest stiffness reported [N/m]: a fixed face is rigid
  moved_nodes moved = moved_nodes::all;
  on_progress tell = {};      ///< called while K is factorised; false throws stopped_by_caller
  double memory_limit = 0.0;  ///< for the factor [B]; 0: available memory (memory_limit.hpp)
};

/// The elastic solid behind a body. press() chooses a point or an area and returns its compliance C [m/N];
/// load() sets the force on it [N], as often as needed; displacement() is u [m] of a node under that force.
template <class E>
concept elastic_solid = requires(E solid, const std::array<int, 3>& nodes, const Eigen::Vector3d& v,
                                 std::span<const int> some, std::span<const double> shares,
                                 int node) {
  { solid.press(nodes, v) } -> std::convertible_to<Eigen::Matrix3d>;
  { solid.press(some, shares) } -> std::convertible_to<Eigen::Matrix3d>;
  { solid.compliance(nodes, v) } -> std::convertible_to<Eigen::Matrix3d>;
  solid.load(v);
  { solid.displacement(node) } -> std::convertible_to<Eigen::Vector3d>;
  { solid.moves(node) } -> std::convertible_to<bool>;
  { solid.mesh_nodes() } -> std::convertible_to<std::size_t>;
};

/// A body on an elastic solid: finite elements (deformable_body), or a table of their compliances
/// (compliance_table.hpp). It can be moved but not copied.
template <elastic_solid Elastic>
class basic_deformable_body {
 public:
  /// Throws what tetrahedral_fem, boundary and contact_tracker throw, and std::invalid_argument for
  /// an option out of range.
  basic_deformable_body(const tetrahedral_mesh& mesh, const material& m,
                        std::span<const int> fixed_nodes, const body_options& options = {})
      : basic_deformable_body(mesh,
                              Elastic(mesh, m, fixed_nodes,
                                      {.tell = options.tell, .memory_limit = options.memory_limit}),
                              options) {}

  /// The same with a solid that has been made of this mesh. Throws std::invalid_argument for another size.
  basic_deformable_body(const tetrahedral_mesh& mesh, Elastic solid,
                        const body_options& options = {})
      : options_(options),
        solid_(std::move(solid)),
        search_(boundary(mesh), mesh.nodes),
        tracker_(options.margin),
        area_(search_, mesh.nodes),
        rest_(mesh.nodes),
        nodes_(mesh.nodes),
        next_(mesh.nodes),
        met_(mesh.nodes.size()) {
    if (solid_.mesh_nodes() != mesh.nodes.size()) {
      refuse_argument("deformable_body: a solid of ", solid_.mesh_nodes(),
                      " nodes is refused on a mesh of ", mesh.nodes.size(),
                      "; give the mesh that it was made of");
    }
    if (!(options.radius >= 0.0) || !std::isfinite(options.radius)) {
      refuse_argument("deformable_body: a fingertip of radius ", options.radius,
                      " m is refused; give a finite one, 0: a point");
    }
    if (!(options.local_stiffness >= 0.0) || !std::isfinite(options.local_stiffness)) {
      refuse_argument("deformable_body: local stiffness ", options.local_stiffness,
                      " N/m is refused; give a finite one, 0: as reported");
    }
    if (!(options.max_stiffness > 0.0) || !std::isfinite(options.max_stiffness)) {
      refuse_argument("deformable_body: greatest stiffness ", options.max_stiffness,
                      " N/m is refused; give a finite one above zero");
    }
    if (around() && options.selection == contact_selection::normal_match) {
      refuse_argument(
          "deformable_body: normal_match looks at the whole body, and moved_nodes::around moves a "
          "part of it; choose closest_point, or moved_nodes::all");
    }
    for (int node = 0; node < static_cast<int>(rest_.size()); ++node) {
      if (solid_.moves(node)) moving_.push_back(node);
    }
    for (int i = 0; i < static_cast<int>(search_.size()); ++i) {
      const auto& corner = search_[slot(i)].nodes;
      if (std::any_of(corner.begin(), corner.end(), [&](int n) { return solid_.moves(n); })) {
        moving_triangles_.push_back(i);
      }
    }
    moved_.reserve(rest_.size());
    moved_before_.reserve(rest_.size());
    double volume = 0.0;
    passive_haptics::mesh::triple centre;
    for (const auto& t : mesh.tetrahedra) {
      const double share = signed_volume(mesh, t);
      for (const int node : t) centre = centre + triple_of(rest_[slot(node)]) * (share / 4.0);
      volume += share;
    }
    centre = centre * (1.0 / volume);
    centre_ = vector_of(centre);
    for (const auto& node : rest_) extent_ = (std::max)(extent_, length(triple_of(node) - centre));
  }

  /// One update of the slow loop. It loads the contact of the LAST update, which the local model has
  /// answered, with the reaction to `force_on_device` [N]; then it finds the contact for `device` [m].
  /// Away from the body the force is zero, the body comes to rest, and the contact names the nearest
  /// triangle with depth ≤ 0. Input that is not finite, or would move a node by 1000 times the size of
  /// the body, changes nothing: the last contact is returned with fresh = false. It never throws,
  /// allocates or factorises, unless the solid does.
  surface_contact update(const Eigen::Vector3d& device, const Eigen::Vector3d& force_on_device) {
    contact_.fresh = false;
    if (!is_finite(triple_of(device)) || !is_finite(triple_of(force_on_device))) return contact_;
    const Eigen::Vector3d force = relaxed(force_on_device);
    const auto found = around() ? find_around(device, force) : find_anywhere(device, force);
    if (!found || !within_reach_ || !std::isfinite(found->depth)) return contact_;

    force_ = force;
    nodes_.swap(next_);
    moved_.swap(moved_before_);
    const surface_triangle& t = search_[slot(found->triangle)];
    const triangle shape = corners(t, nodes_);
    const Eigen::Vector3d& n = found->normal;
    const double give = press(t, shape, *found);
    contact_ = {shape,
                found->point,
                n,
                found->weights,
                at_rest(t, found->weights),
                found->triangle,
                found->depth,
                give * options_.max_stiffness > 1.0 ? 1.0 / give : options_.max_stiffness,
                true};
    return contact_;
  }

  /// Present positions of the nodes [m].
  [[nodiscard]] const std::vector<Eigen::Vector3d>& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const std::vector<surface_triangle>& surface() const noexcept {
    return search_.triangles();
  }
  /// The surface, and the triangles that meet at a node: for quadric_at().
  [[nodiscard]] const surface_search& search() const noexcept { return search_; }
  [[nodiscard]] const surface_contact& contact() const noexcept { return contact_; }

  /// The relaxed force [N] whose reaction deforms the body.
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }

  /// All nodes [m] under force() at the present contact, for a picture, even where an update moves only some of
  /// them. It takes as long as an update that moves all.
  [[nodiscard]] std::vector<Eigen::Vector3d> picture() {
    std::vector<Eigen::Vector3d> all = rest_;
    if (contact_.triangle < 0) return all;
    solid_.load(-force_);
    for (const int node : moving_) all[slot(node)] += solid_.displacement(node);
    return all;
  }

 private:
  [[nodiscard]] bool around() const noexcept { return options_.moved == moved_nodes::around; }

  [[nodiscard]] Eigen::Vector3d at_rest(const surface_triangle& t,
                                        const Eigen::Vector3d& weights) const {
    return point_at(corners(t, rest_), weights);
  }
  /// F + w (F_LM − F) [N] with the w of the last contact; zero before the first contact. (A12)
  [[nodiscard]] Eigen::Vector3d relaxed(const Eigen::Vector3d& answer) const {
    if (contact_.triangle < 0) return Eigen::Vector3d::Zero();
    if (options_.relaxation == force_relaxation::none) return answer;
    const double local =
        options_.local_stiffness > 0.0 ? options_.local_stiffness : contact_.stiffness;
    const double share = contact_.stiffness / (contact_.stiffness + local);
    return vector_of(mesh::between(triple_of(force_), triple_of(answer), share));
  }

  /// Presses the point or area that the next force will act on; returns its compliance along the normal [m/N].
  [[nodiscard]] double press(const surface_triangle& t, const triangle& shape,
                             const surface_point& on) {
    const Eigen::Vector3d& n = on.normal;
    if (options_.radius > 0.0) {
      area_.gather(search_, rest_, t, on.weights, options_.radius);
      solid_.press(area_.nodes(), area_.shares());
      solid_.load(n);  // the contact point moves farther than the mean that press() returns
      double give = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        give += on.weights[static_cast<Eigen::Index>(k)] *
                mesh::dot(triple_of(n), triple_of(solid_.displacement(t.nodes[k])));
      }
      return give;
    }
    // With barycentric shares one solution gives both the compliance and the response to the load.
    if (options_.split == force_split::barycentric) {
      return across(solid_.press(t.nodes, on.weights), n, n);
    }
    const double give = across(solid_.compliance(t.nodes, on.weights), n, n);
    solid_.press(t.nodes, force_shares(options_.split, shape, on.weights));
    return give;
  }

  /// next_ of a node ← rest + u, once per update. (A13)
  void move(int node) {
    if (!met_.add(node)) return;
    moved_.push_back(node);
    const mesh::triple u = triple_of(solid_.displacement(node));
    next_[slot(node)] = vector_of(triple_of(rest_[slot(node)]) + u);
    within_reach_ = within_reach_ && mesh::length(u) < 1e3 * extent_;
  }
  void begin_moves(const Eigen::Vector3d& force) {
    within_reach_ = true;
    for (const int node : moved_) next_[slot(node)] = rest_[slot(node)];
    moved_.clear();
    met_.clear();
    if (contact_.triangle >= 0) solid_.load(vector_of(triple_of(force) * -1.0));
  }

  [[nodiscard]] std::optional<surface_point> find_anywhere(const Eigen::Vector3d& device,
                                                           const Eigen::Vector3d& force) {
    begin_moves(force);
    const bool at_rest = triple_of(force) == mesh::triple{};
    if (!at_rest) {
      for (const int node : moving_) move(node);
      if (!within_reach_) return std::nullopt;
    }
    if (options_.selection == contact_selection::normal_match) {
      return match_normal(surface(), next_, centre_, device);
    }
    if (!at_rest || !fitted_to_rest_) search_.refit(next_, moving_triangles_);
    fitted_to_rest_ = at_rest;
    return tracker_.find(search_, next_, device);
  }

  /// The tree keeps the positions at rest: it finds the first contact, from which the others are followed.
  [[nodiscard]] std::optional<surface_point> find_around(const Eigen::Vector3d& device,
                                                         const Eigen::Vector3d& force) {
    begin_moves(force);
    if (triple_of(force) == mesh::triple{}) return tracker_.find(search_, next_, device);
    const auto move_corners = [&](int i) {
      for (const int node : search_[slot(i)].nodes) move(node);
    };
    const auto found = tracker_.follow(search_, next_, device, move_corners);
    if (!found) return found;
    for (const int node : search_[slot(found->triangle)].nodes) {
      for (const int beside : search_.triangles_at(node)) {
        for (const int ring : search_[slot(beside)].nodes) {
          for (const int i : search_.triangles_at(ring)) move_corners(i);
        }
      }
    }
    return found;
  }

  body_options options_;
  Elastic solid_;
  surface_search search_;
  contact_tracker tracker_;
  contact_area area_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  ///< of mass, at rest [m]
  double extent_ = 0.0;                               ///< largest distance from centre_ [m]
  std::vector<int> moving_;                           ///< nodes that can move
  std::vector<int> moving_triangles_;                 ///< triangles with a node that can move
  std::vector<Eigen::Vector3d> rest_;
  std::vector<Eigen::Vector3d> nodes_;
  std::vector<Eigen::Vector3d> next_;  ///< becomes nodes_ if the update is good
  std::vector<int> moved_;             ///< nodes of next_ that are not at rest
  std::vector<int> moved_before_;      ///< nodes of nodes_ that are not at rest
  marks met_;                          ///< nodes that this update has moved
  bool within_reach_ = true;           ///< no node has moved by 1000 times the size of the body
  bool fitted_to_rest_ = true;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();  ///< F, on the device, relaxed [N]
  surface_contact contact_;
};

/// A body of finite elements.
using deformable_body = basic_deformable_body<tetrahedral_fem>;

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
