// SPDX-License-Identifier: BSD-3-Clause
#include "trial.hpp"

#include <passive_haptics/simulation/challenge.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>
#include <array>
#include <span>

namespace papers {

pressed under_a_hand(const contender& c, const facts& f, double K, const press& by, double shown,
                     ex::csv_file* csv) {
  auto parameters = f.device();
  parameters.start = -by.away;
  parameters.start_velocity = by.speed;
  parameters.substeps = std::max(2, static_cast<int>(20.0 * f.period / 1e-3));
  const sim::impedance_hand<line> hand{.stiffness = by.stiffness,
                                       .damping = by.damping,
                                       .limit = f.hand,
                                       .target = by.push / by.stiffness};
  sim::device<line, sim::impedance_hand<line>> device(parameters, hand);
  auto model = wall_of(c, f, K);
  sim::quiet_judge<line> judge(sim::quiet_bars{}.on_encoders(
      f.quantum, std::isfinite(shown) ? std::min(K, shown) : K, f.mass));
  constexpr std::array<double, 1> normal{-1.0};
  pressed result;
  bool inside = false;
  double low = 1e9, high = -1e9;
  const int ticks = static_cast<int>(by.seconds / f.period + 0.5);
  const auto seen = sim::run(device, model, ticks, sim::idle, sim::idle, [&](const auto& now) {
    const double x = device.position();
    judge.add(now.force, device.velocity(), f.period, std::span(normal).first(x > 0.0 ? 1 : 0));
    if (inside && x < 0.0) ++result.bounces;
    inside = x > 0.0;
    if (now.time > by.seconds - 1.0) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
    if (csv != nullptr) csv->row(device.time(), x, -now.force, device.meter().with_friction());
  });
  result.least_energy = seen.least_energy;
  result.quiet = judge.since() <= by.in_time ? judge.since() : std::nan("");
  result.missed = judge.missed();
  result.swing = high - low;
  return result;
}

double shown_stiffness(const contender& c, const facts& f, double K) {
  constexpr double speed = 1e-3, deepest = 20e-3;
  auto parameters = f.device();
  parameters.start = -1e-3;
  sim::prescribed_motion<line> finger(parameters);
  auto model = wall_of(c, f, K);
  auto sample = finger.exchange(0.0);
  for (;;) {
    const double force = -model.tick(sample).force, depth = finger.position();
    if (force > 0.9 * f.hand || depth > deepest) return force / depth;
    finger.move_to(depth + speed * f.period);
    sample = finger.exchange(-force);
  }
}

double under_attack(const contender& c, const facts& f, double K, int runs) {
  using sim::adversary;
  static constexpr std::array hands{adversary::tapping, adversary::random_tapping,
                                    adversary::trembling};
  static constexpr std::array motions{adversary::nyquist,     adversary::greedy,
                                      adversary::random_walk, adversary::rocking,
                                      adversary::in_step,     adversary::worst_step};
  const sim::circumstances world{.damping = f.damping,
                                 .mass = f.mass,
                                 .friction = f.friction,
                                 .hand_force = f.hand,
                                 .quantum = f.quantum,
                                 .force_limit = f.force_limit,
                                 .longest_tick = f.period,
                                 .latency = f.latency,
                                 .watchdog = false,
                                 .softest = K,
                                 .stiffest = K};
  const wall model = wall_of(c, f, K);
  double least = 0.0;
  const auto by = [&](adversary who) {
    const auto v = sim::challenge(model, who, world, runs);
    if (!(v.least_energy >= least)) least = v.least_energy;
  };
  for (const auto who : hands) by(who);
  if (c.to == promise::any_hand) {
    for (const auto who : motions) by(who);
  }
  return least;
}

outcome judged(const contender& c, const facts& f, double K, const press& by, int runs) {
  outcome o{.contender = c.name, .to = c.to, .asked = K};
  o.shown = shown_stiffness(c, f, K);
  o.pressed_by = under_a_hand(c, f, K, by, o.shown);
  o.attacked = under_attack(c, f, K, runs);
  return o;
}

ex::record record_of(const outcome& o) {
  return {{"source", o.source},
          {"model", o.model},
          {"controller", o.contender},
          {"promises", to_string(o.to)},
          {"asked N/m", o.asked},
          {"shown N/m", o.shown},
          {"quiet s", o.pressed_by.quiet},
          {"misses", sim::to_string(o.pressed_by.missed)},
          {"bounces", o.pressed_by.bounces},
          {"swing m", o.pressed_by.swing},
          {"pressed J", o.pressed_by.least_energy},
          {"attacked J", o.attacked}};
}

ex::record short_record_of(const outcome& o) {
  const auto joules = [](double E) {
    return E >= -accepted_loss ? std::string("0") : ex::format("%.2g", E);
  };
  return {{"controller", o.contender},
          {"promises", to_string(o.to)},
          {"shown N/mm", o.shown * 1e-3, "%.3g"},
          {"quiet s", o.is_quiet() ? ex::format("%.2f", o.pressed_by.quiet) : std::string("never")},
          {"bounces", o.pressed_by.bounces},
          {"pressed J", joules(o.pressed_by.least_energy)},
          {"attacked J", joules(o.attacked)}};
}

}  // namespace papers
