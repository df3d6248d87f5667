// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include "synthetic.hpp"
#include <passive_haptics/identification/device_file.hpp>
#include <passive_haptics/identification/replay.hpp>

namespace replaying {

namespace {

using identification::estimate;

ex::option a_real(const std::string& name, const std::string& unit, const std::string& help,
                  double& where) {
  return {name + " " + unit, help, [&where, name](const std::string& text) {
            const auto value = ph::to_decimal(text);
            if (!value || !ph::kernels::is_finite(*value))
              ex::complain(name + " " + text + ": give a number");
            where = *value;
          }};
}

/// A number of the axis, as a row.
struct found_row {
  std::string what;
  estimate is{};
  std::string unit;
};
ex::record record_of(const found_row& r) {
  return {{"number", r.what},
          {"value", r.is.value, "%.4g"},
          {"deviation", r.is.deviation, "%.2g"},
          {"unit", r.unit}};
}

/// What a ledger was told, and what the recording says to it.
struct trial {
  std::string told;
  ph::encoder_device device{};
  identification::replayed said{};
};
ex::record record_of(const trial& t) {
  return {{"told", t.told},
          {"b", t.device.damping, "%.4g"},
          {"c", t.device.friction, "%.4g"},
          {"p µm", 1e6 * t.device.presliding, "%.3g"},
          {"q µm", 1e6 * t.device.quantum, "%.3g"},
          {"overstated J", std::max(t.said.overstated, 0.0)},
          {"in row", static_cast<std::uint64_t>(t.said.refuted() ? t.said.row : 0)},
          {"credited %", 100.0 * t.said.share(), "%.0f"},
          {"refuted", t.said.refuted()}};
}

ph::encoder_device scaled(ph::encoder_device d, double by) {
  d.damping *= by;
  d.friction *= by;
  return d;
}

/// The description that was told: empty, or a sentence why it cannot be used.
std::string load_told(const std::string& path, ph::encoder_device& told) {
  const auto loaded = identification::load_device(path);
  if (!loaded.fault.empty()) return loaded.fault;
  const auto* encoder = std::get_if<ph::encoder_device>(&loaded.of.device);
  if (encoder == nullptr)
    return path + ": an \"encoder\" is wanted, of which quantum and friction are stated";
  told = *encoder;
  return {};
}

void show_samples(ex::report& report, const identification::recording_statistics& s, bool rotary) {
  const std::string place = rotary ? "µrad" : "µm";
  const ex::record row{{"rows", static_cast<std::uint64_t>(s.rows)},
                       {"tick ms", 1e3 * s.tick, "%.4g"},
                       {"jitter %", 100.0 * s.jitter, "%.3g"},
                       {"longest ms", 1e3 * s.longest, "%.4g"},
                       {"gaps", static_cast<std::uint64_t>(s.gaps)},
                       {"repeated %", 100.0 * s.repeated, "%.2g"},
                       {"step " + place, 1e6 * s.quantum},
                       {"noise " + place, 1e6 * s.noise},
                       {"top speed", s.top_speed},
                       {"top force", s.top_force}};
  report.section(
      "Samples",
      "The median tick, and how far nine of ten ticks are from it; the share of rows under way "
      "whose position "
      "repeats the one before; the step of the encoder, or the noise where there is none.");
  ex::show_rows(report, "samples", std::vector<ex::record>{row});
}

void show_axis(ex::report& report, const identification::recorded_device& found, bool rotary) {
  const auto& m = found.motion;
  const std::string kg = rotary ? "kg·m²" : "kg", b = rotary ? "N·m·s" : "N·s/m",
                    n = rotary ? "N·m" : "N";
  report.section(
      "The axis",
      "By the regression of its motion; deviations by the jackknife over twelve stretches of "
      "time. The force explains " +
          ex::format("%.3f %%", 100.0 * m.explained) + " of the changes of velocity.");
  ex::show_rows(
      report, "axis",
      std::vector<found_row>{{"mass", m.mass, kg},
                             {"damping, forward", m.damping[0], b},
                             {"damping, backward", m.damping[1], b},
                             {"dry friction in motion", m.friction, n},
                             {"constant load", m.load, n},
                             {"presliding",
                              {1e6 * found.presliding.value, 1e6 * found.presliding.deviation},
                              rotary ? "µrad" : "µm"},
                             {"latency", m.exactly, "ticks"}});
}

void plot(ex::report& report, const identification::recording& r,
          const std::vector<std::array<double, 2>>& trace) {
  const std::size_t every = std::max<std::size_t>(1, r.size() / 2000);
  ex::csv_file rows(report.path("recording.csv"), "time s,position,force");
  for (std::size_t i = 0; i < r.size(); i += every) rows.row(r.time[i], r.position[i], r.force[i]);
  rows.close();
  double reach = 0.0;  // of the axis of the force, to both sides
  for (const double f : r.force) reach = std::max(reach, 1.05 * std::abs(f));
  ex::csv_file ledger(report.path("ledger.csv"), "row,ledger J,at most J");
  for (std::size_t i = 0; i < trace.size(); i += every) {
    ledger.row(static_cast<double>(i), trace[i][0], trace[i][1]);
  }
  ledger.close();
  report.plot("recording",
              {"The recording",
               {{"The axis moves;", "recording.csv",
                 [](const ex::recorded& f) { return ex::swing(f["position"]) > 0.0; }},
                ex::definition("its position on the left, the motor's force on the right."),
                ex::no_truth("the force is the one that was recorded, and no wall asks for "
                             "another.")}},
              "set ytics nomirror\nset y2tics\nset xlabel 'time [s]'\nset ylabel 'position [" +
                  std::string(r.rotary ? "rad" : "m") + "]'\nset y2label '" +
                  (r.rotary ? "torque [N·m]" : "force [N]") + "'\nset y2range [" +
                  ex::format("%g:", -reach) + ex::format("%g]\n", reach) +
                  "plot 'recording.csv' using 1:2 with lines, '' using 1:3 axes x1y2 with lines");
  report.plot("ledger",
              {"What the ledger says and what can be",
               {ex::definition("The ledger told what may be stated, through the second half."),
                {"It stays below what can be;", "ledger.csv",
                 [](const ex::recorded& f) {
                   const auto &says = f["ledger J"], &may = f["at most J"];
                   for (std::size_t i = 0; i < says.size(); ++i) {
                     if (says[i] > may[i]) return false;
                   }
                   return true;
                 }},
                ex::definition("far below it, the device moves or is told less than it takes.")}},
              "set xlabel 'row'\nset ylabel 'J'\nplot 'ledger.csv' using 1:2 with lines, '' using "
              "1:3 with lines");
}

int replay_all(const settings& chosen, const std::atomic<bool>& stop) {
  if (!chosen.read.empty() && !std::filesystem::exists(chosen.read)) {
    std::cout << "replay: skipped, there is no " << chosen.read << '\n';
    return 0;
  }
  identification::loaded_recording loaded;
  if (chosen.read.empty()) {
    loaded.rows = recorded({});
  } else {
    loaded = identification::load_recording(chosen.read, chosen.columns);
  }
  const auto refuse = [&](const std::string& why) {
    std::cerr << "replay: " << why << '\n';
    return 1;
  };
  if (!loaded.fault.empty()) return refuse(loaded.fault);
  const auto& all = loaded.rows;
  const std::string name = chosen.read.empty() ? "a simulated drive" : chosen.read;
  const auto samples = identification::statistics_of(all);
  if (const auto doubt = identification::doubt_of(all, samples); !doubt.empty())
    return refuse(name + ": " + doubt);
  const auto found = identification::identified(all, samples);
  if (!found.problem.empty()) return refuse(name + ": " + found.problem);
  if (stop) throw ex::interrupted("stopped: nothing was written");

  ph::encoder_device told{};
  if (!chosen.told.empty()) {
    if (const auto fault = load_told(chosen.told, told); !fault.empty()) return refuse(fault);
    if (const auto fault = identification::fault_of_told(told, found); !fault.empty()) {
      return refuse(chosen.told + ": " + fault);
    }
  }
  ex::report report(chosen.out, {.json = "replay.json", .markdown = "replay.md"});
  show_samples(report, samples, all.rotary);
  show_axis(report, found, all.rotary);

  // Identified on the first half, tried on the second, of which only mass, load and latency are taken.
  const auto half = all.part(0, all.size() / 2), rest = all.part(all.size() / 2, all.size());
  const auto first = identification::identified(half, identification::statistics_of(half));
  const auto second = identification::identified(rest, identification::statistics_of(rest));
  ex::failures failed;
  std::vector<trial> trials;
  std::vector<std::array<double, 2>> trace;
  const bool halves = first.problem.empty() && second.problem.empty();
  if (halves) {
    const identification::hands_off shown(second);
    auto sure = chosen.trust;
    sure.drift = 0.0;
    const auto bounds = identification::stated_of(first, sure);
    const auto stated = identification::stated_of(first, chosen.trust);
    trials.push_back({"what is sure", bounds, identification::replay(rest, bounds, shown)});
    trials.push_back(
        {ex::format("less %.0f %% of drift: what may be stated", 100.0 * chosen.trust.drift),
         stated, identification::replay(rest, stated, shown, 8, &trace)});
    for (const auto& t : trials) {
      ex::expect(failed, !t.said.refuted(),
                 t.told + " is refuted in row " + std::to_string(t.said.row) +
                     " of the second half, by " + ex::format("%.3g J", t.said.overstated) +
                     ": does somebody hold the device?");
    }
    for (const double by : {0.5, 1.1, 1.3, 2.0}) {
      const auto other = scaled(bounds, by);
      trials.push_back({ex::format("what is sure × %.1f", by), other,
                        identification::replay(rest, other, shown)});
    }
  }
  if (!chosen.told.empty()) {
    trials.push_back(
        {"told", told, identification::replay(all, told, identification::hands_off(found))});
    const auto& said = trials.back().said;
    ex::expect(failed, !said.refuted(),
               chosen.told + " is refuted in row " + std::to_string(said.row) + ", by " +
                   ex::format("%.3g J", said.overstated) +
                   ": a ledger told that says more than the motor put in");
  }
  report.section(
      "The falsifier",
      "Nobody holds the device, so a ledger that says more than the motor put in was told too "
      "much. What is "
      "told comes from the first half of the recording, and is tried on the second. One that is "
      "not refuted "
      "is not proved; what it has credited of the true loss says how far the trial went.");
  ex::show_rows(report, "trials", trials);
  plot(report, all, trace);
  return ex::conclude(
      report, "replay", "passive_haptics: " + std::filesystem::path(name).filename().string(),
      "A recording of an axis that nobody held, and what it says to a ledger.", failed);
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  auto& c = chosen.columns;
  ex::read_options(
      "replay",
      {ex::a_text("--read FILE",
                  "CSV, MAT 5, .npy or .npz, not compressed (default: a simulated drive)",
                  chosen.read),
       ex::a_text("--time NAME", "column of the time, by name or number (default: time)", c.time),
       ex::a_text("--position NAME", "of the position (default: position)", c.position),
       ex::a_text("--force NAME", "of the motor's force (default: force)", c.force),
       a_real("--tick", "S", "the time from row to row, where no column has it", c.tick),
       a_real("--time-scale", "X",
              "seconds in one of its units, beside that of its heading (default: 1)", c.time_scale),
       a_real("--position-scale", "X", "metres or radians in one of its units (default: 1)",
              c.position_scale),
       a_real("--force-scale", "X", "newtons or newton metres in one of its units (default: 1)",
              c.force_scale),
       ex::a_switch("--rotary", "a joint: radians and newton metres", c.rotary),
       ex::a_text("--told FILE", "a description of the device, to be refuted", chosen.told),
       a_real("--confidence", "X", "deviations of a bound from its estimate (default: 3)",
              chosen.trust.confidence),
       a_real("--drift", "X", "share of friction and damping that may be lost (default: 0.3)",
              chosen.trust.drift),
       ex::a_text("--out DIR", "where the page goes (default: replay)", chosen.out)},
      arguments, [&] {
        if (const auto fault = chosen.trust.check()) {
          ex::complain(std::string(fault.parameter) + " = " + ex::format("%g", fault.value) +
                       ", must be " + fault.remedy);
        }
        if (c.tick != 0.0) {
          if (!(c.tick > 0.0))
            ex::complain("--tick " + ex::format("%g", c.tick) + ": give a time > 0 s");
          c.time.clear();
        }
      });
  return chosen;
}

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("replay", [&] { return replay_all(parse(arguments), stop); });
}

}  // namespace replaying
