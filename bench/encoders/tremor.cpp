// SPDX-License-Identifier: BSD-3-Clause
// Tremor as a force: 0.3 N at 8.7 Hz beside a hold of 1.1 N, for a minute at the budget's stiffness; and the kneading
// of the section before, by the same hands. A hand that is moved by a tremor of its target resists the device's friction
// with all its stiffness; one that is pushed by it does not, and the device swings within its presliding, which pays
// nothing. What is left of the wall then is for the cap to see to.
#include "program.hpp"
#include <passive_haptics/design/frequency.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>

namespace encoders {

namespace {

constexpr double T = 1e-3;  // [s]

const char* to_string(doing how) {
  return how == doing::kneading ? "kneading" : "tremor as a force";
}

struct tremor_row {
  machine m{};
  const composition* what = nullptr;
  doing how{};
  int seconds = 60;
  double least = 1.0;         ///< share of the budget's stiffness felt in the worst second
  int lost = 0;               ///< of six runs, those with a second below 0.8
  double deepest = 0.0;       ///< [m]
  double least_energy = 0.0;  ///< [J]
  ex::at_rest still{};        ///< when the hand holds still afterwards
};

ex::record record_of(const tremor_row& r) {
  return ex::with_floor({{"device", std::string(r.m.preset.name)},
                         {"presliding_um", r.m.presliding * 1e6, "%.0f"},
                         {"composition", std::string(r.what == nullptr ? "" : r.what->name)},
                         {"pressing", to_string(r.how)},
                         {"budget", r.m.budget().stiffness, "%.0f"},
                         {"least_share", r.least, "%.2f"},
                         {"runs_below_0.8", r.lost},
                         {"deepest_mm", r.deepest * 1e3, "%.2f"},
                         {"least_energy_J", r.least_energy}},
                        r.still);
}

}  // namespace

felt press(const machine& m, wall model, doing how, double K, int seconds,
           const sim::impedance_hand<line>& fingers, double offset) {
  const double displayed = m.displayed(K);
  const double surface = offset * m.preset.quantum;
  const double per_newton = 1.0 / fingers.stiffness + 1.0 / displayed;
  const double mean = std::min(1.1, 0.33 * m.preset.force_limit);
  (void)model.update({surface, -1.0, K});
  return with_device(m, surface - 3e-3, fingers, [&](auto& device) {
    felt found;
    const double approach = (3e-3 + mean * per_newton) / 10e-3;
    double force = 0.0, depth = 0.0;
    const int end = static_cast<int>(approach / T) + 1000 * (seconds + 1);
    rest_of_hold hold(m, K, fingers.own_mass);
    const auto hand = [&](const auto& now) {
      const double t = now.tick * T - approach;
      const double omega = 2.0 * design::pi;
      if (now.tick >= end) {
        device.hand().aim(surface + mean * per_newton, 0.0, device.time());
        return;
      }
      const bool kneads = how == doing::kneading && t > 0.0;
      const double swing = kneads ? 0.8 * std::sin(omega * t) : 0.0;
      const double rate = kneads ? 0.8 * omega * std::cos(omega * t) : 0.0;
      const double pushed = how == doing::tremor ? 0.3 * std::sin(8.7 * omega * now.tick * T) : 0.0;
      const double goal =
          t < 0.0 ? surface - 3e-3 + 10e-3 * now.tick * T : surface + (mean + swing) * per_newton;
      device.hand().aim(goal + pushed / fingers.stiffness, t < 0.0 ? 10e-3 : rate * per_newton,
                        device.time());
    };
    const auto watch = [&](const auto& now) {
      found.outside += now.out.what == ph::event::outside_force ? 1 : 0;
      const int tick = now.tick - static_cast<int>(approach / T) - 1000;
      if (tick < 0) return true;
      if (now.tick >= end) return hold.see(now.force, now.position - surface, device.velocity());
      force -= now.force;
      depth += std::max(0.0, now.position - surface);
      found.deepest = std::max(found.deepest, now.position - surface);
      if ((tick + 1) % 1000 != 0) return true;
      found.least = std::min(found.least, depth > 0.0 ? force / depth / displayed : 0.0);
      force = depth = 0.0;
      return true;
    };
    const int ticks = end + rest_of_hold::ticks;
    found.least_energy = sim::run(device, model, ticks, sim::idle, hand, watch).least_energy;
    hold.tell(found.still);
    return found;
  });
}

namespace {

tremor_row judge(tremor_row row) {
  const double K = row.m.budget().stiffness;
  for (const auto& fingers : hands) {
    for (const double offset : offsets) {
      const felt run =
          press(row.m, row.what->make(row.m.stated(), K), row.how, K, row.seconds, fingers, offset);
      row.least = std::min(row.least, run.least);
      row.lost += run.least < 0.8 ? 1 : 0;
      row.deepest = std::max(row.deepest, run.deepest);
      row.least_energy = std::min(row.least_energy, run.least_energy);
      row.still.add(run.still);
    }
  }
  return row;
}

std::vector<tremor_row> cells(const session& s) {
  std::vector<tremor_row> all;
  for (const auto& preset : sim::all_presets) {
    if (!(preset.friction > 0.0) || (s.chosen.quick && !is_quick(preset))) continue;
    for (const double presliding : {0.0, 5e-6, 15e-6, 30e-6}) {
      if (presliding > 0.0 && s.chosen.quick) continue;
      for (const auto& what : s.judged) {
        if (!what.is_capped) continue;
        for (const auto how : {doing::kneading, doing::tremor}) {
          all.push_back({{preset, presliding}, &what, how, s.chosen.quick ? 5 : 60});
        }
      }
    }
  }
  return all;
}

}  // namespace

std::vector<std::string> run_tremor(const session& s) {
  const auto rows = s.rows("tremor.csv", "tremor", cells(s), judge);
  std::vector<std::string> found;
  for (const auto& r : rows) {
    const auto where = std::string(r.what->name) + ", " + r.m.preset.name + ", " +
                       to_string(r.how) + ex::format(", presliding %g µm: ", r.m.presliding * 1e6);
    if (r.what->covers(r.m) && r.least_energy < -1e-12) {
      found.push_back(where + ex::format("lost %.3g J", -r.least_energy));
    }
    if (r.what->follows && r.least < 0.15) {
      found.push_back(where + ex::format("the wall is lost: %.2f of it is left", r.least));
    }
  }
  s.out.section("Tremor as a force",
                "1.1 N and a tremor of 0.3 N at 8.7 Hz that pushes the hand, or kneading of 0.3 to "
                "1.9 N at 1 Hz, for a minute at the budget: what the worst second of six runs "
                "(three hands, two offsets of the surface) leaves of the stiffness. Then the hand "
                "holds still at 1.1 N for 6 s." +
                    std::string(ex::quiet_columns) + ex::quiet_on_steps + ex::held_last_second);
  ex::show_rows(s.out, "tremor", rows);
  return found;
}

}  // namespace encoders
