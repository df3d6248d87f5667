// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

namespace encoders {

const std::vector<ex::section<session>>& sections() {
  static const std::vector<ex::section<session>> all{
      {"gentle_touch", run_gentle_touch}, {"endurance", run_endurance}, {"tremor", run_tremor},
      {"crossed", run_crossed},           {"nearest", run_nearest},     {"held", run_held},
      {"guarantee", run_guarantee}};
  return all;
}

namespace {

void show_budgets(const session& s) {
  s.out.section("Devices",
                "Simulated, with half of their damping and friction stated. Budget: the largest "
                "stiffness that the ledger can be fed for (design/stiffness_budget.hpp), by "
                "presliding of rigid friction; what binds.");
  struct row {
    machine m{};
  };
  std::vector<row> rows;
  for (const auto& preset : sim::all_presets) rows.push_back({{preset}});
  s.out.show(ex::table_of(rows, [](const row& r) {
    const auto d = r.m.stated();
    const auto b = design::stiffness_budget(d);
    return ex::record{{"device", std::string(r.m.preset.name)},
                      {"mass kg", r.m.preset.mass},
                      {"damping N·s/m", r.m.preset.damping},
                      {"friction N", r.m.preset.friction},
                      {"step µm", r.m.preset.quantum * 1e6, "%.1f"},
                      {"motors N", r.m.preset.force_limit, "%.1f"},
                      {"budget N/m", b.stiffness, "%.0f"},
                      {"binds", to_string(b.binding)},
                      {"working capital mJ", b.working_capital * 1e3, "%.2f"},
                      {"loan for a first touch mJ", b.loan * 1e3, "%.2f"}};
  }));
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen{{"encoders"}};
  ex::read_options("encoders",
                   ex::section_options(sections(), chosen, "two devices, fewer touches and seconds",
                                       {ex::a_seed("of the scenes held still", chosen.seed)}),
                   arguments);
  return chosen;
}

int run(const std::vector<std::string>& arguments, const std::vector<composition>& judged,
        const std::atomic<bool>& stop) {
  return ex::guarded("encoders", [&] {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "encoders.json", .markdown = "encoders.md"});
    const session s{{report, ex::threads_of(chosen.threads), stop}, chosen, judged};
    show_budgets(s);
    const auto found = ex::run_sections(sections(), chosen.only, s);
    return ex::conclude(report, "encoders", "passive_haptics: walls on encoders",
                        "What a hand feels of a guaranteed wall where positions come in steps and "
                        "friction is elastic, and how stiff a wall may be to last.",
                        found);
  });
}

}  // namespace encoders
