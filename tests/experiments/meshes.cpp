// SPDX-License-Identifier: BSD-3-Clause
// thesis_experiments on meshes that somebody brings: what it can stroke it strokes, and of the rest it
// says what is wrong and what to do, before it writes anything.
#include "../../bench/thesis_experiments/program.hpp"
#include "../../bench/thesis_experiments/strokes.hpp"
#include "environment/shapes.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/environment/msh_reader.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace ex = experiments;
namespace fs = std::filesystem;

namespace {

/// As Gmsh writes it, of second order if the edges are given their middles.
std::string msh(const env::tetrahedral_mesh& mesh, bool middles = false) {
  std::ostringstream nodes, elements;
  nodes.precision(17);
  std::size_t tag = 0;
  const auto node = [&](const Vector3d& x) {
    nodes << ++tag << ' ' << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
    return tag;
  };
  for (const auto& x : mesh.nodes) node(x);
  for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e) {
    const auto& t = mesh.tetrahedra[e];
    elements << e + 1 << (middles ? " 11" : " 4") << " 2 1 1";
    for (const int corner : t) elements << ' ' << corner + 1;
    for (std::size_t a = 0; middles && a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) {
        const auto at = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
        elements << ' ' << node((at(a) + at(b)) / 2.0);
      }
    }
    elements << '\n';
  }
  return env::sentence("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n", tag, "\n", nodes.str(),
                       "$EndNodes\n$Elements\n", mesh.tetrahedra.size(), "\n", elements.str(),
                       "$EndElements\n");
}

struct outcome {
  int code = 0;
  std::string printed, complaint;
  bool wrote = false;
  std::string json;
};

/// The program on a mesh, in a folder that is gone afterwards.
outcome run_on(const std::string& content, const std::vector<std::string>& more = {}) {
  const scratch_folder folder;
  std::ofstream(folder / "mine.msh") << content;
  std::vector<std::string> arguments{"--mesh", folder / "mine.msh", "--out", folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::ostringstream out, err;
  auto* const cout_buffer = std::cout.rdbuf(out.rdbuf());
  auto* const cerr_buffer = std::cerr.rdbuf(err.rdbuf());
  outcome result;
  result.code = ex::run_thesis_experiments(arguments);
  std::cout.rdbuf(cout_buffer);
  std::cerr.rdbuf(cerr_buffer);
  result.printed = out.str();
  result.complaint = err.str();
  result.wrote = fs::exists(folder / "out");
  if (std::ifstream json(folder / "out/results.json"); json) {
    std::ostringstream text;
    text << json.rdbuf();
    result.json = text.str();
  }
  return result;
}

/// The program will not have the mesh, says so in these words, and has written nothing.
void check_refused(const outcome& result, const std::vector<std::string_view>& parts) {
  INFO(result.complaint);
  CHECK(result.code == 1);
  CHECK_FALSE(result.wrote);
  CHECK(contains(result.complaint, "mine.msh: "));
  CHECK(contains(result.complaint, "; "));
  for (const auto part : parts) {
    INFO(part);
    CHECK(contains(result.complaint, part));
  }
}

env::tetrahedral_mesh our_organ_in(double unit) {
  return env::scaled(env::read_msh(ex::our_organ), ex::millimetre / unit);
}

}  // namespace

TEST_CASE("a mesh in another unit than it is taken for is refused with its size and --unit",
          "[experiments][meshes]") {
  const std::string metres = msh(our_organ_in(1.0));
  check_refused(run_on(metres),
                {"no place for a stroke 3 mm deep along x", "takes 0 % of its length",
                 "with --unit 0.001 it measures 0.0979 x 0.068 x 0.0424 mm",
                 "as --unit 1, which makes it 97.9 x 68 x 42.4 mm"});
  check_refused(run_on(metres, {"--unit", "1000"}),
                {"is not felt in 2000 of 2000 ticks", "with --unit 1000 it measures 9.79e+04 x",
                 "as --unit 1, "});
  const auto right = run_on(metres, {"--unit", "1"});  // the control
  INFO(right.complaint);
  CHECK(right.code == 0);
  CHECK(right.wrote);
}

TEST_CASE("a body that no unit makes an organ is refused with its size", "[experiments][meshes]") {
  auto sheet = env::scaled(blocks(4, [](int, int, int k) { return k == 0; }), 25.0);
  for (auto& node : sheet.nodes) node.z() *= 0.01;  // 100 x 100 x 0.25 mm
  check_refused(run_on(msh(sheet)), {"no place for a stroke", "100 x 100 x 0.25 mm",
                                     "; give the unit of its coordinates in "
                                     "metres with --unit, or one body that is thick enough"});
}

TEST_CASE("a mesh that cannot be held is refused with what holds it", "[experiments][meshes]") {
  const env::tetrahedral_mesh on_its_tip{{{0, 0, 50}, {100, 0, 50}, {0, 100, 50}, {30, 30, 0}},
                                         {{0, 2, 1, 3}}};
  check_refused(run_on(msh(on_its_tip)), {"by the 1 nodes in the lowest 15 % along z",
                                          "turn it until a broad side is down"});
  auto turned = on_its_tip;  // the control: three nodes at its foot
  for (auto& node : turned.nodes) node.z() = 50.0 - node.z();
  CHECK(run_on(msh(env::oriented(turned))).code == 0);

  auto two = env::scaled(blocks(3, [](int i, int, int) { return i != 1; }), 30.0);
  for (auto& node : two.nodes) node.z() += node.x() > 50.0 ? 40.0 : 0.0;
  for (auto& node : two.nodes) node.head<2>() *= 3.0;  // z is the shortest
  check_refused(run_on(msh(two)), {"its 2 separate parts", "keep one part, or join them"});

  // A step whose upper part shares an edge with the lower one.
  const auto step = [](int reach) {
    auto mesh = env::scaled(
        blocks(3, [reach](int i, int, int k) { return k == 0 ? i < reach : k == 1 && i == 2; }),
        20.0);
    for (auto& node : mesh.nodes) node.head<2>() *= 2.0;
    return msh(mesh);
  };
  check_refused(run_on(step(2)), {"is not held together", "its parts joined by whole faces"});
  CHECK(run_on(step(3)).code == 0);  // the control
}

TEST_CASE("a ring that lies flat is stroked beside its hole", "[experiments][meshes]") {
  const auto ring = torus(40.0, 15.0, 16, 8);
  const auto result = run_on(msh(ring));
  INFO(result.complaint);
  CHECK(result.code == 0);
  const ex::stroke_scene scene({env::scaled(ring, ex::millimetre), "ring"});
  const auto surface = env::boundary(scene.mesh());
  const double middle = ex::stroke_scene::approach + ex::stroke_scene::stroke / 2.0;
  const Vector3d hand = scene.position(middle);
  CHECK(env::is_inside(surface, scene.mesh().nodes, hand));
  CHECK_FALSE(env::is_inside(surface, scene.mesh().nodes, {0.0, 0.0, hand.z()}));  // the hole
}

TEST_CASE("a body without a piece of surface to stroke is refused with the piece that it has",
          "[experiments][meshes]") {
  const auto bars = [](bool apart) {  // across its longest side
    return msh(env::scaled(
        blocks(9, [apart](int i, int, int k) { return k == 0 && (!apart || i % 2 == 0); }), 10.0));
  };
  check_refused(run_on(bars(true)), {"takes 11 % of its length, not 20", "90 x 90 x 10 mm",
                                     "or one body that is thick enough"});
  CHECK(run_on(bars(false)).code == 0);  // the control
}

TEST_CASE("a mesh of second order is stroked by its corners, and the program says so",
          "[experiments][meshes]") {
  const auto block = env::scaled(blocks(3, [](int, int, int) { return true; }), 20.0);
  const auto quadratic = run_on(msh(block, true)), linear = run_on(msh(block));
  CHECK(quadratic.code == 0);
  CHECK(contains(quadratic.printed, "162 tetrahedra of higher order are taken by their corners"));
  CHECK(contains(quadratic.json, "162 tetrahedra of higher order are taken by their corners"));
  CHECK_FALSE(contains(linear.printed, "higher order"));
  const auto strokes_of = [](const std::string& json) {
    const auto from = json.find("\"strokes\"");  // what follows names the file
    return json.substr(from, json.find("\"captions\"") - from);
  };
  CHECK(strokes_of(quadratic.json) == strokes_of(linear.json));
}

TEST_CASE("results.json has the port energy of every stroke", "[experiments][meshes]") {
  const auto result = run_on(msh(our_organ_in(ex::millimetre)));
  REQUIRE(result.code == 0);
  for (const std::string run : {"reference", "bare", "passive"}) {
    const auto at = result.json.find("\"run\": \"" + run + "\"");
    REQUIRE(at != std::string::npos);
    const std::string row = result.json.substr(at, result.json.find('}', at) - at);
    INFO(row);
    for (const std::string name : {"\"min_port_energy_J\": ", "\"end_port_energy_J\": "}) {
      const auto number = row.find(name);
      REQUIRE(number != std::string::npos);
      const double energy = std::stod(row.substr(number + name.size()));
      CHECK(std::isfinite(energy));
      if (run == "passive") CHECK(energy >= 0.0);
    }
  }
}

TEST_CASE("thesis_experiments names the folder that it cannot make, and the option",
          "[experiments][meshes]") {
  const auto result = run_on(msh(our_organ_in(ex::millimetre)), {"--out", "/dev/null/results"});
  CHECK(result.code == 1);
  CHECK(contains(result.complaint, "/dev/null/results: cannot be made a folder"));
  CHECK(contains(result.complaint, "; give another with --out"));
}

TEST_CASE("the option --unit takes a length and says what one is", "[experiments][meshes]") {
  for (const std::string bad : {"0", "-1", "nan", "1e400", "0x1", "1,5", "mm", "2000", "1e-10"}) {
    const auto result = run_on("", {"--unit", bad});
    INFO(bad);
    CHECK(result.code == 2);
    CHECK(contains(result.complaint, "--unit " + bad + ": give a length from 1e-9 to 1000 m"));
  }
}
