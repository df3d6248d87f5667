// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads the tetrahedra of a Gmsh MSH file (ASCII): versions 1, 2.0-2.2 and 4.1.
//
//   $NOD .. $ELM                       version 1, no header
//   $MeshFormat 2.x  $Nodes $Elements  one record per line
//   $MeshFormat 4.1  $Nodes $Elements  blocks per entity; parametric nodes are understood
//   anything else between $X and $EndX is skipped ($PhysicalNames, $Entities, $NodeData, ...)
//
// Kept are the 4-node tetrahedra and the nodes they use, in the order of the file: lines, triangles
// and nodes used by no tetrahedron are dropped, tags need not be contiguous. A mesh whose elements
// are all inverted follows the other convention and is turned (mesh.hpp, oriented); a mixture is
// refused. No unit is known to the format: bring lengths to metres with scaled().
// Format: Gmsh reference manual, "Gmsh file formats".

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/msh_content.hpp>
#include <passive_haptics/environment/msh_lines.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// One reading of one file; use read_msh.
class msh_reader {
 public:
  msh_reader(std::istream& in, std::string_view name) : lines_(in, name) {}

  [[nodiscard]] tetrahedral_mesh read() {
    while (lines_.next()) section();
    if (first_line_) lines_.fail_at(0, "is empty", "save the mesh again as ASCII MSH");
    if (!nodes_read_) lines_.fail("has no $Nodes section", msh_lines::damaged);
    if (!elements_read_) lines_.fail("has no $Elements section", msh_lines::damaged);
    return content_.mesh(lines_);
  }

 private:
  void section() {
    const std::string name(lines_.line());
    if (name.front() != '$') {
      lines_.fail(sentence(first_line_ ? "is not a Gmsh mesh: " : "is outside of any section: ",
                           msh_lines::quoted(name)),
                  first_line_ ? "the first line must be $MeshFormat (MSH 2.2, 4.1) or $NOD (MSH 1)"
                              : msh_lines::damaged);
    }
    first_line_ = false;
    const std::string end = (name == "$NOD" || name == "$ELM" ? "$END" : "$End") + name.substr(1);
    if (name == "$MeshFormat") {
      format();
    } else if (name == "$NOD") {
      once(nodes_read_, name);
      flat_nodes();
    } else if (name == "$ELM") {
      once(elements_read_, name);
      flat_elements(true);
    } else if (name == "$Nodes") {
      once(nodes_read_, name);
      version(name) == 2 ? flat_nodes() : block_nodes();
    } else if (name == "$Elements") {
      once(elements_read_, name);
      version(name) == 2 ? flat_elements(false) : block_elements();
    } else {
      return skip(name, end);
    }
    if (!lines_.next())
      lines_.fail(sentence("ends before ", end), "the file is cut off: save again");
    if (lines_.line() != end) {
      lines_.fail(sentence("has ", msh_lines::quoted(lines_.line()), " where ", end, " should be"),
                  sentence("the count in ", name, " does not match its lines: save again"));
    }
  }

  void once(bool& read, const std::string& name) const {
    if (read) lines_.fail(sentence("is a second ", name, " section"), "keep one");
    read = true;
  }

  [[nodiscard]] int version(const std::string& name) const {
    if (version_ == 0) {
      lines_.fail(sentence(name, " comes before $MeshFormat"), msh_lines::damaged);
    }
    return version_;
  }

  void skip(const std::string& name, const std::string& end) {
    const int opened = lines_.number();
    while (lines_.next()) {
      if (lines_.line() == end) return;
    }
    lines_.fail_at(opened, sentence("opens ", msh_lines::quoted(name), ", which never ends"),
                   "the file is cut off, or is no Gmsh mesh: save again");
  }

  void format() {
    record("version", 0, 1);
    const double version = lines_.real("version");
    const bool binary = lines_.integer("file type") != 0;
    if (binary) {
      lines_.fail("is a binary mesh", "save as ASCII: gmsh in.msh -save -format msh22 -o out.msh");
    }
    version_ = version >= 2.0 && version < 3.0 ? 2 : version == 4.1 ? 4 : 0;
    if (version_ == 0) {
      lines_.fail(sentence("has format version ", version, "; read are 1, 2.0-2.2 and 4.1"),
                  "convert: gmsh in.msh -save -format msh22 -o out.msh");
    }
  }

  /// Goes to record i of `total`, which no section mark may interrupt.
  void record(std::string_view what, std::int64_t i, std::int64_t total) {
    if (!lines_.next()) {
      lines_.fail(sentence("ends at ", what, " ", i + 1, " of ", total),
                  "the file is cut off: save it again");
    }
    if (lines_.line().front() == '$') {
      lines_.fail(sentence("has ", msh_lines::quoted(lines_.line()), " where ", what, " ", i + 1,
                           " of ", total, " should be"),
                  "the count does not match the lines: save the mesh again");
    }
  }

  void flat_nodes() {
    record("number of nodes", 0, 1);
    const std::int64_t total = lines_.count("number of nodes");
    for (std::int64_t i = 0; i < total; ++i) {
      record("node", i, total);
      const std::int64_t tag = lines_.integer("node number");
      content_.add_node(lines_, tag);
      lines_.end_of_line();
    }
  }

  void flat_elements(bool first_version) {
    record("number of elements", 0, 1);
    const std::int64_t total = lines_.count("number of elements");
    for (std::int64_t i = 0; i < total; ++i) {
      record("element", i, total);
      const std::int64_t tag = lines_.integer("element number");
      const std::int64_t type = lines_.integer("element type");
      // version 1: physical region, elementary region, number of nodes; version 2: tags, counted
      const std::int64_t words = first_version ? 3 : lines_.count("number of tags");
      for (std::int64_t k = 0; k < words; ++k) static_cast<void>(lines_.integer("tag"));
      content_.add_element(lines_, tag, type);
    }
  }

  void block_nodes() {
    std::int64_t left = 0;
    for (std::int64_t blocks = header(left, "number of nodes"); blocks > 0; --blocks) {
      record("node block", 0, blocks);
      const std::int64_t dimension = lines_.integer("entity dimension");
      static_cast<void>(lines_.integer("entity number"));
      const bool parametric = lines_.integer("parametric flag") != 0;
      const std::int64_t count = block_size(left);
      std::vector<std::int64_t> tags;
      for (std::int64_t i = 0; i < count; ++i) {
        record("node number", i, count);
        tags.push_back(lines_.integer("node number"));
        lines_.end_of_line();
      }
      for (std::int64_t i = 0; i < count; ++i) {
        record("node", i, count);
        content_.add_node(lines_, tags[static_cast<std::size_t>(i)]);
        for (std::int64_t k = 0; parametric && k < dimension; ++k) {
          static_cast<void>(lines_.real("parametric coordinate"));
        }
        lines_.end_of_line();
      }
    }
    if (left != 0) lines_.fail(sentence("ends ", left, " nodes early"), msh_lines::damaged);
  }

  void block_elements() {
    std::int64_t left = 0;
    for (std::int64_t blocks = header(left, "number of elements"); blocks > 0; --blocks) {
      record("element block", 0, blocks);
      static_cast<void>(lines_.integer("entity dimension"));
      static_cast<void>(lines_.integer("entity number"));
      const std::int64_t type = lines_.integer("element type");
      const std::int64_t count = block_size(left);
      for (std::int64_t i = 0; i < count; ++i) {
        record("element", i, count);
        const std::int64_t tag = lines_.integer("element number");
        content_.add_element(lines_, tag, type);
      }
    }
    if (left != 0) lines_.fail(sentence("ends ", left, " elements early"), msh_lines::damaged);
  }

  [[nodiscard]] std::int64_t header(std::int64_t& total, std::string_view what) {
    record("block header", 0, 1);
    const std::int64_t blocks = lines_.count("number of blocks");
    total = lines_.count(what);
    return blocks;
  }

  [[nodiscard]] std::int64_t block_size(std::int64_t& left) {
    const std::int64_t size = lines_.count("block size");
    if (size > left) {
      lines_.fail(sentence("has a block of ", size, " where ", left, " are left"),
                  "the counts do not match: save the mesh again");
    }
    left -= size;
    return size;
  }

  msh_lines lines_;
  msh_content content_;
  int version_ = 0;
  bool first_line_ = true;
  bool nodes_read_ = false;
  bool elements_read_ = false;
};

/// The tetrahedra of an ASCII MSH stream; `name` stands for the file in messages. Throws
/// mesh_error, nothing else, whatever the bytes.
[[nodiscard]] inline tetrahedral_mesh read_msh(std::istream& in, std::string_view name) {
  return msh_reader(in, name).read();
}

/// The tetrahedra of an ASCII MSH file.
[[nodiscard]] inline tetrahedral_mesh read_msh(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    refuse(mesh_error(name, "is a directory", "give the path of a .msh file"));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(mesh_error(name, "cannot be opened", "check the path and its permissions"));
  return read_msh(file, name);
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
