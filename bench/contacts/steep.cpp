// SPDX-License-Identifier: BSD-3-Clause
// A renderer that is steeper than a guard settles with: is the device quiet, how much of the renderer is shown?
#include "quiet.hpp"
#include <passive_haptics/compositions.hpp>

#include <deque>
#include <utility>

namespace contacts {

namespace {

constexpr double longest = 1.1 * T;  // [s]

/// When it has to be quiet, from the touch on [s]: what nobody holds bounces, and in a flat pit swings.
double guard_in_time(bool held, int late) {
  return held ? (late == 0 ? 1.0 : 1.5) : (late == 0 ? 2.0 : 5.0);
}

struct steep_scene {
  held_point::parameters device;
  double told = 1.0;         ///< of mass and damping
  std::vector<plane> walls;  ///< which somebody else renders
  [[nodiscard]] vector force(const vector& x) const {
    vector f = vector::Zero();
    for (const plane& w : walls) {
      f += std::max(0.0, w.at(x).depth) * w.stiffness * vector(w.normal);
    }
    return f;
  }
};

/// One wall, or three or four about a pit, of `times` what settles each; they are met from 10 mm away.
steep_scene draw(double times, int late, const still_hand& hand, std::uint64_t seed) {
  draws d(seed);
  steep_scene s;
  s.device.mass = d.scale(0.05, 0.5);
  s.device.hand = hand;
  s.told = d.chance(0.5) ? 1.0 : d.between(0.6, 1.0);
  const double most =
      ph::settled_force{.mass = s.device.mass * s.told}.most_stiffness(longest, 0, late);
  const int walls = d.chance(0.4) ? 1 : d.count(3, 4);
  const double lean = walls == 1 ? 0.0 : d.between(10.0, 50.0) * degree;
  const double turn = d.between(0.0, 360.0) * degree;
  for (int i = 0; i < walls; ++i) {
    const double angle = turn + 360.0 * degree * i / walls;
    const vector n(std::sin(lean) * std::cos(angle), std::sin(lean) * std::sin(angle),
                   std::cos(lean));
    s.walls.push_back({vector::Zero(), n, times * most * (i == 0 ? 1.0 : d.between(0.5, 1.0))});
  }
  const double aside = walls == 1 ? 0.0 : 0.3 * std::tan(lean);
  const double down = d.between(0.5, 2.5);
  s.device.load = {aside * down * d.between(-1.0, 1.0), 0.0, -down};
  s.device.goal = {0.0, 0.0, -2e-3};
  s.device.start = {0.0, 0.0, 0.01};
  return s;
}

template <int Late>
quiet_run run_of(const steep_scene& s, bool softens) {
  using loop = ph::late_loop_limits<Late>;
  auto port = ph::make_guard<d3, loop>({.mass = s.device.mass * s.told,
                                        .damping = damping * s.told,
                                        .force_limit = 20.0,
                                        .longest_tick = longest,
                                        .latency = Late},
                                       {.force = 12.0});
  ph::settled_force rule = port.source().parameters();
  rule.softens = softens;
  static_cast<void>(port.set(rule));
  held_point device(s.device);
  sim::quiet_judge<d3> judge;
  std::deque<vector> on_their_way(Late, vector(vector::Zero()));
  quiet_run run;
  std::vector<vector> pressing;
  int until = static_cast<int>(watched / T);
  for (int tick = 0; tick < until; ++tick) {
    on_their_way.push_back(
        port.tick(device.position(), ph::seconds{T}, s.force(device.position())).force);
    device.step(on_their_way.front());
    pressing.clear();
    for (const plane& w : s.walls) {
      if (w.at(device.position()).depth > 0.0) pressing.emplace_back(w.normal);
    }
    judge.add(on_their_way.front(), device.velocity(), T, pressing);
    on_their_way.pop_front();
    if (!pressing.empty()) {
      if (run.touched < 0.0) judge.news();
      run.touched = tick * T;
    }
    until = ticks_of(until, tick, judge);
    run.seconds = (tick + 1) * T;
    if (!(device.position().norm() < 0.4)) {
      run.gone = true;
      break;
    }
  }
  run.end(judge, device.velocity().norm());
  run.least_energy = device.meter().minimum();
  run.shown = port.source().shown();
  run.asked = run.can_be = 1.0;
  return run;
}

/// A motor of 40 g, where the encoder is, and a handle of 60 g on a cable that is hardly damped.
struct cable_row {
  double hertz = 0.0;     ///< at which handle and motor swing against each other
  bool of_motor = false;  ///< told the motor's mass, not that of both
  double times = 0.0;     ///< of most_stiffness of both masses
  double hand_force = 0.0;
  std::array<double, 3> settling{};  ///< in each of the three hands [s]; NaN: not in 6 s
  double least_energy = 0.0;         ///< at the motor [J]
};
ex::record record_of(const cable_row& r) {
  return {{"cable_Hz", r.hertz, "%.0f"},
          {"told_mass", std::string(r.of_motor ? "motor" : "both")},
          {"hand_force_told_N", r.hand_force, "%.0f"},
          {"times", r.times},
          {"off_s", r.settling[0], "%.1f"},
          {"relaxed_s", r.settling[1], "%.1f"},
          {"stiff_s", r.settling[2], "%.1f"},
          {"least_energy_J", r.least_energy, "%.1e"}};
}
void press_by_cable(cable_row& row, std::size_t grip) {
  using d1 = ph::space<double, 1>;
  constexpr double motor = 0.04, handle = 0.06, both = motor + handle,
                   shared = motor * handle / both;
  const double rate = 360.0 * degree * row.hertz;
  const double k = rate * rate * shared, c = 0.02 * rate * shared;
  const double K = row.times * ph::settled_force{.mass = both}.most_stiffness(longest);
  auto port = ph::make_guard<d1>({.mass = row.of_motor ? motor : both,
                                  .damping = damping,
                                  .force_limit = 9.0,
                                  .longest_tick = longest},
                                 ph::trusted_hand{{.force = row.hand_force}});
  sim::quiet_judge<d1> judge;
  constexpr std::array<double, 1> presses{1.0};
  double x = 2e-3, y = 2e-3, v = 0.0, w = 0.0, energy = 0.0;  // of the motor, of the handle
  bool touched = false;
  for (int tick = 0; tick * T < watched; ++tick) {
    const double f = port.tick(x, ph::seconds{T}, std::max(0.0, -K * x)).force;
    if (x < 0.0 && !std::exchange(touched, true)) judge.news();
    const double from = x;
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i) {
      constexpr double h = T / steps;
      const double pull = k * (y - x) + c * (w - v);
      const auto& hand = still_hands[grip];
      v += h * (f + pull - damping * v) / motor;
      w += h * (-2.0 - hand.stiffness * (y + 1e-3) - hand.damping * w - pull) / handle;
      x += h * v;
      y += h * w;
      energy += h * damping * v * v;
    }
    energy -= f * (x - from);
    row.least_energy = std::min(row.least_energy, energy);
    judge.add(f, v, T, std::span(presses).first(x < 0.0 ? 1 : 0));
  }
  row.settling[grip] = judge.settling();
}

}  // namespace

std::vector<std::string> run_steep(const session& s) {
  s.out.section("Steep: guards",
                "Renderers of so many times most_stiffness behind make_guard, a wall or a "
                "pit of three or "
                "four, drawn at random with --seed " +
                    std::to_string(s.chosen.seed) +
                    ": 0.05 to 0.5 kg, of which 60 to 100 % are told; loops on time and late. "
                    "Quiet from 1 s after the "
                    "touch on, 1.5 s late; of a device that nobody holds, which bounces, from 2 "
                    "and 5 s, and in a flat "
                    "pit two ticks late one in fifty may never be. Shown: of the force given; the "
                    "last rows are the "
                    "control, without softens.");
  struct job {
    double times;
    int late;
    std::size_t hand, part;
    bool softens;
  };
  std::vector<job> jobs;
  for (const bool softens : {true, false}) {
    for (const double times : {0.5, 1.5, 3.0, 10.0}) {
      for (int late = 0; late < (softens ? 3 : 1); ++late) {
        for (std::size_t h = 0; h < still_hands.size(); ++h) {
          jobs.push_back({times, late, h, jobs.size(), softens});
        }
      }
    }
  }
  const int cases = s.chosen.quick ? 6 : 100;
  const auto rows = s.rows("steep.csv", "steep", jobs, [&](const job& j) {
    const auto seed = (static_cast<std::uint64_t>(s.chosen.seed) << 32U) + (j.part << 20U);
    const std::string name = ex::format("%g times", j.times) + ", " + std::to_string(j.late) +
                             " ticks late" + (j.softens ? "" : ", as given");
    quiet_row row{.scene = name, .hand = still_hands[j.hand].name, .cases = cases};
    row.in_time = guard_in_time(j.hand != 0, j.late);
    return judged(row, [&](int i) {
      const auto scene =
          draw(j.times, j.late, still_hands[j.hand], seed + static_cast<std::uint64_t>(i));
      return j.late == 0   ? run_of<0>(scene, j.softens)
             : j.late == 1 ? run_of<1>(scene, j.softens)
                           : run_of<2>(scene, j.softens);
    });
  });
  ex::show_rows(s.out, "steep", rows);
  std::vector<std::string> found;
  int rings = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (jobs[i].softens) {
      quiet_row row = rows[i];
      if (jobs[i].late > 0 && jobs[i].hand == 0 && 50 * row.unsettled <= row.judged) {
        row.unsettled = 0;
      }
      expect_quiet(found, row);
    } else if (jobs[i].times > 2.0) {
      rings += rows[i].unsettled;
    }
  }
  expect(found, rings > cases, "the control is quiet: a guard that does not soften");

  s.out.section("Steep: a cable",
                "A handle of 60 g on a cable, 1 % damped, of a motor of 40 g that has the encoder, "
                "comes down from 2 mm with "
                "2 N, in the three hands. When it is quiet, at the motor, from the touch on; "
                "watched for 6 s.");
  std::vector<cable_row> cables;
  for (const bool of_motor : {false, true}) {
    for (const double hertz : {15.0, 25.0, 40.0, 60.0, 100.0, 150.0, 200.0, 250.0, 400.0}) {
      for (const double times : {0.1, 1.0}) cables.push_back({hertz, of_motor, times, 5.0});
    }
  }
  for (const double hertz : {200.0, 250.0, 400.0}) cables.push_back({hertz, true, 1.0, 150.0});
  const auto pulled = s.rows("steep_cable.csv", "cable", cables, [](cable_row row) {
    for (std::size_t grip = 0; grip < still_hands.size(); ++grip) press_by_cable(row, grip);
    return row;
  });
  ex::show_rows(s.out, "steep_cable", pulled);
  for (const cable_row& r : pulled) {
    const bool counted = r.hand_force > 100.0;
    if (r.hertz < 200.0 || counted) {
      expect(found, r.least_energy >= -1e-9, ex::format("a cable of %.0f Hz feeds", r.hertz));
    }
    if (r.hertz >= 60.0 && r.hertz < 200.0) {
      for (const double t : r.settling) {
        expect(found, t <= 1.0, ex::format("a cable of %.0f Hz is not quiet", r.hertz));
      }
    }
  }
  return found;
}

}  // namespace contacts
