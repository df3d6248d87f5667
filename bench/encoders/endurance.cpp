// SPDX-License-Identifier: BSD-3-Clause
// How long a guaranteed wall lasts, and how stiff it may be to last: kneaded with 0.3 to 1.9 N once a
// second, or held with 1.1 N and a tremor of 0.3 N at 8.7 Hz, for a minute. The wall has lasted until the
// first second in which the hand feels less than 0.8 of the stiffness that the law displays.
#include "program.hpp"
#include <passive_haptics/design/frequency.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>

namespace encoders {

namespace {

constexpr double T = 1e-3;                // [s]
constexpr double hand_stiffness = 300.0;  // as in with_device() [N/m]

enum class pressing : std::uint8_t { kneading, holding };
const char* to_string(pressing how) {
  return how == pressing::kneading ? "kneading" : "holding";
}

/// The mean of what the hand presses with, when it holds still [N].
double mean_press(const machine& m) {
  return std::min(1.0, 0.6 * m.preset.force_limit / 1.9) * 1.1;
}

struct press {
  double force = 0.0;  ///< [N]
  double rate = 0.0;   ///< [N/s]
};
press press_at(pressing how, double t, double limit) {
  const double mean = 1.1, swing = how == pressing::kneading ? 0.8 : 0.3;
  const double omega = 2.0 * design::pi * (how == pressing::kneading ? 1.0 : 8.7);
  const double scale = std::min(1.0, 0.6 * limit / 1.9);
  return {scale * (mean + swing * std::sin(omega * t)),
          scale * swing * omega * std::cos(omega * t)};
}

struct lasted {
  double seconds = 0.0;
  double least_energy = 0.0;  ///< [J]
  ex::at_rest still{};        ///< when the hand holds still at its mean afterwards, if it does
};

/// Approaches at 10 mm/s from 3 mm, presses, and goes on; then holds still for 6 s, if `rests`.
lasted last(const machine& m, const composition& what, pressing how, double K, int seconds,
            bool rests = false) {
  const double surface = surface_of(m), displayed = m.displayed(K);
  const double per_newton = 1.0 / hand_stiffness + 1.0 / displayed;
  wall model = wall_of(what, m, K, unlimited);
  return with_device(m, surface - 3e-3, [&](auto& device) {
    const press first = press_at(how, 0.0, m.preset.force_limit);
    const double way = 3e-3 + first.force * per_newton, approach = way / 10e-3;
    double force = 0.0, depth = 0.0;
    lasted result{static_cast<double>(seconds)};
    const int pressed = static_cast<int>(approach / T) + 1000 * seconds;
    int end = pressed;  // of the pressing: earlier, if the wall does not last
    rest_of_hold hold(m, K, device.hand().own_mass);
    const auto hand = [&](const auto& now) {
      const double t = now.tick * T - approach;
      if (now.tick >= end) {
        device.hand().aim(surface + mean_press(m) * per_newton, 0.0, device.time());
        return;
      }
      if (t < 0.0) {
        device.hand().aim(surface - 3e-3 + 10e-3 * now.tick * T, 10e-3, device.time());
        return;
      }
      const press p = press_at(how, t, m.preset.force_limit);
      device.hand().aim(surface + p.force * per_newton, p.rate * per_newton, device.time());
    };
    const auto watch = [&](const auto& now) {
      const int tick = now.tick - static_cast<int>(approach / T);
      if (tick < 0) return true;
      if (now.tick >= end) return hold.see(now.force, now.position - surface, device.velocity());
      force -= now.force;
      depth += std::max(0.0, now.position - surface);
      if ((tick + 1) % 1000 != 0) return true;
      const bool stiff = depth > 0.0 && force / depth >= 0.8 * displayed;
      force = depth = 0.0;
      if (!stiff) {
        result.seconds = tick / 1000;
        end = now.tick + 1;
      }
      return stiff || rests;
    };
    const int ticks = pressed + (rests ? rest_of_hold::ticks : 0);
    result.least_energy = sim::run(device, model, ticks, sim::idle, hand, watch).least_energy;
    if (rests) hold.tell(result.still);
    return result;
  });
}

struct endurance_row {
  machine m{};
  const composition* what = nullptr;
  pressing how{};
  int seconds = 60;
  double at_budget = 0.0;   ///< seconds that the budget's stiffness lasted; NaN: there is none
  double largest = 0.0;     ///< K that lasts [N/m]
  double least_energy = 0;  ///< of all runs [J]
  ex::at_rest still{};      ///< after the run at the budget
};

ex::record record_of(const endurance_row& r) {
  const auto budget = r.m.budget();
  return ex::with_floor({{"device", std::string(r.m.preset.name)},
                         {"presliding_um", r.m.presliding * 1e6, "%.0f"},
                         {"composition", std::string(r.what == nullptr ? "" : r.what->name)},
                         {"pressing", to_string(r.how)},
                         {"budget", budget.stiffness, "%.0f"},
                         {"binds", to_string(budget.binding)},
                         {"seconds_at_budget", r.at_budget, "%.0f"},
                         {"largest_stiffness", r.largest, "%.0f"},
                         {"least_energy_J", r.least_energy}},
                        r.still);
}

/// The largest stiffness that lasts, by bisection of its logarithm to 3 %: 0 if 30 N/m does not.
endurance_row judge(endurance_row row) {
  const auto lasts = [&row](double K, bool rests = false) {
    const lasted found = last(row.m, *row.what, row.how, K, row.seconds, rests);
    row.least_energy = std::min(row.least_energy, found.least_energy);
    row.still.add(found.still);
    return found.seconds;
  };
  const double budget = row.m.budget().stiffness;
  row.at_budget = budget > 0.0 ? lasts(budget, true) : std::nan("");
  double low = budget > 0.0 ? budget / 4.0 : 30.0, high = row.m.displayed(1e9);
  if (lasts(high) >= row.seconds) {
    row.largest = high;
    return row;
  }
  if (lasts(low) < row.seconds) return row;
  while (high > 1.03 * low) {
    const double middle = std::sqrt(low * high);
    (lasts(middle) >= row.seconds ? low : high) = middle;
  }
  row.largest = low;
  return row;
}

std::vector<endurance_row> cells(const session& s) {
  std::vector<endurance_row> all;
  for (const auto& preset : sim::all_presets) {
    if (s.chosen.quick && !is_quick(preset)) continue;
    for (const double presliding : {0.0, 5e-6, 15e-6, 30e-6}) {
      if (presliding > 0.0 && (s.chosen.quick || !(preset.friction > 0.0))) continue;
      for (const auto& what : s.judged) {
        if (!what.fits({preset, presliding}) || what.is_control()) continue;
        for (const auto how : {pressing::kneading, pressing::holding}) {
          all.push_back({{preset, presliding}, &what, how, s.chosen.quick ? 5 : 60});
        }
      }
    }
  }
  return all;
}

/// The stiffness found over the budget: what was kneaded, by composition.
void plot_budget(const session& s, const std::vector<endurance_row>& rows) {
  std::map<std::string, std::vector<std::pair<double, double>>> points;
  for (const auto& r : rows) {
    const double budget = r.m.budget().stiffness;
    if (r.how == pressing::kneading && budget > 0.0 && r.what->promises) {
      points[r.what->name].emplace_back(budget, std::max(r.largest, 1.0));
    }
  }
  std::map<std::string, std::string> lines;
  for (auto& [name, list] : points) {
    std::sort(list.begin(), list.end());
    for (const auto& [budget, found] : list) {
      lines[name] += ex::format("%g", budget) + "," + ex::format("%g", found) + "\n";
    }
  }
  lines["the budget"] = "1000,1000\n10000,10000\n";
  const auto least_share = [&points](bool of_the_dual_ledger) {
    double least = 1e9;
    for (const auto& [name, list] : points) {
      if ((name == "dual ledger") != of_the_dual_ledger) continue;
      for (const auto& [budget, found] : list) least = std::min(least, found / budget);
    }
    return least;
  };
  ex::caption said{
      "How stiff a wall lasts",
      {ex::definition(
           "The largest stiffness that kneading leaves standing, over the budget that the "
           "device's own figures promise beforehand. A point on or above the line of the "
           "budget keeps the promise, far above it the budget is cautious;"),
       {"none of the dual ledger is below half of it.",
        [&] { return ex::at_least(least_share(true), 0.5); }}}};
  if (!s.chosen.quick) {  // which tries no elastic friction
    said.see.emplace_back(
        "The others count no dry friction, or believe that it is rigid, and fall short of what it "
        "pays for.",
        [&] { return ex::at_most(least_share(false), 0.99); });
  }
  s.out.plot("endurance", said,
             "set logscale xy\nset xlabel 'budget [N/m]'\nset ylabel 'largest that lasts [N/m]'\n" +
                 ex::curves(lines));
}

}  // namespace

std::vector<std::string> run_endurance(const session& s) {
  const auto rows = s.rows("endurance.csv", "endurance", cells(s), judge);
  std::vector<std::string> found;
  for (const auto& r : rows) {
    if (!r.what->covers(r.m) || r.least_energy >= -1e-12) continue;
    found.push_back(std::string(r.what->name) + ", " + r.m.preset.name + ", " + to_string(r.how) +
                    ex::format(", presliding %g µm: lost ", r.m.presliding * 1e6) +
                    ex::format("%.3g J", -r.least_energy));
  }
  s.out.section(
      "Endurance",
      "Kneading: 0.3 to 1.9 N at 1 Hz; holding: 1.1 N with a tremor of 0.3 N at 8.7 Hz. How "
      "many seconds the budget's stiffness lasts, and the largest stiffness that lasts to "
      "the end, by bisection to 3 %; 0 if 30 N/m does not. After the run at the budget the hand "
      "holds still at 1.1 N for 6 s." +
          std::string(ex::quiet_columns) + ex::quiet_on_steps + ex::held_last_second);
  ex::show_rows(s.out, "endurance", rows);
  plot_budget(s, rows);
  return found;
}

}  // namespace encoders
