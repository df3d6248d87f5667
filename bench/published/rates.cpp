// SPDX-License-Identifier: BSD-3-Clause
// Choi and Tan, 2004: the stiffest clean texture grows with the update rate. Here: the stiffest quiet wall.
#include "program.hpp"

namespace papers {

namespace {

constexpr double their_rates[] = {250.0, 40e3}, theirs[] = {325.0, 904.0};  // [Hz], [N/m]

/// A PHANToM as device_facts.hpp has one, not verified; its damping is not known.
facts phantom(double rate, double damping) {
  return {.mass = 0.075,
          .damping = damping,
          .friction = 0.04,
          .quantum = 30e-6,
          .force_limit = 8.5,
          .period = 1.0 / rate};
}
constexpr press short_press{.seconds = 2.5, .in_time = 1.5};

}  // namespace

ex::record record_of(const rate_row& r) {
  return {{"rate Hz", r.rate},       {"damping N·s/m", r.damping},
          {"paper N/m", r.paper},    {"bare quiet N/m", r.bare_quiet},
          {"touch N/m", r.touch},    {"touch quiet s", r.touch_quiet},
          {"strict N/m", r.strict},  {"strict quiet s", r.strict_quiet},
          {"bare J", r.bare_energy}, {"ours J", r.ours_energy}};
}

ex::failures run_rates(const session& s) {
  s.out.section(
      "Choi and Tan, IROS 2004: update rate",
      "Says (abstract): the stiffest virtual texture that felt clean grew from 0.325 N/mm at 250 "
      "Hz to 0.904 N/mm at 40 kHz. Not given in what we could read: the device's mass, damping, "
      "friction and modes, and the figures between. So this is a flat wall and no texture, a "
      "judge and no listener, and a rigid device of 75 g, 0.04 N, steps of 30 µm and 8.5 N, with "
      "a damping of 0.05 and 0.5 N·s/m. Bare: the largest stiffness up to which every wall of a "
      "series (each 1.15 times the one before) is quiet after 1.5 s. Ours: asked for 10 N/mm.");
  std::vector<std::pair<double, double>> jobs;
  for (const double b : {0.05, 0.5}) {
    for (const double rate : {250.0, 500.0, 1e3, 2e3, 5e3, 10e3, 40e3}) {
      const bool extra = rate != 250.0 && rate != 1e3 && rate != 10e3;
      if (!(s.chosen.quick && extra)) jobs.emplace_back(rate, b);
    }
  }
  const auto& touch = contenders()[1];
  const auto& strict = contenders()[4];
  const auto rows = s.rows("rates.csv", "rates", jobs, [&](const auto& job) {
    const facts f = phantom(job.first, job.second);
    rate_row r{.rate = job.first, .damping = job.second};
    for (int i = 0; i < 2; ++i) {
      if (r.rate == their_rates[i]) r.paper = theirs[i];
    }
    for (double K = 50.0; K < 100e3; K *= 1.15) {
      if (!std::isfinite(under_a_hand(bare(), f, K, short_press, K).quiet)) break;
      r.bare_quiet = K;
    }
    const auto ours = judged(touch, f, 10e3, short_press, 3);
    const auto safe = judged(strict, f, 10e3, short_press, 3);
    r.touch = ours.shown;
    r.touch_quiet = ours.pressed_by.quiet;
    r.strict = safe.shown;
    r.strict_quiet = safe.pressed_by.quiet;
    r.bare_energy = under_attack(bare(), f, r.bare_quiet, 3);
    r.ours_energy = std::min(ours.least_energy(), safe.least_energy());
    return r;
  });
  s.out.show(ex::table_of(rows, [](const rate_row& r) {
    return ex::record{{"rate Hz", r.rate, "%.0f"},           {"b N·s/m", r.damping},
                      {"paper N/mm", r.paper * 1e-3},        {"bare, quiet", r.bare_quiet * 1e-3},
                      {"it loses J", r.bare_energy, "%.1g"}, {"make_touch", r.touch * 1e-3},
                      {"quiet s", r.touch_quiet, "%.2f"},    {"strict", r.strict * 1e-3},
                      {"ours J", r.ours_energy, "%.1g"}};
  }));
  s.out.member("rates", ex::json_of(rows));
  ex::failures found;
  for (const auto& r : rows) {
    if (r.ours_energy < -accepted_loss) found.push_back(ex::format("ours loses at %g Hz", r.rate));
    if (!std::isfinite(r.touch_quiet))
      found.push_back(ex::format("make_touch is not quiet at %g Hz", r.rate));
  }
  const auto of = [](const ex::recorded& r, const char* heading, double damping) {
    std::vector<double> some;
    for (std::size_t i = 0; i < r["damping N·s/m"].size(); ++i) {
      if (r["damping N·s/m"][i] == damping) some.push_back(r[heading][i]);
    }
    return some;
  };
  s.out.plot("rates",
             {"The stiffest quiet wall over the update rate",
              {ex::definition("Crosses: what they found, with listeners and textures."),
               {"A faster loop helps the bare spring here as it does there.", "rates.csv",
                [of](const ex::recorded& r) {
                  const auto one = of(r, "bare quiet N/m", 0.05),
                             two = of(r, "bare quiet N/m", 0.5);
                  return one.back() > one.front() && two.back() > two.front();
                }},
               {"make_touch is quiet at every rate,", "rates.csv",
                [](const ex::recorded& r) {
                  const auto& since = r["touch quiet s"];
                  return std::all_of(since.begin(), since.end(), [](double t) { return t <= 1.5; });
                }},
               {"and from 5 kHz on stiffer than their 0.904 N/mm.", "rates.csv",
                [](const ex::recorded& r) {
                  for (std::size_t i = 0; i < r["rate Hz"].size(); ++i) {
                    if (r["rate Hz"][i] >= 5e3 && !(r["touch N/m"][i] > theirs[1])) return false;
                  }
                  return true;
                }}}},
             "set logscale xy\nset xlabel 'update rate [Hz]'\nset ylabel 'stiffness [N/m]'\n"
             "plot 'rates.csv' using 1:($2 < 0.1 ? $4 : 1/0) with linespoints "
             "title 'bare, b 0.05', '' using 1:($2 > 0.1 ? $4 : 1/0) with linespoints title "
             "'bare, b 0.5', '' using 1:($2 < 0.1 ? $5 : 1/0) with linespoints title "
             "'make_touch, b 0.05', '' using 1:3 with points pt 2 ps 2 lw 3 title 'the paper'");
  const auto& slow = rows.front();
  const auto& fast = rows.back();
  const auto each = [](double a, double b) {
    return ex::format("%.3g to ", a * 1e-3) + ex::format("%.3g N/mm", b * 1e-3);
  };
  double latest = 0.0, given = 0.0, from = 0.0;  // from: the first rate of a stiffer one
  for (const auto& r : rows) {
    latest = std::max(latest, r.touch_quiet);
    given = std::min(given, r.bare_energy);
    if (!(r.touch > theirs[1])) continue;
    if (from == 0.0 || r.rate < from) from = r.rate;
  }
  s.figures.push_back(
      {"Choi, Tan 2004", "clean from 0.325 N/mm, 250 Hz, to 0.904, 40 kHz",
       each(slow.bare_quiet, fast.bare_quiet) + ", " + ex::format("%.1g J", given),
       each(slow.touch, fast.touch) + ", make_touch", ex::format("%.2f s", latest),
       slow.ours_energy >= -accepted_loss && fast.ours_energy >= -accepted_loss ? "0" : "lost",
       (slow.touch > theirs[0]
            ? std::string("more at both ends")
            : "less at 250 Hz, where " + what_binds(phantom(250.0, 0.05)) +
                  " and the bare spring gives energy away; more than 0.904 from " +
                  ex::format("%.0f Hz on", from)) +
           "; another device, no texture, no listener"});
  return found;
}

}  // namespace papers
