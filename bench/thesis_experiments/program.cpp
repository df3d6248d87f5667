// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include "../common/rows.hpp"
#include "ball.hpp"
#include "strokes.hpp"
#include "wall.hpp"
#include <passive_haptics/base/decimal.hpp>

namespace experiments {

namespace {

struct settings {
  std::string out = "demo";
  std::string mesh;  ///< empty: our organ
  double unit = millimetre;
  int seeds = 10;
};

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  const auto take_unit = [&chosen](const std::string& text) {
    const auto unit = ph::to_decimal(text);
    if (!unit || !(*unit >= 1e-9 && *unit <= 1e3)) {
      complain("--unit " + text + ": give a length from 1e-9 to 1000 m, as 0.001 for millimetres");
    }
    chosen.unit = *unit;
  };
  read_options(
      "thesis_experiments",
      {a_text("--out DIR", "where the results go (default: " + chosen.out + ")", chosen.out),
       a_number("--seeds",
                "random schedules per controller in scene S1 (default: " +
                    std::to_string(chosen.seeds) + ")",
                chosen.seeds),
       a_text("--mesh FILE", "Gmsh MSH (1, 2.2 or 4.1): run the 3-DOF part on it alone",
              chosen.mesh),
       {"--unit METRES",
        "the mesh's unit of length (default: " + format("%g", chosen.unit) + ", millimetres)",
        take_unit}},
      arguments);
  return chosen;
}

stroke_scene scene_of(const settings& chosen) {
  if (!chosen.mesh.empty()) return stroke_scene(read_organ(chosen.mesh, chosen.unit));
  organ ours = read_organ(our_organ, millimetre);
  ours.file = "an organ";
  return stroke_scene(std::move(ours));
}

}  // namespace

int run_thesis_experiments(const std::vector<std::string>& arguments) {
  return guarded("thesis_experiments", [&arguments] {
    const settings chosen = parse(arguments);
    // Everything that can be wrong with a mesh is found before anything is written.
    const stroke_scene scene = scene_of(chosen);
    const strokes stroked = stroke(scene);
    report out(chosen.out);
    if (chosen.mesh.empty()) {
      run_wall(out, chosen.seeds);
      run_sweep(out);
      run_ball(out);
    }
    show_strokes(out, scene, stroked);
    return conclude(
        out, "thesis_experiments", "passive_haptics: the thesis experiments",
        "A simulated device falls onto a wall, presses into a ball and strokes an organ, "
        "with and without a passivity controller.",
        {});
  });
}

}  // namespace experiments
