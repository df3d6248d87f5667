// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <passive_haptics/design/stiffness_budget.hpp>

namespace papers {

const std::vector<ex::section<session>>& sections() {
  static const std::vector<ex::section<session>> all{
      {"limits", run_limits}, {"rates", run_rates}, {"bounces", run_bounces},
      {"stiff", run_stiff},   {"modes", run_modes}, {"thesis", run_thesis}};
  return all;
}

std::vector<outcome> all_on(const session& s, const std::string& source, const std::string& model,
                            const facts& f, double asked, const press& by, ex::failures& found,
                            bool must_lose) {
  std::vector<outcome> rows;
  auto judged_ones = contenders();
  judged_ones.push_back(passivity_controlled());
  for (const auto& c : judged_ones) {
    rows.push_back(judged(c, f, asked, by, s.chosen.quick ? 3 : 30));
    rows.back().source = source;
    rows.back().model = model;
    const auto& o = rows.back();
    if (o.to == promise::nothing || o.least_energy() >= -accepted_loss) continue;
    found.push_back(o.contender + " on " + model + " promises " + to_string(o.to) + " and loses " +
                    ex::format("%.3g", -o.least_energy()) + " J");
  }
  if (must_lose && rows.front().least_energy() >= -accepted_loss) {
    found.push_back("the bare spring on " + model + " loses nothing, and is no control");
  }
  s.out.section(source + ": " + model, ex::format("A wall of %g N/m.", asked));
  s.out.show(ex::table_of(rows, short_record_of));
  return rows;
}

const outcome& best_of(const std::vector<outcome>& rows) {
  const outcome* best = &rows.front();
  for (const auto& o : rows) {
    const bool counts = o.to != promise::nothing && o.is_quiet() &&
                        o.least_energy() >= -accepted_loss && std::isfinite(o.shown);
    if (counts && (best == &rows.front() || o.shown > best->shown)) best = &o;
  }
  return *best;
}

std::string what_binds(const facts& f) {
  namespace design = ph::design;
  if (!(f.quantum > 0.0)) return "sampled mass";
  const auto budget = design::stiffness_budget(ph::encoder_device{.mass = f.mass,
                                                                  .damping = f.damping,
                                                                  .friction = f.friction,
                                                                  .presliding = 0.0,
                                                                  .quantum = f.quantum,
                                                                  .force_limit = f.force_limit,
                                                                  .longest_tick = f.period});
  return std::string(design::to_string(budget.binding)) +
         ex::format(" allows %.3g N/mm", budget.stiffness * 1e-3);
}

figure figure_of(const std::string& source, const std::string& says,
                 const std::vector<outcome>& rows, const std::string& verdict) {
  const auto &spring = rows.front(), &best = best_of(rows);
  const auto quiet = [](const outcome& o) {
    return o.is_quiet() ? ex::format("%.2f s", o.pressed_by.quiet) : std::string("never");
  };
  return {source,
          says,
          ex::format("%.3g N/mm, ", spring.shown * 1e-3) + quiet(spring) +
              ex::format(", %.2g J", spring.least_energy()),
          ex::format("%.3g N/mm, ", best.shown * 1e-3) + best.contender,
          quiet(best),
          best.least_energy() >= -accepted_loss ? "0" : ex::format("%.2g", best.least_energy()),
          verdict};
}

settings parse(const std::vector<std::string>& arguments) {
  settings chosen{"published"};
  ex::read_options("published",
                   ex::section_options(sections(), chosen, "fewer attacks, rates and modes"),
                   arguments);
  return chosen;
}

namespace {
void show(const std::vector<figure>& figures, ex::report& out) {
  std::vector<ex::record> rows;
  for (const auto& f : figures) {
    rows.push_back({{"source", f.source},
                    {"paper says", f.says},
                    {"bare spring there", f.bare},
                    {"ours shows", f.ours},
                    {"quiet after", f.quiet},
                    {"J", f.joules},
                    {"so", f.verdict}});
  }
  out.section("In one table",
              "The stiffest of ours that lost nothing, pressed or attacked, and came to rest. "
              "Bare: stiffness shown, quiet after, the most it gave away.");
  out.show(ex::table_of(rows));
  out.member("figures", ex::json_of(rows));
}
}  // namespace

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("published", [&] {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "published.json", .markdown = "published.md"});
    std::vector<figure> figures;
    const session s{{report, ex::threads_of(chosen.threads), stop}, chosen, figures};
    const auto found = ex::run_sections(sections(), chosen.only, s);
    show(figures, report);
    return ex::conclude(
        report, "published", "passive_haptics: figures that papers give, and ours",
        "The same model with the same numbers, in simulation; where a paper does not give a "
        "number, the page says so and states one.",
        found);
  });
}

}  // namespace papers
