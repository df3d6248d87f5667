// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What an MSH file has said so far, and the mesh that makes: tags become numbers, unused nodes go.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/msh_lines.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class msh_content {
 public:
  /// Takes the node `tag` with the x, y and z that follow on the line.
  void add_node(msh_lines& lines, std::int64_t tag) {
    const double x = lines.real("x");
    const double y = lines.real("y");
    const double z = lines.real("z");
    if (!index_.try_emplace(tag, nodes_.size()).second) {
      lines.fail(sentence("defines node ", tag, " again"), "give every node its own number");
    }
    nodes_.emplace_back(x, y, z);
  }

  /// Takes the element `tag`, whose nodes follow on the line, if it is a 4-node tetrahedron.
  void add_element(msh_lines& lines, std::int64_t tag, std::int64_t type) {
    constexpr std::int64_t tetrahedron = 4;
    constexpr std::int64_t quadratic_tetrahedron = 11;
    if (type != tetrahedron) {
      ++skipped_;
      quadratic_ = quadratic_ || type == quadratic_tetrahedron;
      return;
    }
    element e{tag, {}, lines.number()};
    for (auto& node : e.nodes) node = lines.integer("node number");
    lines.end_of_line();
    elements_.push_back(e);
  }

  /// The mesh, checked. `lines` words the faults.
  [[nodiscard]] tetrahedral_mesh mesh(const msh_lines& lines) const {
    if (elements_.empty()) {
      lines.fail(sentence("has no 4-node tetrahedra among its ", skipped_, " elements"),
                 quadratic_ ? "it is of second order: mesh with gmsh -3 -order 1"
                            : "mesh the volume: gmsh -3");
    }
    constexpr int unused = -1;
    std::vector<int> number(nodes_.size(), unused);
    for (const element& e : elements_) {
      for (const std::int64_t tag : e.nodes) {
        const auto found = index_.find(tag);
        if (found == index_.end()) {
          lines.fail_at(e.line, sentence("element ", e.tag, " names node ", tag, ", unknown"),
                        "the nodes are not all in the file: save the mesh again");
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
    for (const element& e : elements_) {
      auto& nodes = result.tetrahedra.emplace_back();
      for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = number[index_.at(e.nodes[k])];
    }
    result = oriented(std::move(result));
    if (const auto fault = find_fault(result)) {
      const auto found = [this](int number) {
        return elements_.at(static_cast<std::size_t>(number));
      };
      std::string subject = sentence("element ", found(fault->tetrahedron).tag, " ");
      if (fault->other >= 0) subject += sentence("and element ", found(fault->other).tag, " ");
      lines.fail_at(found(fault->tetrahedron).line, subject + fault->problem, fault->remedy);
    }
    return result;
  }

 private:
  struct element {
    std::int64_t tag;
    std::array<std::int64_t, 4> nodes;  ///< tags
    int line;
  };

  std::vector<Eigen::Vector3d> nodes_;
  std::unordered_map<std::int64_t, std::size_t> index_;  ///< of a tag in nodes_
  std::vector<element> elements_;
  std::int64_t skipped_ = 0;
  bool quadratic_ = false;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
