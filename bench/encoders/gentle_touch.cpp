// SPDX-License-Identifier: BSD-3-Clause
// Gentle touches: from 1 to 4 mm before the wall, at 5, 10 or 20 mm/s, pressed with some 2 N at most for
// up to a second, and away again. What the hand feels in the second half of the hold is the mean force
// over the mean true depth; a share of 1 of the stiffness of the law is the wall it was promised.
#include "program.hpp"
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/quiet.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <array>
#include <numeric>
#include <span>

namespace encoders {

namespace {

constexpr double T = 1e-3;                // [s]
constexpr double hand_stiffness = 300.0;  // as in with_device() [N/m]

/// A piece of the hand's way.
struct leg {
  double speed = 0.0;  ///< of its target [m/s]
  int ticks = 0;
  bool felt = false;  ///< is the wall judged in its second half?
};

/// One session of so many touches; the seed chooses speeds, forces and pauses.
std::vector<leg> session_of(const machine& m, double displayed, int touches, std::uint64_t seed) {
  sim::random_source random(seed);
  std::vector<leg> legs;
  double target = -3e-3;
  const auto go = [&](double speed, double to) {
    const int ticks = static_cast<int>(std::abs(to - target) / speed / T);
    const double signed_speed = to > target ? speed : -speed;
    legs.push_back({signed_speed, ticks});
    target += signed_speed * ticks * T;
  };
  const auto stay = [&](double seconds, bool felt) {
    legs.push_back({0.0, static_cast<int>(seconds / T), felt});
  };
  for (int i = 0; i < touches; ++i) {
    constexpr std::array speeds{5e-3, 10e-3, 20e-3};
    const double speed = speeds[static_cast<std::size_t>(random.uniform(0.0, 3.0))];
    const double force = std::min(2.0, 0.6 * m.preset.force_limit) * random.uniform(0.3, 1.0);
    const double depth = force / hand_stiffness + force / displayed;
    go(20e-3, -random.uniform(1e-3, 4e-3));
    stay(random.uniform(0.2, 1.0), false);
    go(speed, depth);
    stay(random.uniform(0.3, 1.0), true);
    go(speed, -1e-3);
  }
  return legs;
}

struct touch_row {
  machine m{};
  double stiffness = 0.0;  ///< of the wall [N/m]
  const composition* what = nullptr;
  std::vector<double> ratios{};  ///< of each touch, over what the law displays
  double first_three = 0.0;      ///< mean of the first three of each session
  double buzz = 0.0;             ///< largest swing of the device while it is held [m]
  double own_swing = 0.0;        ///< the same with an ideal spring in place of the wall [m]
  double least_energy = 0.0;     ///< at the port, friction included [J]
  ex::at_rest still{};           ///< each hold, at its end

  [[nodiscard]] double displayed() const { return what->displayed(m, stiffness); }
  [[nodiscard]] double share(double least) const {
    const auto n =
        std::count_if(ratios.begin(), ratios.end(), [=](double r) { return r >= least; });
    return ratios.empty() ? 0.0 : static_cast<double>(n) / static_cast<double>(ratios.size());
  }
  [[nodiscard]] double median() const {
    if (ratios.empty()) return 0.0;
    auto sorted = ratios;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

ex::record record_of(const touch_row& r) {
  const double budget = r.m.budget().stiffness;
  return ex::with_floor({{"device", std::string(r.m.preset.name)},
                         {"stiffness", r.stiffness, "%.0f"},
                         {"presliding_um", r.m.presliding * 1e6, "%.0f"},
                         {"composition", std::string(r.what == nullptr ? "" : r.what->name)},
                         {"budget", budget, "%.0f"},
                         {"share_080", r.share(0.8), "%.2f"},
                         {"median_ratio", r.median(), "%.2f"},
                         {"first_three_ratio", r.first_three, "%.2f"},
                         {"buzz_steps", r.buzz / r.m.preset.quantum, "%.1f"},
                         {"own_swing_steps", r.own_swing / r.m.preset.quantum, "%.1f"},
                         {"least_energy_J", r.least_energy}},
                        r.still);
}

/// The touches of one session; returns the least energy at the port.
double touch(touch_row& job, int touches, std::uint64_t seed, std::vector<double>& ratios) {
  const double surface = surface_of(job.m), displayed = job.displayed();
  const std::vector<leg> legs = session_of(job.m, displayed, touches, seed);
  const int ticks = std::accumulate(legs.begin(), legs.end(), 0,
                                    [](int sum, const leg& l) { return sum + l.ticks; });
  wall model = wall_of(*job.what, job.m, job.stiffness,
                       job.what->is_capped ? job.m.budget().stiffness : unlimited);
  return with_device(job.m, surface - 3e-3, [&](auto& device) {
    std::size_t at = 0;
    int in_leg = 0;
    double target = surface - 3e-3, force = 0.0, depth = 0.0;
    double lowest = unlimited, highest = -unlimited;
    const sim::impedance_hand<line>& fingers = device.hand();
    sim::quiet_judge<line> judge(sim::quiet_bars{}.on_encoders(
        job.m.preset.quantum, displayed, job.m.preset.mass + fingers.own_mass));
    constexpr std::array<double, 1> normal{-1.0};
    const auto hand = [&](const auto&) {
      while (at < legs.size() && in_leg == legs[at].ticks) {
        if (legs[at].felt) {
          ratios.push_back(depth > 0.0 ? force / depth / displayed : 0.0);
          job.buzz = std::max(job.buzz, highest - lowest);
          job.still.add(judge, {job.stiffness, depth > 0.0 ? force / depth : std::nan("")});
          job.still.on_floor(job.m.preset.quantum * displayed);
        }
        force = depth = 0.0;
        lowest = unlimited, highest = -unlimited;
        in_leg = 0;
        ++at;
        judge.news();
      }
      device.hand().aim(target, legs[at].speed, device.time());
      target += legs[at].speed * T;
      ++in_leg;
    };
    const auto watch = [&](const auto& now) {
      if (legs[at].felt) {
        judge.add(now.force, device.velocity(), T,
                  std::span(normal).first(now.position > surface ? 1 : 0));
      }
      if (!legs[at].felt || 2 * in_leg <= legs[at].ticks) return;
      force -= now.force;
      depth += std::max(0.0, now.position - surface);
      lowest = std::min(lowest, now.position);
      highest = std::max(highest, now.position);
    };
    return sim::run(device, model, ticks, sim::idle, hand, watch).least_energy;
  });
}

/// How far the same machine swings, touched in the same way, on a spring that knows where it is.
double swing_on_ideal_spring(const touch_row& row, int touches, int sessions) {
  static const composition ideal{
      .name = "ideal spring",
      .promises = false,
      .make = [](const design::stated_device& d, double) {
        return wall(ph::local_model{
            line{}, ph::followed<ph::half_space<line>>{}, ph::turn_at_once{}, ph::spring{},
            ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = d.longest_tick}});
      }};
  touch_row control{row.m, row.displayed(), &ideal};
  control.m.preset.quantum = 0.0;
  std::vector<double> ratios;
  for (int seed = 1; seed <= sessions; ++seed) {
    (void)touch(control, touches, static_cast<std::uint64_t>(seed), ratios);
  }
  return control.buzz;
}

std::vector<touch_row> cells(const session& s) {
  std::vector<touch_row> all;
  for (const auto& preset : sim::all_presets) {
    if (s.chosen.quick && !is_quick(preset)) continue;
    for (const double presliding : {0.0, 5e-6, 15e-6, 30e-6}) {
      if (presliding > 0.0 && !(preset.friction > 0.0)) continue;
      if (s.chosen.quick && presliding > 0.0 && presliding != 15e-6) continue;
      for (const double K : {1e3, 3e3, 1e4}) {
        for (const auto& what : s.judged) {
          if (!what.fits({preset, presliding}) || what.is_control()) continue;
          all.push_back({{preset, presliding}, K, &what});
        }
      }
    }
  }
  return all;
}

/// A device for each plot: the share of good touches over the wall's stiffness.
void plot_device(const session& s, const std::vector<touch_row>& rows, const char* device,
                 int number) {
  std::map<std::string, std::string> lines;
  for (const auto& r : rows) {
    if (std::string(r.m.preset.name) != device) continue;
    if (r.m.presliding != 0.0 && r.m.presliding != 15e-6) continue;
    const std::string name = r.what->name + ex::format(", %.0f µm", r.m.presliding * 1e6);
    lines[name] += ex::format("%g", r.stiffness) + "," + ex::format("%g", r.share(0.8)) + "\n";
  }
  s.out.plot(
      "gentle_touch_" + std::to_string(number),
      {std::string(device) + ": who feels the wall",
       {ex::definition("The share of gentle touches that feel 0.8 of the wall's stiffness or "
                       "more; dry friction is rigid (0 µm) or elastic over 15 µm. A curve at "
                       "1 always feels the wall, one at 0 never, as if it had been switched "
                       "off."),
        {"What is capped at the budget stands near 1.",
         [&rows, device] {
           double least = 1.0;
           for (const touch_row& r : rows) {
             if (std::string(r.m.preset.name) == device && r.what->is_capped) {
               least = std::min(least, r.share(0.8));
             }
           }
           return ex::at_least(least, 0.9);
         }}}},
      "set logscale x\nset xrange [900:11000]\nset xtics (1000, 3000, 10000)\nset yrange "
      "[-0.05:1.05]\nset xlabel "
      "'stiffness of the wall [N/m]'\nset ylabel 'share of touches'\n" +
          ex::curves(lines));
}

}  // namespace

std::vector<std::string> run_gentle_touch(const session& s) {
  const int sessions = s.chosen.quick ? 1 : 3, touches = s.chosen.quick ? 8 : 40;
  const auto judge = [&](touch_row row) {
    double first = 0.0;
    for (int seed = 1; seed <= sessions; ++seed) {
      std::vector<double> ratios;
      row.least_energy =
          std::min(row.least_energy, touch(row, touches, static_cast<std::uint64_t>(seed), ratios));
      for (std::size_t i = 0; i < 3; ++i) first += ratios.at(i) / 3.0;
      row.ratios.insert(row.ratios.end(), ratios.begin(), ratios.end());
    }
    row.first_three = first / sessions;
    if (row.what->is_capped) row.own_swing = swing_on_ideal_spring(row, touches, sessions);
    return row;
  };
  const auto rows = s.rows("gentle_touch.csv", "gentle touches", cells(s), judge);

  std::vector<std::string> found;
  for (const auto& r : rows) {
    if (!r.what->covers(r.m) || r.least_energy >= -1e-12) continue;
    found.push_back(std::string(r.what->name) + ", " + r.m.preset.name +
                    ex::format(", %g N/m", r.stiffness) +
                    ex::format(", presliding %g µm: lost ", r.m.presliding * 1e6) +
                    ex::format("%.3g J", -r.least_energy));
  }
  s.out.section(
      "Gentle touches",
      "Touches of 0.6 to 2 N at 5 to 20 mm/s by a hand of 150 g, 300 N/m and 5 N·s/m; half "
      "of the device's damping and friction stated, nothing lent. Ratio: force over true "
      "depth, over what the contact law displays; share_080: of the touches, those of 0.8 "
      "and more. Buzz: largest swing of the device in the second half of a hold; own swing: on "
      "an ideal spring of that stiffness, seen exactly. Least energy: at the port, what friction "
      "took and stores included. A run, for the columns on quiet, is a hold of 0.3 to 1 s." +
          std::string(ex::quiet_columns) + ex::quiet_on_steps + ex::held_last_second);
  ex::show_rows(s.out, "gentle_touch", rows);
  int number = 0;
  for (const auto& preset : sim::all_presets) {
    if (std::any_of(rows.begin(), rows.end(), [&](const touch_row& r) {
          return std::string(r.m.preset.name) == preset.name;
        })) {
      plot_device(s, rows, preset.name, ++number);
    }
  }
  return found;
}

}  // namespace encoders
