// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with devices drawn at random: how often is it found by name, and how often is a name false?
#include "disturbed.hpp"
#include "program.hpp"

namespace identify {

namespace {

constexpr std::array kinds{disturbance::hand,     disturbance::mode,   disturbance::backlash,
                           disturbance::fraction, disturbance::filter, disturbance::cogging,
                           disturbance::drift};

/// A line of the summary: of those that have it, how many are named in the first session, or in any until all that is
/// refused by name is mended, or then by a sentence with two names, or refused at all.
struct line_of_kind {
  std::string kind;
  int drawn = 0, named = 0, in_the_end = 0, of_two = 0, answered = 0, safe = 0;
  int without = 0, alarms = 0;
};
ex::record record_of(const line_of_kind& l) {
  return {{"disturbance", l.kind},
          {"drawn", l.drawn},
          {"named", l.named},
          {"named once others are mended", l.in_the_end},
          {"or one of two names", l.of_two},
          {"or refused", l.answered},
          {"or bounds hold", l.safe},
          {"without it", l.without},
          {"false alarms", l.alarms}};
}
bool holds(const disturbed_verdict& v) {
  return v.mass() && v.damping() && v.friction();
}

std::vector<line_of_kind> summary_of(const std::vector<mended_verdict>& all) {
  std::vector<line_of_kind> lines;
  line_of_kind total{.kind = "all"};
  for (const auto kind : kinds) {
    line_of_kind l{.kind = to_string(kind)};
    for (const auto& v : all) {
      if (v.truth.is(kind)) {
        ++l.drawn;
        l.named += v.names(kind) ? 1 : 0;
        const auto i = static_cast<std::size_t>(kind);
        l.in_the_end += v.found_in_any[i] ? 1 : 0;
        l.of_two += v.found_in_any[i] || v.one_of_two_in_any[i] ? 1 : 0;
        l.answered += v.names(kind) || v.refused() ? 1 : 0;
        l.safe += v.names(kind) || v.refused() || holds(v) ? 1 : 0;
      } else if (!v.has(kind)) {
        ++l.without;
        // Two names, and neither is true: a false alarm of the first.
        const bool neither =
            kind == disturbance::hand && v.of_two_names() && !v.truth.is(disturbance::mode);
        l.alarms += v.names(kind) || neither ? 1 : 0;
      }
    }
    total.drawn += l.drawn;
    total.named += l.named;
    total.in_the_end += l.in_the_end;
    total.of_two += l.of_two;
    total.answered += l.answered;
    total.safe += l.safe;
    total.without += l.without;
    total.alarms += l.alarms;
    lines.push_back(l);
  }
  lines.push_back(total);
  return lines;
}
struct line_of_bound {
  std::string bound;
  int stated = 0, above = 0;
};
ex::record record_of(const line_of_bound& l) {
  return {{"lower bound", l.bound}, {"stated", l.stated}, {"above the truth", l.above}};
}

}  // namespace

ex::record record_of(const mended_verdict& v) {
  std::string has, named, later;
  for (const auto kind : kinds) {
    if (v.found_in_any[static_cast<std::size_t>(kind)] && !v.names(kind)) {
      later += (later.empty() ? "" : ", ") + std::string(to_string(kind));
    }
    if (v.truth.is(kind)) has += (has.empty() ? "" : ", ") + std::string(to_string(kind));
    if (v.found.wrong.of(kind).found) {
      named += (named.empty() ? "" : ", ") + std::string(to_string(kind));
    }
  }
  const subject& s = v.truth.rigid;
  const wrongs& w = v.truth.has;
  const auto& f = v.found;
  return {{"seed", static_cast<int>(s.seed)},
          {"has", has},
          {"named", named},
          {"named later", later},
          {"sessions", v.sessions},
          {"problem", std::string(f.problem != nullptr ? f.problem : "")},
          {"mass_kg", s.mass},
          {"rotor_kg", v.truth.rotor()},
          {"rotor_at_least", f.moves_rigidly()},
          {"damping", s.damping},
          {"damping_at_least", f.damping},
          {"friction_N", s.friction},
          {"friction_at_least", f.friction},
          {"friction_like", to_string(s.like)},
          {"presliding_um", 1e6 * s.presliding},
          {"quantum_um", 1e6 * s.quantum},
          {"latency", s.latency},
          {"mode_Hz", w.mode},
          {"mode_found", f.wrong.of(disturbance::mode).size},
          {"gap_um", 1e6 * w.gap},
          {"fraction", w.fraction},
          {"lag_ms", 1e3 * w.lag},
          {"cogging_N", w.cogging},
          {"wavelength_mm", 1e3 * w.wavelength},
          {"warms", w.warms},
          {"load_drift_N_per_s", w.load_drifts},
          {"grip_N_per_m", w.grip},
          {"bounds_hold", v.mass_above + v.damping_above + v.friction_above == 0},
          {"seconds", v.longest}};
}

int run_disturbed(const settings& chosen, const std::atomic<bool>& stop) {
  ex::report report(chosen.out, {.json = "disturbed.json", .markdown = "disturbed.md"});
  const ex::workshop shop{report, ex::threads_of(chosen.threads), stop};
  const auto all =
      shop.rows("disturbed.csv", "devices", seeds_of(chosen, chosen.disturbed),
                [](std::uint64_t seed) { return identified_until_mended(draw_disturbed(seed)); });
  const auto lines = summary_of(all);
  int clean = 0, refused = 0;
  line_of_bound mass{"mass that moves with the encoder"}, damping{"damping"}, friction{"friction"};
  for (const auto& v : all) {
    bool any = false;
    for (const auto kind : kinds) any = any || v.truth.is(kind);
    clean += any ? 0 : 1;
    refused += !any && v.refused() ? 1 : 0;
    for (auto* l : {&mass, &damping, &friction}) l->stated += v.stated;
    mass.above += v.mass_above;
    damping.above += v.damping_above;
    friction.above += v.friction_above;
  }
  report.section(
      "What is wrong",
      "Devices drawn at random, each wrong by itself in 12 of 100, so several at once. " +
          took(all) + " The longest session counts of a device that is mended. " +
          std::to_string(clean) + " have nothing wrong, of which " + std::to_string(refused) +
          " were refused.");
  ex::show_rows(report, "disturbances", lines);
  const std::vector<line_of_bound> bounds{mass, damping, friction};
  ex::show_rows(report, "lower bounds", bounds);
  ex::failures found;
  for (const auto& l : bounds) {
    ex::expect(found, l.above == 0,
               l.bound + ": above the truth on " + std::to_string(l.above) + " devices");
  }
  for (const auto& l : lines) {
    ex::expect(
        found, l.alarms * 50 <= l.without,
        l.kind + ": " + std::to_string(l.alarms) + " false alarms of " + std::to_string(l.without));
  }
  return ex::conclude(report, "identify", "passive_haptics: what is wrong with a device",
                      "Devices with hands, modes, backlash, late and filtered forces, cogging and "
                      "drift: how often each is found.",
                      found);
}

}  // namespace identify
