// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

namespace controllers {

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
  auto wall = c.in<d1>()(premises{});
  wall.update({0.0, -1.0, 1e4});
  sim::prescribed_motion<d1> hand;
  double depth = 1e-6, force = 0.0;
  hand.move_to(depth);
  sim::run(hand, wall, 30000, sim::idle, [&](const auto& now) {
    force = now.force;
    if (!(depth < 0.020 && -force < 1.0)) return false;
    depth += 1e-6;
    hand.move_to(depth);
    return true;
  });
  return -force / depth;
}

wall_row judge_on_wall(const controller& c, const ex::wall_scene& scene, const effort& seeds) {
  wall_row row{.controller = c.name,
               .tag = c.tag,
               .scene = scene.name,
               .runs = scene.yields ? seeds.runs : 1,
               .covered = c.covers_prompt(scene.stiffness),
               .displayed = displayed_stiffness(c)};
  row.least.peak_to_peak = row.least.force_error = std::numeric_limits<double>::infinity();
  row.mean.settle = std::nan("");
  for (int i = 0; i < row.runs; ++i) {
    const auto r =
        ex::drop(c.in<d1>()(known_of(scene)), scene, seeds.first + static_cast<std::uint64_t>(i));
    for (const auto figure : {&ex::wall_result::peak_to_peak, &ex::wall_result::force_error}) {
      row.mean.*figure += r.*figure / row.runs;
      row.least.*figure = std::min(row.least.*figure, r.*figure);
      row.most.*figure = std::max(row.most.*figure, r.*figure);
    }
    row.mean.rest += r.rest / row.runs;
    const double least = c.credits_friction ? r.rubbed_energy : r.port_energy;
    row.mean.port_energy = std::min(row.mean.port_energy, least);
    row.settled += std::isfinite(r.settle) ? 1 : 0;
    row.mean.settle = std::fmax(row.mean.settle, r.settle);
    row.still.add(r.still);
  }
  return row;
}

const std::vector<published>& section_5() {
  using four = std::array<double, 4>;  // S0, S1, S2, S5
  struct line {
    const char* controller;
    four millimetres, newtons;
    const char* reason = "";
    const char* there = "S0 S1 S2 S5";
  };
  static const std::vector<published> all = [] {
    std::vector<published> list;
    for (const line& l : {
             line{"none", {65.0, 65.9, 6.81, 2.28}, {0, 0, 2.2, 0}},
             line{"strict FBA", {93.2, 90.1, 0, 0}, {231, 210, 74, 117}},
             line{"memoryless FBA", {105.8, 105.8, 0, 0}, {328, 327, 136, 162}},
             line{"EBA, tight", {105.8, 105.8, 0, 0}, {328, 327, 136, 162}},
             line{"EBA", {137.9, 137.9, 0, 0}, {510, 509, 323, 324}},
             line{"thesis", {1.89, 2.21, 0, 0.11}, {0.81, 0.54, 0.16, 0.04}},
             line{"thesis safe, holds 2 mg", {0.87, 1.19, 0, 0.11}, {0.53, 0.38, 0.18, 0.04}},
             line{"thesis safe, holds 1.2 mg", {0.10, 0.17, 0, 0.10}, {0.10, 0.62, 26, 0.04}},
             line{"PO/PC", {42.6, 44.6, 0, 0.012}, {1.4, 0.67, 0.18, 0.01}},
             line{"PO/PC + reference energy", {63.3, 64.5, 0, 0.001}, {4.5, 2.5, 0.19, 0.01}},
             line{"PSPM as published",
                  {65.0, 65.9, 6.81, 2.30},
                  {0, 0.04, 2.2, 0},
                  "no: its tank books what the saturated motors did not hold",
                  "S2"},
             line{"virtual coupling", {106.8, 102.7, 0, 0}, {331, 314, 138, 163}},
             line{"tank + level controller",
                  {47.7, 48.7, 0, 0.005},
                  {2.3, 1.4, 0.17, 0.01},
                  "no: § 5 does not give its tank's parameters"},
         }) {
      const std::array scenes{"S0", "S1", "S2", "S5"};
      for (std::size_t i = 0; i < scenes.size(); ++i) {
        const bool explained = std::string(l.there).find(scenes[i]) != std::string::npos;
        list.push_back(
            {l.controller, scenes[i], l.millimetres[i], l.newtons[i], explained ? l.reason : ""});
      }
    }
    return list;
  }();
  return all;
}

static ex::record record_of(const wall_row& r) {
  return ex::with({{"controller", r.controller},
                   {"scene", r.scene.c_str()},
                   {"runs", r.runs},
                   {"settled", r.settled},
                   {"peak to peak mm", r.mean.peak_to_peak * 1e3},
                   {"worst settle s", r.mean.settle},
                   {"covered", r.covered},
                   {"min port energy J", r.mean.port_energy},
                   {"mean force error N", r.mean.force_error},
                   {"rest mm", r.mean.rest * 1e3},
                   {"displayed stiffness N/m", r.displayed}},
                  r.still);
}

/// For people, beside what § 5 has.
static ex::record compared(const wall_row& r) {
  published p{"", "", std::nan(""), std::nan("")};
  for (const auto& q : section_5()) {
    if (q.controller == r.controller && q.scene == r.scene) p = q;
  }
  const std::string energy = ex::format("%.2g", r.mean.port_energy);
  ex::record row{{r.scene, r.controller},
                 {"tag", to_string(r.tag)},
                 {"peak to peak mm", r.mean.peak_to_peak * 1e3, "%.3f"},
                 {"settled", std::to_string(r.settled) + " of " + std::to_string(r.runs)},
                 {"settle s", r.mean.settle, "%.2f"},
                 {"min port energy J", r.covered ? energy : "(" + energy + ")"},
                 {"force error N", r.mean.force_error},
                 {"rest mm", r.mean.rest * 1e3, "%.2f"},
                 {"displays N/m", r.displayed, "%.4g"},
                 {"§ 5: mm", p.peak_to_peak_mm, "%.4g"},
                 {"§ 5: N", p.force_error, "%.4g"},
                 {"agrees", p.controller.empty() ? "-" : agreement(r, p)}};
  return ex::with(std::move(row), r.still);
}

std::string agreement(const wall_row& row, const published& p) {
  const auto agrees = [](double measured, double published) {
    return (measured < 0.1 && published < 0.1) ||
           std::abs(measured - published) <= 0.1 * std::abs(published);
  };
  const bool length = agrees(row.mean.peak_to_peak * 1e3, p.peak_to_peak_mm);
  const bool force = agrees(row.mean.force_error, p.force_error);
  if (length && force) return "yes";
  const auto between = [](double least, double x, double most) { return least <= x && x <= most; };
  const bool reached =
      between(row.least.peak_to_peak * 1e3, p.peak_to_peak_mm, row.most.peak_to_peak * 1e3);
  const bool pushed = between(row.least.force_error, p.force_error, row.most.force_error);
  if ((length || reached) && (force || pushed)) return "within the seeds";
  return p.reason.empty() ? "NO" : p.reason;
}

std::vector<std::string> run_wall(const session& s) {
  const auto scenes = wall_scenes();
  const auto rows =
      s.rows("controllers.csv", "wall", with_each(s.judged, scenes), [&s](const auto& job) {
        return judge_on_wall(*job.first, job.second, {s.chosen.seeds, s.chosen.first()});
      });
  s.out.section(
      "Wall",
      "A device of 0.1 kg and 0.03 N·s/m falls 61 mm onto a wall of 10 kN/m. S0: ideal device, "
      "static wall. S1: the wall gives way, surface = F/K, at 20-50 Hz. S2: 9 N saturation and 0.2 "
      "N dry friction. S5: S1 with a hand that damps, 2 N·s/m. Settle time and energy are the "
      "worst of the seeds that settled, the rest means. The port energy is the simulator's own, "
      "with dry friction booked for controllers that credit it; in brackets it is not covered by "
      "the tag, or the controller is built for a loop that is late. Displays: static stiffness "
      "felt when pressed at 1 mm/s with an empty ledger, force over depth at 1 N or at 20 mm; the "
      "wall has 10 kN/m. § 5: docs/design/mathematics.md. Its rows \"thesis literal\", "
      "\"out-only\", "
      "\"out-only + reset\" and \"PO/PC 2002 pairing\" are no compositions of the library." +
          std::string(ex::quiet_columns) + ex::held_last_second);
  for (const auto& scene : scenes) {
    s.out.show(ex::table_of(rows, [&scene](const wall_row& r) {
      return r.scene == scene.name ? compared(r) : ex::record{};
    }));
  }
  s.out.member("wall", ex::json_of(rows));
  std::vector<std::string> found;
  for (const auto& r : rows) {
    if (!r.covered || r.mean.port_energy >= -1e-12) continue;
    found.push_back(r.controller + ", tagged " + to_string(r.tag) + ", in scene " + r.scene +
                    ": lost " + ex::format("%.3g", -r.mean.port_energy) + " J");
  }
  return found;
}

}  // namespace controllers
