// SPDX-License-Identifier: BSD-3-Clause
#include "wall.hpp"

#include "../common/record.hpp"

namespace experiments {

std::vector<wall_controller> wall_controllers() {
  const auto with = [](std::string name, auto make) {
    return wall_controller{std::move(name),
                           [make](const wall_scene& scene, std::uint64_t seed, csv_file* csv) {
                             return drop(make(scene), scene, seed, csv);
                           }};
  };
  const ph::spring spring;
  const ph::reduced_energy ledger{.damping = 0.03};
  const ph::shaped thesis{spring, ph::thesis_rule{}};
  return {
      with("none",
           [=](const auto&) { return wall_model(spring, ph::no_observer{}, ph::no_bound{}); }),
      with("strict", [=](const auto&) { return wall_model(spring, ledger, ph::strict_bound{}); }),
      with("thesis", [=](const auto&) { return wall_model(thesis, ledger, ph::no_bound{}); }),
      with("reachable",
           [=](const auto& scene) {
             return wall_model(spring, ledger,
                               ph::reachable_bound{.mass = scene.mass, .hand_force = 5.0});
           }),
      with("damped spring + reachable",
           [](const auto& scene) { return settling_model(scene.mass); }),
  };
}

namespace {

std::string file_name(std::string text) {
  std::replace(text.begin(), text.end(), ' ', '_');
  text.erase(std::remove(text.begin(), text.end(), '+'), text.end());
  return text;
}

}  // namespace

void run_wall(report& out, int seeds) {
  const std::vector<wall_scene> scenes{{.name = "S0"},
                                       {.name = "S1", .yields = true},
                                       {.name = "S2", .force_limit = 9.0, .friction = 0.2}};
  const auto controllers = wall_controllers();
  progress bar("wall", static_cast<int>(controllers.size()) * (2 + seeds));
  std::vector<record> rows;
  for (const auto& scene : scenes) {
    for (const auto& controller : controllers) {
      const int runs = scene.yields ? seeds : 1;
      wall_result mean;
      int settled = 0;
      double worst = 0.0;
      for (int seed = 1; seed <= runs; ++seed) {
        csv_file csv(out.path("wall_" + scene.name + "_" + file_name(controller.name) + "_" +
                              std::to_string(seed) + ".csv"),
                     "time s,device m,local surface m,environment surface m,force N,E1 J,"
                     "port energy J");
        const wall_result r = controller.run(scene, static_cast<std::uint64_t>(seed), &csv);
        csv.close();
        mean.peak_to_peak += r.peak_to_peak / runs;
        mean.force_error += r.force_error / runs;
        mean.rest += r.rest / runs;
        mean.port_energy = std::min(mean.port_energy, r.port_energy);
        if (std::isfinite(r.settle)) {
          ++settled;
          worst = std::max(worst, r.settle);
        }
        bar.step();
      }
      const double settle = settled == runs ? worst : std::nan("");
      rows.push_back({{"scene", scene.name},
                      {"controller", controller.name},
                      {"runs", runs},
                      {"peak to peak mm", mean.peak_to_peak * 1e3, "%.3f"},
                      {"settled", std::to_string(settled) + " of " + std::to_string(runs)},
                      {"settle s (worst)", settle, "%.3f"},
                      {"min port energy J", mean.port_energy},
                      {"mean force error N", mean.force_error},
                      {"rest mm", mean.rest * 1e3, "%.3f"}});
    }
  }
  out.section("Wall (thesis section 3.2)",
              "A device of 0.1 kg and 0.03 N·s/m falls 61 mm onto a wall of 10 kN/m. S0: ideal "
              "device, static wall. S1: the wall gives way, surface = F/K, at 20-50 Hz. S2: 9 N "
              "saturation and 0.2 N dry friction. Swing: peak to peak after 2 s. Settle time and "
              "energy are "
              "the worst of the runs, swing and force error their mean. The port energy is the "
              "simulator's own, never the observer's.");
  out.show(table_of(rows, [](const record& r) {
    return record{r[0],
                  r[1],
                  r[3].renamed("swing mm"),
                  r[4],
                  r[5].renamed("settle s"),
                  r[6],
                  r[7].renamed("force error N")};
  }));
  out.member("wall", json_of(rows));
  const auto figure = [&out](const std::string& name, const caption& said, const std::string& run,
                             const std::string& times, const std::string& positions) {
    const std::string data = "'wall_" + run + "_1.csv' using 1:";
    out.plot(name, said,
             "set xlabel 'time [s]'\nset ylabel 'position [mm]'\nset xrange " + times +
                 "\nset yrange " + positions + "\nplot " + data +
                 "($3*1e3) with lines lt 1 lw 4 title 'local model', " + data +
                 "($4*1e3) with lines lt -1 title 'environment', " + data +
                 "($2*1e3) with lines lt 2 dt 2 title 'device'");
  };
  figure("fig_3_1",
         {"As Fig. 3.1: no bound, the wall gives way (S1)",
          "Above 0 is inside the wall. Each time the device comes out of it, it flies as far as "
          "before, for ever, although it is left alone: the wall pays for what damping takes."},
         "S1_none", "[0:2]", "[*:*]");
  figure("fig_3_1_S2",
         {"The same on a device of 9 N and 0.2 N of dry friction (S2)",
          "Friction takes the large bounces, but not the last millimetres: the device goes on in "
          "and out of the wall, and a hand feels that as a buzz."},
         "S2_none", "[0:2]", "[*:*]");
  figure("fig_3_2",
         {"As Fig. 3.2: the thesis's bound, the wall gives way (S1)",
          "The bounces are cut down at once. A tremble of a millimetre or two stays, for this "
          "device has no friction, and the bound forbids gain without damping."},
         "S1_thesis", "[0:2]", "[-10:6]");
  figure("fig_3_2_S2",
         {"The same on the device of S2",
          "With a little dry friction, as every real device has, it settles in a third of a "
          "second: all three curves end as one level line."},
         "S2_thesis", "[0:1]", "[-10:8]");
  figure("fig_3_3",
         {"As Fig. 3.3: between two updates, enlarged (S1)",
          "The thin steps are all that the environment says. Where the force that it asks for "
          "would be too much, the bound moves the surface of the local model, which then goes "
          "back with the device."},
         "S1_thesis", "[0.1:0.3]", "[-9:5]");
  const auto energy = [](const std::string& run, const std::string& style,
                         const std::string& title) {
    return "'wall_S0_" + run + "_1.csv' every 10 using 1:7 with lines " + style + " title '" +
           title + "'";
  };
  out.plot("port_energy",
           {"What the hand has paid in, less what it got back (S0)",
            "Below zero a wall has given more than it ever got: without a bound it goes there at "
            "once, and further at each bounce. The strict bound gives all back and no more, so "
            "the device bounces on. With the damped spring what is paid in stays, and the device "
            "is at rest."},
           "set xlabel 'time [s]'\nset ylabel 'energy at the port [J]'\nset xrange [0:3]\n"
           "set xzeroaxis lt -1 lw 1\nplot " +
               energy("none", "lt 2", "no bound: the wall feeds the hand") + ", " +
               energy("strict", "lt 3", "strict bound") + ", " +
               energy("damped_spring__reachable", "lt 1", "damped spring + reachable bound"));
  figure("fig_settled",
         {"Passive and settled: damped spring + reachable bound (S1)",
          "A few touches, and the device rests on the wall within half a second; after that no "
          "curve can be told from another."},
         "S1_damped_spring__reachable", "[0:1]", "[-26:6]");
}

}  // namespace experiments
