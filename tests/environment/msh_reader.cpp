// SPDX-License-Identifier: BSD-3-Clause
// The reader of meshes: three versions of one mesh, as text and in binary, every way to damage it.
#include "environment/shapes.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/environment/msh_reader.hpp>

#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unordered_map>

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

/// Text and binary numbers in either byte order, one after the other.
class binary {
 public:
  explicit binary(bool big) : big_(big) {}

  binary& text(std::string_view part) {
    content_ += part;
    return *this;
  }
  template <class... Numbers>
  binary& ints(Numbers... numbers) {
    (number(static_cast<std::uint32_t>(numbers), 4), ...);
    return *this;
  }
  template <class... Numbers>
  binary& sizes(int bytes, Numbers... numbers) {
    (number(static_cast<std::uint64_t>(numbers), bytes), ...);
    return *this;
  }
  template <class... Numbers>
  binary& reals(Numbers... numbers) {
    (number(std::bit_cast<std::uint64_t>(double(numbers)), 8), ...);
    return *this;
  }
  [[nodiscard]] const std::string& content() const { return content_; }

 private:
  void number(std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) {
      const int digit = big_ ? bytes - 1 - i : i;
      content_ += static_cast<char>(value >> (8 * digit) & 0xFFU);
    }
  }

  bool big_;
  std::string content_;
};

// version_2 in binary.
std::string binary_2(bool big) {
  binary file(big);
  file.text("$MeshFormat\n2.2 1 8\n").ints(1).text("\n$EndMeshFormat\n$Nodes\n6\n");
  file.ints(10).reals(0, 0, 0).ints(20).reals(1, 0, 0).ints(35).reals(0, 1, 0);
  file.ints(40).reals(0, 0, 1.5).ints(77).reals(9, 9, 9).ints(1000000).reals(-0.25, -0.25, -0.25);
  file.text("\n$EndNodes\n$Elements\n3\n");
  file.ints(2, 1, 2).ints(1, 1, 1, 10, 20, 35);
  file.ints(4, 1, 2).ints(2, 1, 1, 10, 20, 35, 40);
  file.ints(4, 1, 0).ints(3, 10, 35, 20, 1000000);
  return file.text("\n$EndElements\n").content();
}

// version_4 in binary; tags and counts of 4 or 8 bytes.
std::string binary_4(bool big, int size) {
  binary file(big);
  file.text(sentence("$MeshFormat\n4.1 1 ", size, "\n")).ints(1).text("\n$EndMeshFormat\n");
  file.text("$Entities\n")
      .sizes(size, 0, 0, 0, 1)
      .ints(1)
      .reals(0, 0, 0, 1, 1, 1)
      .sizes(size, 0, 0);
  file.text("\n$EndEntities\n$Nodes\n").sizes(size, 3, 6, 10, 1000000);
  file.ints(2, 1, 1).sizes(size, 2, 10, 20).reals(0, 0, 0, 0.5, 0.5).reals(1, 0, 0, 0.5, 0.5);
  file.ints(3, 1, 0).sizes(size, 0);
  file.ints(3, 1, 0).sizes(size, 4, 35, 40, 77, 1000000);
  file.reals(0, 1, 0).reals(0, 0, 1.5).reals(9, 9, 9).reals(-0.25, -0.25, -0.25);
  file.text("\n$EndNodes\n$Elements\n").sizes(size, 2, 3, 1, 3);
  file.ints(2, 1, 2).sizes(size, 1, 1, 10, 20, 35);
  file.ints(3, 1, 4).sizes(size, 2, 2, 10, 20, 35, 40, 3, 10, 35, 20, 1000000);
  return file.text("\n$EndElements\n").content();
}

std::vector<std::string> all_binary() {
  std::vector<std::string> all;
  for (const bool big : {false, true}) {
    all.push_back(binary_2(big));
    for (const int size : {4, 8}) all.push_back(binary_4(big, size));
  }
  return all;
}

env::loaded_msh load(const std::string& text) {
  std::istringstream in(text);
  return env::load_msh(in, "m.msh");
}

env::tetrahedral_mesh read(const std::string& text) {
  std::istringstream in(text);
  return env::read_msh(in, "m.msh");
}

// What load() has to say against the text, "" if nothing.
std::string complaint(const std::string& text) {
  const auto fault = load(text).fault;
  return fault ? fault->what() : "";
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
    CHECK(load(text).notes.empty());
  }
}

TEST_CASE("read_msh reads binary files of either byte order as it reads text",
          "[environment][reader]") {
  const auto plain = read(version_2);
  for (const auto& content : all_binary()) {
    const auto mesh = read(content);
    CHECK(mesh.nodes == plain.nodes);
    CHECK(mesh.tetrahedra == plain.tetrahedra);
  }
  // Line ends within numbers, and end marks that follow them on one line.
  const auto at_10 = replaced(binary_2(false), std::string("\x14\0\0\0", 4), "\n\n\n\n");
  CHECK(contains(complaint(at_10), "names node 20, unknown"));
  const auto tight = replaced(binary_4(false, 8), "\n$EndEntities", "$EndEntities");
  CHECK(read(replaced(tight, "\n$EndNodes", "$EndNodes")).nodes == plain.nodes);
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

TEST_CASE("load_msh tells of a fault without throwing, and of what a mesh leaves out",
          "[environment][reader]") {
  const auto good = load(version_2);
  CHECK_FALSE(good.fault);
  CHECK(good.mesh.tetrahedra.size() == 2);
  const auto bad = load(replaced(version_2, "20 1 0 0", "20 one 0 0"));
  REQUIRE(bad.fault);
  CHECK(bad.mesh.nodes.empty());
  CHECK(text_of<env::mesh_error>([] {
          static_cast<void>(read(replaced(version_2, "20 1 0 0", "20 one 0 0")));
        }) == bad.fault->what());
}

TEST_CASE("a volume in two physical groups is read once from every version",
          "[environment][reader]") {
  // Versions 1 and 2 save the element for each group, version 4 names the groups with the entity.
  const auto groups_1 = replaced(replaced(version_1, "$ELM\n3", "$ELM\n4"), "$ENDELM",
                                 "4 4 2 1 4 10 20 35 40\n$ENDELM");
  const auto groups_2 = replaced(replaced(version_2, "$Elements\n3", "$Elements\n4"),
                                 "$EndElements", "4 4 2 2 1 10 20 35 40\n$EndElements");
  const auto groups_4 = replaced(version_4, "1 0 0 0 1 1 1 0 0", "1 0 0 0 1 1 1 2 1 2 0");
  const auto plain = read(version_2);
  for (const auto& text : {groups_1, groups_2, groups_4}) {
    const auto mesh = read(text);
    CHECK(mesh.nodes == plain.nodes);
    CHECK(mesh.tetrahedra == plain.tetrahedra);
  }
  for (const auto& text : {groups_1, groups_2}) {
    const auto notes = load(text).notes;
    REQUIRE(notes.size() == 1);
    CHECK(contains(notes[0], "1 tetrahedra are in the file once more"));
  }
  CHECK(load(groups_4).notes.empty());

  // The same element of the same group, or of two bodies in one place, is too much in every version.
  const auto once_more =
      replaced(replaced(version_4, "2 3 1 3", "2 4 1 4"), "3 1 4 2\n", "3 1 4 3\n4 10 20 35 40\n");
  for (const auto& text :
       {replaced(groups_1, "4 4 2 1 4", "4 4 1 1 4"), replaced(groups_1, "4 4 2 1 4", "4 4 2 7 4"),
        replaced(groups_2, "4 4 2 2 1", "4 4 2 1 1"), replaced(groups_2, "4 4 2 2 1", "4 4 2 2 7"),
        once_more}) {
    CHECK(contains(complaint(text), "overlap at a common face; "));
  }
}

TEST_CASE("tetrahedra of second order are taken by their corners, and the file's note says so",
          "[environment][reader]") {
  // One element, its mid-side nodes 5 to 10 on the straight edges but for one.
  const std::string nodes =
      "10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .5 .5 0\n7 0 .5 .1\n8 0 0 .5\n9 0 .5 "
      ".5\n"
      "10 .5 0 .5\n";
  const std::string text_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + nodes +
                             "$EndNodes\n$Elements\n2\n1 9 2 1 1 1 2 3 5 6 7\n"
                             "2 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";
  binary file(true);
  file.text("$MeshFormat\n2.2 1 8\n").ints(1).text("\n$EndMeshFormat\n$Nodes\n10\n");
  file.ints(1).reals(0, 0, 0).ints(2).reals(1, 0, 0).ints(3).reals(0, 1, 0).ints(4).reals(0, 0, 1);
  for (int mid = 5; mid <= 10; ++mid) file.ints(mid).reals(.5, .5, .5);
  file.text("\n$EndNodes\n$Elements\n2\n").ints(9, 1, 1, 1, 7, 1, 2, 3, 5, 6, 7);
  file.ints(11, 1, 1, 2, 7, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10).text("\n$EndElements\n");
  for (const auto& content : {text_2, file.content()}) {
    const auto loaded = load(content);
    REQUIRE_FALSE(loaded.fault);
    CHECK(loaded.mesh.nodes == std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    CHECK(loaded.mesh.tetrahedra == std::vector<std::array<int, 4>>{{0, 1, 2, 3}});
    REQUIRE(loaded.notes.size() == 1);
    CHECK(contains(loaded.notes[0], "1 tetrahedra of higher order are taken by their corners"));
    CHECK(contains(loaded.notes[0], "; 6 nodes that are no corner, "));
  }
  CHECK(contains(complaint(replaced(text_2, "8 9 10\n$End", "8 9\n$End")), "ends before the node"));
  CHECK(
      contains(complaint(replaced(text_2, "8 9 10\n$End", "8 9 10 4\n$End")), "more on the line"));
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
      {in_2("2.2 0 8", "2.2 1 8"), {"m.msh, byte 20: shows the byte order by 1684948260"}},
      {in_2("2.2 0 8", "2.2 1 4"), {"m.msh:2: has binary numbers of 4 bytes", "-format msh41"}},
      {in_2("2.2 0 8", "4 0 8"), {"m.msh:2:", "version 4;", "-format msh41"}},
      {in_2("2.2 0 8", "3.0 0 8"), {"m.msh:2:", "version 3"}},
      {in_2("2.2 0 8", "nan 0 8"), {"m.msh:2: version 'nan' is not a finite number"}},
      {in_2("20 1 0 0", "20 one 0 0"), {"m.msh:11: x 'one' is not a finite number"}},
      {in_2("20 1 0 0", "20 1,0 0 0"), {"m.msh:11: x '1,0' is not a finite number"}},
      {in_2("20 1 0 0", "20 inf 0 0"), {"m.msh:11: x 'inf' is not a finite number"}},
      {in_2("20 1 0 0", "20 0 nan 0"), {"m.msh:11: y 'nan' is not a finite number"}},
      {in_2("20 1 0 0", "20 1e400 0 0"), {"m.msh:11: x '1e400' is not a finite number"}},
      {in_2("20 1 0 0", "20 0x10 0 0"), {"m.msh:11: x '0x10' is not a finite number"}},
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
      {in_2("3 4 0 10 35 20 1000000", "3 4 0 20 10 40 35"),
       {"m.msh:21: element 3 and element 2 overlap"}},
      {in_2("$Nodes", "$Nude"), {"m.msh:8: opens '$Nude', which never ends"}},
      {"$Nodes\n0\n$EndNodes\n", {"m.msh:1: $Nodes comes before $MeshFormat"}},
      {version_2 + version_2, {"is a second $Nodes section"}},
      {version_2 + "stray\n", {"m.msh:29: is outside of any section: 'stray'"}},
      {"$NOD\n0\n$ENDNOD\n", {"has no $Elements section"}},
      {"$ELM\n0\n$ENDELM\n", {"has no $Nodes section"}},
      {replaced(replaced(version_1, "2 4 1 1 4 10 20 35 40", "2 2 1 1 3 10 20 35"),
                "3 4 1 1 4 10 35 20 1000000", "3 1 1 1 2 10 20"),
       {"m.msh:15: has no tetrahedra among its 3 elements", "gmsh -3"}},
      {in_2("2 4 2 1 1 10", "2 5 2 1 1 10"), {"m.msh:20: element 2 of type 5", "tetrahedra alone"}},
      {in_2("2 4 2 1 1 10", "2 99 2 1 1 10"), {"m.msh:20: element 2 has type 99", "-order 1"}},
      {replaced(version_1, "1 1 4 10 20 35 40", "1 1 5 10 20 35 40 77"), {"m.msh:13:", "more"}},
      {in_4("3 6 10 1000000", "3 7 10 1000000"), {"ends 1 nodes early"}},
      {in_4("3 6 10 1000000", "3 5 10 1000000"), {"block of 4 where 3 are left"}},
      {in_4("3 6 10 1000000", "3 6 10"), {"m.msh:9: ends before the largest tag"}},
      {in_4("2 3 1 3", "2 4 1 3"), {"ends 1 elements early"}},
      {in_4("2 3 1 3", "3 3 1 3"), {"'$EndElements' where element block"}},
      {in_4("2 3 1 3", "1000000000000 3 1 3"), {"number of blocks 1000000000000"}},
      {in_4("0 0 0 0.5 0.5", "0 0 0 0.5"), {"ends before the parametric coordinate"}},
      {"$NOD\n1\n" + std::string(env::msh_input::longest_line + 1, '1'), {"m.msh:3: is longer"}},
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

TEST_CASE("read_msh names the byte at which a binary file goes wrong", "[environment][reader]") {
  const std::string good = binary_2(false);
  const auto nodes = good.find("$Nodes\n6\n") + 9;
  const auto elements = good.find("$Elements\n3\n") + 12;
  const auto said = [&good](std::size_t at, auto... numbers) {
    const std::string put = binary(false).ints(numbers...).content();
    return complaint(std::string(good).replace(at, put.size(), put));
  };
  CHECK(contains(complaint(good.substr(0, nodes + 30)),
                 sentence("m.msh, byte ", nodes + 28, ": ends before the node number; ")));
  CHECK(contains(said(nodes + 28, 10), "defines node 10 again"));
  CHECK(contains(said(nodes + 28 + 4, -1, -1), "nan is not a finite number"));
  CHECK(contains(said(elements, 5), "element 1 of type 5"));
  CHECK(contains(said(elements, 99), "element 1 has type 99"));
  CHECK(contains(said(elements + 4, 4), "has a block of 4 where 3 are left"));
  CHECK(contains(said(elements + 4, 0), "has a block of no elements"));
  CHECK(contains(said(elements + 4, -1), "block size -1 is not between 0 and"));
  CHECK(contains(said(elements + 8, -2), "number of tags -2"));
  CHECK(contains(said(elements + 8, 2147483647), "ends before the tag"));
  CHECK(contains(complaint(replaced(good, "$Nodes\n6", "$Nodes\n5")), "where $EndNodes should be"));
  const std::string four = binary_4(true, 8);
  CHECK(contains(complaint(replaced(four, std::string("\0\0\0\x06", 4), "\xFF\xFF\xFF\xFF")),
                 "number of nodes 4294967295 is not between 0 and"));
  CHECK(contains(
      complaint(replaced(four, std::string("\0\0\0\x06", 4), std::string("\x7F\0\0\0", 4))),
      "ends 2130706426 nodes early"));
}

TEST_CASE("read_msh opens files and says why it cannot", "[environment][reader]") {
  const scratch_folder folder;
  const auto open = [](const std::filesystem::path& path) -> std::string {
    try {
      static_cast<void>(env::read_msh(path));
      return "";
    } catch (const env::mesh_error& e) {
      return e.what();
    }
  };
  CHECK(contains(open(folder.path()), "is a directory; "));
  CHECK(contains(open(folder / "no such folder/mesh.msh"), "cannot be opened; "));

  const auto path = folder / "mesh.msh";
  std::ofstream(path, std::ios::binary) << version_2;
  CHECK(env::read_msh(path).nodes == read(version_2).nodes);
}

TEST_CASE("a surface, or a mesh of another format, is refused with the command that helps",
          "[environment][reader]") {
  const std::string fill =
      "\\nVolume(1) = {1};\\n' > in.geo && gmsh -3 in.geo -o out.msh; one that has holes";
  const std::string convert = "meshio convert -o gmsh22 in.vtu out.msh (Debian: meshio-tools)";
  const std::string stl = "solid organ\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n";
  const std::string binary_stl =
      std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0');
  const std::string vtu = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n";
  for (const auto& text : {stl, binary_stl, vtu, std::string("# vtk DataFile Version 3.0\n")}) {
    const std::string said = complaint(text);
    INFO(said);
    CHECK(contains(said, "is not a Gmsh mesh"));
    CHECK(contains(said, convert));
    CHECK(contains(said, fill));
  }
  // What meshio makes of a surface is one of Gmsh's meshes, of triangles.
  const std::string triangles =
      replaced(replaced(version_2, "2 4 2 1 1 10 20 35 40", "2 2 2 1 1 10 20 40"),
               "3 4 0 10 35 20 1000000", "3 2 0 10 35 40");
  CHECK(contains(complaint(triangles), "has no tetrahedra among its 3 elements; mesh the volume"));
  CHECK(contains(complaint(triangles), fill));
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

TEST_CASE("read_msh refuses a binary file cut off at any byte", "[environment][reader]") {
  for (const auto& content : all_binary()) {
    const std::size_t needed = content.size() - 1;
    CHECK(complaint(content.substr(0, needed)).empty());
    std::size_t accepted = 0;
    for (std::size_t length = 0; length < needed; ++length) {
      accepted += complaint(content.substr(0, length)).empty() ? 1 : 0;
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
  for (const auto& original :
       {version_1, version_2, version_4, binary_2(false), binary_4(true, 8)}) {
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

TEST_CASE("node numbers that all have one hash are read as fast as any", "[environment][reader]") {
  static constexpr long nodes = 20000;
  std::unordered_map<std::int64_t, int> table;
  for (long i = 0; i < nodes; ++i) table[i] = 0;
  const auto seconds = [](std::int64_t apart) {
    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << nodes << '\n';
    for (long i = 0; i < nodes; ++i) {
      text << (i + 1) * apart << ' ' << (i % 4 == 1) + 10 * i << ' ' << (i % 4 == 2) << ' '
           << (i % 4 == 3) << '\n';
    }
    text << "$EndNodes\n$Elements\n" << nodes / 4 << '\n';
    for (long i = 0; i < nodes / 4; ++i) {
      text << i + 1 << " 4 2 1 1";
      for (long k = 1; k <= 4; ++k) text << ' ' << (4 * i + k) * apart;
      text << '\n';
    }
    text << "$EndElements\n";
    std::istringstream in(text.str());
    const auto begin = std::chrono::steady_clock::now();
    CHECK(env::read_msh(in, "m.msh").nodes.size() == std::size_t{nodes});
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const double any = seconds(1);
  CHECK(seconds(static_cast<std::int64_t>(table.bucket_count())) < 10.0 * any + 0.2);
  CHECK(seconds(-7) < 10.0 * any + 0.2);
}
