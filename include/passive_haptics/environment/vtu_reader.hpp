// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads the tetrahedra of a VTU file (XML UnstructuredGrid): arrays as text, or as bytes that are not
// compressed.
//
//   <VTKFile type="UnstructuredGrid" byte_order=".." header_type="UInt32 | UInt64">
//     <Piece NumberOfPoints="n" NumberOfCells="m">   one
//       <Points> <DataArray>                         3n numbers
//       <Cells>  <DataArray Name="connectivity | offsets | types">
//   DataArray: format="ascii", "binary" (base64 with its size in front) or "appended" (an offset into
//   <AppendedData encoding="raw | base64">); everything else is data, and is not read
//
// Compressed arrays and files of several pieces are refused with the way to save them otherwise. What is
// kept: vtk_content.hpp. Format: VTK File Formats, Kitware.

#include <passive_haptics/environment/base64.hpp>
#include <passive_haptics/environment/vtk_content.hpp>
#include <passive_haptics/environment/vtk_input.hpp>
#include <passive_haptics/environment/xml_tags.hpp>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// One reading of one file; use load_vtu.
class vtu_reader {
 public:
  vtu_reader(std::istream& in, std::string_view name) : in_(in, name) {}

  [[nodiscard]] loaded_mesh read() {
    find_arrays();
    if (in_.good() && pieces_ == 0) in_.fail("has no Piece");
    read_array<double>(points_, 3 * point_count_, "coordinate",
                       [this](double x) { content_.add_coordinate(x); });
    content_.ends.push_back(0);
    read_array<std::int64_t>(offsets_, cell_count_, "cell offset",
                             [this](std::int64_t n) { content_.ends.push_back(n); });
    read_array<std::int64_t>(types_, cell_count_, "cell type",
                             [this](std::int64_t n) { content_.types.push_back(n); });
    read_array<std::int64_t>(connectivity_, content_.ends.back(), "node of a cell",
                             [this](std::int64_t n) { content_.nodes.push_back(n); });
    return content_.mesh(in_);
  }

 private:
  /// Of a DataArray: what is said of it, and the text after its tag.
  struct array {
    bool is_there = false;
    std::string_view type, format;
    std::int64_t offset = 0;
    std::string_view text;
  };
  static constexpr std::string_view save_as_text =
      "save it again as text: in ParaView, File, Save Data, *.vtu, Data Mode: Ascii; or meshio "
      "ascii x.vtu";

  void find_arrays() {
    std::string_view section;
    bool is_vtk = false;
    for (xml_tags tags(in_.rest()); in_.good();) {
      const auto tag = tags.next();
      if (!tag) break;
      if (!tag->opens) {
        if (tag->name == section) section = {};
      } else if (tag->name == "VTKFile") {
        is_vtk = true;
        file((*tag)["type"].value_or(""), *tag);
      } else if (tag->name == "Piece") {
        if (++pieces_ > 1) {
          in_.fail("has several pieces",
                   "save one: in ParaView, Merge Blocks, merge points, first");
        }
        point_count_ = integer(*tag, "NumberOfPoints");
        cell_count_ = integer(*tag, "NumberOfCells");
      } else if (tag->name == "Points" || tag->name == "Cells") {
        section = tag->name;
      } else if (tag->name == "DataArray" && !section.empty()) {
        if (array* const to = wanted(section, (*tag)["Name"].value_or(""))) {
          *to = {true, (*tag)["type"].value_or(""), (*tag)["format"].value_or("ascii"),
                 (*tag)["offset"] ? integer(*tag, "offset") : 0, tags.left()};
        }
      } else if (tag->name == "AppendedData") {
        appended_ = tags.left();
        appended_.remove_prefix((std::min)(appended_.size(), appended_.find('_')));
        if (!appended_.empty()) appended_.remove_prefix(1);
        is_raw_ = (*tag)["encoding"] != "base64";
        break;
      }
    }
    if (!is_vtk)
      in_.fail("is no VTU file: it has no tag VTKFile", "save the mesh as .msh, .vtk or .vtu");
  }

  void file(std::string_view type, const xml_tag& tag) {
    if (type == "PolyData") return in_.fail("is a surface", fill_the_surface);
    if (type != "UnstructuredGrid") {
      return in_.fail(sentence("is no UnstructuredGrid but ", msh_input::quoted(type)),
                      "give the .vtu file of a mesh of tetrahedra");
    }
    if (tag["byte_order"] == "BigEndian") written_ = vtk_numbers::encoding::big_endian;
    header_ = tag["header_type"].value_or("UInt32");
    is_compressed_ = !tag["compressor"].value_or("").empty();
  }

  [[nodiscard]] array* wanted(std::string_view section, std::string_view name) {
    if (section == "Points") return &points_;
    if (name == "connectivity") return &connectivity_;
    if (name == "offsets") return &offsets_;
    return name == "types" ? &types_ : nullptr;
  }

  [[nodiscard]] std::int64_t integer(const xml_tag& tag, std::string_view key) {
    const std::string_view text = tag[key].value_or("");
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size() && value >= 0 &&
        value <= std::int64_t{1} << 40) {
      return value;
    }
    in_.fail(sentence("has ", msh_input::quoted(text), " for ", key));
    return 0;
  }

  template <class Number, class Take>
  void read_array(const array& a, std::int64_t total, std::string_view what, const Take& take) {
    if (!in_.good()) return;
    if (!a.is_there) return in_.fail(sentence("has no DataArray for a ", what));
    const bool is_text = a.format == "ascii";
    const vtk_numbers are =
        vtk_numbers::of(a.type, is_text ? vtk_numbers::encoding::text : written_);
    if (are.bytes == 0) {
      return in_.fail(sentence("has ", msh_input::quoted(a.type), " for the type of a ", what),
                      save_as_text);
    }
    std::string decoded;
    std::string_view from = a.text;
    if (is_text) {
      from = from.substr(0, from.find('<'));
    } else if (is_compressed_) {
      return in_.fail("is compressed", save_as_text);
    } else if (a.format == "appended" && is_raw_) {
      from = appended_;
      from.remove_prefix((std::min)(from.size(), static_cast<std::size_t>(a.offset)));
      from = behind_size(from);
    } else if (a.format == "appended" || a.format == "binary") {
      if (a.format == "appended") from = appended_;
      from.remove_prefix((std::min)(from.size(), static_cast<std::size_t>(a.offset)));
      decoded = from_base64(from, header_bytes() + are.bytes * static_cast<std::size_t>(total));
      from = behind_size(decoded);
    } else {
      return in_.fail(sentence("has an array of format ", msh_input::quoted(a.format)),
                      save_as_text);
    }
    in_.numbers<Number>(from, total, are, what, take);
  }

  [[nodiscard]] std::size_t header_bytes() const { return header_ == "UInt64" ? 8 : 4; }

  /// The bytes whose number stands in front of them, as far as they are there.
  [[nodiscard]] std::string_view behind_size(std::string_view bytes) {
    const std::int64_t size = [&] {
      std::int64_t said = 0;
      in_.numbers<std::int64_t>(bytes, 1, vtk_numbers::of(header_, written_), "size of an array",
                                [&](std::int64_t n) { said = n; });
      return said;
    }();
    return bytes.substr(0, static_cast<std::size_t>(size));
  }

  vtk_input in_;
  vtk_content content_;
  array points_, connectivity_, offsets_, types_;
  int pieces_ = 0;
  std::int64_t point_count_ = 0, cell_count_ = 0;
  vtk_numbers::encoding written_ = vtk_numbers::encoding::little_endian;
  std::string_view header_ = "UInt32";
  bool is_compressed_ = false;
  std::string_view appended_;
  bool is_raw_ = true;
};

/// The tetrahedra of a VTU stream, or what is wrong with it, whatever the bytes. It needs a stream that is
/// opened as a binary one.
[[nodiscard]] inline loaded_mesh load_vtu(std::istream& in, std::string_view name) {
  return vtu_reader(in, name).read();
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
