// SPDX-License-Identifier: BSD-3-Clause
// The environment without exceptions: a bad file is a value, a bad argument ends the program with its sentence,
// which the test wants to read.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <every_environment_header.hpp>
#include <sstream>

namespace env = passive_haptics::environment;

namespace {

bool never(const char* what) {
  std::fprintf(stderr, "wrong: %s\n", what);
  return false;
}

bool files_are_values() {
  const std::string nodes = "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$ENDNOD\n$ELM\n1\n";
  std::istringstream good(nodes + "1 4 1 1 4 1 2 3 4\n$ENDELM\n");
  std::istringstream bad(nodes + "1 4 1 1 4 1 2 3 9\n$ENDELM\n");
  if (const auto loaded = env::load_msh(good, "good.msh"); loaded.fault) return never("a fault");
  const auto loaded = env::load_msh(bad, "bad.msh");
  if (!loaded.fault) return never("no fault");
  std::fprintf(stderr, "%s\n", loaded.fault->what());
  return env::load_msh("no such folder/mesh.msh").fault || never("a file that is not there");
}

bool bodies_are_solved() {
  const auto mesh = env::ball(0.05);
  const auto fixed = env::ball_fixed_nodes();
  if (env::find_fault(mesh) || env::rigid_modes_left(mesh, fixed) != 0) return never("a bad ball");
  env::deformable_body body(mesh, {.young = 1e4, .poisson = 0.3}, fixed);
  const auto contact = body.update({0.0, 0.0, 0.045}, {0.0, 0.0, 0.0});
  return (contact.fresh && contact.depth > 0.0) || never("no contact");
}

}  // namespace

int main() {
  if (!files_are_values() || !bodies_are_solved()) return 1;
  std::signal(SIGABRT, [](int) { std::_Exit(0); });
  (void)env::ball(-1.0);
  return never("a ball of radius -1") ? 0 : 1;
}
