// SPDX-License-Identifier: BSD-3-Clause
// Legacy VTK: what is written is read again, and what cannot be used is refused with a sentence.
#include "environment/vtk_files.hpp"
#include "support/scratch_folder.hpp"

#include <filesystem>

namespace {

std::string fault(const std::string& text) {
  return vtk_files::fault(env::load_vtk, text);
}

const std::string head = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n";
const std::string five = "POINTS 5 double\n0 0 0 1 0 0 0 1 0\n0 0 1 9 9 9\n";

/// A file of the present layout (5.1) or the one before, as text or binary, of numbers of these types.
std::string file(bool binary, bool recent, const std::string& real, const std::string& whole) {
  using vtk_files::numbers;
  const std::string how = binary ? "big" : "text";
  std::string text = env::sentence("# vtk DataFile Version ", recent ? "5.1" : "3.0", "\ntitle\n",
                                   binary ? "BINARY" : "ASCII", "\nDATASET UNSTRUCTURED_GRID\n");
  // The time, as ParaView writes it before the points, and what it knows of the points after them.
  text += "FIELD FieldData 1\nTimeValue 1 2 double\n" + numbers("double", how, {0.5, 1.5}) + "\n";
  text += "POINTS 5 " + real + "\n" + numbers(real, how, vtk_files::five_points) + "\n";
  text += "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n";
  text += recent ? "CELLS 3 7\nOFFSETS " + whole + "\n" + numbers(whole, how, {0, 3, 7}) +
                       "\nCONNECTIVITY " + whole + "\n" + numbers(whole, how, {0, 1, 2, 0, 1, 2, 3})
                 : "CELLS 2 9\n" + numbers("int", how, {3, 0, 1, 2, 4, 0, 1, 2, 3});
  return text + "\nCELL_TYPES 2\n" + numbers("int", how, {5, 10}) + "\n";
}

}  // namespace

TEST_CASE("a mesh that is written as VTK is read again, bit by bit", "[environment][vtk]") {
  const auto mesh = env::ball(0.05);
  auto moved = mesh;
  for (auto& x : moved.nodes) x += Vector3d(1e-3, x.z() / 3.0, -0.1);
  std::ostringstream out;
  env::write_vtk(out, {mesh, moved.nodes});
  CHECK(contains(out.str(), "VECTORS displacement double"));
  std::istringstream in(out.str());
  const auto loaded = env::load_vtk(in, "ball.vtk");
  REQUIRE_FALSE(loaded.fault);
  CHECK(loaded.mesh.nodes == moved.nodes);
  CHECK(loaded.mesh.tetrahedra == mesh.tetrahedra);
  // Cut off anywhere before its cell types end it is refused, and never more than that.
  const std::string text = out.str();
  const std::size_t end = text.find("POINT_DATA") - 3;
  for (std::size_t size = 0; size < end; size += 7)
    CHECK_FALSE(fault(text.substr(0, size)).empty());
  const scratch_folder folder;
  const std::filesystem::path path = folder / "ball.vtk";
  env::write_vtk(path, {mesh, moved.nodes});
  CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
  CHECK(env::load_mesh(path).mesh.nodes == moved.nodes);
  env::write_vtk(path, {mesh, moved.nodes, env::vtk_points::at_rest});
  CHECK(env::load_mesh(path).mesh.nodes == mesh.nodes);
  moved.nodes.pop_back();
  CHECK(contains(text_of<std::invalid_argument>([&] {
                   env::write_vtk(out, {mesh, moved.nodes});
                 }),
                 "10 positions for 11 nodes"));
  CHECK(contains(text_of<env::mesh_error>([&] {
                   env::write_vtk("/no folder/a.vtk", {mesh, mesh.nodes});
                 }),
                 "cannot be written"));
}

TEST_CASE("VTK files of every layout are read, and flat cells dropped", "[environment][vtk]") {
  for (const bool binary : {false, true}) {
    for (const bool recent : {false, true}) {
      for (const auto* const real : {"float", "double"}) {
        for (const auto* const whole : {"vtktypeint64", "int", "unsigned_short"}) {
          const std::string text = file(binary, recent, real, whole);
          std::istringstream in(text);
          const auto loaded = env::load_vtk(in, "body.vtk");
          INFO((loaded.fault ? loaded.fault->what() : ""));
          REQUIRE_FALSE(loaded.fault);
          CHECK(loaded.mesh.nodes.size() == 4);  // the fifth belongs to no tetrahedron
          CHECK(loaded.mesh.nodes[3] == Vector3d(0, 0, 1.25));
          CHECK(loaded.mesh.tetrahedra == std::vector<std::array<int, 4>>{{0, 1, 2, 3}});
          if (binary) vtk_files::survives_damage(env::load_vtk, text, text.size() - 1);
        }
      }
    }
  }
}

TEST_CASE("a file that is no VTK body is refused with a sentence", "[environment][vtk]") {
  CHECK(contains(fault(""), "is no legacy VTK file"));
  CHECK(contains(fault("<?xml version=\"1.0\"?>\n<VTKFile>"), "the extension .vtu"));
  CHECK(contains(fault("# vtk DataFile Version 3.0\nt\nUTF-8\n"), "neither ASCII nor BINARY"));
  CHECK(contains(fault("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n"),
                 "is a surface; a body to be deformed needs tetrahedra"));
  CHECK(contains(fault("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n"),
                 "no unstructured grid"));
  CHECK(contains(fault(head + "SCALARS\n"), "'SCALARS' where POINTS"));
  CHECK(contains(fault(head + "POINTS 2 quad\n"), "type 'quad', which is not read"));
  CHECK(contains(fault(head + "POINTS 2 double\n0 0 0 1 x 0\n"), "'x' for a coordinate"));
  CHECK(contains(fault(head + "POINTS 2 double\n0 0 0 1 1e999 0\n"), "'1e999' for a coordinate"));
  CHECK(contains(fault(head + "FIELD F 1\na 99999 99999 int\n1\n"), "within a FIELD"));
  const auto cells = [](const std::string& what) { return fault(head + five + what); };
  CHECK(cells("CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n").empty());  // the control
  CHECK(contains(cells("CELLS 1 5\n4 0 1 2 7\nCELL_TYPES 1\n10\n"), "cell 0 names node 7 of 5"));
  CHECK(contains(cells("CELLS 1 5\n4 0 1 2 -1\nCELL_TYPES 1\n10\n"), "'-1' for a node"));
  CHECK(contains(cells("CELLS 1 3\n4 0 1 2 3\nCELL_TYPES 1\n10\n"), "larger cells"));
  CHECK(contains(cells("CELLS 2 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"), "has 1 cells of 2"));
  CHECK(contains(cells("CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 2\n10 10\n"), "2 cell types for 1"));
  CHECK(contains(cells("CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n"), "has no tetrahedra; a body"));
  // Hexahedra of both orders and polyhedra leave holes; an unknown type may.
  for (const int type : {12, 13, 25, 42, 72, 99}) {
    CHECK(contains(cells(env::sentence("CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n", type, "\n")),
                   "is no tetrahedron"));
  }
  CHECK(contains(fault(head + five + "CELLS 9999999999 9\n"), "ends at a"));
  CHECK(contains(fault(head + std::string(100000, 'x')), "where POINTS"));
}

TEST_CASE("a VTK file names the cell of a flat, flipped or doubled tetrahedron",
          "[environment][vtk]") {
  // A triangle first, so that tetrahedra and cells count differently; the sixth point is flat on 0 1 2.
  const auto cells = [](const std::string& second, const std::string& third) {
    return fault(head + "POINTS 6 double\n0 0 0 1 0 0 0 1 0\n0 0 1 0 0 -1 2 3 0\n" +
                 "CELLS 3 14\n3 0 1 2 4 " + second + " 4 " + third + "\nCELL_TYPES 3\n5 10 10\n");
  };
  CHECK(cells("0 1 2 3", "0 2 1 4").empty());
  CHECK(cells("0 2 1 3", "0 1 2 4").empty());  // all of the other order: turned
  CHECK(contains(cells("0 1 2 3", "0 1 2 4"), "cell 2 is inverted"));
  CHECK(contains(cells("0 1 2 3", "0 1 2 5"), "cell 2 has no volume"));
  CHECK(contains(cells("0 1 2 3", "0 1 2 2"), "cell 2 names node"));
  CHECK(contains(cells("0 1 2 3", "1 2 0 3"), "cell 2 and cell 1 overlap at a common face"));
}

TEST_CASE("tetrahedra of second order in a VTK file are taken by their corners, and a note says so",
          "[environment][vtk]") {
  std::istringstream in(head + "POINTS 10 double\n" +
                        "0 0 0 2 0 0 0 2 0 0 0 2 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 0 1 1\n" +
                        "CELLS 1 11\n10 0 1 2 3 4 5 6 7 8 9\nCELL_TYPES 1\n24\n");
  const auto loaded = env::load_vtk(in, "body.vtk");
  REQUIRE_FALSE(loaded.fault);
  CHECK(loaded.mesh.nodes.size() == 4);
  REQUIRE(loaded.notes.size() == 1);
  CHECK(contains(loaded.notes[0], "1 tetrahedra of higher order are taken by their corners; 6"));
}

TEST_CASE("a surface is refused with the way to fill it", "[environment][vtk]") {
  const scratch_folder folder;
  const auto with = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return env::load_mesh(folder / name);
  };
  const std::string text = "solid organ\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n";
  const std::string binary = std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, 0);
  for (const auto& one : {std::pair{"a.STL", text}, {"b.stl", binary}, {"c.obj", text}}) {
    const auto loaded = with(one.first, one.second);
    REQUIRE(loaded.fault);
    CHECK(contains(loaded.fault->what(), "is a surface; a body to be deformed needs tetrahedra"));
    CHECK(contains(loaded.fault->what(), "\nVolume(1) = {1};\\n' > in.geo && gmsh -3") == false);
    CHECK(contains(loaded.fault->what(), "\\nVolume(1) = {1};\\n' > in.geo && gmsh -3 in.geo"));
    CHECK(text_of<env::mesh_error>([&] { (void)env::read_mesh(folder / one.first); }) ==
          loaded.fault->what());
  }
  CHECK(contains(with("organ.txt", text).fault->what(), "give a .msh, .vtk or .vtu file"));
  for (const auto* const name : {"none.vtk", "none.vtu", "none.stl", "none.msh"}) {
    CHECK(contains(env::load_mesh(folder / name).fault->what(), "cannot be opened"));
  }
  CHECK_FALSE(env::load_mesh(PASSIVE_HAPTICS_TEST_DATA "/organ.msh").fault);
  CHECK(env::read_mesh(PASSIVE_HAPTICS_TEST_DATA "/organ.msh").nodes.size() > 100);
}
