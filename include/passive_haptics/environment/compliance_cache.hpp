// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a patch of the surface answers, computed when a contact first needs it and kept: for bodies of up to
// some 10 000 nodes that have no table.
//
//     auto cache = env::cache_compliance(env::tetrahedral_fem(mesh, m, fixed), patch, 64e6);  // [B] at most
//     env::basic_deformable_body<env::compliance_cache<>> body(mesh, std::move(cache));
//
// A node takes 9M scalars for M nodes of the patch. Where they do not all fit, those of the node that was
// asked for longest ago are given up; those of one contact always fit, also of a fingertip that is wider than
// most_bytes. An update that needs a new node takes a full solution and the heap; one that needs none takes
// neither.

#include <passive_haptics/environment/memory_limit.hpp>
#include <passive_haptics/environment/patch_compliance.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

template <std::floating_point Scalar, column_solver Solver>
class computed_columns {
 public:
  computed_columns(basic_tetrahedral_fem<Solver> solid, std::vector<int> patch, double most_bytes)
      : solid_(std::move(solid)), patch_(std::move(patch)), place_of_(patch_.size(), -1) {
    const double each = 9.0 * static_cast<double>(patch_.size() * sizeof(Scalar));
    if (!(most_bytes >= 3.0 * each)) {
      refuse_argument("compliance_cache: ", most_bytes,
                      " B do not hold the three nodes of a contact; give ", 3.0 * each,
                      " B at least, or a smaller patch");
    }
    const auto places =
        static_cast<std::size_t>((std::min)(most_bytes / each, static_cast<double>(patch_.size())));
    check_memory("compliance_cache", each * static_cast<double>(places), 0.0, patch_.size());
    make_room(places);
  }

  /// Computes what is not there, for all of them at once. There is always room for what is asked for at once.
  void fetch(std::span<const int> indices) {
    if (indices.size() > places()) make_room(indices.size());
    missing_.clear();
    ++now_;
    for (const int i : indices) {
      if (const int place = place_of_[slot(i)]; place >= 0) {
        used_[slot(place)] = now_;
      } else if (std::find(missing_.begin(), missing_.end(), i) == missing_.end()) {
        missing_.push_back(i);
      }
    }
    if (missing_.empty()) return;
    std::vector<int> nodes;
    for (const int i : missing_) nodes.push_back(patch_[slot(i)]);
    const auto found = patch_columns<Scalar>(solid_, patch_, nodes);
    const std::size_t each = 9 * patch_.size();
    for (std::size_t k = 0; k < missing_.size(); ++k) {
      const auto place =
          static_cast<std::size_t>(std::min_element(used_.begin(), used_.end()) - used_.begin());
      if (node_at_[place] >= 0) place_of_[slot(node_at_[place])] = -1;
      node_at_[place] = missing_[k];
      place_of_[slot(missing_[k])] = static_cast<int>(place);
      used_[place] = now_;
      std::copy_n(found.data() + k * each, each, scalars_.data() + place * each);
    }
    computed_ += missing_.size();
  }
  /// Computes it if it is not there.
  [[nodiscard]] const Scalar* column(std::size_t index) {
    const int i = static_cast<int>(index);
    if (place_of_[index] < 0) fetch(std::span(&i, 1));
    return scalars_.data() + 9 * patch_.size() * slot(place_of_[index]);
  }

  /// Nodes there is room for, and how many have been computed, those counted again that had been given up.
  [[nodiscard]] std::size_t places() const noexcept { return node_at_.size(); }
  [[nodiscard]] std::size_t computed() const noexcept { return computed_; }

 private:
  void make_room(std::size_t places) {
    scalars_.resize(9 * patch_.size() * places);
    node_at_.resize(places, -1);
    used_.resize(places, 0);
  }

  basic_tetrahedral_fem<Solver> solid_;
  std::vector<int> patch_;
  std::vector<int> place_of_;        ///< of a node of the patch, or −1
  std::vector<int> node_at_;         ///< each place, or −1
  std::vector<std::uint64_t> used_;  ///< each place last
  std::uint64_t now_ = 0;
  std::vector<int> missing_;
  std::vector<Scalar> scalars_;
  std::size_t computed_ = 0;
};

/// An elastic_solid that computes its columns when they are asked for. Even const calls may compute: it is for
/// one thread.
template <std::floating_point Scalar = float, column_solver Solver = multifrontal>
using compliance_cache = patch_compliance<computed_columns<Scalar, Solver>>;

/// Of a patch of `solid`, in `most_bytes` [B] beside its factor, or what one contact needs if that is more.
/// std::invalid_argument for a patch that is none or does not fit, memory_refused where the system has less.
template <std::floating_point Scalar = float, column_solver Solver>
[[nodiscard]] compliance_cache<Scalar, Solver> cache_compliance(basic_tetrahedral_fem<Solver> solid,
                                                                std::vector<int> patch,
                                                                double most_bytes = 64e6) {
  const std::size_t mesh_nodes = solid.numbers().size();
  check_patch("compliance_cache", patch, mesh_nodes);
  computed_columns<Scalar, Solver> columns(std::move(solid), patch, most_bytes);
  return {std::move(columns), std::move(patch), mesh_nodes};
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
