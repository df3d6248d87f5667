// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads the tetrahedra of a file, whatever kind it is of, and says of a surface how it becomes a body.
//
//   .msh   Gmsh (msh_reader.hpp)        .vtk   legacy VTK (vtk_reader.hpp)      .vtu   XML (vtu_reader.hpp)
//   .stl   refused, as .obj, .ply and .vtp: a surface has no inside

#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/environment/vtk_reader.hpp>
#include <passive_haptics/environment/vtu_reader.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// The tetrahedra of a file, by its extension, or what is wrong with it.
[[nodiscard]] inline loaded_mesh load_mesh(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (extension == ".msh") return load_msh(path);
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored)) {
    return {{}, mesh_error(name, "cannot be opened", "check the path and its permissions")};
  }
  if (extension == ".vtk") return load_vtk(file, name);
  if (extension == ".vtu") return load_vtu(file, name);
  if (extension == ".stl" || extension == ".obj" || extension == ".ply" || extension == ".vtp") {
    return {{}, mesh_error(name, "is a surface", fill_the_surface)};
  }
  return {{}, mesh_error(name, "is of a kind that is not read", "give a .msh, .vtk or .vtu file")};
}

/// The same, its fault thrown.
[[nodiscard]] inline tetrahedral_mesh read_mesh(const std::filesystem::path& path) {
  loaded_mesh loaded = load_mesh(path);
  if (loaded.fault) refuse(*loaded.fault);
  return std::move(loaded.mesh);
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
