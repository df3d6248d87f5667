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
  const std::vector<wall_scene> scenes{
      {.name = "S0"},
      {.name = "S1", .yields = true},
      {.name = "S2", .force_limit = 9.0, .friction = 0.2},
      {.name = "S3", .yields = true, .force_limit = 9.0, .friction = 0.2}};
  const auto controllers = wall_controllers();
  progress bar("wall", static_cast<int>(controllers.size()) * 2 * (1 + seeds));
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
        mean.still.add(r.still);
        if (std::isfinite(r.settle)) {
          ++settled;
          worst = std::max(worst, r.settle);
        }
        bar.step();
      }
      const double settle = settled == runs ? worst : std::nan("");
      rows.push_back(with({{"scene", scene.name},
                           {"controller", controller.name},
                           {"runs", runs},
                           {"peak to peak mm", mean.peak_to_peak * 1e3, "%.3f"},
                           {"settled", std::to_string(settled) + " of " + std::to_string(runs)},
                           {"settle s (worst)", settle, "%.3f"},
                           {"min port energy J", mean.port_energy},
                           {"mean force error N", mean.force_error},
                           {"rest mm", mean.rest * 1e3, "%.3f"}},
                          mean.still));
    }
  }
  const auto moves = [](const recorded& r) {
    return at_least(swing(r["environment surface m"]), 1e-4);
  };
  const auto stands = [](const recorded& r) { return swing(r["environment surface m"]) == 0.0; };
  const auto limited = [](const recorded& r) {
    return between(std::max(most(r["force N"]), -least(r["force N"])), 9.0, 9.0);
  };
  out.section(
      "Wall (thesis section 3.2)",
      {{"A device of 0.1 kg and 0.03 N·s/m falls 61 mm onto a wall of 10 kN/m.",
        "wall_S0_none_1.csv",
        [](const recorded& r) { return between(-1e3 * r["device m"].front(), 60.9, 61.1); }},
       {"S0: ideal device, static wall.", "wall_S0_none_1.csv", stands},
       {"S1: the wall gives way, surface = F/K, at 20-50 Hz.", "wall_S1_thesis_1.csv", moves},
       {"S2: 9 N saturation and 0.2 N dry friction.", "wall_S2_none_1.csv", limited},
       {"S3, as in the thesis: both at once.", "wall_S3_thesis_1.csv",
        [=](const recorded& r) { return limited(r).so && moves(r).so; }},
       definition(
           "Swing: peak to peak after 2 s. Settle time and energy are the worst of the runs, "
           "swing and force error their mean. The port energy is the simulator's own, never "
           "the observer's." +
           std::string(quiet_columns))});
  out.show(table_of(rows, [](const record& r) {
    record some{r[0],
                r[1],
                r[3].renamed("swing mm"),
                r[4],
                r[5].renamed("settle s"),
                r[6],
                r[7].renamed("force error N")};
    some.insert(some.end(), r.begin() + 9, r.end());  // on quiet
    return some;
  }));
  out.member("wall", json_of(rows));
  const auto figure = [&out](const std::string& name, const std::string& run,
                             const std::string& times, const std::string& positions,
                             const caption& said) {
    const std::string data = "'wall_" + run + "_1.csv' using 1:";
    out.plot(name, said,
             "set xlabel 'time [s]'\nset ylabel 'position [mm]'\nset xrange " + times +
                 "\nset yrange " + positions + "\nplot " + data +
                 "($3*1e3) with lines lt 1 lw 4 title 'local model', " + data +
                 "($4*1e3) with lines lt -1 title 'environment', " + data +
                 "($2*1e3) with lines lt 2 dt 2 title 'device'");
  };
  const std::string device = "device m", local = "local surface m", world = "environment surface m",
                    paid = "port energy J";
  const auto file = [](const std::string& run) { return "wall_" + run + "_1.csv"; };
  // A claim about a swing of the device [mm].
  const auto swings = [&](double from, double to, double from_mm, double to_mm) {
    return [=](const recorded& r) {
      return between(1e3 * swing(r.within(device, from, to)), from_mm, to_mm);
    };
  };
  // How often it comes into the wall.
  const auto touches = [=](const recorded& r, double from, double to) {
    const auto x = r.within(device, from, to);
    int count = 0;
    for (std::size_t i = 1; i < x.size(); ++i) count += x[i - 1] <= 0.0 && x[i] > 0.0 ? 1 : 0;
    return count;
  };
  // The most and the least of all three curves differ by so much [mm].
  const auto apart = [=](const recorded& r, double from, double to) {
    const auto x = r.within(device, from, to), own = r.within(local, from, to),
               told = r.within(world, from, to);
    return 1e3 * (std::max({most(x), most(own), most(told)}) -
                  std::min({least(x), least(own), least(told)}));
  };
  const auto cut_down = [=](const recorded& r) {
    return at_least(1e3 * least(r.within(device, 0.12, 2.0)), -10.0);
  };
  const auto from_10_mm = definition("What falls from 61 mm comes into the picture at 10 mm.");
  const std::string bare_3 = file("S3_none"), bare_1 = file("S1_none"), bare_2 = file("S2_none"),
                    thesis_3 = file("S3_thesis"), thesis_1 = file("S1_thesis"),
                    thesis_2 = file("S2_thesis");
  figure("fig_3_1", "S3_none", "[0:2]", "[*:*]",
         {"As Fig. 3.1: no bound, the wall gives way, 9 N and 0.2 N of friction (S3)",
          {definition("Above 0 is inside the wall."),
           {"The device bounces for a second,", bare_3, swings(0.8, 1.0, 5.0, 60.0)},
           {"and the wall moves where an update falls into a contact,", bare_3,
            [=](const recorded& r) {
              const auto x = r.within(device, 0.0, 1.0), told = r.within(world, 0.0, 1.0);
              for (std::size_t i = 1; i < x.size(); ++i) {
                if (told[i] > told[i - 1] && std::max(x[i], x[i - 1]) <= 0.0) return false;
              }
              return swing(told) > 1e-4;
            }},
           {"until friction holds the device where that has left it.", bare_3,
            swings(1.3, 2.0, 0.0, 0.05)},
           definition("In the thesis it goes on for ever, by 5 mm: something of that device is not "
                      "in ours.")}});
  figure("fig_3_1_S1", "S1_none", "[0:2]", "[*:*]",
         {"The same on an ideal device (S1)",
          {{"Without friction and limit every bounce ends at the stop 61 mm away from the wall:",
            bare_1,
            [=](const recorded& r) {  // in each time that three bounces take, it is there
              double nearest = -1.0;
              for (double from = 0.0; from < 2.0; from += 0.5) {
                nearest = std::max(nearest, least(r.within(device, from, from + 0.5)));
              }
              return at_most(1e3 * nearest, -60.9);
            }},
           {"the wall pays for what the damping takes.", bare_1,
            [=](const recorded& r) { return at_most(r.within(paid, 0.0, 2.0).back(), -0.1); }},
           {"A contact lasts for milliseconds,", bare_1,
            [=](const recorded& r) {
              int longest = 0, now = 0;  // rows, of a millisecond each
              for (const double x : r.within(device, 0.0, 2.0)) {
                now = x > 0.0 ? now + 1 : 0;
                longest = std::max(longest, now);
              }
              return between(longest, 2, 15);
            }},
           {"so in these two seconds no update finds one, and the wall never moves.", bare_1,
            [=](const recorded& r) { return swing(r.within(world, 0.0, 2.0)) == 0.0; }}}});
  figure("fig_3_1_S2", "S2_none", "[0:2]", "[*:*]",
         {"The same before a wall that stands still (S2)",
          {{"Friction takes the large bounces,", bare_2, swings(1.8, 2.0, 0.0, 20.0)},
           {"but not the last millimetres: about ten times a second the device goes on in and out "
            "of the wall.",
            bare_2, [=](const recorded& r) { return between(touches(r, 1.0, 2.0), 8, 12); }}}});
  figure("fig_3_2", "S3_thesis", "[0:2]", "[-10:8]",
         {"As Fig. 3.2: the thesis's bound (S3)",
          {from_10_mm,
           {"The bounces are cut down at once,", thesis_3, cut_down},
           {"and as in the thesis they die out: within half a second the device rests on the wall.",
            thesis_3, [=](const recorded& r) {
              return between(1e3 * swing(r.within(device, 0.5, 2.0)), 0.0,
                             most(r.within(device, 1.9, 2.0)) > 0.0 ? 0.5 : 0.0);
            }}}});
  figure("fig_3_2_S1", "S1_thesis", "[0:2]", "[-10:6]",
         {"The same on an ideal device (S1)",
          {from_10_mm,
           {"The bounces are cut down at once.", thesis_1, cut_down},
           {"A tremble of one to three millimetres stays,", thesis_1, swings(1.0, 2.0, 1.0, 3.0)},
           definition("for this device has no friction, and the bound forbids gain without "
                      "damping.")}});
  figure("fig_3_2_S2", "S2_thesis", "[0:1]", "[-10:8]",
         {"The same before a wall that stands still (S2)",
          {from_10_mm,
           {"It settles within half a second:", thesis_2, swings(0.5, 1.0, 0.0, 0.5)},
           {"all three curves end as one level line.", thesis_2,
            [=](const recorded& r) { return at_most(apart(r, 0.9, 1.0), 0.2); }}}});
  figure("fig_3_3", "S3_thesis", "[0.1:0.3]", "[-9:8]",
         {"As Fig. 3.3: between two updates, enlarged (S3)",
          {definition("The thin line is all that the environment says."),
           {"Where the force that it asks for would be too much, the bound moves the surface of "
            "the local model away from it,",
            thesis_3,
            [=](const recorded& r) {
              const auto own = r.within(local, 0.1, 0.3), told = r.within(world, 0.1, 0.3);
              double away = 0.0;
              for (std::size_t i = 0; i < own.size(); ++i) away = std::max(away, own[i] - told[i]);
              return at_least(1e3 * away, 1.0);
            }},
           {"and lets it go back with the device.", thesis_3, [=](const recorded& r) {
              const auto x = r.within(device, 0.1, 0.3), own = r.within(local, 0.1, 0.3),
                         told = r.within(world, 0.1, 0.3);
              double away = 0.0;  // where the device has left
              for (std::size_t i = 0; i < own.size(); ++i) {
                if (x[i] < told[i] - 1e-3) away = std::max(away, std::abs(own[i] - told[i]));
              }
              return at_most(1e3 * away, 0.1);
            }}}});
  const auto energy = [](const std::string& run, const std::string& style,
                         const std::string& title) {
    return "'wall_S0_" + run + "_1.csv' every 10 using 1:7 with lines " + style + " title '" +
           title + "'";
  };
  const std::string damped = file("S0_damped_spring__reachable");
  out.plot("port_energy",
           {"What the hand has paid in, less what it got back (S0)",
            {definition("Below zero a wall has given more than it ever got:"),
             {"without a bound it goes there at once,", file("S0_none"),
              [=](const recorded& r) { return least(r.within(paid, 0.0, 0.2)) < 0.0; }},
             {"and further at each bounce.", file("S0_none"),
              [=](const recorded& r) {
                double before = 0.0;
                for (double from = 0.1; from < 3.0; from += 0.2) {  // a bounce takes 0.18 s
                  const double now = least(r.within(paid, from, from + 0.2));
                  if (now >= before) return false;
                  before = now;
                }
                return true;
              }},
             {"The strict bound gives nearly all back", file("S0_strict"),
              [=](const recorded& r) {
                const auto late = r.within(paid, 2.0, 3.0);
                return at_most(least(late) / most(late), 0.15);
              }},
             {"and no more,", file("S0_strict"),
              [=](const recorded& r) { return at_least(least(r.within(paid, 0.0, 3.0)), -1e-12); }},
             {"so the device bounces on.", file("S0_strict"), swings(2.0, 3.0, 50.0, 130.0)},
             {"With the damped spring what is paid in stays,", damped,
              [=](const recorded& r) {
                const auto kept = r.within(paid, 1.0, 3.0);
                return least(kept) > 0.0 && swing(kept) < 1e-3 * least(kept);
              }},
             {"and the device is at rest.", damped, swings(1.0, 3.0, 0.0, 0.01)}}},
           "set xlabel 'time [s]'\nset ylabel 'energy at the port [J]'\nset xrange [0:3]\n"
           "set xzeroaxis lt -1 lw 1\nplot " +
               energy("none", "lt 2", "no bound: the wall feeds the hand") + ", " +
               energy("strict", "lt 3", "strict bound") + ", " +
               energy("damped_spring__reachable", "lt 1", "damped spring + reachable bound"));
  const std::string settled = "S1_damped_spring__reachable";
  figure("fig_settled", settled, "[0:1]", "[-26:6]",
         {"Damped spring + reachable bound (S1)",
          {definition("What falls from 61 mm comes into the picture at 26 mm."),
           {"A few touches,", file(settled),
            [=](const recorded& r) { return between(touches(r, 0.0, 1.0), 2, 6); }},
           {"and the device rests on the wall within half a second;", file(settled),
            swings(0.5, 1.0, 0.0, 0.5)},
           {"after that no curve can be told from another.", file(settled),
            [=](const recorded& r) {  // of 32 mm on 430 pixels
              return at_most(apart(r, 0.6, 1.0), 0.2);
            }}}});
}

}  // namespace experiments
