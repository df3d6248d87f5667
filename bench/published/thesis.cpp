// SPDX-License-Identifier: BSD-3-Clause
// McWilliam's own figures: the Falcon dropped onto a wall of 10 kN/m that gives way.
#include "../common/wall.hpp"
#include "program.hpp"

namespace papers {

ex::failures run_thesis(const session& s) {
  s.out.section(
      "McWilliam (thesis, § 3.2)",
      "Says: a Falcon of b = 0.03 N·s/m, dropped from 61 mm under its weight onto a spring of 10 "
      "kN/m that gives way at 20 to 50 Hz, oscillates by about 5 mm and never settles (Fig. 3.1); "
      "with force bounding it dies out quickly (Fig. 3.2; no time is given). Not given: mass, "
      "friction, saturation. Stated: 0.1 kg; S1: neither, S3: 9 N and 0.2 N of dry friction. Five "
      "schedules each; the worst. bench/thesis_experiments has the thesis's own rule and plots.");
  const std::vector<ex::wall_scene> scenes{
      {.name = "S1", .yields = true},
      {.name = "S3", .yields = true, .force_limit = 9.0, .friction = 0.2}};
  const facts falcon{.mass = 0.1, .damping = 0.03, .force_limit = 9.0};
  std::vector<ex::record> rows;
  ex::failures found;
  for (const auto& scene : scenes) {
    double bare_swing = 0.0, bare_energy = 0.0, best_quiet = std::nan(""),
           best_error = std::nan("");
    double best_energy = 0.0, best_swing = 1e9;
    bool bare_rests = true;
    std::string restless;
    std::string best;
    for (const auto& c : contenders()) {
      double swing = 0.0, energy = 0.0, quiet = 0.0, error = 0.0;
      sim::quiet_bar missed{};
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto r = ex::drop(wall_of(c, falcon, scene.stiffness), scene, seed);
        swing = std::max(swing, r.peak_to_peak);
        energy = std::min(energy, r.rubbed_energy);
        error = std::max(error, r.force_error);
        if (!std::isfinite(r.quiet)) missed = r.missed;
        quiet = std::isfinite(quiet) && std::isfinite(r.quiet) ? std::max(quiet, r.quiet)
                                                               : std::nan("");
      }
      rows.push_back({{"scene", scene.name.c_str()},
                      {"controller", c.name},
                      {"swing mm", swing * 1e3},
                      {"quiet s", quiet, "%.2f"},
                      {"misses", sim::to_string(missed)},
                      {"force error N", error, "%.2g"},
                      {"least J", energy, "%.2g"}});
      if (c.to != promise::nothing && !std::isfinite(quiet)) {
        restless += (restless.empty() ? "; not so " : ", ") + std::string(c.name);
      }
      if (c.to == promise::nothing) {
        bare_swing = swing;
        bare_energy = energy;
        bare_rests = std::isfinite(quiet);
      } else if (energy < -accepted_loss) {
        found.push_back(std::string(c.name) + " loses " + ex::format("%.3g J", -energy) + " in " +
                        scene.name);
      } else if (std::isfinite(quiet) && !(error >= best_error)) {
        best = c.name;
        best_quiet = quiet;
        best_swing = swing;
        best_energy = energy;
        best_error = error;
      }
    }
    if (best.empty()) found.push_back("none of ours comes to rest in " + scene.name);
    s.figures.push_back(
        {"McWilliam, " + scene.name, "swings by 5 mm for ever; bounded, dies out quickly",
         ex::format("%.2g mm, ", bare_swing * 1e3) + (bare_rests ? "rests" : "never rests") +
             ex::format(", %.2g J", bare_energy),
         ex::format("%.2g mm, ", best_swing * 1e3) + best, ex::format("%.2f s", best_quiet),
         best_energy >= -accepted_loss ? "0" : ex::format("%.2g", best_energy),
         (bare_rests ? std::string("rests as theirs, which did not bare; ")
                     : std::string("rests where the bare one does not; ")) +
             ex::format("force off by %.2g N", best_error) + restless});
  }
  s.out.show(ex::table_of(rows));
  s.out.member("thesis", ex::json_of(rows));
  return found;
}

}  // namespace papers
