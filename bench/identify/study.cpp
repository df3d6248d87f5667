// SPDX-License-Identifier: BSD-3-Clause
// How often each bound holds, and how near it is, on devices drawn at random.
#include "program.hpp"

namespace identify {

ex::record record_of(const verdict& v) {
  const subject& s = v.truth;
  const auto& f = v.found;
  return {{"seed", static_cast<int>(s.seed)},
          {"friction_like", to_string(s.like)},
          {"mass_kg", s.mass},
          {"mass_at_least", f.mass},
          {"damping", s.damping},
          {"damping_at_least", f.damping},
          {"damping_at_most", f.damping_max},
          {"friction_N", s.friction},
          {"friction_at_least", f.friction},
          {"presliding_um", 1e6 * s.presliding},
          {"presliding_at_most", 1e6 * f.presliding},
          {"quantum_um", 1e6 * s.quantum},
          {"quantum_at_most", 1e6 * f.quantum},
          {"noise_at_most", 1e6 * f.noise},
          {"latency", s.latency},
          {"latency_found", f.latency},
          {"load_N", s.load},
          {"load_likely", f.load},
          {"uneven", f.uneven},
          {"creep", f.creep},
          {"seconds", v.seconds},
          {"all_hold", v.all()},
          {"problem", std::string(f.problem != nullptr  ? f.problem
                                  : f.remark != nullptr ? f.remark
                                                        : "")}};
}

namespace {

/// A line of the summary.
struct line_of_study {
  std::string bound;
  int asked = 0, hold = 0;
  double middle = 0.0;  ///< of the bound over the truth, where there is something to find
  bool must = true;     ///< hold for 99 of 100

  [[nodiscard]] double share() const { return asked > 0 ? static_cast<double>(hold) / asked : 0.0; }
};
ex::record record_of(const line_of_study& l) {
  return {{"bound", l.bound},
          {"devices", l.asked},
          {"holds", l.hold},
          {"share %", 100.0 * l.share(), "%.1f"},
          {"median of bound/truth", l.middle, "%.2f"}};
}

line_of_study summed(const std::vector<verdict>& all, const std::string& bound, auto holds,
                     auto ratio) {
  line_of_study sum{.bound = bound};
  std::vector<double> ratios;
  for (const verdict& v : all) {
    if (!v.identified()) continue;
    ++sum.asked;
    sum.hold += holds(v) ? 1 : 0;
    const double r = ratio(v);
    if (r >= 0.0) ratios.push_back(r);
  }
  sum.middle = ex::median(ratios);
  return sum;
}

std::vector<line_of_study> summary_of(const std::vector<verdict>& all) {
  constexpr double nothing = -1.0;
  const auto over = [](double bound, double truth, double least) {
    return truth > least ? bound / truth : nothing;
  };
  line_of_study found{.bound = "identified at all", .asked = static_cast<int>(all.size())};
  for (const verdict& v : all) found.hold += v.identified() ? 1 : 0;
  found.middle = std::nan("");
  std::vector<line_of_study> lines{found};
  const auto add = [&](const char* name, auto holds, auto ratio) {
    lines.push_back(summed(all, name, holds, ratio));
  };
  using v = const verdict&;
  add(
      "mass, from below", [](v d) { return d.mass(); },
      [&](v d) { return over(d.found.mass, d.truth.mass, 0.0); });
  add(
      "damping, from below (b > 0.05)", [](v d) { return d.damping(); },
      [&](v d) { return over(d.found.damping, d.truth.damping, 0.05); });
  add(
      "damping, from above", [](v d) { return d.damping_max(); },
      [&](v d) { return over(d.found.damping_max, d.truth.damping, 0.05); });
  add(
      "dry friction, from below (c > 0.05)", [](v d) { return d.friction(); },
      [&](v d) { return over(d.found.friction, d.truth.friction, 0.05); });
  add(
      "presliding, from above", [](v d) { return d.presliding(); },
      [&](v d) {
        return d.found.friction > 0.0 ? over(d.found.presliding, d.truth.presliding, 0.0) : nothing;
      });
  add(
      "presliding, to within max(q, 2p)", [](v d) { return d.presliding_near(); },
      [](v) { return nothing; });
  lines.back().must = false;
  add(
      "step, from above", [](v d) { return d.quantum(); },
      [&](v d) { return over(d.found.quantum, d.truth.quantum, 0.0); });
  add(
      "noise, from above (truth 0)", [](v d) { return d.noise(); }, [](v) { return nothing; });
  add(
      "latency, from above", [](v d) { return d.latency(); },
      [&](v d) { return over(d.found.latency, d.truth.latency, 0.5); });
  add(
      "longest tick, from above", [](v d) { return d.longest_tick(); },
      [&](v d) { return over(d.found.longest_tick, 1e-3, 0.0); });
  add(
      "all of these at once", [](v d) { return d.all(); }, [](v) { return nothing; });
  lines.back().must = false;
  return lines;
}

}  // namespace

int run_study(const settings& chosen, const std::atomic<bool>& stop) {
  ex::report report(chosen.out, {.json = "identify.json", .markdown = "identify.md"});
  const ex::workshop shop{report, ex::threads_of(chosen.threads), stop};
  const auto all =
      shop.rows("identify.csv", "devices", seeds_of(chosen, chosen.study),
                [&](std::uint64_t seed) { return identified(draw(seed), chosen.how); });
  const auto lines = summary_of(all);
  report.section(
      "Bounds",
      "Devices drawn at random: 0.03 to 1 kg, 0.01 to 5 N·s/m, 0 to 0.5 N of dry friction of "
      "six kinds, presliding up to 50 µm, steps of 1 to 100 µm, up to 3 ticks of latency, a "
      "load of up to 1 N. " +
          took(all));
  ex::show_rows(report, "bounds", lines);
  ex::failures found;
  for (const auto& l : lines) {
    ex::expect(
        found, !l.must || l.share() >= 0.99,
        l.bound + ": holds for " + std::to_string(l.hold) + " of " + std::to_string(l.asked));
  }
  return ex::conclude(report, "identify", "passive_haptics: identification",
                      "Devices drawn at random, measured by their own encoder and motor: how "
                      "often the bounds that come out of it hold.",
                      found);
}

}  // namespace identify
