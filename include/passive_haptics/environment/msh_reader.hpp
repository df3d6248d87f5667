// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads the tetrahedra of a Gmsh MSH file: versions 1, 2.0-2.2 and 4.1, as text and, from 2.0 on, in
// binary with either byte order.
//
//   $NOD .. $ELM                       version 1, no header
//   $MeshFormat 2.x  $Nodes $Elements  one record per node and element
//   $MeshFormat 4.1  $Nodes $Elements  blocks per entity; parametric nodes are understood
//   anything else between $X and $EndX is skipped ($PhysicalNames, $Entities, $NodeData, ...)
//
// Kept are the tetrahedra and the nodes that are their corners, in the order of the file: points,
// lines, triangles and nodes used by no tetrahedron are dropped, tags need not be contiguous.
// Tetrahedra of higher order are taken by their four corners. One that is in several physical groups
// is taken once, though versions 1 and 2 write it for each. Other volumes are refused: without them the
// body would have holes. A mesh whose elements are all inverted follows the other convention and is
// turned (mesh.hpp, oriented); a mixture is refused. No unit is known to the format: bring lengths to
// metres with scaled(). Format: Gmsh reference manual, "Gmsh file formats".

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/msh_content.hpp>
#include <passive_haptics/environment/msh_input.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// What load_msh made of a file.
struct loaded_msh {
  tetrahedral_mesh mesh;             ///< checked; empty if there is a fault
  std::optional<mesh_error> fault;   ///< the first thing wrong, with file, place and remedy
  std::vector<std::string> notes{};  ///< what the mesh leaves out of the file, a sentence each
};

/// One reading of one file; use load_msh or read_msh.
class msh_reader {
 public:
  msh_reader(std::istream& in, std::string_view name) : in_(in, name) {}

  [[nodiscard]] loaded_msh read() {
    while (in_.next()) section();
    if (first_line_) in_.fail_file("is empty", "save the mesh again");
    if (!nodes_read_) in_.fail("has no $Nodes section", msh_input::damaged);
    if (!elements_read_) in_.fail("has no $Elements section", msh_input::damaged);
    if (!in_.good()) return {{}, in_.fault()};
    tetrahedral_mesh mesh = content_.mesh(in_);
    if (!in_.good()) return {{}, in_.fault()};
    return {std::move(mesh), std::nullopt, content_.notes()};
  }

 private:
  void section() {
    const std::string name(in_.line());
    if (name.front() != '$') {
      in_.fail(sentence(first_line_ ? "is not a Gmsh mesh: " : "is outside of any section: ",
                        msh_input::quoted(name)),
               first_line_ ? "the first line must be $MeshFormat (MSH 2.2, 4.1) or $NOD (MSH 1)"
                           : msh_input::damaged);
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
    if (!in_.next()) {
      in_.fail(sentence("ends before ", end), "the file is cut off: save the mesh again");
    } else if (in_.line() != end) {
      in_.fail(
          sentence("has ", msh_input::quoted(in_.line()), " where ", end, " should be"),
          sentence("the count in ", name, " does not match what follows: save the mesh again"));
    }
  }

  void once(bool& read, const std::string& name) {
    if (read) in_.fail(sentence("is a second ", name, " section"), "keep one");
    read = true;
  }

  [[nodiscard]] int version(const std::string& name) {
    if (version_ == 0) {
      in_.fail(sentence(name, " comes before $MeshFormat"), msh_input::damaged);
    }
    return version_;
  }

  void skip(const std::string& name, const std::string& end) {
    const std::int64_t opened = in_.place();
    if (in_.skip_to(end)) return;
    in_.fail_at(opened, sentence("opens ", msh_input::quoted(name), ", which never ends"),
                "the file is cut off, or is no Gmsh mesh: save the mesh again");
  }

  void format() {
    line("version", 0, 1);
    const double version = in_.word_real("version");
    version_ = version >= 2.0 && version < 3.0 ? 2 : version == 4.1 ? 4 : 0;
    if (version_ == 0) {
      in_.fail(sentence("has format version ", version, "; read are 1, 2.0-2.2 and 4.1"),
               "convert: gmsh -0 -format msh41 -o out.msh in.msh");
    }
    if (in_.word_integer("file type") == 0 || !in_.good()) return;
    const std::int64_t size = in_.word_integer("data size");
    if (size != 8 && !(size == 4 && version_ == 4)) {
      in_.fail(sentence("has binary numbers of ", size, " bytes; read are 8, and 4 in version 4.1"),
               "convert: gmsh -0 -format msh41 -o out.msh in.msh");
    }
    tag_size_ = version_ == 2 ? 4 : static_cast<int>(size);
    in_.encode(msh_encoding::little_endian);
    const std::int64_t one = in_.integer("number one that shows the byte order", 4);
    if (one == 1) return;
    in_.encode(msh_encoding::big_endian);
    if (one != 1 << 24) {
      in_.fail(sentence("shows the byte order by ", one, ", which is no 1 in any order"),
               msh_input::damaged);
    }
  }

  /// Goes to the line of number i of `total`, which no section mark may interrupt.
  void line(std::string_view what, std::int64_t i, std::int64_t total) {
    if (!in_.next()) {
      in_.fail(sentence("ends at ", what, " ", i + 1, " of ", total),
               "the file is cut off: save the mesh again");
    } else if (in_.line().front() == '$') {
      in_.fail(sentence("has ", msh_input::quoted(in_.line()), " where ", what, " ", i + 1, " of ",
                        total, " should be"),
               "the count does not match what follows: save the mesh again");
    }
  }
  /// The same where binary numbers follow each other without lines.
  void record(std::string_view what, std::int64_t i, std::int64_t total) {
    if (!in_.binary()) line(what, i, total);
  }

  /// A count on a line of its own, in a binary file, too.
  [[nodiscard]] std::int64_t line_of_count(std::string_view what) {
    line(what, 0, 1);
    return in_.as_count(what, in_.word_integer(what));
  }
  [[nodiscard]] std::int64_t count(std::string_view what, int size) {
    return in_.as_count(what, in_.integer(what, size));
  }

  void node(std::int64_t tag) {
    const double x = in_.real("x");
    const double y = in_.real("y");
    content_.add_node(in_, tag, x, y, in_.real("z"));
  }

  void flat_nodes() {
    const std::int64_t total = line_of_count("number of nodes");
    for (std::int64_t i = 0; i < total && in_.good(); ++i) {
      record("node", i, total);
      node(in_.integer("node number", tag_size_));
      in_.end_of_record();
    }
  }

  void flat_elements(bool first_version) {
    const std::int64_t total = line_of_count("number of elements");
    if (in_.binary()) return flat_element_runs(total);
    for (std::int64_t i = 0; i < total && in_.good(); ++i) {
      record("element", i, total);
      msh_content::heading e{.tag = in_.integer("element number", tag_size_)};
      e.type = in_.integer("element type", tag_size_);
      // version 1: physical and elementary region, number of nodes; version 2: tags, counted
      tags(e, first_version ? 3 : count("number of tags", tag_size_));
      content_.add_element(in_, e, tag_size_);
    }
  }

  /// In a binary file elements of one type follow each other, and what they share is written once.
  void flat_element_runs(std::int64_t total) {
    for (std::int64_t left = total; left > 0 && in_.good();) {
      const std::int64_t type = in_.integer("element type", tag_size_);
      const std::int64_t run = block_size(left);
      const std::int64_t words = count("number of tags", tag_size_);
      if (run == 0) in_.fail("has a block of no elements", msh_input::damaged);
      for (std::int64_t i = 0; i < run && in_.good(); ++i) {
        msh_content::heading e{.tag = in_.integer("element number", tag_size_), .type = type};
        tags(e, words);
        content_.add_element(in_, e, tag_size_);
      }
    }
  }

  /// Of version 1 and 2: the physical group, the entity, and whatever follows.
  void tags(msh_content::heading& e, std::int64_t words) {
    for (std::int64_t k = 0; k < words && in_.good(); ++k) {
      const std::int64_t tag = in_.integer("tag", tag_size_);
      if (k == 0) e.group = tag;
      if (k == 1) e.entity = tag;
    }
  }

  void block_nodes() {
    std::int64_t left = 0;
    for (std::int64_t blocks = header(left, "number of nodes"); blocks > 0 && in_.good();
         --blocks) {
      record("node block", 0, blocks);
      const std::int64_t dimension = in_.integer("entity dimension", 4);
      static_cast<void>(in_.integer("entity number", 4));
      const bool parametric = in_.integer("parametric flag", 4) != 0;
      const std::int64_t count = block_size(left);
      in_.end_of_record();
      std::vector<std::int64_t> tags;
      for (std::int64_t i = 0; i < count && in_.good(); ++i) {
        record("node number", i, count);
        tags.push_back(in_.integer("node number", tag_size_));
        in_.end_of_record();
      }
      for (std::size_t i = 0; i < tags.size() && in_.good(); ++i) {
        record("node", static_cast<std::int64_t>(i), count);
        node(tags[i]);
        for (std::int64_t k = 0; parametric && k < dimension && in_.good(); ++k) {
          static_cast<void>(in_.real("parametric coordinate"));
        }
        in_.end_of_record();
      }
    }
    if (left != 0) in_.fail(sentence("ends ", left, " nodes early"), msh_input::damaged);
  }

  void block_elements() {
    std::int64_t left = 0;
    for (std::int64_t blocks = header(left, "number of elements"); blocks > 0 && in_.good();
         --blocks) {
      record("element block", 0, blocks);
      static_cast<void>(in_.integer("entity dimension", 4));
      msh_content::heading e{.entity = in_.integer("entity number", 4)};
      e.type = in_.integer("element type", 4);
      const std::int64_t count = block_size(left);
      in_.end_of_record();
      for (std::int64_t i = 0; i < count && in_.good(); ++i) {
        record("element", i, count);
        e.tag = in_.integer("element number", tag_size_);
        content_.add_element(in_, e, tag_size_);
      }
    }
    if (left != 0) in_.fail(sentence("ends ", left, " elements early"), msh_input::damaged);
  }

  /// Of version 4: how many blocks, how many in them all, the smallest and the largest tag.
  [[nodiscard]] std::int64_t header(std::int64_t& total, std::string_view what) {
    record("block header", 0, 1);
    const std::int64_t blocks = count("number of blocks", tag_size_);
    total = count(what, tag_size_);
    static_cast<void>(in_.integer("smallest tag", tag_size_));
    static_cast<void>(in_.integer("largest tag", tag_size_));
    in_.end_of_record();
    return blocks;
  }

  [[nodiscard]] std::int64_t block_size(std::int64_t& left) {
    const std::int64_t size = count("block size", tag_size_);
    if (size > left) {
      in_.fail(sentence("has a block of ", size, " where ", left, " are left"),
               "the counts do not match: save the mesh again");
    }
    left -= size;
    return size;
  }

  msh_input in_;
  msh_content content_;
  int version_ = 0;
  int tag_size_ = 4;  ///< of binary tags and counts [bytes]
  bool first_line_ = true;
  bool nodes_read_ = false;
  bool elements_read_ = false;
};

/// The tetrahedra of an MSH stream, or what is wrong with it, whatever the bytes; `name` stands for the
/// file in messages. A binary file needs a stream that is opened as one.
[[nodiscard]] inline loaded_msh load_msh(std::istream& in, std::string_view name) {
  return msh_reader(in, name).read();
}

/// The same of a file.
[[nodiscard]] inline loaded_msh load_msh(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return {{}, mesh_error(name, "is a directory", "give the path of a .msh file")};
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return {{}, mesh_error(name, "cannot be opened", "check the path and its permissions")};
  }
  return load_msh(file, name);
}

/// The tetrahedra that load_msh finds, its fault thrown.
[[nodiscard]] inline tetrahedral_mesh read_msh(std::istream& in, std::string_view name) {
  loaded_msh loaded = load_msh(in, name);
  if (loaded.fault) refuse(*loaded.fault);
  return std::move(loaded.mesh);
}
[[nodiscard]] inline tetrahedral_mesh read_msh(const std::filesystem::path& path) {
  loaded_msh loaded = load_msh(path);
  if (loaded.fault) refuse(*loaded.fault);
  return std::move(loaded.mesh);
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
