// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes a mesh and what became of it as legacy VTK text, or as VTU with its numbers in base64.
//
//     env::write_vtu("body_000.vtu", {mesh, body.picture()});     a series of them ParaView plays over time
//
// The vectors "displacement" [m] of the points lead from the rest to the positions. Where the points are
// deformed a file shows the body as it is; where they are at rest "Warp by Vector" deforms it, by any factor.
// Format: VTK File Formats, Kitware.

#include <passive_haptics/environment/base64.hpp>
#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/refuse.hpp>
#include <passive_haptics/environment/surface.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <locale>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

enum class vtk_points : std::uint8_t { deformed, at_rest };

/// What is written: a mesh, where its nodes are, and which points the file shows; a view of both.
struct deformed_mesh {
  const tetrahedral_mesh& mesh;
  nodes_view positions;
  vtk_points points;

  /// std::invalid_argument unless there is a position for each node.
  deformed_mesh(const tetrahedral_mesh& of, nodes_view at,
                vtk_points written = vtk_points::deformed)
      : mesh(of), positions(at), points(written) {
    if (positions.size() == mesh.nodes.size()) return;
    refuse_argument("deformed_mesh: ", positions.size(), " positions for ", mesh.nodes.size(),
                    " nodes; give one per node");
  }
  [[nodiscard]] const Eigen::Vector3d& point(std::size_t i) const {
    return points == vtk_points::deformed ? positions[i] : mesh.nodes[i];
  }
  [[nodiscard]] Eigen::Vector3d displacement(std::size_t i) const {
    return positions[i] - mesh.nodes[i];
  }
};

inline void write_vtk(std::ostream& out, const deformed_mesh& body) {
  const tetrahedral_mesh& mesh = body.mesh;
  const auto locale = out.imbue(std::locale::classic());
  const auto digits = out.precision(17);
  const auto vectors = [&](const auto& of) {
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      const Eigen::Vector3d x = of(i);
      out << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
    }
  };
  out << "# vtk DataFile Version 3.0\npassive_haptics\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
      << mesh.nodes.size() << " double\n";
  vectors([&](std::size_t i) { return body.point(i); });
  out << "CELLS " << mesh.tetrahedra.size() << ' ' << 5 * mesh.tetrahedra.size() << '\n';
  for (const auto& t : mesh.tetrahedra) {
    out << "4 " << t[0] << ' ' << t[1] << ' ' << t[2] << ' ' << t[3] << '\n';
  }
  out << "CELL_TYPES " << mesh.tetrahedra.size() << '\n';
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) out << "10\n";
  out << "POINT_DATA " << mesh.nodes.size() << "\nVECTORS displacement double\n";
  vectors([&](std::size_t i) { return body.displacement(i); });
  out.precision(digits);
  out.imbue(locale);
}

inline void write_vtu(std::ostream& out, const deformed_mesh& body) {
  const tetrahedral_mesh& mesh = body.mesh;
  const auto array = [&](std::string_view attributes, const auto& numbers) {
    const std::uint64_t size = numbers.size() * sizeof(numbers[0]);
    std::string bytes(sizeof(size) + size, '\0');
    std::memcpy(bytes.data(), &size, sizeof(size));
    if (size > 0) std::memcpy(bytes.data() + sizeof(size), numbers.data(), size);
    out << "<DataArray " << attributes << " format=\"binary\">" << to_base64(bytes)
        << "</DataArray>\n";
  };
  const auto vectors = [&](const auto& of) {
    std::vector<double> all;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      const Eigen::Vector3d x = of(i);
      all.insert(all.end(), x.begin(), x.end());
    }
    return all;
  };
  std::vector<std::int32_t> nodes, ends;
  for (const auto& t : mesh.tetrahedra) {
    nodes.insert(nodes.end(), t.begin(), t.end());
    ends.push_back(static_cast<std::int32_t>(nodes.size()));
  }
  const bool is_big = std::endian::native == std::endian::big;
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
      << (is_big ? "Big" : "Little") << "Endian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
      << sentence("<Piece NumberOfPoints=\"", mesh.nodes.size(), "\" NumberOfCells=\"",
                  mesh.tetrahedra.size(), "\">\n<Points>\n");
  array("type=\"Float64\" NumberOfComponents=\"3\"",
        vectors([&](std::size_t i) { return body.point(i); }));
  out << "</Points>\n<Cells>\n";
  array("type=\"Int32\" Name=\"connectivity\"", nodes);
  array("type=\"Int32\" Name=\"offsets\"", ends);
  array("type=\"UInt8\" Name=\"types\"", std::string(mesh.tetrahedra.size(), char{10}));
  out << "</Cells>\n<PointData Vectors=\"displacement\">\n";
  array("type=\"Float64\" Name=\"displacement\" NumberOfComponents=\"3\"",
        vectors([&](std::size_t i) { return body.displacement(i); }));
  out << "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

/// What `write` gives a stream as a file, written to `path`.part and renamed when it is whole. mesh_error if
/// it cannot be.
template <class Write>
void write_whole_file(const std::filesystem::path& path, const Write& write) {
  const std::filesystem::path part = path.string() + ".part";
  std::ofstream file(part, std::ios::binary);
  write(file);
  file.close();
  std::error_code refused;
  if (file) std::filesystem::rename(part, path, refused);
  if (file && !refused) return;
  std::filesystem::remove(part, refused);
  refuse(
      mesh_error(path.string(), "cannot be written", "is there a folder, and room on the disk?"));
}
inline void write_vtk(const std::filesystem::path& path, const deformed_mesh& body) {
  write_whole_file(path, [&](std::ostream& out) { write_vtk(out, body); });
}
inline void write_vtu(const std::filesystem::path& path, const deformed_mesh& body) {
  write_whole_file(path, [&](std::ostream& out) { write_vtu(out, body); });
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
