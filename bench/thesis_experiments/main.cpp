// SPDX-License-Identifier: BSD-3-Clause
// thesis_experiments: the thesis's system, end to end, on a simulated device.
//
//     thesis_experiments --out DIR                      wall, sweep, ball and an organ
//     thesis_experiments --mesh FILE.msh --out DIR      the 3-DOF part on your mesh

#include "../common/options.hpp"
#include "ball.hpp"
#include "mesh.hpp"
#include "wall.hpp"

namespace {

namespace ex = experiments;

struct settings {
  std::string out = "demo";
  std::string mesh;  ///< empty: our organ
  double unit = ex::millimetre;
  int seeds = 10;
};

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  const auto take_unit = [&chosen](const std::string& text) {
    char* end = nullptr;
    chosen.unit = std::strtod(text.c_str(), &end);
    if (*end == '\0' && chosen.unit >= 1e-9 && std::isfinite(chosen.unit)) return;
    ex::complain("--unit " + text + ": give a length of at least 1e-9 m");
  };
  ex::read_options(
      "thesis_experiments",
      {ex::a_text("--out DIR", "where the results go (default: " + chosen.out + ")", chosen.out),
       ex::a_number("--seeds",
                    "random schedules per controller in scene S1 (default: " +
                        std::to_string(chosen.seeds) + ")",
                    chosen.seeds),
       ex::a_text("--mesh FILE", "Gmsh MSH (ASCII 1, 2.2 or 4.1): run the 3-DOF part on it alone",
                  chosen.mesh),
       {"--unit METRES",
        "the mesh's unit of length (default: " + ex::format("%g", chosen.unit) + ")", take_unit}},
      arguments);
  return chosen;
}

int run(const settings& chosen) {
  // Everything that can be wrong with a mesh is found before anything is written.
  const bool own = !chosen.mesh.empty();
  const ex::stroke_scene scene(own ? ex::read_mesh(chosen.mesh, chosen.unit)
                                   : ex::read_mesh(ex::organ, ex::millimetre));
  ex::report report(chosen.out);
  if (!own) {
    ex::run_wall(report, chosen.seeds);
    ex::run_sweep(report);
    ex::run_ball(report);
  }
  ex::run_mesh(report, scene, own ? chosen.mesh : "an organ");
  if (!report.finish("passive_haptics: the thesis experiments")) {
    std::cout << "gnuplot did not draw every plot: is it installed? The rest is complete.\n";
  }
  std::cout << "results: " << report.path("results.json").string() << ", "
            << report.path("index.html").string() << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return ex::guarded("thesis_experiments", [&] { return run(parse({argv + 1, argv + argc})); });
}
