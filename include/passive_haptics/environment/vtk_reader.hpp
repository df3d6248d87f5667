// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads the tetrahedra of a legacy VTK file, ASCII or BINARY, as ParaView, Gmsh and meshio write them.
//
//   # vtk DataFile Version 2.0-5.1  ASCII | BINARY  DATASET UNSTRUCTURED_GRID
//   POINTS n type      CELLS n size  |  CELLS n+1 size  OFFSETS .. CONNECTIVITY ..      CELL_TYPES n
//   FIELD and METADATA before the cell types are skipped; what follows them is data, and is not read
//
// Binary numbers are big-endian, as the format has it. What is kept: vtk_content.hpp. Format: VTK File
// Formats, Kitware.

#include <passive_haptics/environment/vtk_content.hpp>
#include <passive_haptics/environment/vtk_input.hpp>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string_view>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// One reading of one file; use load_vtk.
class vtk_reader {
 public:
  vtk_reader(std::istream& in, std::string_view name) : in_(in, name) {}

  [[nodiscard]] loaded_mesh read() {
    head();
    while (in_.good() && content_.types.empty()) {
      const std::string_view section = in_.word();
      if (section == "POINTS") {
        points();
      } else if (section == "CELLS") {
        cells();
      } else if (section == "CELL_TYPES") {
        array(content_.types, in_.count("number of cell types"), "int", "cell type");
        if (content_.types.empty()) in_.fail("has no cells", "mesh the volume");
      } else if (section == "FIELD") {
        field();
      } else if (section == "METADATA") {
        in_.line();
        while (!in_.line().empty()) {
        }
      } else if (section.empty()) {
        in_.fail("ends before its CELL_TYPES");
      } else {
        in_.fail(sentence("has ", msh_input::quoted(section),
                          " where POINTS, CELLS or CELL_TYPES should be"));
      }
    }
    return content_.mesh(in_);
  }

 private:
  void head() {
    const std::string_view first = in_.line();
    if (!first.starts_with("# vtk DataFile Version")) {
      return in_.fail("is no legacy VTK file: its first line is another",
                      first.starts_with("<") ? "give an XML file the extension .vtu"
                                             : "save the mesh as .msh, .vtk or .vtu");
    }
    in_.line();  // the title
    const std::string_view encoding = in_.word();
    if (encoding == "BINARY") {
      written_ = vtk_numbers::encoding::big_endian;
    } else if (encoding != "ASCII") {
      return in_.fail(sentence("is neither ASCII nor BINARY but ", msh_input::quoted(encoding)));
    }
    if (in_.word() != "DATASET") return in_.fail("has no DATASET");
    if (const auto kind = in_.word(); kind == "POLYDATA") {
      in_.fail("is a surface", fill_the_surface);
    } else if (kind != "UNSTRUCTURED_GRID") {
      in_.fail(sentence("is no unstructured grid but ", msh_input::quoted(kind)),
               "give a mesh of tetrahedra");
    }
  }

  /// Binary numbers begin with the next line.
  [[nodiscard]] vtk_numbers numbers_of(std::string_view type) {
    const vtk_numbers are = vtk_numbers::of(type, written_);
    if (are.bytes == 0) {
      in_.fail(sentence("has numbers of type ", msh_input::quoted(type), ", which is not read"));
    }
    if (written_ != vtk_numbers::encoding::text) in_.line();
    return are;
  }

  void array(std::vector<std::int64_t>& to, std::int64_t total, std::string_view type,
             std::string_view what) {
    in_.numbers<std::int64_t>(total, numbers_of(type), what,
                              [&](std::int64_t n) { to.push_back(n); });
  }

  void points() {
    const std::int64_t total = in_.count("number of points");
    const vtk_numbers are = numbers_of(in_.word());
    content_.points.clear();
    in_.numbers<double>(3 * total, are, "coordinate",
                        [this](double x) { content_.add_coordinate(x); });
  }

  void cells() {
    const std::int64_t first = in_.count("number of cells");
    const std::int64_t second = in_.count("number of cell entries");
    content_.ends.clear();
    content_.nodes.clear();
    auto rest = in_.rest();
    rest.remove_prefix((std::min)(rest.size(), rest.find_first_not_of(" \r\n")));
    if (rest.starts_with("OFFSETS")) {
      static_cast<void>(in_.word());
      array(content_.ends, first, in_.word(), "cell offset");
      if (in_.word() != "CONNECTIVITY") return in_.fail("has no CONNECTIVITY");
      return array(content_.nodes, second, in_.word(), "node of a cell");
    }
    // How many nodes, and which, cell after cell.
    content_.ends.push_back(0);
    std::int64_t left = -1, entries = 0;
    in_.numbers<std::int64_t>(second, numbers_of("int"), "node of a cell", [&](std::int64_t n) {
      ++entries;
      if (left > 0) {
        content_.nodes.push_back(n);
        --left;
      } else {
        left = n;
        if (n > second - entries) in_.fail("has larger cells than it says");
      }
      if (left == 0) content_.ends.push_back(static_cast<std::int64_t>(content_.nodes.size()));
    });
    if (static_cast<std::int64_t>(content_.ends.size()) != first + 1) {
      in_.fail(sentence("has ", content_.ends.size() - 1, " cells of ", first));
    }
  }

  /// FIELD name n, then n times: name, components, tuples, type, numbers. ParaView keeps the time there.
  void field() {
    static_cast<void>(in_.word());
    for (std::int64_t i = in_.count("number of arrays"); i > 0 && in_.good(); --i) {
      static_cast<void>(in_.word());
      const std::int64_t components = in_.count("number of components");
      const std::int64_t tuples = in_.count("number of tuples");
      const vtk_numbers are = numbers_of(in_.word());
      const bool is_text = written_ == vtk_numbers::encoding::text;
      const auto left = static_cast<std::int64_t>(in_.rest().size());
      if (components > 0 && tuples > left / components) return in_.fail("ends within a FIELD");
      for (std::int64_t k = 0; is_text && k < components * tuples; ++k) {
        static_cast<void>(in_.word());
      }
      if (!is_text) in_.skip(static_cast<std::size_t>(components * tuples) * are.bytes);
    }
  }

  vtk_input in_;
  vtk_content content_;
  vtk_numbers::encoding written_ = vtk_numbers::encoding::text;
};

/// The tetrahedra of a legacy VTK stream, or what is wrong with it, whatever the bytes. A binary file needs a
/// stream that is opened as one.
[[nodiscard]] inline loaded_mesh load_vtk(std::istream& in, std::string_view name) {
  return vtk_reader(in, name).read();
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
