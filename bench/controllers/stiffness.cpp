// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

namespace controllers {

stiffness_row judge_on_stiffness(const controller& c, double stiffness, int seed) {
  constexpr double most_hand = 5.0;
  ex::redrawn number(seed, static_cast<std::uint64_t>(stiffness));
  const double mass = number(0.1, 0.05, 0.5), damping = number(0.1, 0.03, 0.3);
  sim::impedance_hand<d1> hand{.limit = most_hand};
  hand.stiffness = number(30.0, 10.0, 100.0);
  hand.damping = number(0.5, 0.2, 2.0);
  hand.target = number(0.015, 0.005, 0.025);
  sim::device<d1, sim::impedance_hand<d1>> device(
      {.mass = mass, .damping = damping, .start = -0.020, .substeps = 50}, hand);
  auto wall = c.in<d1>()({.mass = mass,
                          .damping = damping,
                          .hand_force = most_hand,
                          .load = hand.stiffness * hand.target});
  wall.update({0.0, -1.0, stiffness});
  double squares = 0.0;
  sim::quiet_judge<d1> quiet;
  constexpr std::array<double, 1> normal{-1.0};
  ex::held_stiffness held;
  sim::run(device, wall, 5999, sim::idle, sim::idle, [&](const auto& now) {
    quiet.add(now.force, device.velocity(), 1e-3,
              std::span(normal).first(now.position > 0.0 ? 1 : 0));
    if (now.tick >= 4999) held.add(-now.force, now.position);
    if (now.tick >= 3999) squares += device.velocity() * device.velocity();
  });
  ex::at_rest still;
  still.add(quiet, {stiffness, held.shown()});
  return {c.name,
          c.tag,
          stiffness,
          c.covers_prompt(stiffness),
          0.0 - device.meter().minimum(),
          device.meter().total().actuator,
          std::sqrt(squares / 2000.0),
          ex::quiet_in_time(quiet),
          quiet.missed(),
          still};
}

static ex::record record_of(const stiffness_row& r) {
  return ex::with({{"controller", r.controller},
                   {"tag", to_string(r.tag)},
                   {"stiffness N/m", r.stiffness},
                   {"covered", r.covered},
                   {"out of port J", r.out_of_port},
                   {"out of wall J", r.out_of_wall},
                   {"rms speed m/s", r.rms_speed}},
                  r.still);
}

std::vector<std::string> run_stiffness(const session& s) {
  const std::vector<double> swept{500, 1000, 2000, 4000, 8000, 16000};
  const auto rows = s.rows(
      "stiffness.csv", "stiffness", with_each(s.judged, swept),
      [&s](const auto& job) { return judge_on_stiffness(*job.first, job.second, s.chosen.seed); });
  std::vector<std::string> heading{"out of port | of wall, mJ | quiet", "tag"}, found, line;
  ex::at_rest still;
  std::vector<ex::record> rests;
  for (const double K : swept) heading.push_back(ex::format("%g N/m", K));
  ex::table shown(heading);
  for (const auto& r : rows) {
    if (line.empty()) line = {r.controller, to_string(r.tag)};
    const std::string cell = ex::format("%.3g", r.out_of_port * 1e3) + " | " +
                             ex::format("%.3g", r.out_of_wall * 1e3) + " | " +
                             ex::quiet_since(r.quiet, r.missed);
    line.push_back(r.covered ? cell : "(" + cell + ")");
    still.add(r.still);
    if (line.size() == heading.size()) {
      shown.add(std::exchange(line, {}));
      rests.push_back(ex::with({{"controller", r.controller}}, std::exchange(still, {})));
    }
    if (!r.covered || r.out_of_port <= 1e-12) continue;
    found.push_back(r.controller + ", tagged " + to_string(r.tag) + ", on a wall of " +
                    ex::format("%g", r.stiffness) + " N/m: gave the hand " +
                    ex::format("%.3g", r.out_of_port) + " J");
  }
  s.out.section(
      "Walls of 0.5 to 16 kN/m",
      "A hand of 30 N/m and 0.5 N·s/m lets a device of 0.1 kg and 0.1 N·s/m go at the wall, 6 s. "
      "First the most that wall and device together ever gave to the hand (what a guarantee is "
      "about: not above zero), then the sum of f·Δx at the end, which the damper of the device may "
      "have eaten: negative when the wall has kept energy; then since when it is quiet "
      "(docs/design/settling.md), or what it missed last, if not by 5 s. In brackets: not covered "
      "by the tag, or the controller is built for a loop that is late. Below them the six walls of "
      "each together." +
          std::string(ex::quiet_columns) + ex::held_last_second);
  s.out.show(shown);
  s.out.show(ex::table_of(rests));
  s.out.member("stiffness", ex::json_of(rows));
  return found;
}

}  // namespace controllers
