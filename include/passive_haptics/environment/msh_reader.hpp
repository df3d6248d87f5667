// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads the tetrahedra of a Gmsh MSH file of version 1, 2.0-2.2 or 4.1.
// The file may be text or, from version 2.0 on, binary with either byte order.
//
//   $NOD .. $ELM                       version 1, no header
//   $MeshFormat 2.x  $Nodes $Elements  one record per node and element
//   $MeshFormat 4.1  $Nodes $Elements  blocks per entity; parametric nodes are understood
//   anything else between $X and $EndX is skipped ($PhysicalNames, $Entities, $NodeData, ...)
//
// The reader keeps the tetrahedra and the nodes that are their corners, in the order of the file. Points,
// lines, triangles and nodes used by no tetrahedron are dropped; tags need not be contiguous. A tetrahedron
// of higher order is taken by its four corners, and one of several physical groups once, though versions 1
// and 2 write it for each. Other volumes are refused, because without them the body would have holes. A mesh
// whose elements are all inverted follows the other convention and is turned (mesh.hpp, oriented); a mixture
// is refused. The format has no unit of length: bring lengths to metres with scaled(). Other formats are not
// read: convert them by `meshio convert -o gmsh22 in.vtu out.msh`. Source: Gmsh reference manual, "Gmsh file
// formats".

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/msh_input.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// The answer of load_msh().
struct loaded_msh {
  tetrahedral_mesh mesh;             ///< checked; empty if there is a fault
  std::optional<mesh_error> fault;   ///< the first fault, with file, place and remedy
  std::vector<std::string> notes{};  ///< a sentence for each thing that the mesh leaves out
};

/// The remedy for a file of another format.
inline constexpr std::string_view convert_the_mesh =
    "Convert another mesh of tetrahedra: meshio convert -o gmsh22 in.vtu out.msh (Debian: "
    "meshio-tools).";
/// The remedy for a file without volumes. Gmsh merges a file at the end of a LINE, so each statement has its own.
inline constexpr std::string_view fill_the_surface =
    "Fill a surface that is closed: printf 'Merge \"in.stl\";\\nSurface Loop(1) = "
    "{1};\\nVolume(1) = {1};\\n' > in.geo && gmsh -3 in.geo -o out.msh; one that has holes: "
    "FloatTetwild_bin -i in.stl -o out.msh";

/// A type of element by its number (Gmsh reference manual, "MSH file format").
struct msh_type {
  enum class shape : std::uint8_t { unknown, flat, tetrahedron, other_volume };
  shape is = shape::unknown;
  int nodes = 0;  ///< nodes of the element; the first four of a tetrahedron are its corners

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

/// The content of a file, and the mesh that it makes: tags become numbers from 0, and nodes that no tetrahedron
/// uses are dropped.
class msh_content {
 public:
  void add_node(msh_input& in, std::int64_t tag, double x, double y, double z) {
    if (!in.good()) return;
    tags_.push_back({tag, nodes_.size(), in.place()});
    nodes_.emplace_back(x, y, z);
  }

  /// The numbers of an element that stand before its nodes.
  struct heading {
    std::int64_t tag = 0;
    std::int64_t type = 0;
    std::int64_t entity = 0;  ///< the entity of the geometry that the element is a part of
    std::int64_t group = 0;   ///< physical group; versions 1 and 2 repeat an element for each group
  };

  /// Takes an element if it is a tetrahedron; its nodes come next as numbers of `size` bytes.
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

  /// The mesh, checked; a fault is reported to `in`.
  [[nodiscard]] tetrahedral_mesh mesh(msh_input& in) {
    sort_tags(in);
    if (elements_.empty()) {
      in.fail(sentence("has no tetrahedra among its ", skipped_, " elements"),
              sentence("mesh the volume: gmsh -3. ", fill_the_surface));
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

  /// After mesh(): a sentence for each part of the file that a user might miss in the mesh.
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

  struct tagged {
    std::int64_t tag;
    std::size_t node;    ///< in nodes_
    std::int64_t place;  ///< in the file
  };
  /// Sorts the tags, and reports one that is there twice. A hash table could be slowed down by a hostile file.
  void sort_tags(msh_input& in) {
    const auto below = [](const tagged& a, const tagged& b) {
      return std::tie(a.tag, a.node) < std::tie(b.tag, b.node);
    };
    if (!std::is_sorted(tags_.begin(), tags_.end(), below)) {
      std::sort(tags_.begin(), tags_.end(), below);
    }
    const auto same = [](const tagged& a, const tagged& b) { return a.tag == b.tag; };
    const auto twice = std::adjacent_find(tags_.begin(), tags_.end(), same);
    if (twice == tags_.end()) return;
    in.fail_at((twice + 1)->place, sentence("defines node ", twice->tag, " again"),
               "give every node its own number");
  }
  /// The index of the node with this tag in nodes_, or nodes_.size() if there is none.
  [[nodiscard]] std::size_t node_of(std::int64_t tag) const {
    const auto first = tags_.empty() ? 0 : tags_.front().tag;
    const auto guess = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first);
    if (guess < tags_.size() && tags_[guess].tag == tag) return tags_[guess].node;
    const auto found =
        std::lower_bound(tags_.begin(), tags_.end(), tag,
                         [](const tagged& t, std::int64_t wanted) { return t.tag < wanted; });
    return found != tags_.end() && found->tag == tag ? found->node : nodes_.size();
  }

  /// Drops an element whose nodes and entity are those of an element of another physical group.
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
        const std::size_t found = node_of(tag);
        if (found == nodes_.size()) {
          in.fail_at(e.place, sentence("element ", e.is.tag, " names node ", tag, ", unknown"),
                     "the nodes are not all in the file: save the mesh again");
          return {};
        }
        number[found] = 0;
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
      for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = number[node_of(e.nodes[k])];
    }
    return result;
  }

  std::vector<Eigen::Vector3d> nodes_;
  std::vector<tagged> tags_;  ///< one for each of nodes_
  std::vector<element> elements_;
  std::int64_t skipped_ = 0;       ///< points, lines and faces
  std::int64_t higher_order_ = 0;  ///< tetrahedra of more than four nodes
  std::size_t repeated_ = 0;       ///< elements dropped, as another physical group repeats them
  std::size_t loose_ = 0;          ///< nodes that are no corner
};

/// Reads one file once; use load_msh() or read_msh().
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
               first_line_ ? sentence("the first line must be $MeshFormat (MSH 2.2, 4.1) or $NOD "
                                      "(MSH 1). ",
                                      convert_the_mesh, " ", fill_the_surface)
                           : std::string(msh_input::damaged));
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

  /// Goes to the line of number i of `total`; a section mark there is a fault.
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
  /// Calls line() for a text file. The numbers of a binary file have no lines, so it does nothing there.
  void record(std::string_view what, std::int64_t i, std::int64_t total) {
    if (!in_.binary()) line(what, i, total);
  }

  /// A count that has a line of its own in a binary file, too.
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

  /// Reads a binary file, where elements of one type follow each other and share one heading.
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

  /// Reads the tags of versions 1 and 2: the physical group, the entity, and others that are ignored.
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

  /// The number of blocks of a section of version 4, with the number of its items in `total`.
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
  int tag_size_ = 4;  ///< size of binary tags and counts [bytes]
  bool first_line_ = true;
  bool nodes_read_ = false;
  bool elements_read_ = false;
};

/// The tetrahedra of an MSH stream, or its first fault, for any bytes; `name` stands for the file in messages. A
/// binary file needs a stream that is opened as binary.
[[nodiscard]] inline loaded_msh load_msh(std::istream& in, std::string_view name) {
  return msh_reader(in, name).read();
}

/// The same for a file.
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

/// The tetrahedra that load_msh() finds; throws its fault as a mesh_error.
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
