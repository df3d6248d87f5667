// SPDX-License-Identifier: BSD-3-Clause
// A cable stands between the motor, with its encoder, and the hand. What do the bounds lose, told what?
#include "program.hpp"
#include <passive_haptics/simulation/compliant_device.hpp>

#include <numbers>
#include <random>

namespace devices {

namespace {

namespace sim = ph::simulation;
using line = ph::space<double, 1>;

constexpr double accepted_loss = 1e-9;  // [J]: the simulator's own error

struct attack_row {
  std::string told{};
  bool promised = false;
  double mode = 0.0, share = 0.0;
  int runs = 0, lost = 0;
  double least_energy = 0.0;
};

ex::record record_of(const attack_row& r) {
  return {{"told", r.told},
          {"promised", std::string(r.promised ? "yes" : "no")},
          {"mode_Hz", r.mode, "%.0f"},
          {"share", r.share, "%.2f"},
          {"runs", r.runs},
          {"lost", r.lost},
          {"least_energy_J", r.least_energy}};
}

/// A hand that switches between two forces.
struct square_hand {
  double bias, amplitude, frequency;

  [[nodiscard]] double force(double t, double /*x*/, double /*v*/) const noexcept {
    return bias + (std::sin(2.0 * std::numbers::pi * frequency * t) > 0.0 ? amplitude : -amplitude);
  }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

attack_row pushed(const char* told, bool promised, double mode, double share, int runs,
                  const auto& bound) {
  attack_row r{told, promised, mode, share, runs, 0, 0.0};
  for (int i = 0; i < runs; ++i) {
    std::mt19937 draw(static_cast<unsigned>(i));
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double bias = -4.0 * unit(draw);
    const square_hand hand{bias, 5.0 + bias, std::pow(10.0, 0.5 + 2.0 * unit(draw))};
    sim::compliant_device<line, square_hand> arm(
        {.mass = 0.1, .share = share, .mode = mode, .start = 0.002}, hand);
    ph::local_model touch{
        line{},
        ph::followed<ph::half_space<line>>{},
        ph::turn_at_once{},
        ph::damped_spring{.mass = 0.1 * share},
        ph::reduced_energy{.damping = 0.05},
        bound,
        ph::loop_limits{.longest_tick = 1e-3, .top_speed = 100.0, .workspace = 100.0}};
    (void)touch.update({0.0, 1.0, i % 2 == 0 ? 1e3 : 1e4});
    double f = 0.0;
    for (int n = 0; n < 2000; ++n) f = touch.tick(arm.exchange(f)).force;
    r.lost += arm.minimum() < -accepted_loss ? 1 : 0;
    r.least_energy = std::min(r.least_energy, arm.minimum());
  }
  return r;
}

}  // namespace

ex::failures run_compliance(const session& s) {
  s.out.section("A transmission that gives",
                "A motor with its encoder, a spring, and the handle behind it, 0.1 kg in all. A "
                "hand of 5 N at most "
                "switches its force. The port is the motor's.");
  struct job {
    double mode, share;
  };
  std::vector<job> jobs;
  for (const double mode : {60.0, 150.0, 300.0, 400.0}) {
    for (const double share : {0.3, 0.5, 0.7}) jobs.push_back({mode, share});
  }
  const int runs = s.chosen.quick ? 6 : 20;
  const auto rows = s.rows("compliance.csv", "transmissions", jobs, [&](const job& j) {
    return std::vector<attack_row>{
        pushed("strict_bound", true, j.mode, j.share, runs, ph::strict_bound{}),
        pushed("control: reachable_bound, all the mass", false, j.mode, j.share, runs,
               ph::reachable_bound{.mass = 0.095, .hand_force = 5.0})};
  });
  ex::show_rows(s.out, "compliance", rows);
  ex::failures found;
  int lost = 0;
  for (const auto& r : rows) {
    if (!r.promised) lost += r.lost;
    if (r.promised && r.lost > 0) {
      found.push_back(r.told + " loses " + std::to_string(-r.least_energy) + " J at " +
                      std::to_string(r.mode) + " Hz, a share of " + std::to_string(r.share));
    }
  }
  if (lost == 0) found.emplace_back("reachable_bound told all the mass loses nothing: no control");
  return found;
}

}  // namespace devices
