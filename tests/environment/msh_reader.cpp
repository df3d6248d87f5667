// SPDX-License-Identifier: BSD-3-Clause
// The reader of meshes: three versions of one mesh, every way to damage it.
#include "environment/shapes.hpp"
#include <passive_haptics/environment/msh_reader.hpp>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

using env::sentence;

// Two tetrahedra on a common face; node 77 and the triangle are used by no tetrahedron.
const std::string version_1 =
    "$NOD\n6\n10 0 0 0\n20 1 0 0\n35 0 1 0\n40 0 0 1.5\n77 9 9 9\n1000000 -0.25 -0.25 -0.25\n"
    "$ENDNOD\n$ELM\n3\n1 2 1 1 3 10 20 35\n2 4 1 1 4 10 20 35 40\n3 4 1 1 4 10 35 20 1000000\n"
    "$ENDELM\n";
const std::string version_2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"a volume\"\n$EndPhysicalNames\n"
    "$Nodes\n6\n10 0 0 0\n20 1 0 0\n35 0 1 0\n40 0 0 1.5\n77 9 9 9\n1000000 -0.25 -0.25 -0.25\n"
    "$EndNodes\n$Elements\n3\n1 2 2 1 1 10 20 35\n2 4 2 1 1 10 20 35 40\n"
    "3 4 0 10 35 20 1000000\n$EndElements\n$NodeData\n1\n\"u\"\n0\n0\n$EndNodeData\n";
const std::string version_4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n"
    "$Nodes\n3 6 10 1000000\n2 1 1 2\n10\n20\n0 0 0 0.5 0.5\n1 0 0 0.5 0.5\n3 1 0 0\n3 1 0 4\n35\n"
    "40\n77\n1000000\n0 1 0\n0 0 1.5\n9 9 9\n-0.25 -0.25 -0.25\n$EndNodes\n$Elements\n2 3 1 3\n"
    "2 1 2 1\n1 10 20 35\n3 1 4 2\n2 10 20 35 40\n3 10 35 20 1000000\n$EndElements\n";

env::tetrahedral_mesh read(const std::string& text) {
  std::istringstream in(text);
  return env::read_msh(in, "m.msh");
}

// What read() has to say against the text, "" if nothing.
std::string complaint(const std::string& text) {
  try {
    static_cast<void>(read(text));
    return "";
  } catch (const env::mesh_error& e) {
    return e.what();
  }
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("read_msh reads the same mesh from versions 1, 2.2 and 4.1", "[environment][reader]") {
  const auto one = read(version_1);
  REQUIRE(one.nodes.size() == 5);  // 77 is gone
  REQUIRE(one.tetrahedra.size() == 2);
  CHECK(one.nodes[3] == Eigen::Vector3d(0, 0, 1.5));
  CHECK(one.nodes[4] == Eigen::Vector3d(-0.25, -0.25, -0.25));
  CHECK(one.tetrahedra[1] == std::array<int, 4>{0, 2, 1, 4});
  CHECK(env::signed_volume(one, one.tetrahedra[0]) == 0.25);
  for (const auto& text : {version_2, version_4}) {
    const auto other = read(text);
    CHECK(other.nodes == one.nodes);
    CHECK(other.tetrahedra == one.tetrahedra);
  }
}

TEST_CASE("read_msh reads what other writers make of the format", "[environment][reader]") {
  const auto plain = read(version_2);
  const auto same = [&](const std::string& text) {
    const auto mesh = read(text);
    return mesh.nodes == plain.nodes && mesh.tetrahedra == plain.tetrahedra;
  };
  std::string crlf;
  for (const char c : version_2) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(same(crlf));
  CHECK(same("\xEF\xBB\xBF" + version_2));
  CHECK(same("\n  \n" + version_2 + "\n\t\n"));
  CHECK(same(version_2.substr(0, version_2.size() - 1)));
  CHECK(same("$Comments\nmade by hand\n$Nodes\n$EndComments\n" + version_2));
  CHECK(same(replaced(version_2, "20 1 0 0", "  20\t+1.0e0   0 0  ")));
  CHECK(same(replaced(version_2, "2.2 0 8", "2 0 8")));
  std::istringstream strict(version_2);
  strict.exceptions(std::ios::eofbit | std::ios::failbit);
  CHECK(env::read_msh(strict, "strict").nodes == plain.nodes);
}

TEST_CASE("read_msh turns a mesh of the other node order and refuses a mixture",
          "[environment][reader]") {
  auto other = replaced(version_2, "10 20 35 40", "20 10 35 40");
  CHECK(contains(complaint(other), "inverted, as are 1 of 2"));
  CHECK(contains(complaint(other), "m.msh:20: element 2 "));
  other = replaced(other, "10 35 20 1000000", "35 10 20 1000000");
  const auto turned = read(other);
  for (const auto& t : turned.tetrahedra) CHECK(env::signed_volume(turned, t) > 0.0);
}

TEST_CASE("read_msh names file, line and remedy of what it refuses", "[environment][reader]") {
  struct damage {
    std::string text;
    std::vector<std::string_view> parts;
  };
  const auto in_2 = [](std::string_view from, std::string_view to) {
    return replaced(version_2, from, to);
  };
  const auto in_4 = [](std::string_view from, std::string_view to) {
    return replaced(version_4, from, to);
  };
  const std::vector<damage> cases{
      {"", {"m.msh: is empty"}},
      {" \n\n", {"m.msh: is empty"}},
      {"solid cube\n", {"m.msh:1: is not a Gmsh mesh: 'solid cube'", "$MeshFormat", "$NOD"}},
      {std::string("\x7f"
                   "ELF\0\1",
                   6),
       {"m.msh:1:", "not a Gmsh mesh"}},
      {in_2("2.2 0 8", "2.2 1 8"), {"m.msh:2:", "binary", "save as ASCII"}},
      {in_2("2.2 0 8", "4 0 8"), {"m.msh:2:", "version 4;", "-format msh22"}},
      {in_2("2.2 0 8", "3.0 0 8"), {"m.msh:2:", "version 3"}},
      {in_2("2.2 0 8", "nan 0 8"), {"m.msh:2:", "not finite"}},
      {in_2("20 1 0 0", "20 one 0 0"), {"m.msh:11: x 'one' is not a number"}},
      {in_2("20 1 0 0", "20 1,0 0 0"), {"m.msh:11: x '1,0' is not a number"}},
      {in_2("20 1 0 0", "20 inf 0 0"), {"m.msh:11: x 'inf' is not finite"}},
      {in_2("20 1 0 0", "20 0 nan 0"), {"m.msh:11: y 'nan' is not finite"}},
      {in_2("20 1 0 0", "20 1 0"), {"m.msh:11: ends before the z"}},
      {in_2("20 1 0 0", "20 1 0 0 5"), {"m.msh:11: has more on the line", "'5'"}},
      {in_2("20 1 0 0", "2.5 1 0 0"), {"m.msh:11: node number '2.5' is not a whole number"}},
      {in_2("20 1 0 0", "10 1 0 0"), {"m.msh:11: defines node 10 again"}},
      {in_2("$Nodes\n6", "$Nodes\n7"), {"m.msh:16: has '$EndNodes' where node 7 of 7"}},
      {in_2("$Nodes\n6", "$Nodes\n5"), {"m.msh:15:", "where $EndNodes should be", "count"}},
      {in_2("$Nodes\n6", "$Nodes\n-6"), {"m.msh:9: number of nodes -6"}},
      {in_2("$Nodes\n6", "$Nodes\n1000000000000000000"), {"m.msh:9: number of nodes 1000"}},
      {in_2("$Nodes\n6", "$Nodes\n99999999999999999999999"), {"m.msh:9:", "not a whole number"}},
      {in_2("$Nodes\n6", "$Nodes\n2147483647"), {"m.msh:16:", "of 2147483647"}},
      {in_2("$Elements\n3", "$Elements\n4"), {"m.msh:22:", "element 4 of 4"}},
      {in_2("2 4 2 1 1 10", "2 4 -2 1 1 10"), {"m.msh:20: number of tags -2"}},
      {in_2("2 4 2 1 1 10", "2 4 1000000000 1 1 10"), {"m.msh:20: ends before the tag"}},
      {in_2("10 20 35 40", "10 20 35 41"), {"m.msh:20: element 2 names node 41, unknown"}},
      {in_2("10 20 35 40", "10 20 35 35"), {"m.msh:20: element 2 names node", "twice"}},
      {in_2("10 20 35 40", "10 20 35"), {"m.msh:20: ends before the node number"}},
      {in_2("0 0 1.5", "0.5 0.5 0"), {"m.msh:20: element 2 has no volume"}},
      {in_2("3 4 0 10 35 20 1000000", "3 4 0 20 10 40 35"), {"m.msh:21: element 3 and element 2 overlap"}},
      {in_2("$Nodes", "$Nude"), {"m.msh:8: opens '$Nude', which never ends"}},
      {"$Nodes\n0\n$EndNodes\n", {"m.msh:1: $Nodes comes before $MeshFormat"}},
      {version_2 + version_2, {"is a second $Nodes section"}},
      {version_2 + "stray\n", {"m.msh:29: is outside of any section: 'stray'"}},
      {"$NOD\n0\n$ENDNOD\n", {"has no $Elements section"}},
      {"$ELM\n0\n$ENDELM\n", {"has no $Nodes section"}},
      {replaced(replaced(version_1, "2 4 1 1 4 10 20 35 40", "2 2 1 1 3 10 20 35"),
                "3 4 1 1 4 10 35 20 1000000", "3 1 1 1 2 10 20"),
       {"no 4-node tetrahedra among its 3 elements", "gmsh -3"}},
      {replaced(replaced(version_1, "2 4 1 1 4 10 20 35 40", "2 11 1 1 10 1 2 3 4 5 6 7 8 9 10"),
                "3 4 1 1 4 10 35 20 1000000", "3 1 1 1 2 10 20"),
       {"second order", "-order 1"}},
      {replaced(version_1, "1 1 4 10 20 35 40", "1 1 5 10 20 35 40 77"), {"m.msh:13:", "more"}},
      {in_4("3 6 10 1000000", "3 7 10 1000000"), {"ends 1 nodes early"}},
      {in_4("3 6 10 1000000", "3 5 10 1000000"), {"block of 4 where 3 are left"}},
      {in_4("2 3 1 3", "2 4 1 3"), {"ends 1 elements early"}},
      {in_4("2 3 1 3", "3 3 1 3"), {"'$EndElements' where element block"}},
      {in_4("2 3 1 3", "1000000000000 3 1 3"), {"number of blocks 1000000000000"}},
      {in_4("0 0 0 0.5 0.5", "0 0 0 0.5"), {"ends before the parametric coordinate"}},
      {"$NOD\n1\n" + std::string(env::msh_lines::longest_line + 1, '1'), {"m.msh:3: is longer"}},
  };
  for (const auto& [text, parts] : cases) {
    const std::string said = complaint(text);
    for (const auto part : parts) {
      INFO("complaint: " << said << "\nexpected:  " << part);
      CHECK(contains(said, part));
      CHECK(contains(said, "; "));
    }
  }
  CHECK(complaint(version_1).empty());
  CHECK(complaint(version_2).empty());
  CHECK(complaint(version_4).empty());
}

TEST_CASE("read_msh opens files and says why it cannot", "[environment][reader]") {
  const auto folder = std::filesystem::temp_directory_path();
  const auto open = [](const std::filesystem::path& path) -> std::string {
    try {
      static_cast<void>(env::read_msh(path));
      return "";
    } catch (const env::mesh_error& e) {
      return e.what();
    }
  };
  CHECK(contains(open(folder), "is a directory; "));
  CHECK(contains(open(folder / "no such folder" / "mesh.msh"), "cannot be opened; "));

  const auto path = folder / sentence("passive_haptics_", std::random_device{}(), ".msh");
  std::ofstream(path, std::ios::binary) << version_2;
  CHECK(env::read_msh(path).nodes == read(version_2).nodes);
  std::filesystem::remove(path);
}

TEST_CASE("read_msh refuses a file cut off at any byte", "[environment][reader]") {
  for (const auto& text : {version_1, version_2, version_4}) {
    const std::size_t needed = text.size() - 1;  // the last line end is not
    CHECK(complaint(text.substr(0, needed)).empty());
    const std::size_t elements_end = text.find("$EndElements\n") == std::string::npos
                                         ? needed
                                         : text.find("$EndElements\n") + 12;
    std::size_t accepted = 0;
    for (std::size_t length = 0; length < needed; ++length) {
      const bool between_sections = length == elements_end || length == elements_end + 1;
      if (complaint(text.substr(0, length)).empty() && !between_sections) ++accepted;
    }
    CHECK(accepted == 0);
  }
}

TEST_CASE("read_msh makes a usable mesh or a mesh_error of random damage",
          "[environment][reader]") {
  constexpr unsigned seed = 20260101;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return random() % static_cast<unsigned>(n); };
  const std::string_view alphabet = "0123456789 -+.eE$\n\r\tNaif";
  std::size_t meshes = 0;
  std::size_t errors = 0;
  for (const auto& original : {version_1, version_2, version_4}) {
    for (int run = 0; run < 3000; ++run) {
      std::string text = original;
      for (auto edits = 1 + below(4); edits > 0; --edits) {
        const auto at = below(text.size());
        switch (below(4)) {
          case 0:
            text[at] = static_cast<char>(random() & 0xFFu);
            break;
          case 1:
            text[at] = alphabet[below(alphabet.size())];
            break;
          case 2:
            text.insert(at, 1, alphabet[below(alphabet.size())]);
            break;
          default:
            text.erase(at, 1 + below(9));
            break;
        }
      }
      try {
        const auto mesh = read(text);
        REQUIRE_NOTHROW(env::check(mesh));
        ++meshes;
      } catch (const env::mesh_error&) {
        ++errors;
      }
    }
  }
  CHECK(meshes > 100);
  CHECK(errors > 1000);
}

TEST_CASE("an organ reads as one closed body", "[environment][reader]") {
  const auto mesh = env::read_msh(PASSIVE_HAPTICS_TEST_DATA "/organ.msh");
  CHECK(mesh.nodes.size() == 185);
  CHECK(mesh.tetrahedra.size() == 720);
  check_closed(mesh, 2);
}
