// SPDX-License-Identifier: BSD-3-Clause
// thesis_experiments: the thesis's system, end to end, on a simulated device.
//
//     thesis_experiments --out DIR                      wall, sweep, ball and a built-in cushion
//     thesis_experiments --mesh FILE.msh --out DIR      the 3-DOF part on your mesh

#include "ball.hpp"
#include "mesh.hpp"
#include "wall.hpp"

#include <exception>

namespace {

struct options {
  std::string out = "demo";
  std::string mesh;
  double unit = 0.02;
  int seeds = 10;
};

[[noreturn]] void usage(const std::string& complaint) {
  throw std::invalid_argument(
      complaint +
      "\nusage: thesis_experiments [--out DIR] [--seeds N] [--mesh FILE.msh [--unit METRES]]\n"
      "  --out DIR      where the results go (default: demo)\n"
      "  --seeds N      random schedules per controller in scene S1, at least 1 (default: 10)\n"
      "  --mesh FILE    Gmsh MSH (ASCII 1, 2.2 or 4.1): run the 3-DOF part on it alone\n"
      "  --unit METRES  the mesh's unit of length (default: 0.01, centimetres)");
}

double number(const std::string& name, const char* text, double least) {
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (end == text || *end != '\0' || !std::isfinite(value) || value < least) {
    usage(name + " " + text + ": give a number of at least " + experiments::format("%g", least));
  }
  return value;
}

options parse(int argc, char** argv) {
  options chosen;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc) usage(name + ": its value is missing");
    const char* value = argv[i + 1];
    if (name == "--out") {
      chosen.out = value;
    } else if (name == "--mesh") {
      chosen.mesh = value;
    } else if (name == "--unit") {
      chosen.unit = number(name, value, 1e-9);
    } else if (name == "--seeds") {
      chosen.seeds = static_cast<int>(number(name, value, 1));
    } else {
      usage(name + ": no such option");
    }
  }
  return chosen;
}

void run(const options& chosen) {
  // Everything that can be wrong with a mesh is found before anything is written.
  const bool own = !chosen.mesh.empty();
  const auto mesh = own ? experiments::read_mesh(chosen.mesh, chosen.unit) : experiments::cushion();
  const experiments::stroke_scene scene(mesh);
  experiments::report report(chosen.out);
  if (!own) {
    experiments::run_wall(report, chosen.seeds);
    experiments::run_sweep(report);
    experiments::run_ball(report);
  }
  experiments::run_mesh(report, scene, own ? chosen.mesh : "built-in cushion");
  if (!report.finish("passive_haptics: the thesis experiments")) {
    std::cout << "gnuplot did not draw every plot: is it installed? The rest is complete.\n";
  }
  std::cout << "results: " << report.path("results.json").string() << ", "
            << report.path("index.html").string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse(argc, argv));
    return 0;
  } catch (const std::exception& problem) {
    std::cerr << "thesis_experiments: " << problem.what() << '\n';
    return 1;
  }
}
