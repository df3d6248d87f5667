// SPDX-License-Identifier: BSD-3-Clause
// VTU: text, base64 and appended arrays of either byte order, and what is refused with the way to save it.
#include "environment/vtk_files.hpp"
#include "support/scratch_folder.hpp"

#include <filesystem>

namespace {

std::string fault(const std::string& text) {
  return vtk_files::fault(env::load_vtu, text);
}
std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

struct layout {
  std::string format = "ascii";  ///< or "binary", "raw", "base64": the latter two appended
  std::string order = "little";
  std::string header = "UInt32";
  std::string whole = "Int64";
  std::string real = "Float64";
  bool header_by_itself = false;
};

/// A triangle and a tetrahedron, with data that is not read before and after them.
std::string file(const layout& is) {
  std::string appended;
  const auto array = [&](const std::string& type, const std::string& name,
                         const std::vector<double>& values) {
    const std::string tag = "<DataArray type=\"" + type + "\" Name='" + name + "' format=\"";
    if (is.format == "ascii") {
      return tag + "ascii\">\n" + vtk_files::numbers(type, "text", values) +
             "<InformationKey><Value> 7 </Value></InformationKey></DataArray>\n";
    }
    const std::string bytes = vtk_files::numbers(type, is.order, values);
    const std::string size =
        vtk_files::numbers(is.header, is.order, {static_cast<double>(bytes.size())});
    const std::string text = is.header_by_itself ? env::to_base64(size) + env::to_base64(bytes)
                                                 : env::to_base64(size + bytes);
    if (is.format == "binary") return tag + "binary\">\n  " + text + "\n</DataArray>\n";
    const auto offset = appended.size();
    appended += is.format == "raw" ? size + bytes : text;
    return tag + "appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
  };
  std::string text = "<?xml version=\"1.0\"?>\n<!-- a comment with <Points> -->\n";
  text += "<VTKFile type=\"UnstructuredGrid\" byte_order=\"";
  text += (is.order == "big" ? "BigEndian" : "LittleEndian");
  text += "\" header_type = \"" + is.header + "\">\n<UnstructuredGrid>\n<FieldData>\n";
  text += array(is.real, "TimeValue", {0.5});
  text +=
      "</FieldData>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<PointData note='1 > 0'>\n";
  text += array(is.real, "offsets", {1, 2, 3, 4, 5});
  text += "</PointData>\n<CellData/>\n<Points>\n";
  text += array(is.real, "Points", vtk_files::five_points);
  text += "</Points>\n<Cells>\n";
  text += array(is.whole, "connectivity", {0, 1, 2, 0, 1, 2, 3});
  text += array(is.whole, "offsets", {3, 7});
  text += array("UInt8", "types", {5, 10});
  text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (!appended.empty()) {
    text += "<AppendedData encoding=\"" + is.format + "\">\n _" + appended + "\n</AppendedData>\n";
  }
  return text + "</VTKFile>\n";
}

void reads(const layout& is) {
  const std::string text = file(is);
  INFO(text);
  std::istringstream in(text);
  const auto loaded = env::load_vtu(in, "body.vtu");
  INFO((loaded.fault ? loaded.fault->what() : ""));
  REQUIRE_FALSE(loaded.fault);
  CHECK(loaded.mesh.nodes.size() == 4);
  CHECK(loaded.mesh.nodes[3] == Vector3d(0, 0, 1.25));
  CHECK(loaded.mesh.tetrahedra == std::vector<std::array<int, 4>>{{0, 1, 2, 3}});
}

}  // namespace

TEST_CASE("a mesh that is written as VTU is read again, bit by bit", "[environment][vtu]") {
  const auto mesh = env::ball(0.05);
  auto moved = mesh.nodes;
  for (auto& x : moved) x += Vector3d(1e-3, x.z() / 3.0, -0.1);
  const scratch_folder folder;
  const std::filesystem::path path = folder / "ball.VTU";
  env::write_vtu(path, {mesh, moved});
  CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
  const auto loaded = env::load_mesh(path);
  REQUIRE_FALSE(loaded.fault);
  CHECK(loaded.mesh.nodes == moved);
  CHECK(loaded.mesh.tetrahedra == mesh.tetrahedra);
  env::write_vtu(path, {mesh, moved, env::vtk_points::at_rest});
  CHECK(env::read_mesh(path).nodes == mesh.nodes);
  // The displacements: the same bytes as they stand in base64.
  std::ostringstream out;
  env::write_vtu(out, {mesh, moved});
  std::vector<double> displacements;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Vector3d u = moved[i] - mesh.nodes[i];
    displacements.insert(displacements.end(), u.begin(), u.end());
  }
  const std::string order = std::endian::native == std::endian::big ? "big" : "little";
  const auto size = static_cast<double>(8 * displacements.size());
  CHECK(
      contains(out.str(), "Name=\"displacement\" NumberOfComponents=\"3\" format=\"binary\">" +
                              env::to_base64(vtk_files::numbers("UInt64", order, {size}) +
                                             vtk_files::numbers("Float64", order, displacements)) +
                              "</DataArray>"));
  // What cannot be written leaves nothing behind.
  moved.pop_back();
  CHECK_THROWS_AS(env::write_vtu(folder / "b.vtu", {mesh, moved}), std::invalid_argument);
  CHECK(contains(text_of<env::mesh_error>([&] {
                   env::write_vtu("/no folder/a.vtu", {mesh, mesh.nodes});
                 }),
                 "cannot be written"));
  CHECK(contains(text_of<env::mesh_error>([&] {
                   env::write_vtu(folder.path(), {mesh, mesh.nodes});
                 }),
                 "cannot be written"));
  CHECK_FALSE(std::filesystem::exists(folder.path().string() + ".part"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.vtu"));
}

TEST_CASE("VTU arrays of every encoding, byte order and type are read", "[environment][vtu]") {
  for (const std::string format : {"ascii", "binary", "raw", "base64"}) {
    for (const std::string order : {"little", "big"}) {
      for (const std::string header : {"UInt32", "UInt64"}) {
        reads({.format = format, .order = order, .header = header});
        reads({.format = format, .order = order, .header = header, .header_by_itself = true});
      }
    }
    for (const std::string whole :
         {"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "UInt64"})
      reads({.format = format, .whole = whole});
    reads({.format = format, .real = "Float32"});
    const std::string text = file({.format = format});
    std::size_t needed = text.find("\n</AppendedData>");  // up to the end of the types
    if (format == "ascii") needed = text.find("5 10 ") + 4;
    if (format == "binary") needed = text.rfind("\n</DataArray>");
    REQUIRE(needed < text.size());
    vtk_files::survives_damage(env::load_vtu, text, needed);
  }
}

TEST_CASE("a file that is no VTU body, or is encoded otherwise, is refused with a sentence",
          "[environment][vtu]") {
  const std::string good = file({}), base64 = file({.format = "binary"});
  CHECK(fault(good).empty());
  const auto with = [&](const std::string& from, const std::string& to) {
    return fault(changed(good, from, to));
  };
  CHECK(contains(fault(""), "no tag VTKFile"));
  CHECK(contains(fault("# vtk DataFile Version 3.0\n"), "save the mesh as .msh, .vtk or .vtu"));
  CHECK(contains(with("\"UnstructuredGrid\"", "\"PolyData\""), "is a surface; a body"));
  CHECK(contains(with("\"UnstructuredGrid\"", "\"ImageData\""), "'ImageData'"));
  // With a compressor arrays of text are text all the same, others are compressed.
  const std::string zlib = " compressor=\"vtkZLibDataCompressor\" header_type";
  CHECK(with(" header_type", zlib).empty());
  const std::string refused = fault(changed(base64, " header_type", zlib));
  CHECK(contains(refused, "is compressed; save it again as text: in ParaView, File, Save Data"));
  CHECK(contains(refused, "Data Mode: Ascii"));
  CHECK(contains(with("</Piece>", "</Piece><Piece>"), "several pieces; save one: in ParaView"));
  CHECK(contains(with("ascii\">\n0 0 0", "hex\">\n0 0 0"), "format 'hex'; save it again as text"));
  CHECK(contains(with("\"Int64\" Name='conn", "\"String\" Name='conn"), "'String' for the type"));
  CHECK(contains(with("'types'", "'kinds'"), "has no DataArray for a cell type"));
  CHECK(contains(with("<Points>\n", "<Dots>\n"), "has no DataArray for a coordinate"));
  CHECK(contains(with("NumberOfPoints=\"5\"", "NumberOfPoints=\"6\""), "ends at a coordinate"));
  CHECK(contains(with("NumberOfPoints=\"5\"", "NumberOfPoints=\"x\""), "'x' for NumberOfPoints"));
  CHECK(contains(with("NumberOfCells=\"2\"", "NumberOfCells=\"999999999999\""), "ends at a"));
  CHECK(contains(with("NumberOfCells=\"2\"", "NumberOfCells=\"-2\""), "'-2' for NumberOfCells"));
  CHECK(contains(with("NumberOfCells=\"2\"", ""), "'' for NumberOfCells"));
  CHECK(contains(with("1.25", "1.2x"), "'1.2x' for a coordinate"));
  CHECK(contains(with("0 1 2 0 1 2 3", "0 1 2 0 1 2 8"), "cell 1 names node 8 of 5"));
  CHECK(contains(with("0 1 2 0 1 2 3", "0 1 2 0 1 2 2"), "cell 1 names node 2 twice"));
  CHECK(contains(with("5 10 ", "5 12 "), "cell 1 of type 12 is no tetrahedron"));
  CHECK(contains(with("3 7 ", "3 5 "), "cell 1 has fewer than four nodes"));
  CHECK(contains(with("1.25", "0"), "cell 1 has no volume"));
  // The byte order that is said is not the one that is there.
  CHECK_FALSE(fault(changed(base64, "LittleEndian", "BigEndian")).empty());
  CHECK_FALSE(fault(changed(base64, "UInt32", "UInt64")).empty());
}

TEST_CASE("base64 is what RFC 4648 has", "[environment][vtu]") {
  const std::array<std::pair<std::string, std::string>, 7> vectors{{{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"}}};
  for (const auto& [bytes, text] : vectors) {
    CHECK(env::to_base64(bytes) == text);
    CHECK(env::from_base64(text, 100) == bytes);
    CHECK(env::from_base64(
              " " + text.substr(0, 3) + "\n" + text.substr(std::min(text.size(), std::size_t{3})),
              2) == bytes.substr(0, 2));
  }
  CHECK(env::from_base64("Zg==Zm8=", 100) == "ffo");
  CHECK(env::from_base64("Zm9v<Zm9v", 100) == "foo");
}
