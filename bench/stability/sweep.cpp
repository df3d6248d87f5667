// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"

#include <map>

namespace stability {

namespace {

using controllers::controller;

bool has(unsigned events, ph::event e) noexcept {
  return (events >> static_cast<unsigned>(e) & 1U) != 0;
}
/// Is one of them that tells of a lost guarantee or of bad input?
bool reported(unsigned events) noexcept {
  using enum ph::event;
  return has(events, debt) || has(events, late_tick) || has(events, rejected_target) ||
         has(events, rejected_sample) || has(events, rejected_parameters);
}

/// A controller in one Space: all its cells, one after the other.
struct job {
  const controller* c;
  const char* scalar;
  int dof;
  outcome (*judge)(const controller&, const world&, const effort&);
};

std::vector<job> jobs_of(const std::vector<controller>& all) {
  std::vector<job> list;
  for (const auto& c : all) {
    list.push_back({&c, "float", 1, judge<controllers::f1>});
    list.push_back({&c, "double", 1, judge<controllers::d1>});
    if (!c.in<controllers::d3>()) continue;
    list.push_back({&c, "float", 3, judge<controllers::f3>});
    list.push_back({&c, "double", 3, judge<controllers::d3>});
  }
  return list;
}

/// How near a claim came to being broken: 1 is at the edge of what rounding explains.
double strain(const row& r) {
  return r.says == verdict::holds && r.found.least_energy < 0.0 && r.where.offset == 0.0
             ? -r.found.least_energy / (r.found.slack + r.found.blurred)
             : 0.0;
}

/// The grid, corners drawn at random, and from the cell under the greatest strain on, a walk to
/// worse ones.
std::vector<row> work(const job& j, bool quick) {
  const effort how = quick ? effort{3, 300} : effort{12, 600};
  std::vector<row> rows;
  const auto visit = [&](const world& w) -> const row& {
    rows.push_back(judged(*j.c, j.scalar, j.dof, w, j.judge(*j.c, w, how)));
    return rows.back();
  };
  for (const world& w : cells(quick)) visit(w);
  const std::uint64_t corners = quick ? 20 : 300;
  for (std::uint64_t seed = 1; seed <= corners; ++seed) visit(anywhere(seed));
  const auto worst = std::max_element(
      rows.begin(), rows.end(), [](const row& a, const row& b) { return strain(a) < strain(b); });
  world at = worst->where;
  double most = strain(*worst);
  const std::uint64_t steps = quick ? 10 : 150;
  for (std::uint64_t seed = 1; seed <= steps && most > 0.0; ++seed) {
    const row& next = visit(nearby(at, seed));
    if (strain(next) <= most) continue;
    most = strain(next);
    at = next.where;
  }
  return rows;
}

std::string events_text(unsigned events) {
  std::string text;
  for (unsigned e = 1; e <= static_cast<unsigned>(ph::event::rejected_parameters); ++e) {
    const auto what = static_cast<ph::event>(e);
    if (has(events, what)) text += (text.empty() ? "" : "; ") + std::string(to_string(what));
  }
  return text;
}

/// Numbers of cells by verdict, and what goes with it.
struct tally {
  ex::record key;  ///< what its cells have in common
  int cells = 0, stable = 0, passive = 0, finite = 0, told = 0;
  std::map<verdict, int> verdicts{};
  double strained = 0.0;

  void add(const row& r) {
    ++cells;
    stable += r.found.stable ? 1 : 0;
    passive += r.found.margin >= 0.0 ? 1 : 0;
    finite += r.found.finite ? 1 : 0;
    told += reported(r.found.events) ? 1 : 0;
    ++verdicts[r.says];
    strained = std::fmax(strained, strain(r));
  }
  [[nodiscard]] ex::record columns() const {
    const auto of = [this](verdict v) { return verdicts.contains(v) ? verdicts.at(v) : 0; };
    const int failed = of(verdict::lost) + of(verdict::no_number) + of(verdict::silent);
    ex::record all = key;
    all.emplace_back("cells", cells);
    all.emplace_back("stable", stable);
    all.emplace_back("passive", passive);
    all.emplace_back("finite", finite);
    all.emplace_back("event", told);
    for (const auto v :
         {verdict::holds, verdict::refused, verdict::told, verdict::outside, verdict::no_claim}) {
      all.emplace_back(to_string(v), of(v));
    }
    all.emplace_back("LOST, NaN, silent", failed);
    return all;
  }
};

/// Sums over rows with the same key, in order of first appearance.
template <class Key>
std::vector<tally> grouped(const std::vector<row>& rows, Key key) {
  std::vector<tally> all;
  std::map<std::string, std::size_t> where;
  for (const row& r : rows) {
    const ex::record common = key(r);
    const auto [it, fresh] = where.emplace(ex::csv_line(common), all.size());
    if (fresh) all.push_back({common});
    all[it->second].add(r);
  }
  return all;
}

/// Swing against stiffness, a line for each of a few controllers, in double and one dimension.
void plot_swing(const session& s, const std::vector<row>& rows) {
  std::map<std::string, std::string> lines;
  for (const row& r : rows) {
    const bool shown = r.where.axis == "K N/m" && std::string(r.scalar) == "double" && r.dof == 1;
    if (!shown) continue;
    for (const char* name :
         {"none", "strict FBA", "thesis", "reachable", "damped spring + reachable", "PO/PC"}) {
      if (r.controller != name) continue;
      lines[name] += ex::format("%g", r.where.stiffness) +
                     ex::format(",%.4g\n", std::fmin(std::fmax(r.found.swing, 1e-3), 1e12));
    }
  }
  s.out.plot(
      "swing",
      {"A mass falls onto ever stiffer walls",
       {ex::definition("The most mechanical energy of the second half of a run over that of the "
                       "first (0.1 kg, 0.03 N·s/m, ticks of 1 ms)."),
        {"Above the dashed line the device has gained energy from the wall, as without a "
         "controller on stiff ones;",
         [&rows] {
           return std::any_of(rows.begin(), rows.end(), [](const row& r) {
             return r.controller == "none" && r.where.axis == "K N/m" &&
                    std::string(r.scalar) == "double" && r.dof == 1 && r.found.swing > 1.0;
           });
         }},
        ex::definition("a curve that falls to the lower edge has come to rest.")}},
      "set logscale xy\nset format '10^{%L}'\nset xlabel 'stiffness of the wall [N/m]'\n"
      "set ylabel 'energy, last over first'\n" +
          ex::curves(lines) + ", 1 with lines dt 2 lt -1 title 'no gain'");
}

}  // namespace

const char* to_string(verdict v) noexcept {
  constexpr std::array names{"holds",    "refused", "told",      "outside",
                             "no claim", "LOST",    "NO NUMBER", "SILENT"};
  return names[static_cast<std::size_t>(v)];
}

std::string why_outside(const controller& c, const world& w, const outcome& found) {
  if (w.clock == clockwork::missed_and_held) return "a late tick with no watchdog";
  if (c.proved_up_to > 0.0 && w.stiffness > 2.0 * w.damping / w.tick) return "stiffer than 2b/T";
  if (c.needs_known_hands() && w.damping * w.tick > 0.1 * w.mass) return "b T/m > 0.1";
  if (!c.knows_steps && found.blurred > 1e-3 * found.exchanged && found.blurred > 1e-12) {
    return "position resolution";
  }
  return {};
}

row judged(const controller& c, const char* scalar, int dof, const world& w, const outcome& found) {
  row r{c.name, c.tag, scalar, dof, w, found, verdict::holds, {}};
  if (!found.finite) {
    r.says = verdict::no_number;
  } else if (found.refused) {
    const bool said = has(found.events, ph::event::rejected_parameters);
    r.says = said && !(found.largest_force > 0.0) ? verdict::refused : verdict::silent;
  } else if (!c.promises()) {
    r.says = verdict::no_claim;
  } else {
    r.why = why_outside(c, w, found);
    if (w.clock == clockwork::missed_and_held) {
      r.says = has(found.events, ph::event::late_tick) ? verdict::told : verdict::silent;
    } else if (!r.why.empty()) {
      r.says = verdict::outside;
    } else if (!(found.margin >= 0.0)) {
      r.says = verdict::lost;
    }
  }
  return r;
}

static ex::record record_of(const row& r) {
  return {{"controller", r.controller},
          {"tag", to_string(r.tag)},
          {"scalar", r.scalar},
          {"dof", r.dof},
          {"axis", r.where.axis},
          {"value", r.where.value},
          {"stable", r.found.stable},
          {"passive", r.found.margin >= 0.0},
          {"finite", r.found.finite},
          {"event", reported(r.found.events)},
          {"verdict", to_string(r.says)},
          {"why", r.why},
          {"least energy J", r.found.least_energy},
          {"rounding slack J", r.found.slack},
          {"position slack J", r.found.blurred},
          {"exchanged J", r.found.exchanged},
          {"largest force N", r.found.largest_force},
          {"swing", r.found.swing},
          {"events", events_text(r.found.events)}};
}

/// What is outside, by the reason.
struct reason {
  std::string why;
  int cells = 0, lost = 0;
};
static ex::record record_of(const reason& r) {
  return {{"why", r.why.c_str()}, {"cells", r.cells}, {"lost there", r.lost}};
}

std::vector<std::string> run_sweep(const session& s) {
  const auto rows = s.rows(
      "stability.csv", "stability", jobs_of(s.judged),
      [&s](const job& j) { return work(j, s.chosen.quick); }, "%.6g");
  s.out.section(
      "Stiff and extreme cells",
      "Every controller of the catalogue, float and double, 1 and 3 dimensions. stable: a mass "
      "left alone on the wall gains no energy. passive: the true port energy fell no further below "
      "zero than rounding explains, derived run by run. finite: every number that came out. event: "
      "one told of debt, lateness or refusal. holds: the tag covers the cell and nothing was lost. "
      "refused: check() names the parameter. told: a late tick, reported. outside: the tag does "
      "not cover the cell, stability.csv says why. The last column fails the program. Whether "
      "a cell is quiet is not asked: its ticks last 10 us to 100 ms and a run has 600 of them, "
      "where quiet means 5 s (docs/design/settling.md); the tables of controllers say it of the "
      "same walls.");
  const auto by_controller = grouped(rows, [](const row& r) {
    return ex::record{
        {"controller", r.controller}, {"tag", to_string(r.tag)}, {"scalar", r.scalar}};
  });
  const auto columns = [](const tally& t) { return t.columns(); };
  s.out.show(ex::table_of(by_controller, columns));
  s.out.section("By axis",
                "The same cells by what they vary; the rest is K 1e4 N/m, b 0.03 N·s/m, "
                "T 1 ms, 0.1 kg, 1 mm at the origin.");
  const auto by_axis = grouped(rows, [](const row& r) {
    const bool single = r.where.axis != "anywhere" && r.where.axis != "refined";
    return ex::record{{"axis", r.where.axis}, {"value", single ? r.where.value : "random"}};
  });
  s.out.show(ex::table_of(by_axis, columns));
  s.out.section("Outside, and why", "Cells of controllers with a tag that the tag does not cover.");
  std::vector<std::string> found;
  std::map<std::string, reason> outside;
  for (const row& r : rows) {
    if (!r.why.empty()) {
      reason& why = outside.try_emplace(r.why, reason{r.why}).first->second;
      ++why.cells;
      why.lost += r.found.margin >= 0.0 ? 0 : 1;
    }
    if (r.says != verdict::lost && r.says != verdict::no_number && r.says != verdict::silent) {
      continue;
    }
    found.push_back(r.controller + ", tagged " + to_string(r.tag) + ", " + r.scalar + ", " +
                    std::to_string(r.dof) + " DOF, " + r.where.axis + " " + r.where.value + ": " +
                    to_string(r.says) + ex::format(", least energy %.3g J", r.found.least_energy) +
                    ex::format(", explained by rounding %.3g J", r.found.slack + r.found.blurred));
  }
  std::vector<reason> reasons;
  for (const auto& [why, sum] : outside) reasons.push_back(sum);
  s.out.show(ex::table_of(reasons));
  s.out.member("controllers", ex::json_of(by_controller, [](const tally& t) {
                 ex::record all = t.columns();
                 all.emplace_back("greatest strain", t.strained);
                 return all;
               }));
  plot_swing(s, rows);
  return found;
}

}  // namespace stability
