// SPDX-License-Identifier: BSD-3-Clause
// A cable stands between the motor, with its encoder, and the hand. How stiff a wall does each bound sustain?
#include "transmissions.hpp"

namespace devices {

namespace {

constexpr double mass = 0.1, damping = 0.1, hand = 5.0, motors = 9.0, speed = 0.5, T = 1e-3;

enum class told : std::uint8_t { all_mass, strict, observed, modelled, nothing };
constexpr std::array<const char*, 5> names{"all mass", "strict", "observed", "modelled", "spring"};
enum class scene : std::uint8_t { rests, kneads, taps };
constexpr std::array<const char*, 3> scenes{"rest", "knead", "tap"};

struct cell_row {
  int dimensions = 1, latency = 0;
  double share = 0.0, mode = 0.0;
  std::string does{};
  std::array<double, 5> stiffest{};
};

ex::record record_of(const cell_row& r) {
  ex::record all{{"dimensions", r.dimensions},
                 {"latency", r.latency},
                 {"share", r.share, "%.1f"},
                 {"mode_Hz", r.mode, "%.0f"},
                 {"hand", r.does}};
  for (std::size_t i = 0; i < names.size(); ++i) all.emplace_back(names[i], r.stiffest[i], "%.0f");
  return all;
}

template <class Space, int Late>
loop_of<Space> loop(told what, const sim::compliant_parameters<Space>& p, double K) {
  const double rotor = p.mass_of(0);
  const bold_spring law{.mass = rotor};
  const auto behind = [&](const auto& bound) {
    return wall_behind<Space, Late>(bound, law, p.damping, K, motors, T);
  };
  switch (what) {
    case told::all_mass:
      return behind(ph::reachable_bound{.mass = p.mass, .hand_force = hand});
    case told::strict:
      return behind(ph::strict_bound{});
    case told::observed: {
      const auto pull = lemma_a(p, hand, motors, speed);
      return behind(ph::observed_reach{.mass = rotor,
                                       .mass_above = rotor,
                                       .slew = pull.slew,
                                       .damping_above = p.damping,
                                       .pull = pull.most});
    }
    case told::modelled:
      return behind(
          ph::modelled_reach<2, Late>{.device = chain_of<2>(p), .hand_force = hand, .tick = T});
    case told::nothing:
      break;
  }
  return behind(ph::no_bound{});
}

/// Is 0.8 K felt for the last two of four seconds, and does the rotor not buzz where the hand rests?
template <class Space, int Late>
bool sustains(told what, const sim::compliant_parameters<Space>& p, scene which, double K) {
  using hands = drawn_hand<Space>;
  hands by{.does = hands::kind::kneads,
           .most = hand,
           .frequency = 0.01,
           .stiffness = 400.0,
           .damping = 4.0};
  if (which == scene::rests) by.bias = -0.008;
  if (which == scene::kneads) by.frequency = 2.0, by.bias = -0.006, by.amplitude = 0.005;
  if (which == scene::taps) by.frequency = 3.0, by.bias = 0.002, by.amplitude = 0.010;
  by.across = Space::dof > 1 ? 0.3 : 0.0;
  sim::compliant_device<Space, hands> arm(p, by);
  const auto touch = loop<Space, Late>(what, p, K);
  constexpr int normal = Space::dof - 1;
  auto sample = arm.exchange(Space::zero());
  double force = 0.0, depth = 0.0, swing = 0.0, last = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const auto f = touch(sample);
    const double x = Space::component(sample.position, normal);
    if (n > 2000) {
      if (x < 0.0) force += Space::component(f, normal), depth -= x;
      swing += (x - last) * (x - last);
    }
    if (std::abs(x) > 1.0) return false;
    last = x;
    sample = arm.exchange(f);
  }
  const bool buzzes = which == scene::rests && std::sqrt(swing / 2000.0) > 4e-6;
  return depth > 0.0 && force >= 0.8 * K * depth && !buzzes;
}

template <class Space, int Late>
cell_row stiffest(double share, double mode, scene which, bool quick) {
  cell_row row{Space::dof, Late, share, mode, scenes[static_cast<std::size_t>(which)], {}};
  sim::compliant_parameters<Space> p;
  p.mass = mass;
  p.share = share;
  p.mode = mode;
  p.damping = damping;
  p.substeps = 40;
  p.latency = Late;
  p.start = sim::every_axis<Space>(0.004);
  for (std::size_t i = 0; i < names.size(); ++i) {
    int fails = 0;
    for (double K = 100.0; K < 13000.0 && fails < 3; K *= quick ? 2.0 : 1.25) {
      const bool holds = sustains<Space, Late>(static_cast<told>(i), p, which, K);
      fails = holds ? 0 : fails + 1;
      if (holds) row.stiffest[i] = K;
    }
  }
  return row;
}

/// How many of the cells have 0.7 of the smaller of what is unsafe today and what the spring by itself sustains.
struct worth {
  std::string bound{};
  int dimensions = 1, latency = 0, cells = 0, enough = 0;
  double worst = 1e9;
};
ex::record record_of(const worth& w) {
  return {{"bound", w.bound}, {"dimensions", w.dimensions}, {"latency", w.latency},
          {"cells", w.cells}, {"at_least_0.7", w.enough},   {"worst", w.worst, "%.2f"}};
}

}  // namespace

ex::failures run_compliance(const session& s) {
  s.out.section("How stiff a wall through a transmission that gives",
                "0.1 kg behind a spring, share of it with the encoder; a hand of 400 N/m and 4 "
                "N·s/m up to 5 N. The "
                "largest K of a grid up to 10.8 kN/m of which 0.8 is shown, no buzz. \"All mass\" "
                "is reachable_bound "
                "told the mass that the hand feels, which is unsafe; \"spring\" has no bound.");
  struct job {
    int dimensions, latency;
    double share, mode;
    scene which;
  };
  std::vector<job> jobs;
  for (const int dimensions : {1, 3}) {
    for (const int latency : {0, 1}) {
      if (latency > 0 && (dimensions > 1 || s.chosen.quick)) continue;
      for (const double share : {0.1, 0.3, 0.5, 0.8}) {
        for (const double mode : {20.0, 40.0, 80.0, 160.0, 320.0}) {
          if (s.chosen.quick && (mode == 40.0 || mode == 160.0)) continue;
          for (const auto which : {scene::rests, scene::kneads, scene::taps}) {
            jobs.push_back({dimensions, latency, share, mode, which});
          }
        }
      }
    }
  }
  const auto rows = s.rows("compliance.csv", "walls", jobs, [&](const job& j) {
    if (j.dimensions == 3) return stiffest<d3, 0>(j.share, j.mode, j.which, s.chosen.quick);
    if (j.latency == 1) return stiffest<d1, 1>(j.share, j.mode, j.which, s.chosen.quick);
    return stiffest<d1, 0>(j.share, j.mode, j.which, s.chosen.quick);
  });
  ex::show_rows(s.out, "compliance", rows);
  std::vector<worth> sums;
  for (const int dimensions : {1, 3}) {
    for (const int latency : {0, 1}) {
      for (const auto what : {told::strict, told::observed, told::modelled}) {
        const auto i = static_cast<std::size_t>(what);
        worth w{names[i], dimensions, latency};
        for (const auto& r : rows) {
          if (r.dimensions != dimensions || r.latency != latency) continue;
          const double possible = std::min(r.stiffest[0], r.stiffest[4]);
          const double ratio = possible > 0.0 ? r.stiffest[i] / possible : 1.0;
          ++w.cells;
          w.enough += ratio >= 0.7 ? 1 : 0;
          w.worst = std::min(w.worst, ratio);
        }
        if (w.cells > 0) sums.push_back(w);
      }
    }
  }
  ex::show_rows(s.out, "compliance_worth", sums);
  return {};
}

}  // namespace devices
