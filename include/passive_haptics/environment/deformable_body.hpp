// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A deformable body to be touched: mesh, finite elements and surface, tied together for a slow
// loop.
//
//     deformable_body body{ball(0.05), {.young = 2e4, .poisson = 0.3}, ball_fixed_nodes(), {}};
//     every 20-50 ms:  contact = body.update(device position, force on the device)
//
// The loop of local model and body has the eigenvalue −K_LM/K_VE: with equal stiffness the surface
// swings for ever under a device that stands still (A12). `relaxation` decides:
//   dead_beat   F ← F + w (F_LM − F), w = K_VE/(K_VE + K_LM): settles in one update
//   none        F ← F_LM, the thesis: only for K_LM well below K_VE

#include <passive_haptics/environment/contact_tracker.hpp>
#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/tetrahedral_fem.hpp>
#include <passive_haptics/environment/triangle.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// What the local model needs to know of the body.
struct surface_contact {
  std::array<Eigen::Vector3d, 3> nodes{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                       Eigen::Vector3d::Zero()};  ///< of the triangle [m]
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< p: of the triangle, closest to device [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< n: of the triangle, unit, outward
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< barycentric, of p
  int triangle = -1;                                  ///< −1 until the first good update
  double depth = 0.0;                                 ///< (p − x)·n [m], positive inside
  double stiffness = 0.0;                             ///< of the body at p along n [N/m]
  bool fresh = false;  ///< false: the last state, because the input could not be used
};

enum class contact_selection : std::uint8_t {
  closest_point,  ///< with hysteresis; for any shape
  normal_match,   ///< thesis A.1, for comparison; for balls. The sign of depth is that of one plane
};

enum class force_relaxation : std::uint8_t { none, dead_beat };

struct body_options {
  double margin = 2e-4;  ///< hysteresis of closest_point [m]
  force_split split = force_split::barycentric;
  contact_selection selection = contact_selection::closest_point;
  force_relaxation relaxation = force_relaxation::dead_beat;
  double local_stiffness = 0.0;  ///< K_LM [N/m]; 0: the local model uses the one reported
  double max_stiffness = 1e6;    ///< [N/m] reported at most: a face of three fixed nodes is rigid
};

/// Neither copied nor moved: it holds a factorisation.
class deformable_body {
 public:
  /// Throws what tetrahedral_fem, boundary and contact_tracker throw, and std::invalid_argument for
  /// an option out of range.
  deformable_body(const tetrahedral_mesh& mesh, const material& m, std::span<const int> fixed_nodes,
                  const body_options& options = {})
      : options_(options),
        fem_(mesh, m, fixed_nodes),
        surface_(boundary(mesh)),
        tracker_(options.margin),
        rest_(mesh.nodes),
        nodes_(mesh.nodes),
        next_(mesh.nodes),
        forces_(mesh.nodes.size(), Eigen::Vector3d::Zero()) {
    if (!(options.local_stiffness >= 0.0) || !std::isfinite(options.local_stiffness)) {
      refuse_argument("deformable_body: local stiffness ", options.local_stiffness,
                      " N/m is refused; give a finite one, 0: as reported");
    }
    if (!(options.max_stiffness > 0.0) || !std::isfinite(options.max_stiffness)) {
      refuse_argument("deformable_body: greatest stiffness ", options.max_stiffness,
                      " N/m is refused; give a finite one above zero");
    }
    double volume = 0.0;
    for (const auto& t : mesh.tetrahedra) {
      for (const int node : t) {
        centre_ += signed_volume(mesh, t) / 4.0 * mesh.nodes[static_cast<std::size_t>(node)];
      }
      volume += signed_volume(mesh, t);
    }
    centre_ /= volume;
    for (const auto& node : rest_) extent_ = (std::max)(extent_, (node - centre_).norm());
  }

  /// One update of the slow loop. Loads the contact of the LAST update, the one the local model
  /// answered, with the reaction to `force_on_device` [N]; then finds the contact for `device` [m].
  /// Away from the body the force is zero, the body comes to rest, and the contact names the
  /// nearest triangle with depth ≤ 0. Input that is not finite, or would move a node by 1000 times
  /// the size of the body, changes nothing: the last contact comes back with fresh = false. Never
  /// throws, allocates or factorises.
  surface_contact update(const Eigen::Vector3d& device, const Eigen::Vector3d& force_on_device) {
    contact_.fresh = false;
    if (!device.allFinite() || !force_on_device.allFinite()) return contact_;
    const Eigen::Vector3d force = relaxed(force_on_device);
    if (!deform_under(force)) return contact_;
    const auto found = options_.selection == contact_selection::closest_point
                           ? tracker_.find(surface_, next_, device)
                           : match_normal(surface_, next_, centre_, device);
    if (!found || !std::isfinite(found->depth)) return contact_;

    force_ = force;
    nodes_.swap(next_);
    const surface_triangle& t = surface_[static_cast<std::size_t>(found->triangle)];
    const double stiffness = fem_.stiffness(t.nodes, found->weights, found->normal);
    contact_ = {corners(t, nodes_),
                found->point,
                found->normal,
                found->weights,
                found->triangle,
                found->depth,
                (std::min)(stiffness, options_.max_stiffness),
                true};
    return contact_;
  }

  /// Present positions of the nodes [m].
  [[nodiscard]] const std::vector<Eigen::Vector3d>& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const std::vector<surface_triangle>& surface() const noexcept { return surface_; }
  [[nodiscard]] const surface_contact& contact() const noexcept { return contact_; }

  /// The relaxed force [N] whose reaction deforms the body.
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }

 private:
  /// F + w (F_LM − F) with the w of the contact that was answered; zero before the first. (A12)
  [[nodiscard]] Eigen::Vector3d relaxed(const Eigen::Vector3d& answer) const {
    if (contact_.triangle < 0) return Eigen::Vector3d::Zero();
    if (options_.relaxation == force_relaxation::none) return answer;
    const double local =
        options_.local_stiffness > 0.0 ? options_.local_stiffness : contact_.stiffness;
    return force_ + contact_.stiffness / (contact_.stiffness + local) * (answer - force_);
  }

  /// next_ ← rest + u(−force at the last contact); false if the body would fly apart. (A13)
  [[nodiscard]] bool deform_under(const Eigen::Vector3d& force) {
    std::fill(forces_.begin(), forces_.end(), Eigen::Vector3d::Zero());
    if (contact_.triangle >= 0) {
      const surface_triangle& t = surface_[static_cast<std::size_t>(contact_.triangle)];
      const Eigen::Vector3d shares =
          force_shares(options_.split, corners(t, nodes_), contact_.weights);
      for (std::size_t k = 0; k < 3; ++k) {
        forces_[static_cast<std::size_t>(t.nodes[k])] =
            -shares[static_cast<Eigen::Index>(k)] * force;
      }
    }
    const auto& u = fem_.displacements(forces_);
    for (std::size_t i = 0; i < next_.size(); ++i) next_[i] = rest_[i] + u[i];
    return std::all_of(u.begin(), u.end(), [&](const auto& d) { return d.norm() < 1e3 * extent_; });
  }

  body_options options_;
  tetrahedral_fem fem_;
  std::vector<surface_triangle> surface_;
  contact_tracker tracker_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  ///< of mass, at rest [m]
  double extent_ = 0.0;                               ///< largest distance from centre_ [m]
  std::vector<Eigen::Vector3d> rest_;
  std::vector<Eigen::Vector3d> nodes_;
  std::vector<Eigen::Vector3d> next_;  ///< nodes_ to be, until the update is known to be good
  std::vector<Eigen::Vector3d> forces_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();  ///< F, on the device, relaxed [N]
  surface_contact contact_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
