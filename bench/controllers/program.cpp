// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

namespace controllers {

namespace {

/// The tag, and what is proved beyond it.
std::string promise_of(const controller& c) {
  const bool more = c.proved_up_to > 0.0;
  return to_string(c.tag) + (more ? ex::format("; strict to %g N/m", c.proved_up_to) : "");
}

/// The sections that were asked for; returns what contradicts the tags.
std::vector<std::string> judge(const session& s) {
  s.out.section(
      "Controllers",
      std::string("The tag is the type's own promise: strict for every motion and environment, "
                  "conditional under the assumptions named in the header, none. What each header "
                  "assumes beside that: a lower bound of the damping, exact positions, the force "
                  "held known, no tick longer than the longest.") +
          (s.chosen.seed == 1
               ? ""
               : " Drawn with --seed " + std::to_string(s.chosen.seed) +
                     ": schedules and hands of all sections; masses, damping and forces "
                     "of the hands of the adversaries; device and hand at the walls of "
                     "0.5 to 16 kN/m; mass, load and wall of each case that falls. "
                     "The device of § 5 stays, since figures of others stand beside "
                     "it."));
  s.out.show(ex::table_of(s.judged, [](const controller& c) {
    return ex::record{{"controller", c.name},
                      {"tag", promise_of(c)},
                      {"dimensions", c.in<d3>()   ? "1, 2, 3"
                                     : c.in<d2>() ? "1, 2"
                                                  : "1"},
                      {"composition", c.composition}};
  }));
  return ex::run_sections(sections(), s.chosen.only, s);
}

}  // namespace

const std::vector<ex::section<session>>& sections() {
  static const std::vector<ex::section<session>> all{{"wall", run_wall},
                                                     {"adversaries", run_adversaries},
                                                     {"assumptions", run_assumptions},
                                                     {"stiffness", run_stiffness},
                                                     {"settling", run_settling},
                                                     {"z_width", run_z_width}};
  return all;
}

int run(const std::vector<std::string>& arguments, const std::vector<controller>& judged,
        const std::atomic<bool>& stop) {
  return ex::guarded("controllers", [&] {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "controllers.json", .markdown = "controllers.md"});
    const session s{{report, ex::threads_of(chosen.threads), stop}, chosen, judged};
    ex::failures found;
    if (chosen.merge.empty()) {
      found = judge(s);
    } else {
      merge_z_width(s, chosen.merge);
    }
    if (chosen.part.of > 1) return 0;  // a part is no report
    return ex::conclude(report, "controllers", "passive_haptics: all controllers side by side",
                        "Every composition on the same walls, against the same hands and "
                        "adversaries: what it promises, what it keeps, and how it feels.",
                        found);
  });
}

}  // namespace controllers
