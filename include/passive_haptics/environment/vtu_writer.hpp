// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes a mesh and the present positions of its nodes as a VTU text file, which ParaView opens.
//
//     env::write_vtu("body_000.vtu", mesh, body.picture());     ParaView plays a series of them over time
//
// The points [m] are the present positions, and each has the vector "displacement" [m] from its position at rest:
// "Warp By Vector" with a factor of −1 shows the body at rest, with 9 ten times as deformed. Numbers have 17
// digits, so a reader gets the same doubles.
// Source: VTK File Formats, Kitware, "UnstructuredGrid"; cells of type 10 are linear tetrahedra.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/refuse.hpp>
#include <passive_haptics/environment/surface.hpp>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <ios>
#include <locale>
#include <ostream>
#include <string_view>
#include <system_error>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

namespace detail {

/// Writes the text of a mesh with a position [m] for each node.
inline void put_vtu(std::ostream& out, const tetrahedral_mesh& mesh, nodes_view positions) {
  const std::size_t nodes = mesh.nodes.size(), cells = mesh.tetrahedra.size();
  const auto locale = out.imbue(std::locale::classic());
  const auto flags = out.flags(std::ios::dec);
  const auto digits = out.precision(17);
  const auto array = [&out](std::string_view attributes, std::size_t lines, const auto& line) {
    out << "<DataArray " << attributes << " format=\"ascii\">\n";
    for (std::size_t i = 0; i < lines; ++i) {
      line(i);
      out << '\n';
    }
    out << "</DataArray>\n";
  };
  const auto vector = [&out](const Eigen::Vector3d& x) {
    out << x.x() << ' ' << x.y() << ' ' << x.z();
  };
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n"
      << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << nodes << "\" NumberOfCells=\"" << cells
      << "\">\n<Points>\n";
  array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", nodes,
        [&](std::size_t i) { vector(positions[i]); });
  out << "</Points>\n<Cells>\n";
  array("type=\"Int32\" Name=\"connectivity\"", cells, [&](std::size_t i) {
    const auto& t = mesh.tetrahedra[i];
    out << t[0] << ' ' << t[1] << ' ' << t[2] << ' ' << t[3];
  });
  array("type=\"Int32\" Name=\"offsets\"", cells, [&](std::size_t i) { out << 4 * (i + 1); });
  array("type=\"UInt8\" Name=\"types\"", cells, [&](std::size_t) { out << 10; });
  out << "</Cells>\n<PointData Vectors=\"displacement\">\n";
  array("type=\"Float64\" Name=\"displacement\" NumberOfComponents=\"3\"", nodes,
        [&](std::size_t i) { vector(positions[i] - mesh.nodes[i]); });
  out << "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  out.precision(digits);
  out.flags(flags);
  out.imbue(locale);
}

inline void check_positions(const tetrahedral_mesh& mesh, nodes_view positions) {
  if (positions.size() == mesh.nodes.size()) return;
  refuse_argument("write_vtu: ", positions.size(), " positions for ", mesh.nodes.size(),
                  " nodes; give one per node");
}

}  // namespace detail

/// Writes the text. Throws std::invalid_argument unless there is a position [m] for each node.
inline void write_vtu(std::ostream& out, const tetrahedral_mesh& mesh, nodes_view positions) {
  detail::check_positions(mesh, positions);
  detail::put_vtu(out, mesh, positions);
}

/// Writes the file `path`, as `path`.part until it is whole. Throws mesh_error if it cannot be written.
inline void write_vtu(const std::filesystem::path& path, const tetrahedral_mesh& mesh,
                      nodes_view positions) {
  detail::check_positions(mesh, positions);
  const std::filesystem::path part = path.string() + ".part";
  std::ofstream file(part, std::ios::binary);
  detail::put_vtu(file, mesh, positions);
  file.close();
  std::error_code refused;
  if (file) std::filesystem::rename(part, path, refused);
  if (file && !refused) return;
  std::filesystem::remove(part, refused);
  refuse(
      mesh_error(path.string(), "cannot be written", "is there a folder, and room on the disk?"));
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
