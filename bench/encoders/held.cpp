// SPDX-License-Identifier: BSD-3-Clause
// What the door makes of a device with encoders, in a hand that holds still after a world that was restless, where no two
// ticks last as long and forces come late: does it rest? A device, its loop, the hand, the walls and their news are drawn.
#include "../common/draws.hpp"
#include "program.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>
#include <numbers>

namespace encoders {

namespace {

using scene = ph::space<double, 3>;
using vector = scene::vector;
using plane = ph::half_space<scene>;
using fingers = sim::impedance_hand<scene>;

constexpr double T = 1e-3;        // the longest tick [s]
constexpr double restless = 3.0;  // [s]

enum class built : std::uint8_t { touch, corner, guard, cable, bare };
const char* to_string(built what) {
  switch (what) {
    case built::touch:
      return "make_touch";
    case built::corner:
      return "make_contacts";
    case built::guard:
      return "make_guard";
    case built::cable:
      return "told of a cable";
    case built::bare:
      return "bare spring";
  }
  return "";
}

struct held_row {
  built what{};
  int latency = 0;      ///< ticks until a command is held
  double jitter = 0.0;  ///< share of a tick by which one is shorter than the longest, at most
  bool hand = false;    ///< a hand holds the device; else a load alone pushes it
  int runs = 0;
  int seed = 1;
  double least_energy = 0.0;  ///< what friction took included [J]
  ex::at_rest still{};
};
ex::record record_of(const held_row& r) {
  return ex::with_floor({{"composition", std::string(to_string(r.what))},
                         {"late", r.latency},
                         {"jitter", r.jitter},
                         {"hand", std::string(r.hand ? "holds still" : "none")},
                         {"least_energy_J", r.least_energy}},
                        r.still);
}

/// A device, what is told of it, who holds it, and a wall that heaves.
struct drawn : ex::draws {
  sim::device_parameters<scene> device{};
  ph::encoder_device told{};
  ph::known_hand known{};
  fingers hand{};
  double stiffness = 0.0, swing = 0.0, frequency = 0.0, rate = 0.0;  // [N/m], [m], [Hz], [Hz]
  vector normal, second;

  drawn(std::uint64_t seed, const held_row& row) : ex::draws(seed) {
    device.mass = scale(0.03, 1.0);
    device.damping = scale(0.05, 1.0);
    device.friction = scale(0.02, 0.3);
    device.quantum = scale(1e-6, 60e-6);
    device.force_limit = scale(3.0, 20.0);
    device.period = T;
    device.latency = row.latency;
    normal = direction();
    second = (normal + 0.8 * direction()).normalized();
    const double push = between(0.3, 0.7) * device.force_limit;
    device.load = -push * normal;
    if (row.hand) {
      const bool stiff = chance(0.5);
      hand = {.stiffness = stiff ? 400.0 : 100.0, .damping = stiff ? 6.0 : 1.0, .limit = 1e9};
    } else {
      hand = {.stiffness = 0.0, .damping = 0.0, .limit = 1e9};
    }
    const double share = between(0.3, 1.7);  // the mass is told truly, or less
    told = {.mass = device.mass * std::min(1.0, share),
            .damping = device.damping,
            .friction = device.friction / 2.0,
            .presliding = 0.0,
            .quantum = device.quantum,
            .force_limit = device.force_limit,
            .longest_tick = T,
            .latency = row.latency};
    known.force = push + between(0.1, 10.0);
    stiffness = scale(300.0, 80e3);
    swing = scale(1e-4, 5e-3);
    frequency = between(1.0, 12.0);
    rate = scale(10.0, 100.0);
  }
};

/// One run: news(h) tells of walls that heave by h [m] along the normal, force(sample, h) is a tick [N], shown() the
/// stiffness that the port displays [N/m].
void hold(held_row& row, drawn& d, auto news, auto force, auto shown) {
  sim::device<scene, fingers> device(d.device, d.hand);
  sim::quiet_judge<scene> judge;
  ex::held_stiffness held;
  vector f = vector::Zero();
  const double last_news = restless + 1.0 / d.rate, end = last_news + ex::quiet_watched;
  double t = 0.0, next = 0.0, h = 0.0, least = 0.0;
  bool over = false;
  while (t < end) {
    const double dt = T * (1.0 - row.jitter * d.between(0.0, 1.0));
    device.set_period(dt);
    const auto sample = device.exchange(f);
    t += dt;
    if (t >= next) {
      next += 1.0 / d.rate;
      h = t < restless ? d.swing * std::sin(2.0 * std::numbers::pi * d.frequency * t) : 0.0;
      news(h);
    }
    f = force(sample, h);
    if (!over && t >= last_news) {
      over = true;
      judge.news();
    }
    judge.judge_by(sim::quiet_bars{}.on_encoders(d.device.quantum, shown(), d.device.mass));
    judge.add(f, device.velocity(), dt, std::span(&d.normal, f.norm() > 0.0 ? 1 : 0));
    if (t > end - 1.0) held.add(f.dot(d.normal), -device.position().dot(d.normal));
    least = std::min(least, device.meter().with_friction());
  }
  row.least_energy = std::min(row.least_energy, least);
  row.still.add(judge, {d.stiffness, row.what == built::corner ? std::nan("") : held.shown()});
  row.still.on_floor(shown() * d.device.quantum);
}

template <int Late>
held_row judge(held_row row) {
  using limits = ph::late_loop_limits<Late>;
  for (int i = 0; i < row.runs; ++i) {
    drawn d((static_cast<std::uint64_t>(row.seed) << 32U) + static_cast<std::uint64_t>(i), row);
    const auto port_of = [&](auto port, auto news, auto force) {
      hold(
          row, d, [&](double h) { news(port, vector(h * d.normal)); },
          [&](const auto& sample, double h) { return vector(force(port, sample, h)); },
          [&] { return port.explain().shown; });
    };
    const auto ticked = [](auto& port, const auto& sample, double /*h*/) {
      return port.tick(sample).force;
    };
    const auto one = [&](auto& port, const vector& at) {
      (void)port.update({at, d.normal, d.stiffness});
    };
    const auto spring = [&d](const vector& x, double h) -> vector {
      return std::max(0.0, d.stiffness * (h - x.dot(d.normal))) * d.normal;
    };
    switch (row.what) {
      case built::touch:
        port_of(ph::make_touch<scene, plane, limits>(d.told, d.known), one, ticked);
        break;
      case built::corner:
        port_of(
            ph::make_contacts<scene, limits>(d.told, d.known, ph::slots<plane, 2>{}),
            [&](auto& port, const vector& at) {
              (void)port.source().update(0, {at, d.normal, d.stiffness});
              (void)port.source().update(1, {at, d.second, d.stiffness / 2.0});
            },
            ticked);
        break;
      case built::guard:
        port_of(
            ph::make_guard<scene, limits>(d.told, d.known), [](auto&, const vector&) {},
            [&](auto& port, const auto& sample, double h) {
              return port.tick(sample, spring(sample.position, h)).force;
            });
        break;
      case built::cable: {
        ph::observed_transmission cable{.rotor = d.told.mass, .slew = d.scale(500.0, 20e3)};
        if (i % 2 == 1) cable.pull = d.known.force;
        port_of(ph::make_touch<scene, plane, limits>(d.told, cable, d.known), one, ticked);
        break;
      }
      case built::bare:
        hold(
            row, d, [](double) {},
            [&](const auto& sample, double h) -> vector {
              const vector f = spring(sample.position, h);
              return f * std::min(1.0, d.device.force_limit / std::max(f.norm(), 1e-9));
            },
            [&] { return d.stiffness; });
        break;
    }
  }
  return row;
}

}  // namespace

std::vector<std::string> run_held(const session& s) {
  std::vector<held_row> jobs;
  for (const auto what : {built::touch, built::corner, built::guard, built::cable, built::bare}) {
    for (const int latency : {0, 1, 2}) {
      for (const double jitter : {0.0, 0.05, 0.3, 0.6}) {
        if (s.chosen.quick && jitter != 0.3) continue;
        for (const bool hand : {true, false}) {
          jobs.push_back({what, latency, jitter, hand, s.chosen.quick ? 10 : 60, s.chosen.seed});
        }
      }
    }
  }
  const auto rows = s.rows("held.csv", "held still", jobs, [](const held_row& r) {
    return r.latency == 0 ? judge<0>(r) : r.latency == 1 ? judge<1>(r) : judge<2>(r);
  });
  s.out.section("Held still, on ticks of unequal length",
                "Devices drawn with --seed " + std::to_string(s.chosen.seed) +
                    ": 0.03 to 1 kg, 0.05 to 1 N·s/m, of dry friction half is told, steps of 1 to "
                    "60 µm, of the mass 30 to 100 %. A load of 0.3 to 0.7 of the motors' limit "
                    "pushes them onto walls of 0.3 to 80 kN/m off the axis, which heave for 3 s "
                    "with news at 10 to 100 Hz and then stay; a hand of 100 or 400 N/m holds them, "
                    "or none. With jitter, each tick is shorter than the longest by up to that "
                    "share. Told of a cable: observed_reach, and behind the motor there is none." +
                    std::string(ex::quiet_columns) + ex::quiet_on_steps + ex::held_last_second);
  ex::show_rows(s.out, "held", rows);

  std::vector<std::string> found;
  int bare_quiet = 0, bare_runs = 0;
  double bare_least = 0.0;
  for (const auto& r : rows) {
    if (r.what == built::bare) {
      bare_quiet += r.still.quiet();
      bare_runs += r.still.runs();
      bare_least = std::min(bare_least, r.least_energy);
      continue;
    }
    const std::string name = ex::format("held, %g ticks late", r.latency) +
                             ex::format(", jitter %g, ", r.jitter) + to_string(r.what);
    if (r.least_energy < -1e-12) found.push_back(name + ": loses energy");
    if (r.hand && !r.still.all_quiet()) found.push_back(name + ": quiet in " + r.still.share());
  }
  if (bare_least > -1e-6 || 2 * bare_quiet > bare_runs) {
    found.push_back("held: the bare spring is quiet, too: these scenes are too easy");
  }
  return found;
}

}  // namespace encoders
