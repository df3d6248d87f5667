// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

#include "../common/pareto.hpp"
#include "../common/work.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace experiments {
namespace {

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

const std::atomic<bool> never = false;  // nothing stops a report but the end of the program

std::string gnuplot_points(const std::string& part, int column, const std::string& value, int style,
                           int colour) {
  return "'error_vs_runtime.csv' using (stringcolumn(1) eq '" + part + "' && stringcolumn(" +
         std::to_string(column) + ") eq '" + value + "' ? column(3) : NaN):4 with points pt " +
         std::to_string(style) + " ps 0.7 lc " + std::to_string(colour) + " title '" + value +
         "', ";
}

std::string front_of(const std::string& part) {
  return "'front_" + part + ".csv' using 1:2 with steps lw 2 lt 8 title 'Pareto front'";
}

}  // namespace

figures::figures(const report& out)
    : csv_(out.path("error_vs_runtime.csv"),
           "part,configuration,ns a tick,error,variant,tick ns p50,tick ns p99.9,tick ns max,"
           "instructions a tick,state bytes") {}

void figures::add(const figure& f) {
  csv_.line(quoted(f.part) + "," + quoted(f.configuration) + "," + json_number(f.ns) + "," +
            json_number(f.error) + "," + quoted(f.variant) + "," + json_number(f.cost.time.median) +
            "," + json_number(f.cost.time.p999) + "," + json_number(f.cost.time.worst) + "," +
            json_number(f.cost.instructions) + "," + std::to_string(f.bytes));
  points_[f.part].emplace_back(f.ns, f.error);
}

void figures::write_front(const report& out, const std::string& part) const {
  const auto& all = points(part);
  csv_file csv(out.path("front_" + part + ".csv"), "ns a tick,error");
  for (const std::size_t i : pareto_front(all)) csv.row(all[i].first, all[i].second);
  csv.close();
}

std::vector<double> instructions_of(const std::string& what, const std::vector<std::string>& names,
                                    const settings& chosen) {
  std::vector<double> counts(names.size(), std::nan(""));
  if (!chosen.counts) return counts;
  const int all = static_cast<int>(names.size());
  progress bar(what + ", instructions", all);
  work_through(
      all, threads_of(0), never,
      [&](int i) {
        return instructions_per_tick(chosen.program, names[static_cast<std::size_t>(i)]);
      },
      [&](int i, double found) {
        counts[static_cast<std::size_t>(i)] = found;
        bar.step();
      });
  return counts;
}

std::vector<measured_cost> measure(const std::string& what, const std::vector<candidate>& all,
                                   const settings& chosen) {
  std::vector<measured_cost> costs;
  std::vector<std::string> names;
  progress bar(what + ", times", static_cast<int>(all.size()));
  for (const auto& c : all) {
    costs.push_back({c.time()});
    names.push_back(c.name);
    bar.step();
  }
  const auto counts = instructions_of(what, names, chosen);
  for (std::size_t i = 0; i < costs.size(); ++i) costs[i].instructions = counts[i];
  return costs;
}

failures report_arithmetic(report& out, const settings& chosen, figures& all) {
  const auto& compositions = arithmetic_compositions();
  const int count = static_cast<int>(compositions.size());
  std::vector<arithmetic_row> rows;
  progress bar("arithmetic", count);
  work_through(
      count, threads_of(0), never,
      [&](int i) { return compositions[static_cast<std::size_t>(i)].compare(chosen.ticks); },
      [&](int, const std::vector<arithmetic_row>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
        bar.step();
      });

  std::vector<candidate> timed;
  for (const auto& c : compositions) timed.insert(timed.end(), c.timed.begin(), c.timed.end());
  const auto measured = measure("arithmetic", timed, chosen);
  std::map<std::string, measured_cost> costs;
  std::map<std::string, std::size_t> bytes;
  for (std::size_t i = 0; i < timed.size(); ++i) {
    costs[timed[i].name] = measured[i];
    bytes[timed[i].name] = timed[i].bytes;
  }

  out.section(
      "Arithmetic",
      "Each scalar against the same composition in 113 bits (Boost cpp_bin_float), fed with "
      "the same motion, written in float so that none has to round it. Errors are the "
      "largest of the run so far as a share of the largest value of the 113-bit run; in "
      "ulp, as a multiple of the scalar's epsilon. Times: blocks of 16 ticks of a replay; "
      "on a busy machine the worst is the machine's. Instructions: callgrind, the loop of "
      "the replay included.");
  std::vector<record> shown;
  failures found;
  for (const auto& r : rows) {
    const std::string name = r.composition + ", " + r.scalar;
    const measured_cost& cost = costs[name];
    shown.push_back({{"configuration", r.composition},
                     {"scalar", r.scalar},
                     {"ticks", static_cast<double>(r.ticks), "%.0e"},
                     {"force", r.error.force, "%.1e"},
                     {"force ulp", r.error.force / r.epsilon, "%.0f"},
                     {"energy", r.error.energy, "%.1e"},
                     {"energy ulp", r.error.energy / r.epsilon, "%.0f"},
                     {"plane", r.error.plane, "%.1e"},
                     {"normal", r.error.normal, "%.1e"},
                     {"ns p50", cost.time.median, "%.1f"},
                     {"p99.9", cost.time.p999, "%.1f"},
                     {"max", cost.time.worst, "%.0f"},
                     {"instructions", cost.instructions, "%.1f"},
                     {"bytes", bytes[name]}});
    if (r.ticks == chosen.ticks) {
      all.add({"arithmetic", r.composition, r.scalar, r.error.force, cost.time.median, cost,
               bytes[name]});
    }
    // Without this the next would judge the motion.
    expect(found, r.same_motion, name + ": was not where the 113 bits were");
    // Rounding alone: a ledger that is never rounded up may give away an epsilon of itself a tick.
    expect(found, r.error.force < (1e4 + static_cast<double>(r.ticks)) * r.epsilon,
           name + format(": force off by %.1e after ", r.error.force) + std::to_string(r.ticks) +
               " ticks, more than rounding can do");
  }
  out.show(table_of(shown, std::identity{}));
  out.member("arithmetic", json_of(shown, std::identity{}));
  all.write_front(out, "arithmetic");
  std::string plot =
      "set logscale xy\nset format '10^{%L}'\nset xlabel 'run time [ns a tick]'\n"
      "set ylabel 'largest force error / largest force'\nplot ";
  int series = 0;
  for (const auto& composition : compositions) {
    ++series;
    plot += gnuplot_points("arithmetic", 2, composition.name, 4 + series, series);
  }
  out.plot("arithmetic",
           {"What rounding costs: error of the force after " +
                format("%.0e", static_cast<double>(chosen.ticks)) + " ticks against run time",
            {definition("Down is more exact, left is faster."),
             {"Two levels are to be seen, float above and double below;",
              [&rows, &chosen] {
                double least_float = 1.0, most_double = 0.0;
                for (const auto& r : rows) {
                  if (r.ticks != chosen.ticks) continue;
                  const bool single = r.scalar.rfind("float", 0) == 0;
                  if (single) least_float = std::min(least_float, r.error.force);
                  if (r.scalar == "double") most_double = std::max(most_double, r.error.force);
                }
                return at_least(most_double > 0.0 ? least_float / most_double : 0.0, 1e3);
              }},
             {"the grey line joins what nothing else beats in both.", "front_arithmetic.csv",
              joins_unbeaten("ns a tick", "error", all.points("arithmetic"))}}},
           plot + front_of("arithmetic"));
  return found;
}

failures report_models(report& out, const settings& chosen, figures& figured) {
  const std::vector<touch_scene> scenes{yielding_wall(), soft_ball(), stroked_organ()};
  const std::vector<double> rates = chosen.quick
                                        ? std::vector<double>{30, 1000}
                                        : std::vector<double>{1, 3, 10, 30, 100, 300, 1000};
  const auto& all = all_compositions();
  std::vector<candidate> timed;
  for (const auto& c : all) timed.push_back(c.cost);
  const auto costs = measure("models", timed, chosen);

  std::vector<record> parts;
  for (std::size_t i = 0; i < all.size(); ++i) {
    parts.push_back({{"configuration", all[i].cost.name},
                     {"tag", ph::to_string(all[i].tag)},
                     {"ns p50", costs[i].time.median, "%.1f"},
                     {"p99.9", costs[i].time.p999, "%.1f"},
                     {"max", costs[i].time.worst, "%.0f"},
                     {"instructions", costs[i].instructions, "%.1f"},
                     {"bytes", all[i].cost.bytes}});
  }
  out.section("What a tick costs",
              "Every composition below, in double, on one recorded motion with an update each 33 "
              "ticks. Instructions include the loop of the replay and the update.");
  out.show(table_of(parts, std::identity{}));
  out.member("ticks", json_of(parts, std::identity{}));

  std::vector<record> models;
  failures found;
  std::map<std::string, double> strongest_of;                    // by scene [N]
  std::map<std::pair<std::string, double>, model_error> errors;  // by scene and name, and rate
  for (const auto& scene : scenes) {
    const felt truth = truth_of(scene);
    const model_error smooth = error_of(scene, truth, truth);
    double strongest = 0.0;
    for (const auto& f : truth.force) strongest = std::max(strongest, f.norm());
    strongest_of[scene.name] = strongest;
    out.section(
        "Model error: " + scene.name,
        "Against the environment solved at 10 kHz and no bound: forces up to " +
            format("%.2f", strongest) + " N, largest step in a millisecond " +
            format("%.3f", smooth.largest_step) + " N; one solution takes " +
            format("%.1f", truth.update_ns / 1e3) +
            " µs. Run time: a tick, and its share of the environment's work. Quiet: from "
            "when the hand holds "
            "still at the end of that, by the bars of docs/design/settling.md for force and steps; "
            "the stiffness told "
            "there, and the one that 1 µm along the force shows.");
    std::vector<record> shown;
    std::map<double, double> times;  // of all compositions, by rate
    std::vector<std::size_t> fitting;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].dof == scene.dof) fitting.push_back(i);
    }
    const int cells = static_cast<int>(fitting.size() * rates.size());
    progress bar(scene.name, cells);
    work_through(
        cells, threads_of(0), never,
        [&](int cell) {
          const auto& c = all[fitting[static_cast<std::size_t>(cell) / rates.size()]];
          return c.touch(scene, rates[static_cast<std::size_t>(cell) % rates.size()]);
        },
        [&](int cell, const felt& run) {
          const std::size_t i = fitting[static_cast<std::size_t>(cell) / rates.size()];
          const double rate = rates[static_cast<std::size_t>(cell) % rates.size()];
          const auto& c = all[i];
          const model_error e = error_of(scene, run, truth);
          const double ns = costs[i].time.median + run.update_ns * rate / 1000.0;
          figured.add({scene.name, c.cost.name, format("%g Hz", rate), e.rms_force, ns, costs[i],
                       c.cost.bytes});
          errors[{scene.name + ": " + c.cost.name, rate}] = e;
          times[rate] += ns;
          shown.push_back({{"configuration", c.cost.name},
                           {"tag", ph::to_string(c.tag)},
                           {"environment Hz", rate, "%g"},
                           {"rms force N", e.rms_force, "%.4f"},
                           {"largest force N", e.largest_force, "%.4f"},
                           {"rms depth mm", e.rms_depth * 1e3, "%.3f"},
                           {"largest step N", e.largest_step, "%.4f"},
                           {"quiet after s", run.quiet, "%.1f"},
                           {"asked N/m", run.asked, "%.0f"},
                           {"shown N/m", run.shown, "%.0f"},
                           {"ns a tick", ns, "%.1f"}});
          expect(found, std::isfinite(e.rms_force),
                 scene.name + ", " + c.cost.name + ", " + format("%g Hz: no number", rate));
          bar.step();
        });
    out.show(table_of(shown, std::identity{}));
    for (record& r : shown) {
      r.insert(r.begin(), {"scene", scene.name});
      models.push_back(std::move(r));
    }
    figured.write_front(out, scene.name);
    std::string plot =
        "set logscale xy\nset xlabel 'run time [ns a tick, environment included]'\nset ylabel "
        "'rms force error [N]'\nplot ";
    int colour = 0;
    for (const double rate : rates) {
      plot += gnuplot_points(scene.name, 5, format("%g Hz", rate), 7, ++colour);
    }
    out.plot(
        "model_" + scene.name,
        {"Model error against run time: " + scene.name,
         {definition("Each point is a composition at one rate of the environment, the colours are "
                     "the rates."),
          {"Faster environments lie to the right, for they are paid for;",
           [&times] {
             return times.size() > 1 ? at_least(times.rbegin()->second / times.begin()->second, 1.0)
                                     : finding(false);
           }},
          {"the grey line joins what nothing else beats in both.", "front_" + scene.name + ".csv",
           joins_unbeaten("ns a tick", "error", figured.points(scene.name))}}},
        plot + front_of(scene.name));
  }
  const auto of = [&errors](const std::string& what, double rate) {
    return errors.at({what, rate});
  };
  const std::string at_once = "ball: plane, turn_at_once, spring, reachable",
                    slowly = "ball: plane, turn_limited, spring, reachable";
  out.section(
      "What to read off the models",
      {{"The strict bound is off by more than half of the largest force on the wall,",
        [&] {
          return at_least(of("wall: wall, spring, strict", 30).rms_force / strongest_of.at("wall"),
                          0.5);
        }},
       definition("for this hand begins with an empty ledger."),
       {"Turning normals slowly costs 0.02 to 0.03 N of error on the ball,",
        [&] {
          return std::ranges::all_of(std::array{30.0, 1000.0}, [&](double rate) {
            const double cost = of(slowly, rate).rms_force - of(at_once, rate).rms_force;
            return cost > 0.015 && cost < 0.035;
          });
        }},
       {"and makes the largest step half at 30 Hz and a seventh at 1 kHz.",
        [&] {
          const auto left = [&](double rate) {
            return of(slowly, rate).largest_step / of(at_once, rate).largest_step;
          };
          return std::abs(left(30) - 0.5) < 0.1 && std::abs(left(1000) - 1.0 / 7.0) < 0.03;
        }},
       {"On the organ a triangle steps by a newton at 30 Hz as at 1 kHz and a plane by less than a "
        "tenth:",
        [&] {
          return std::ranges::all_of(std::array{30.0, 1000.0}, [&](double rate) {
            return of("mesh: triangle, turn_limited, spring, reachable", rate).largest_step > 0.9 &&
                   of("mesh: plane, turn_limited, spring, reachable", rate).largest_step < 0.1;
          });
        }},
       definition("under a dent the closest point lies on an edge, beside every triangle's prism, "
                  "and the contact is lost. Send the tangent plane of a mesh that dents."),
       {"Asked ahead, told how the organ gives way, and lent 0.2 mJ, make_touch errs on it by less "
        "than half as much as the bare spring at 30 Hz, and by less at 1 kHz too.",
        [&] {
          const auto of_bare = [&](double rate) {
            return of("mesh: plane, make_touch, asked ahead, lent", rate).rms_force /
                   of("mesh: plane, turn_at_once, spring, none", rate).rms_force;
          };
          return at_most(std::max(of_bare(30), of_bare(1000) / 2.0), 0.5);
        }},
       {"Told how the wall gives way it errs as much at any rate,",
        [&] {
          const std::string told = "wall: wall, make_touch, asked ahead, lent";
          return between(of(told, 30).rms_force / of(told, 1000).rms_force, 0.99, 1.01);
        }},
       definition("by what its damper takes from the tremor of 8 Hz that this hand has.")});
  out.member("models", json_of(models, std::identity{}));
  return found;
}

}  // namespace experiments
