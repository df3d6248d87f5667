// SPDX-License-Identifier: BSD-3-Clause
// Gil and others, 2010: vibration modes limit the stiffness. By how much, where the transmission gives?
#include "../devices/transmissions.hpp"
#include "program.hpp"

namespace papers {

namespace {

constexpr double at_motor = 0.1;  ///< share of the damping
constexpr double motors = 9.0, hand_force = 5.0, T = 1e-3;

/// `damping` is the motor's [N·s/m].
sim::compliant_parameters<line> arm(double mode, double damping) {
  return {
      .mass = 0.1, .share = 0.3, .mode = mode, .loss = 0.03, .damping = damping, .substeps = 40};
}

/// Does a spring K on the rotor swing up, where a damper of `behind` [N·s/m] is on the handle?
bool swings_up(const sim::compliant_parameters<line>& p, double behind, double K) {
  auto from = p;
  from.start = 1e-3;
  sim::compliant_device<line, sim::impedance_hand<line>> device(
      from, {.stiffness = 0.0, .damping = behind});
  double force = 0.0, early = 0.0, late = 0.0;
  constexpr int ticks = 6000;
  for (int n = 0; n < ticks; ++n) {
    force = -K * device.exchange(force).position;
    const double x = std::max(std::abs(device.position()), std::abs(device.handle()));
    if (!(x < 1.0)) return true;
    if (n > ticks / 6 && n < ticks / 3) early = std::max(early, x);
    if (n > ticks / 6 * 5) late = std::max(late, x);
  }
  return late > early;
}
/// The first stiffness of a series that does, refined.
double critical(const sim::compliant_parameters<line>& p, double behind) {
  double low = 5.0, high = 5.0;
  while (!swings_up(p, behind, high) && high < 1e6) low = high, high *= 1.15;
  while (high / low > 1.002) {
    const double middle = std::sqrt(low * high);
    (swings_up(p, behind, middle) ? high : low) = middle;
  }
  return low;
}

ph::exact_device stated(const sim::compliant_parameters<line>& p) {
  return {.mass = p.mass, .damping = p.damping, .force_limit = motors, .top_speed = 20.0};
}
auto as_rigid(const sim::compliant_parameters<line>& p) {
  return ph::make_touch<line>(stated(p), ph::known_hand{.force = hand_force});
}
auto as_it_is(const sim::compliant_parameters<line>& p) {
  const auto chain = ph::two_masses(p.mass, p.share, p.mode, p.loss, p.damping);
  return ph::make_touch<line>(stated(p), ph::chain_transmission<2>{.device = chain},
                              ph::known_hand{.force = hand_force});
}
auto laid(auto made, double K) {
  const auto fault = made.check();
  if (fault) ex::complain(std::string("modes: ") + fault.parameter);
  (void)made.update({0.0, -1.0, K});
  return made;
}

/// The least energy [J] under hands of 5 N.
double under_hands(const sim::compliant_parameters<line>& p, const auto& touch, double K,
                   int hands) {
  using hand = devices::drawn_hand<line>;
  double least = 0.0;
  std::mt19937 from(7u);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  auto start = p;
  start.force_limit = motors;
  for (int i = 0; i < hands; ++i) {
    hand h{.does = static_cast<hand::kind>(i % 6), .most = hand_force};
    h.frequency = std::pow(10.0, 0.3 + 2.2 * unit(from));
    h.bias = -hand_force * unit(from);
    h.amplitude = hand_force;
    h.phase = unit(from);
    h.seed = static_cast<unsigned>(from());
    if (h.does == hand::kind::kneads || h.does == hand::kind::turns_at) {
      h.bias = 4e-3 * unit(from);
      h.amplitude = 4e-3 * unit(from);
      h.stiffness = 1000.0;
    } else {
      h.bias = -h.bias;  // into the wall
    }
    start.start = -2e-3;
    sim::compliant_device<line, hand> device(start, h);
    auto model = laid(touch, K);
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 2000 && std::abs(device.position()) < 0.5; ++n) {
      sample = device.exchange(model.tick(sample).force);
    }
    least = std::min(least, device.minimum());
  }
  return least;
}

/// Since when it is quiet under a light grip [s], and the stiffness at rest [N/m].
std::pair<double, double> at_rest(const sim::compliant_parameters<line>& p, const auto& touch,
                                  double K) {
  auto start = p;
  start.force_limit = motors;
  start.start = -5e-3;
  const sim::impedance_hand<line> grip{
      .stiffness = 30.0, .damping = 0.5, .limit = hand_force, .target = 1.0 / 30.0};
  sim::compliant_device<line, sim::impedance_hand<line>> device(start, grip);
  auto model = laid(touch, K);
  sim::quiet_judge<line> judge;
  constexpr std::array<double, 1> normal{-1.0};
  auto sample = device.exchange(0.0);
  double pushed = 0.0, deep = 0.0;
  for (int n = 0; n < 6000; ++n) {
    const double f = model.tick(sample).force;
    sample = device.exchange(f);
    const double x = device.position();
    judge.add_at(f, x, T, std::span(normal).first(x > 0.0 ? 1 : 0));
    if (n >= 5000) pushed -= f, deep += x;
  }
  return {judge.since() <= 5.0 ? judge.since() : std::nan(""), pushed / deep};
}

}  // namespace

ex::record record_of(const mode_row& r) {
  return {{"mode Hz", r.mode},
          {"damping N·s/m", r.damping},
          {"rigid N/m", r.stiff},
          {"giving N/m", r.giving},
          {"taken for rigid J", r.untold},
          {"told J", r.told},
          {"shown N/m", r.shown},
          {"quiet s", r.quiet}};
}

ex::failures run_modes(const session& s) {
  s.out.section(
      "Gil, Puerto, Díaz, Sánchez, IROS 2010: modes",
      "Says (abstract): two vibration modes of one axis of a PHANToM 1.0 significantly limit the "
      "stiffness that is stable. Not given in it: their frequencies, the masses and losses, and "
      "the limits. Stated: 0.1 kg, 0.3 of it on the motor's side, one mode at 15 to 240 Hz with a "
      "loss of 0.03, damping of 0.1 and 1 N·s/m, a tenth of it the motor's, 1 kHz, nobody holds "
      "it. "
      "Rigid: K < b/(T/2). Below 2/T times the motor's own damping no mode can matter, because "
      "what it drives is passive (Colgate). "
      "Ours, asked for 10 N/mm: make_touch that takes the device for rigid, which breaks its "
      "assumption, and one that is told the chain (compliant/compositions.hpp), under hands of 5 "
      "N. Shown is "
      "the stiffness at rest.");
  struct job {
    double mode, damping;
  };
  std::vector<job> jobs;
  for (const double b : {0.1, 1.0}) {
    for (const double f : {15.0, 30.0, 60.0, 120.0, 240.0}) {
      if (!s.chosen.quick || f == 15.0 || f == 60.0 || f == 240.0) jobs.push_back({f, b});
    }
  }
  const int hands = s.chosen.quick ? 12 : 60;
  const auto rows = s.rows("modes.csv", "modes", jobs, [&](const job& j) {
    const auto p = arm(j.mode, at_motor * j.damping);
    mode_row r{.mode = j.mode, .damping = j.damping};
    r.stiff = j.damping / (T / 2.0);
    r.giving = critical(p, (1.0 - at_motor) * j.damping);
    r.untold = under_hands(p, as_rigid(p), 10e3, hands);
    r.told = under_hands(p, as_it_is(p), 10e3, hands);
    std::tie(r.quiet, r.shown) = at_rest(p, as_it_is(p), 10e3);
    return r;
  });
  s.out.show(ex::table_of(rows, [](const mode_row& r) {
    return ex::record{{"mode Hz", r.mode},
                      {"b N·s/m", r.damping},
                      {"rigid N/mm", r.stiff * 1e-3},
                      {"with mode", r.giving * 1e-3},
                      {"untold J", r.untold, "%.1g"},
                      {"told J", r.told, "%.1g"},
                      {"told, N/mm", r.shown * 1e-3},
                      {"quiet s", r.quiet, "%.2f"}};
  }));
  s.out.member("modes", ex::json_of(rows));
  ex::failures found;
  double least = 1.0, lost = 0.0, told = 0.0, softest = 1e9, stiffest = 0.0, latest = 0.0;
  bool rests = true;
  for (const auto& r : rows) {
    if (r.told < -1e-9) {
      found.push_back(ex::format("make_touch that is told a mode of %g Hz loses", r.mode) +
                      ex::format(" %.3g J", -r.told));
    }
    least = std::min(least, r.giving / r.stiff);
    lost = std::min(lost, r.untold);
    told = std::min(told, r.told);
    softest = std::min(softest, r.shown);
    stiffest = std::max(stiffest, r.shown);
    rests = rests && std::isfinite(r.quiet);
    latest = std::max(latest, r.quiet);
  }
  if (lost > -1e-9) found.push_back("taken for rigid nothing is lost, and that is no control");
  const auto ratio_at = [](const ex::recorded& r, double mode, double b) {
    const auto &f = r["mode Hz"], &damping = r["damping N·s/m"];
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (f[i] == mode && damping[i] == b) return r["giving N/m"][i] / r["rigid N/m"][i];
    }
    return std::nan("");
  };
  s.out.plot("modes",
             {"The largest stable stiffness of a bare spring, with a mode",
              {{"The two lines are rigid devices of the same damping.", "modes.csv",
                [](const ex::recorded& r) {
                  const auto& rigid = r["rigid N/m"];
                  return std::all_of(rigid.begin(), rigid.end(), [](double K) {
                    return std::abs(K - 200.0) < 1e-6 || std::abs(K - 2000.0) < 1e-6;
                  });
                }},
               {"At 15 Hz and 1 N·s/m a mode takes most of it away,", "modes.csv",
                [=](const ex::recorded& r) { return ex::at_most(ratio_at(r, 15.0, 1.0), 0.5); }},
               {"at 240 Hz nothing,", "modes.csv",
                [=](const ex::recorded& r) {
                  return ex::at_least(std::min(ratio_at(r, 240.0, 0.1), ratio_at(r, 240.0, 1.0)),
                                      0.98);
                }},
               {"and never what the motor's own damping holds.", "modes.csv",
                [](const ex::recorded& r) {
                  for (std::size_t i = 0; i < r["rigid N/m"].size(); ++i) {
                    if (r["giving N/m"][i] < 0.99 * at_motor * r["rigid N/m"][i]) return false;
                  }
                  return true;
                }}}},
             "set logscale xy\nset xlabel 'mode [Hz]'\nset ylabel 'stiffness [N/m]'\n"
             "plot 200 with lines lt -1 notitle, 2000 with lines lt -1 notitle, "
             "'modes.csv' using 1:($2 < 0.5 ? $4 : 1/0) with linespoints title 'b 0.1', "
             "'' using 1:($2 > 0.5 ? $4 : 1/0) with linespoints title 'b 1'");
  s.figures.push_back(
      {"Gil and others 2010", "modes significantly limit the stable stiffness",
       ex::format("%.2g of the rigid limit, at the worst mode", least),
       ex::format("%.3g to ", softest * 1e-3) +
           ex::format("%.3g N/mm, make_touch told the chain", stiffest * 1e-3),
       rests ? ex::format("%.2f s", latest) : "not everywhere",
       told >= -1e-9 ? "0" : ex::format("%.2g", told),
       ex::format("taken for rigid, ours loses %.2g J: state the transmission", -lost)});
  return found;
}

}  // namespace papers
