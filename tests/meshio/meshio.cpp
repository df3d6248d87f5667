// SPDX-License-Identifier: BSD-3-Clause
// meshio opens what we write, and makes of it what we read, by the command that the reader's refusal names.
#include "environment/shapes.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/environment/vtu_writer.hpp>

#include <cstdlib>

namespace {

/// The command of the sentence, in that folder. Its meshio is the one that CMake has found.
int convert_in(const scratch_folder& folder) {
  const std::string sentence(env::convert_the_mesh);
  const auto begin = sentence.find("meshio convert"), end = sentence.find(" (Debian");
  REQUIRE(begin < end);
  const std::string rest = sentence.substr(begin + 6, end - begin - 6);
  return std::system(
      ("cd '" + folder.path().string() + "' && " + MESHIO + rest + " >log 2>&1").c_str());
}

}  // namespace

TEST_CASE("a body that is written as VTU comes back through meshio, bit by bit",
          "[environment][meshio]") {
  const auto mesh = env::ball(0.05);
  auto moved = mesh.nodes;
  for (auto& x : moved) x += Vector3d(1e-3, x.z() / 3.0, -0.1);
  const scratch_folder folder;
  env::write_vtu(folder / "in.vtu", mesh, moved);
  REQUIRE(convert_in(folder) == 0);
  const auto back = env::load_msh(folder / "out.msh");
  INFO((back.fault ? back.fault->what() : ""));
  REQUIRE_FALSE(back.fault);
  CHECK(back.mesh.nodes == moved);
  CHECK(back.mesh.tetrahedra == mesh.tetrahedra);
}
