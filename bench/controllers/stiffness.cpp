// SPDX-License-Identifier: BSD-3-Clause
#include "stiffness.hpp"

#include <passive_haptics/simulation/device.hpp>

namespace controllers {

namespace sim = passive_haptics::simulation;

std::vector<double> swept_stiffnesses() {
  return {500, 1000, 2000, 4000, 8000, 16000};
}

stiffness_row judge_on_stiffness(const controller& c, double stiffness) {
  constexpr double most_hand = 5.0;
  const sim::impedance_hand<d1> hand{
      .stiffness = 30.0, .damping = 0.5, .limit = most_hand, .target = 0.015};
  sim::device<d1, sim::impedance_hand<d1>> device({.damping = 0.1, .start = -0.020, .substeps = 50},
                                                  hand);
  auto wall = c.in_1({.damping = 0.1, .hand_force = most_hand, .load = 30.0 * 0.015});
  wall.retarget({0.0, -1.0, stiffness});

  double squares = 0.0;
  auto sample = device.exchange(0.0);
  for (int n = 1; n < 6000; ++n) {
    sample = device.exchange(wall.tick(sample).force);
    if (n >= 4000) squares += device.velocity() * device.velocity();
  }
  const bool covered = c.tag != ph::guarantee::none && stiffness <= c.covers.stiffest;
  return {c.name,
          c.tag,
          stiffness,
          covered,
          0.0 - device.meter().minimum(),
          device.meter().total().actuator,
          std::sqrt(squares / 2000.0)};
}

std::vector<std::string> run_stiffness(const session& s) {
  const auto swept = swept_stiffnesses();
  const auto columns = swept.size();
  const auto rows = s.rows(
      "stiffness.csv",
      "controller,tag,stiffness N/m,covered,out of port J,out of wall J,rms speed m/s", "stiffness",
      static_cast<int>(s.judged.size() * columns),
      [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        return judge_on_stiffness(s.judged[at / columns], swept[at % columns]);
      },
      [](const stiffness_row& r) {
        return csv_text(r.controller) + ',' + to_string(r.tag) + ',' + csv_number(r.stiffness) +
               ',' + (r.covered ? "yes" : "no") + ',' + csv_number(r.out_of_port) + ',' +
               csv_number(r.out_of_wall) + ',' + csv_number(r.rms_speed);
      });

  std::vector<std::string> heading{"out of port | of wall, mJ", "tag"};
  for (const double K : swept) heading.push_back(ex::format("%g N/m", K));
  ex::table shown(heading);
  std::vector<std::string> json, found;
  for (std::size_t i = 0; i < rows.size(); i += columns) {
    std::vector<std::string> line{rows[i].controller, to_string(rows[i].tag)};
    for (std::size_t k = i; k < i + columns; ++k) {
      const auto& r = rows[k];
      const std::string cell =
          ex::format("%.3g", r.out_of_port * 1e3) + " | " + ex::format("%.3g", r.out_of_wall * 1e3);
      line.push_back(r.covered ? cell : "(" + cell + ")");
      json.push_back(ex::json_object({{"controller", ex::json_string(r.controller)},
                                      {"stiffness_N_per_m", ex::json_number(r.stiffness)},
                                      {"covered", r.covered ? "true" : "false"},
                                      {"out_of_port_J", ex::json_number(r.out_of_port)},
                                      {"out_of_wall_J", ex::json_number(r.out_of_wall)},
                                      {"rms_speed_m_per_s", ex::json_number(r.rms_speed)}}));
      if (r.covered && !(r.out_of_port <= 1e-12)) {
        found.push_back(r.controller + ", tagged " + to_string(r.tag) + ", on a wall of " +
                        ex::format("%g", r.stiffness) + " N/m: gave the hand " +
                        ex::format("%.3g", r.out_of_port) + " J");
      }
    }
    shown.add(line);
  }
  s.out.section(
      "Walls of 0.5 to 16 kN/m",
      "A hand of 30 N/m and 0.5 N·s/m lets a device of 0.1 kg and 0.1 N·s/m go at the wall, 6 s. "
      "First the most that wall and device together ever gave to the hand (what a guarantee is "
      "about: not above zero), then the sum of f·Δx at the end, which the damper of the device may "
      "have eaten: negative when the wall has kept energy. In brackets: not covered by the tag.");
  s.out.show(shown);
  s.out.member("stiffness", ex::json_array(json));
  return found;
}

}  // namespace controllers
