// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The points and cells that a VTK or VTU file has, and the tetrahedra among them.
//
// Kept are the tetrahedra, those of second order by their corners, and the nodes that they use; points, lines
// and faces are dropped, other volumes refused, as in an MSH file: without them the body would have holes.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/environment/node_graph.hpp>
#include <passive_haptics/environment/vtk_input.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// What load_vtk, load_vtu and load_mesh made of a file.
using loaded_mesh = loaded_msh;

/// How a surface becomes a body. Gmsh merges a file at the end of a LINE: each statement needs its own.
inline constexpr std::string_view fill_the_surface =
    "a body to be deformed needs tetrahedra. If it is closed, fill it: printf 'Merge \"in.stl\";\\n"
    "Surface Loop(1) = {1};\\nVolume(1) = {1};\\n' > in.geo && gmsh -3 in.geo -o out.msh; if it "
    "has "
    "holes: FloatTetwild_bin -i in.stl -o out.msh";

struct vtk_content {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::int64_t> nodes;  ///< of one cell after the other
  std::vector<std::int64_t> ends;   ///< of each cell in nodes, the first after a 0
  std::vector<std::int64_t> types;  ///< of each cell

  /// The next coordinate of the points.
  void add_coordinate(double value) {
    if (coordinates_ % 3 == 0) points.emplace_back(0.0, 0.0, 0.0);
    points.back()[static_cast<Eigen::Index>(coordinates_++ % 3)] = value;
  }

  /// The mesh, checked; `in` keeps the fault if there is one.
  [[nodiscard]] loaded_mesh mesh(vtk_input& in) const {
    if (types.size() + 1 != ends.size()) {
      in.fail(sentence("has ", types.size(), " cell types for ", ends.empty() ? 0 : ends.size() - 1,
                       " cells"));
    }
    tetrahedral_mesh found;
    std::vector<std::size_t> cell_of;  // a tetrahedron
    std::size_t higher_order = 0;
    for (std::size_t i = 0; i < types.size() && in.good(); ++i) {
      const std::int64_t type = types[i];
      if (is_flat(type)) continue;
      if (type != 10 && type != 24) {
        in.fail(sentence("cell ", i, " of type ", type, " is no tetrahedron"),
                "mesh the volume with tetrahedra alone, linear or of second order");
        break;
      }
      higher_order += type == 24 ? 1 : 0;
      add_tetrahedron(in, i, found);
      cell_of.push_back(i);
    }
    if (found.tetrahedra.empty()) in.fail("has no tetrahedra", fill_the_surface);
    if (!in.good()) return {{}, in.fault()};
    const std::size_t dropped = number_nodes(found);
    found = oriented(std::move(found));
    if (const auto wrong = find_fault(found)) {
      const auto cell = [&](int tetrahedron) {
        return sentence("cell ", cell_of[slot(tetrahedron)], " ");
      };
      std::string subject;
      if (wrong->tetrahedron >= 0) subject = cell(wrong->tetrahedron);
      if (wrong->other >= 0) subject += "and " + cell(wrong->other);
      in.fail(subject + wrong->problem, wrong->remedy);
      return {{}, in.fault()};
    }
    loaded_mesh result{std::move(found), std::nullopt};
    if (higher_order > 0) {
      result.notes.push_back(sentence(
          higher_order, " tetrahedra of higher order are taken by their corners; ", dropped,
          " nodes that are no corner, as those in the middle of edges, are dropped"));
    }
    return result;
  }

 private:
  /// Nothing, a vertex, a line or a face, of any order.
  [[nodiscard]] static bool is_flat(std::int64_t type) {
    return (type >= 0 && type <= 9) || (type >= 21 && type <= 23) || type == 28 || type == 30 ||
           (type >= 34 && type <= 36) || (type >= 68 && type <= 70) || (type >= 75 && type <= 77);
  }

  void add_tetrahedron(vtk_input& in, std::size_t cell, tetrahedral_mesh& to) const {
    const std::int64_t begin = ends[cell], end = ends[cell + 1];
    if (end - begin < 4 || end > static_cast<std::int64_t>(nodes.size())) {
      return in.fail(sentence("cell ", cell, " has fewer than four nodes"));
    }
    auto& corners = to.tetrahedra.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int64_t node = nodes[static_cast<std::size_t>(begin) + k];
      if (node >= static_cast<std::int64_t>(points.size())) {
        return in.fail(sentence("cell ", cell, " names node ", node, " of ", points.size()));
      }
      corners[k] = static_cast<int>(node);
    }
  }

  /// Takes over the points that are corners, in their order; how many are not.
  [[nodiscard]] std::size_t number_nodes(tetrahedral_mesh& of) const {
    std::vector<int> number(points.size(), -1);
    for (const auto& t : of.tetrahedra) {
      for (const int node : t) number[slot(node)] = 0;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (number[i] < 0) continue;
      number[i] = static_cast<int>(of.nodes.size());
      of.nodes.push_back(points[i]);
    }
    for (auto& t : of.tetrahedra) {
      for (int& node : t) node = number[slot(node)];
    }
    return points.size() - of.nodes.size();
  }

  std::size_t coordinates_ = 0;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
