// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What an MSH file has said so far, and the mesh that makes: tags become numbers, what no tetrahedron
// uses goes.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/msh_input.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// A type of element: Gmsh reference manual, "MSH file format".
struct msh_type {
  enum class shape : std::uint8_t { unknown, flat, tetrahedron, other_volume };
  shape is = shape::unknown;
  int nodes = 0;  ///< of a tetrahedron the first four are its corners

  [[nodiscard]] static constexpr msh_type of(std::int64_t number) noexcept {
    constexpr std::array<int, 32> nodes{0,  2,  3,  4,  4, 8, 6,  5,  3,  6, 9,
                                        10, 27, 18, 14, 1, 8, 20, 15, 13, 9, 10,
                                        12, 15, 15, 21, 4, 5, 6,  20, 35, 56};
    const auto is_one_of = [number](const auto&... all) { return ((number == all) || ...); };
    if (is_one_of(92, 93)) return {shape::other_volume, number == 92 ? 64 : 125};
    if (number < 1 || number >= static_cast<std::int64_t>(nodes.size())) return {};
    msh_type type{shape::flat, nodes[static_cast<std::size_t>(number)]};
    if (is_one_of(4, 11, 29, 30, 31)) type.is = shape::tetrahedron;
    if (is_one_of(5, 6, 7, 12, 13, 14, 17, 18, 19)) type.is = shape::other_volume;
    return type;
  }
};

class msh_content {
 public:
  void add_node(msh_input& in, std::int64_t tag, double x, double y, double z) {
    if (!in.good()) return;
    if (!index_.try_emplace(tag, nodes_.size()).second) {
      in.fail(sentence("defines node ", tag, " again"), "give every node its own number");
    }
    nodes_.emplace_back(x, y, z);
  }

  /// What is said of an element before its nodes.
  struct heading {
    std::int64_t tag = 0;
    std::int64_t type = 0;
    std::int64_t entity = 0;  ///< of the geometry, which the element is a part of
    std::int64_t group = 0;   ///< physical; a file of version 1 or 2 repeats the element for each
  };

  /// Takes an element, whose nodes come next as numbers of `size` bytes, if it is a tetrahedron.
  void add_element(msh_input& in, const heading& is, int size) {
    const msh_type type = msh_type::of(is.type);
    element e{is, {}, in.place()};
    if (type.is == msh_type::shape::unknown) {
      in.fail(sentence("element ", is.tag, " has type ", is.type, ", which is not read"),
              "mesh the volume with linear tetrahedra: gmsh -3 -order 1");
    } else if (type.is == msh_type::shape::other_volume) {
      in.fail(
          sentence("element ", is.tag, " of type ", is.type, " has a volume and is no tetrahedron"),
          "mesh the volume with tetrahedra alone, without Recombine");
    }
    const bool kept = type.is == msh_type::shape::tetrahedron;
    skipped_ += kept ? 0 : 1;
    if (!kept && !in.binary()) return;  // the rest of the line
    for (int k = 0; k < type.nodes && in.good(); ++k) {
      const std::int64_t node = in.integer("node number", size);
      if (kept && k < 4) e.nodes[static_cast<std::size_t>(k)] = node;
    }
    if (!kept) return;
    in.end_of_record();
    elements_.push_back(e);
  }

  /// The mesh, checked; `in` keeps the fault if there is one.
  [[nodiscard]] tetrahedral_mesh mesh(msh_input& in) {
    if (elements_.empty()) {
      in.fail(sentence("has no tetrahedra among its ", skipped_, " elements"),
              "mesh the volume: gmsh -3");
    }
    drop_repeated();
    tetrahedral_mesh result = numbered(in);
    if (!in.good()) return {};
    result = oriented(std::move(result));
    if (const auto fault = find_fault(result)) {
      const auto tag = [this](int number) {
        return sentence("element ", elements_[static_cast<std::size_t>(number)].is.tag);
      };
      std::string subject = tag(fault->tetrahedron);
      if (fault->other >= 0) subject += " and " + tag(fault->other);
      in.fail_at(elements_[static_cast<std::size_t>(fault->tetrahedron)].place,
                 sentence(subject, " ", fault->problem), fault->remedy);
    }
    return result;
  }

  /// After mesh(): what of the file is not in the mesh although it might be looked for there.
  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> all;
    if (higher_order_ > 0) {
      all.push_back(sentence(
          higher_order_, " tetrahedra of higher order are taken by their corners; ", loose_,
          " nodes that are no corner, as those in the middle of edges, are dropped"));
    }
    if (repeated_ > 0) {
      all.push_back(sentence(repeated_,
                             " tetrahedra are in the file once more, because they are in "
                             "several physical groups; each is taken once"));
    }
    return all;
  }

 private:
  struct element {
    heading is;
    std::array<std::int64_t, 4> nodes;  ///< tags
    std::int64_t place;
  };

  /// The same nodes of the same entity in another physical group are the same element.
  void drop_repeated() {
    const auto in_first_group = [this](const element& e) {
      return e.is.group == elements_.front().is.group;
    };
    if (std::all_of(elements_.begin(), elements_.end(), in_first_group)) return;
    using key = std::tuple<std::int64_t, std::array<std::int64_t, 4>, std::size_t>;
    std::vector<key> sorted;
    sorted.reserve(elements_.size());
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      auto nodes = elements_[i].nodes;
      std::sort(nodes.begin(), nodes.end());
      sorted.emplace_back(elements_[i].is.entity, nodes, i);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<bool> drop(elements_.size(), false);
    std::size_t first = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      const auto& [entity, nodes, number] = sorted[i];
      if (entity != std::get<0>(sorted[first]) || nodes != std::get<1>(sorted[first])) first = i;
      drop[number] = elements_[number].is.group != elements_[std::get<2>(sorted[first])].is.group;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      if (!drop[i]) elements_[kept++] = elements_[i];
    }
    repeated_ = elements_.size() - kept;
    elements_.resize(kept);
  }

  /// Nodes and elements numbered from 0, without the nodes that no tetrahedron has as a corner.
  [[nodiscard]] tetrahedral_mesh numbered(msh_input& in) {
    constexpr int unused = -1;
    std::vector<int> number(nodes_.size(), unused);
    for (const element& e : elements_) {
      for (const std::int64_t tag : e.nodes) {
        const auto found = index_.find(tag);
        if (found == index_.end()) {
          in.fail_at(e.place, sentence("element ", e.is.tag, " names node ", tag, ", unknown"),
                     "the nodes are not all in the file: save the mesh again");
          return {};
        }
        number[found->second] = 0;
      }
    }
    tetrahedral_mesh result;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (number[i] == unused) continue;
      number[i] = static_cast<int>(result.nodes.size());
      result.nodes.push_back(nodes_[i]);
    }
    loose_ = nodes_.size() - result.nodes.size();
    for (const element& e : elements_) {
      higher_order_ += msh_type::of(e.is.type).nodes > 4 ? 1 : 0;
      auto& nodes = result.tetrahedra.emplace_back();
      for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = number[index_.at(e.nodes[k])];
    }
    return result;
  }

  std::vector<Eigen::Vector3d> nodes_;
  std::unordered_map<std::int64_t, std::size_t> index_;  ///< of a tag in nodes_
  std::vector<element> elements_;
  std::int64_t skipped_ = 0;       ///< points, lines and faces
  std::int64_t higher_order_ = 0;  ///< tetrahedra of more than four nodes
  std::size_t repeated_ = 0;       ///< for another group
  std::size_t loose_ = 0;          ///< nodes that are no corner
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
