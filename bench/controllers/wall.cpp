// SPDX-License-Identifier: BSD-3-Clause
#include "wall.hpp"

#include <passive_haptics/simulation/prescribed_motion.hpp>

namespace controllers {

namespace sim = passive_haptics::simulation;

std::vector<ex::wall_scene> wall_scenes() {
  return {{.name = "S0"},
          {.name = "S1", .yields = true},
          {.name = "S2", .force_limit = 9.0, .friction = 0.2},
          {.name = "S5", .yields = true, .hand_damping = 2.0}};
}

premises known_of(const ex::wall_scene& scene) {
  return {.mass = scene.mass, .friction = scene.friction, .load = 9.81 * scene.mass};
}

double displayed_stiffness(const controller& c) {
  auto wall = c.in_1(premises{});
  sim::prescribed_motion<d1> hand;
  wall.retarget({0.0, -1.0, 1e4});
  auto sample = hand.exchange(0.0);
  double depth = 0.0, force = 0.0;
  while (depth < 0.020 && -force < 1.0) {
    depth += 1e-6;
    hand.move_to(depth);
    sample = hand.exchange(force);
    force = wall.tick(sample).force;
  }
  return -force / depth;
}

wall_row judge_on_wall(const controller& c, const ex::wall_scene& scene, int seeds) {
  wall_row row;
  row.controller = c.name;
  row.scene = scene.name;
  row.runs = scene.yields ? seeds : 1;
  row.displayed = displayed_stiffness(c);
  row.least.peak_to_peak = row.least.force_error = std::numeric_limits<double>::infinity();
  double worst = 0.0;
  for (int seed = 1; seed <= row.runs; ++seed) {
    const auto r = ex::drop(c.in_1(known_of(scene)), scene, static_cast<std::uint64_t>(seed));
    row.mean.peak_to_peak += r.peak_to_peak / row.runs;
    row.mean.force_error += r.force_error / row.runs;
    row.least.peak_to_peak = std::min(row.least.peak_to_peak, r.peak_to_peak);
    row.most.peak_to_peak = std::max(row.most.peak_to_peak, r.peak_to_peak);
    row.least.force_error = std::min(row.least.force_error, r.force_error);
    row.most.force_error = std::max(row.most.force_error, r.force_error);
    row.mean.rest += r.rest / row.runs;
    const double least = c.credits_friction ? r.rubbed_energy : r.port_energy;
    row.mean.port_energy = std::min(row.mean.port_energy, least);
    if (!std::isfinite(r.settle)) continue;
    ++row.settled;
    worst = std::max(worst, r.settle);
  }
  row.mean.settle = row.settled > 0 ? worst : std::nan("");
  return row;
}

const std::vector<published>& section_5() {
  static const char* const tuning = "no: § 5 does not give its tank's parameters";
  static const std::vector<published> all{
      {"none", "S0", 65.0, 0.0},
      {"none", "S1", 65.9, 0.0},
      {"none", "S2", 6.81, 2.2},
      {"none", "S5", 2.28, 0.0},
      {"strict FBA", "S0", 93.2, 231.0},
      {"strict FBA", "S1", 90.1, 210.0},
      {"strict FBA", "S2", 0.0, 74.0},
      {"strict FBA", "S5", 0.0, 117.0},
      {"memoryless FBA", "S0", 105.8, 328.0},
      {"memoryless FBA", "S1", 105.8, 327.0},
      {"memoryless FBA", "S2", 0.0, 136.0},
      {"memoryless FBA", "S5", 0.0, 162.0},
      {"EBA, tight", "S0", 105.8, 328.0},
      {"EBA, tight", "S1", 105.8, 327.0},
      {"EBA, tight", "S2", 0.0, 136.0},
      {"EBA, tight", "S5", 0.0, 162.0},
      {"EBA", "S0", 137.9, 510.0},
      {"EBA", "S1", 137.9, 509.0},
      {"EBA", "S2", 0.0, 323.0},
      {"EBA", "S5", 0.0, 324.0},
      {"thesis", "S0", 1.89, 0.81},
      {"thesis", "S1", 2.21, 0.54},
      {"thesis", "S2", 0.0, 0.16},
      {"thesis", "S5", 0.11, 0.04},
      {"thesis safe, holds 2 mg", "S0", 0.87, 0.53},
      {"thesis safe, holds 2 mg", "S1", 1.19, 0.38},
      {"thesis safe, holds 2 mg", "S2", 0.0, 0.18},
      {"thesis safe, holds 2 mg", "S5", 0.11, 0.04},
      {"thesis safe, holds 1.2 mg", "S0", 0.10, 0.10},
      {"thesis safe, holds 1.2 mg", "S1", 0.17, 0.62},
      {"thesis safe, holds 1.2 mg", "S2", 0.0, 26.0},
      {"thesis safe, holds 1.2 mg", "S5", 0.10, 0.04},
      {"PO/PC", "S0", 42.6, 1.4},
      {"PO/PC", "S1", 44.6, 0.67},
      {"PO/PC", "S2", 0.0, 0.18},
      {"PO/PC", "S5", 0.012, 0.01},
      {"PO/PC + reference energy", "S0", 63.3, 4.5},
      {"PO/PC + reference energy", "S1", 64.5, 2.5},
      {"PO/PC + reference energy", "S2", 0.0, 0.19},
      {"PO/PC + reference energy", "S5", 0.001, 0.01},
      {"PSPM as published", "S0", 65.0, 0.0},
      {"PSPM as published", "S1", 65.9, 0.04},
      {"PSPM as published", "S2", 6.81, 2.2,
       "no: its tank books what the saturated motors did not hold"},
      {"PSPM as published", "S5", 2.30, 0.0},
      {"virtual coupling", "S0", 106.8, 331.0},
      {"virtual coupling", "S1", 102.7, 314.0},
      {"virtual coupling", "S2", 0.0, 138.0},
      {"virtual coupling", "S5", 0.0, 163.0},
      {"tank + level controller", "S0", 47.7, 2.3, tuning},
      {"tank + level controller", "S1", 48.7, 1.4, tuning},
      {"tank + level controller", "S2", 0.0, 0.17, tuning},
      {"tank + level controller", "S5", 0.005, 0.01, tuning},
  };
  return all;
}

namespace {

bool agrees(double measured, double published) noexcept {
  if (measured < 0.1 && published < 0.1) return true;
  return std::abs(measured - published) <= 0.1 * std::abs(published);
}

std::string line_of(const wall_row& r) {
  return csv_text(r.controller) + ',' + r.scene + ',' + std::to_string(r.runs) + ',' +
         std::to_string(r.settled) + ',' + csv_number(r.mean.peak_to_peak * 1e3) + ',' +
         csv_number(r.mean.settle) + ',' + csv_number(r.mean.port_energy) + ',' +
         csv_number(r.mean.force_error) + ',' + csv_number(r.mean.rest * 1e3) + ',' +
         csv_number(r.displayed);
}

std::string json_of(const wall_row& r) {
  return ex::json_object({{"controller", ex::json_string(r.controller)},
                          {"scene", ex::json_string(r.scene)},
                          {"runs", std::to_string(r.runs)},
                          {"runs_settled", std::to_string(r.settled)},
                          {"peak_to_peak_mm", ex::json_number(r.mean.peak_to_peak * 1e3)},
                          {"settle_s", ex::json_number(r.mean.settle)},
                          {"min_port_energy_J", ex::json_number(r.mean.port_energy)},
                          {"mean_force_error_N", ex::json_number(r.mean.force_error)},
                          {"rest_mm", ex::json_number(r.mean.rest * 1e3)},
                          {"displayed_stiffness_N_per_m", ex::json_number(r.displayed)}});
}

/// One scene for people, beside what § 5 has.
ex::table table_of(const std::string& scene, const std::vector<wall_row>& rows,
                   const std::vector<controller>& judged) {
  ex::table shown({scene, "tag", "peak to peak mm", "settled", "settle s", "min port energy J",
                   "force error N", "rest mm", "displays N/m", "§ 5: mm", "§ 5: N", "agrees"});
  for (const auto& r : rows) {
    if (r.scene != scene) continue;
    std::vector<std::string> line{r.controller};
    for (const auto& c : judged) {
      if (c.name == r.controller) line.push_back(to_string(c.tag));
    }
    for (const auto& cell :
         {ex::format("%.3f", r.mean.peak_to_peak * 1e3),
          std::to_string(r.settled) + " of " + std::to_string(r.runs),
          ex::format("%.2f", r.mean.settle), ex::format("%.2g", r.mean.port_energy),
          ex::format("%.3g", r.mean.force_error), ex::format("%.2f", r.mean.rest * 1e3),
          ex::format("%.4g", r.displayed)}) {
      line.push_back(cell);
    }
    std::vector<std::string> reference{"-", "-", "-"};
    for (const auto& p : section_5()) {
      if (p.controller != r.controller || p.scene != r.scene) continue;
      reference = {ex::format("%.4g", p.peak_to_peak_mm), ex::format("%.4g", p.force_error),
                   agreement(r, p)};
    }
    line.insert(line.end(), reference.begin(), reference.end());
    shown.add(line);
  }
  return shown;
}

}  // namespace

std::string agreement(const wall_row& row, const published& p) {
  const double mm = row.mean.peak_to_peak * 1e3;
  if (agrees(mm, p.peak_to_peak_mm) && agrees(row.mean.force_error, p.force_error)) return "yes";
  const auto between = [](double least, double x, double most) { return least <= x && x <= most; };
  const bool length =
      agrees(mm, p.peak_to_peak_mm) ||
      between(row.least.peak_to_peak * 1e3, p.peak_to_peak_mm, row.most.peak_to_peak * 1e3);
  const bool force = agrees(row.mean.force_error, p.force_error) ||
                     between(row.least.force_error, p.force_error, row.most.force_error);
  if (length && force) return "within the seeds";
  return *p.reason != '\0' ? p.reason : "NO";
}

std::vector<std::string> run_wall(const session& s) {
  const auto scenes = wall_scenes();
  const auto rows = s.rows(
      "controllers.csv",
      "controller,scene,runs,settled,peak to peak mm,worst settle s,min port energy J,"
      "mean force error N,rest mm,displayed stiffness N/m",
      "wall", static_cast<int>(s.judged.size() * scenes.size()),
      [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        return judge_on_wall(s.judged[at / scenes.size()], scenes[at % scenes.size()],
                             s.chosen.seeds);
      },
      line_of);

  s.out.section(
      "Wall",
      "A device of 0.1 kg and 0.03 N·s/m falls 61 mm onto a wall of 10 kN/m. S0: ideal device, "
      "static wall. S1: the wall gives way, surface = F/K, at 20-50 Hz. S2: 9 N saturation and 0.2 "
      "N dry friction. S5: S1 with a hand that damps, 2 N·s/m. Settle time and energy are the "
      "worst "
      "of the seeds that settled, the rest means. The port energy is the simulator's own, with dry "
      "friction booked for controllers that credit it. Displays: static stiffness felt when "
      "pressed at 1 mm/s with an empty ledger, force over depth at 1 N or at 20 mm; the wall has "
      "10 kN/m. § 5: docs/design/mathematics.md. Its rows \"thesis literal\", \"out-only\", "
      "\"out-only + reset\" and \"PO/PC 2002 pairing\" are no compositions of the library.");
  for (const auto& scene : scenes) s.out.show(table_of(scene.name, rows, s.judged));
  std::vector<std::string> json;
  for (const auto& r : rows) json.push_back(json_of(r));
  s.out.member("wall", ex::json_array(json));
  return {};
}

}  // namespace controllers
