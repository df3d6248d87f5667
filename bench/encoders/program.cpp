// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

namespace encoders {

const std::vector<section>& sections() {
  static const std::vector<section> all{{"gentle_touch", run_gentle_touch},
                                        {"endurance", run_endurance},
                                        {"guarantee", run_guarantee}};
  return all;
}

namespace {

std::vector<std::string> some_sections(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, ',');) {
    const auto is = [&name](const section& s) { return name == s.name; };
    if (std::none_of(sections().begin(), sections().end(), is)) {
      ex::complain("--only " + name + ": there are gentle_touch, endurance, guarantee");
    }
    list.push_back(name);
  }
  if (list.empty()) ex::complain("--only: name some of gentle_touch, endurance, guarantee");
  return list;
}

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
  settings chosen;
  ex::read_options(
      "encoders",
      {ex::a_switch("--quick", "two devices, fewer touches and seconds", chosen.quick),
       ex::a_text("--out DIR", "where the results go (default: encoders)", chosen.out),
       {"--only LIST", "of the sections, with commas between (default: all)",
        [&](const std::string& text) { chosen.only = some_sections(text); }},
       ex::a_number("--threads", "(default: as many as the machine has)", chosen.threads)},
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
    ex::failures found;
    for (const auto& part : sections()) {
      const auto& only = chosen.only;
      if (!only.empty() && std::find(only.begin(), only.end(), part.name) == only.end()) continue;
      for (auto& sentence : part.run(s)) found.push_back(std::move(sentence));
    }
    return ex::conclude(report, "encoders", "passive_haptics: walls on encoders",
                        "What a hand feels of a guaranteed wall where positions come in steps and "
                        "friction is elastic, and how stiff a wall may be to last.",
                        found);
  });
}

}  // namespace encoders
