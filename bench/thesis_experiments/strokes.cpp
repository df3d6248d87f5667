// SPDX-License-Identifier: BSD-3-Clause
#include "strokes.hpp"

#include "../common/median.hpp"
#include "../common/record.hpp"
#include <passive_haptics/environment/tetrahedral_fem.hpp>

#include <cmath>
#include <functional>
#include <tuple>

namespace experiments {

namespace {

/// A comparison with a hand that mostly moves through the air is none.
void must_keep_contact(const stroke_result& reference, const stroke_scene& scene) {
  constexpr int stroked = static_cast<int>(stroke_scene::stroke * 1000.0);
  if (reference.contact_lost <= stroked / 10) return;
  const organ& which = scene.stroked();
  throw unusable_organ(which,
                       "is not felt in " + std::to_string(reference.contact_lost) + " of " +
                           std::to_string(stroked) + " ticks of a stroke 1 to 3 mm deep; " +
                           measured(which),
                       other_unit(which) + ", or an organ of some centimetres");
}

record described(const stroke_result& run, const stroke_result& reference, const std::string& title,
                 const std::string& composition, const char* rate) {
  return {{"run", title},
          {"composition", composition},
          {"environment", rate},
          {"largest force step N", run.force_step, "%.4f"},
          {"contact lost, ticks", run.contact_lost},
          {"rms force error N", rms_error(run, reference), "%.4f"},
          {"min port energy J", run.port_energy},
          {"end port energy J", run.end_energy}};
}

constexpr double plotted_from = 1.3, plotted_to = 2.2;  // [s]
/// The largest step of the force in a tick of what is plotted [N].
double drawn_step(const stroke_result& run) {
  std::vector<double> forces;
  for (const auto& row : run.rows) {
    if (std::get<0>(row) < plotted_from || std::get<0>(row) > plotted_to) continue;
    forces.push_back(std::get<7>(row));
  }
  return largest_step(forces);
}

void write_rows(const std::filesystem::path& path, const stroke_result& run) {
  csv_file csv(path, "time s,x m,y m,z m,fx N,fy N,fz N,force N,depth m,E1 J,port energy J");
  for (const auto& row : run.rows) {
    std::apply([&csv](auto... numbers) { csv.row(numbers...); }, row);
  }
  csv.close();
}

}  // namespace

strokes stroke(const stroke_scene& scene) {
  progress bar("mesh", 5);
  const auto follow = [&](auto run, double period) {
    stroke_result result = run(scene, period);
    bar.step();
    return result;
  };
  strokes runs;
  try {
    runs.reference = follow(bare_stroke, 1e-3);
  } catch (const env::singular_stiffness&) {
    throw unusable_organ(
        scene.stroked(),
        "is not held together: parts that share a node or an edge only turn about it",
        "mesh the volume again, its parts joined by whole faces");
  }
  must_keep_contact(runs.reference, scene);
  runs.bare = follow(bare_stroke, 1.0 / 30.0);
  runs.passive = follow(passive_stroke, 1.0 / 30.0);
  runs.touch = follow(touched_stroke, 1.0 / 30.0);
  runs.lent = follow(lent_stroke, 1.0 / 30.0);
  return runs;
}

double rms_error(const stroke_result& run, const stroke_result& reference) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = 0; n < run.forces.size(); ++n) {
    if (!stroke_scene::stroking(1e-3 * static_cast<double>(n + 1))) continue;
    sum += (run.forces[n] - reference.forces[n]).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

void show_strokes(report& out, const stroke_scene& scene, const strokes& runs) {
  write_rows(out.path("mesh_reference.csv"), runs.reference);
  write_rows(out.path("mesh_bare.csv"), runs.bare);
  write_rows(out.path("mesh_passive.csv"), runs.passive);
  write_rows(out.path("mesh_touch.csv"), runs.touch);
  write_rows(out.path("mesh_lent.csv"), runs.lent);
  const std::vector<record> rows{
      described(runs.reference, runs.reference, "reference", "turn_at_once, no bound", "1 kHz"),
      described(runs.bare, runs.reference, "bare", "turn_at_once, no bound", "30 Hz"),
      described(runs.passive, runs.reference, "passive",
                "turn_limited, force-rate limit, reachable bound", "30 Hz"),
      described(runs.touch, runs.reference, "make_touch", "make_touch", "30 Hz"),
      described(runs.lent, runs.reference, "... lent",
                "make_touch, asked ahead, yielding, loan 0.2 mJ", "30 Hz")};
  const organ& which = scene.stroked();
  const double update_ms = median(runs.passive.update_ms);
  const std::string nodes = std::to_string(scene.mesh().nodes.size()) + " nodes, " +
                            std::to_string(scene.mesh().tetrahedra.size()) + " tetrahedra, " +
                            size_of(which);
  // Of our organ it must hold; on any mesh it need not, as a path is no hand of limited force.
  const bool kept = which.file == "an organ" || runs.lent.port_energy >= -loan;
  const std::string lends =
      kept ? ", E ≥ −0.2 mJ"
           : ", below which E falls on this mesh, as a path is no hand of limited force";
  out.section(
      "Mesh: " + which.file,
      {definition(nodes + ", " + format("%g", flesh.young / 1e3) +
                  " kPa. A stroke 1-3 mm below the surface, haptic tick 1 kHz. reference and bare: "
                  "turn_at_once, no bound. passive, the thesis's: turn_limited, force-rate limit, "
                  "reachable bound. make_touch: the recommended one."),
       {"lent: the same, told the surface as it yields where the finger will be, and lent "
        "0.2 mJ" +
            std::string(runs.reference.port_energy < 0.0
                            ? " because the reference itself gives out energy"
                            : "") +
            lends + ".",
        "mesh_lent.csv",
        [kept](const recorded& r) { return kept == (least(r["port energy J"]) >= -loan); }},
       definition(
           "Contact lost: ticks of the stroke without force. Median environment update " +
           format("%.3f", update_ms) +
           " ms (wall clock of this machine). Quiet is not judged here, because the hand is a path "
           "that never rests and leaves at the end; organ --only chain judges an organ at rest.")});
  std::cout << which.file << ": " << nodes << '\n';
  for (const auto& note : which.notes) std::cout << "  " << note << '\n';
  std::cout << '\n';
  out.show(table_of(rows, [](const record& r) {
    return record{r[0], r[2], r[3], r[4].renamed("contact lost"), r[5], r[6]};
  }));
  std::cout << "median environment update " << format("%.3f", update_ms) << " ms\n\n";
  out.member("mesh", json_of(record{{"file", which.file},
                                    {"nodes", scene.mesh().nodes.size()},
                                    {"tetrahedra", scene.mesh().tetrahedra.size()},
                                    {"unit m", which.unit},
                                    {"size", size_of(which)},
                                    {"median update ms", update_ms}}));
  out.member("notes", json_of(which.notes));
  out.member("strokes", json_of(rows));
  // Whatever mesh it is: what is drawn is said in figures, and the file must have them.
  const double bare_step = drawn_step(runs.bare), passive_step = drawn_step(runs.passive);
  const auto of_bare = [&runs](const stroke_result& run) {
    return rms_error(run, runs.reference) / rms_error(runs.bare, runs.reference);
  };
  const double farther = of_bare(runs.passive), lent = of_bare(runs.lent);
  const auto as_said = [](double step) {
    return [step](const recorded& r) {
      return between(largest_step(r.within("force N", plotted_from, plotted_to)), step - 1e-6,
                     step + 1e-6);
    };
  };
  // How far a file is off the reference, over the stroke [N].
  const auto off = [&out](const char* file) {
    const recorded run(out.path(file)), reference(out.path("mesh_reference.csv"));
    std::vector<double> is, ought;
    for (const char* along : {"fx N", "fy N", "fz N"}) {
      for (std::size_t i = 0; i < run[along].size(); ++i) {
        if (!stroke_scene::stroking(run["time s"][i])) continue;
        is.push_back(run[along][i]);
        ought.push_back(reference[along][i]);
      }
    }
    return rms_between(is, ought);
  };
  out.plot(
      "mesh_force",
      {"The force along the stroke, its second half enlarged",
       {{"At 30 Hz the bare mesh goes its way in steps of up to " + format("%.3f", bare_step) +
             " N,",
         "mesh_bare.csv", as_said(bare_step)},
        {"the passive model in steps of up to " + format("%.3f N", passive_step) + " a tick,",
         "mesh_passive.csv", as_said(passive_step)},
        {"and over the whole stroke it is " + format("%.2f", farther) + " times as far off,",
         [=] {
           return between(off("mesh_passive.csv") / off("mesh_bare.csv"), farther - 0.005,
                          farther + 0.005);
         }},
        {"make_touch, lent 0.2 mJ and told how the mesh yields where the finger will be, " +
             format("%.2f", lent) + " times.",
         [=] {
           return between(off("mesh_lent.csv") / off("mesh_bare.csv"), lent - 0.005, lent + 0.005);
         }},
        definition("Steps over 0.02 N are felt as a grating.")},
       {"mesh_reference.csv", "force N", "what a surface that is solved in every tick feels like"}},
      "set xlabel 'time [s]'\nset ylabel 'force [N]'\nset xrange [1.3:2.2]\nset yrange [0:*]\nplot "
      "'mesh_bare.csv' using 1:8 with lines lt 2 lw 1.2 title 'bare, 30 Hz', "
      "'mesh_passive.csv' using 1:8 with lines lt 1 title 'passive, 30 Hz', "
      "'mesh_lent.csv' using 1:8 with lines lt 3 title 'make_touch, lent, 30 Hz'");
}

}  // namespace experiments
