// SPDX-License-Identifier: BSD-3-Clause
// VTU: what ParaView is told of a body is the body, to the last bit.
#include "environment/shapes.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/environment/vtu_writer.hpp>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace {

/// The numbers of the DataArray of that name.
std::vector<double> array(const std::string& vtu, const std::string& name) {
  const auto tag = vtu.find("Name=\"" + name + "\"");
  REQUIRE(tag != std::string::npos);
  const auto begin = vtu.find('>', tag) + 1;
  std::istringstream words(vtu.substr(begin, vtu.find('<', begin) - begin));
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    const auto number = passive_haptics::to_decimal(word);
    REQUIRE(number);
    numbers.push_back(*number);
  }
  return numbers;
}

std::string text_of_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

struct comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("a mesh that is written as VTU is told bit by bit, and how far it has moved",
          "[environment][vtu]") {
  const auto mesh = env::ball(0.05);
  auto moved = mesh.nodes;
  for (auto& x : moved) x += Vector3d(1e-3, x.z() / 3.0, -0.1);
  std::vector<double> points, displacements, nodes, ends;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Vector3d u = moved[i] - mesh.nodes[i];
    points.insert(points.end(), moved[i].begin(), moved[i].end());
    displacements.insert(displacements.end(), u.begin(), u.end());
  }
  for (const auto& t : mesh.tetrahedra) {
    nodes.insert(nodes.end(), t.begin(), t.end());
    ends.push_back(static_cast<double>(nodes.size()));
  }
  std::ostringstream out;
  env::write_vtu(out, mesh, moved);
  const std::string text = out.str();
  CHECK(array(text, "Points") == points);
  CHECK(array(text, "displacement") == displacements);
  CHECK(array(text, "connectivity") == nodes);
  CHECK(array(text, "offsets") == ends);
  CHECK(array(text, "types") == std::vector<double>(mesh.tetrahedra.size(), 10.0));
  CHECK(contains(text, "<Piece NumberOfPoints=\"11\" NumberOfCells=\"16\">"));
}

TEST_CASE("a VTU file is the same whatever its stream writes otherwise", "[environment][vtu]") {
  const auto mesh = blocks(6, [](int, int, int) { return true; });  // more than 999 elements
  std::ostringstream plain, odd;
  odd.imbue(std::locale(std::locale::classic(), new comma));
  odd << std::fixed << std::hex << std::showpos << std::setprecision(2);
  env::write_vtu(plain, mesh, mesh.nodes);
  env::write_vtu(odd, mesh, mesh.nodes);
  CHECK(odd.str() == plain.str());
  odd.str("");
  odd << 1.5;  // and goes on as before
  CHECK(odd.str() == "+1,50");
}

TEST_CASE("a VTU file is whole or not there", "[environment][vtu]") {
  const auto mesh = env::ball(0.05);
  const scratch_folder folder;
  const std::filesystem::path path = folder / "ball.vtu";
  std::ostringstream out;
  env::write_vtu(out, mesh, mesh.nodes);
  env::write_vtu(path, mesh, mesh.nodes);
  CHECK(text_of_file(path.string()) == out.str());
  CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
  const std::vector<Vector3d> too_few(mesh.nodes.begin(), mesh.nodes.end() - 1);
  CHECK(contains(
      text_of<std::invalid_argument>([&] { env::write_vtu(folder / "b.vtu", mesh, too_few); }),
      "10 positions for 11 nodes"));
  CHECK_THROWS_AS(env::write_vtu(out, mesh, too_few), std::invalid_argument);
  CHECK(contains(
      text_of<env::mesh_error>([&] { env::write_vtu("/no folder/a.vtu", mesh, mesh.nodes); }),
      "cannot be written"));
  CHECK(contains(text_of<env::mesh_error>([&] { env::write_vtu(folder.path(), mesh, mesh.nodes); }),
                 "cannot be written"));
  CHECK_FALSE(std::filesystem::exists(folder.path().string() + ".part"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.vtu"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.vtu.part"));
}
