// SPDX-License-Identifier: BSD-3-Clause
#include "sweep.hpp"

#include "../common/work.hpp"

#include <map>

namespace stability {

namespace {

using controllers::controller;

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
    if (c.in_3_float) list.push_back({&c, "float", 3, judge<controllers::f3>});
    if (c.in_3) list.push_back({&c, "double", 3, judge<controllers::d3>});
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

std::string yes(bool b) {
  return b ? "yes" : "no";
}

std::string events_text(unsigned events) {
  std::string text;
  for (unsigned e = 1; e <= static_cast<unsigned>(ph::event::rejected_parameters); ++e) {
    const auto what = static_cast<ph::event>(e);
    if (has(events, what)) text += (text.empty() ? "" : "; ") + std::string(to_string(what));
  }
  return text;
}

std::string csv_line(const row& r) {
  const auto number = [](double x) { return ex::format("%.6g", x); };
  return '"' + r.controller + "\"," + to_string(r.tag) + ',' + r.scalar + ',' +
         std::to_string(r.dof) + ",\"" + r.where.axis + "\",\"" + r.where.value + "\"," +
         yes(r.found.stable) + ',' + yes(r.found.margin >= 0.0) + ',' + yes(r.found.finite) + ',' +
         yes(reported(r.found.events)) + ',' + to_string(r.says) + ",\"" + r.why + "\"," +
         number(r.found.least_energy) + ',' + number(r.found.slack) + ',' +
         number(r.found.blurred) + ',' + number(r.found.exchanged) + ',' +
         number(r.found.largest_force) + ',' + number(r.found.swing) + ",\"" +
         events_text(r.found.events) + '"';
}

/// Numbers of cells by verdict, and what goes with it.
struct tally {
  int cells = 0, stable = 0, passive = 0, finite = 0, told = 0;
  std::map<verdict, int> verdicts;
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
  [[nodiscard]] int of(verdict v) const {
    const auto it = verdicts.find(v);
    return it == verdicts.end() ? 0 : it->second;
  }
  [[nodiscard]] std::vector<std::string> columns() const {
    const int failed = of(verdict::lost) + of(verdict::no_number) + of(verdict::silent);
    std::vector<std::string> all;
    for (const int n :
         {cells, stable, passive, finite, told, of(verdict::holds), of(verdict::refused),
          of(verdict::told), of(verdict::outside), of(verdict::no_claim), failed}) {
      all.push_back(std::to_string(n));
    }
    return all;
  }
};

const std::vector<std::string> tally_heading{"cells",   "stable",   "passive",          "finite",
                                             "event",   "holds",    "refused",          "told",
                                             "outside", "no claim", "LOST, NaN, silent"};

ex::table table_of(const std::vector<std::string>& keys,
                   const std::vector<std::pair<std::vector<std::string>, tally>>& lines) {
  std::vector<std::string> heading = keys;
  heading.insert(heading.end(), tally_heading.begin(), tally_heading.end());
  ex::table shown(heading);
  for (const auto& [key, sum] : lines) {
    std::vector<std::string> line = key;
    for (const auto& column : sum.columns()) line.push_back(column);
    shown.add(line);
  }
  return shown;
}

/// Sums over rows with the same key, in order of first appearance.
template <class Key>
std::vector<std::pair<std::vector<std::string>, tally>> grouped(const std::vector<row>& rows,
                                                                Key key) {
  std::vector<std::pair<std::vector<std::string>, tally>> lines;
  std::map<std::vector<std::string>, std::size_t> where;
  for (const row& r : rows) {
    const auto k = key(r);
    const auto [it, fresh] = where.emplace(k, lines.size());
    if (fresh) lines.emplace_back(k, tally{});
    lines[it->second].second.add(r);
  }
  return lines;
}

std::string json_of(const std::vector<std::pair<std::vector<std::string>, tally>>& lines) {
  std::vector<std::string> items;
  for (const auto& [key, sum] : lines) {
    std::vector<std::pair<std::string, std::string>> members{
        {"controller", ex::json_string(key[0])},
        {"tag", ex::json_string(key[1])},
        {"scalar", ex::json_string(key[2])},
        {"greatest_strain", ex::json_number(sum.strained)}};
    const auto columns = sum.columns();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      members.emplace_back(tally_heading[i], columns[i]);
    }
    items.push_back(ex::json_object(members));
  }
  return ex::json_array(items);
}

/// Swing against stiffness, a column for each of a few controllers, in double and one dimension.
void plot_swing(const session& s, const std::vector<row>& rows) {
  const std::vector<std::string> shown{
      "none", "strict FBA", "thesis", "reachable", "damped spring + reachable", "PO/PC"};
  std::string heading = "K N/m";
  for (const auto& name : shown) heading += ',' + name;
  ex::csv_file csv(s.out.path("swing.csv"), heading);
  std::map<double, std::map<std::string, double>> at;
  for (const row& r : rows) {
    if (r.where.axis == "K N/m" && std::string(r.scalar) == "double" && r.dof == 1) {
      at[r.where.stiffness][r.controller] = r.found.swing;
    }
  }
  for (const auto& [K, by] : at) {
    std::string line = ex::format("%g", K);
    for (const auto& name : shown) {
      const auto it = by.find(name);
      const double swing = it == by.end() ? 0.0 : it->second;
      line += ',' + ex::format("%.4g", std::fmin(std::fmax(swing, 1e-3), 1e12));
    }
    csv.line(line);
  }
  csv.close();
  s.out.plot("swing",
             "A mass falling onto the wall: most mechanical energy of the second half of the run "
             "over the first, against stiffness (b 0.03 N·s/m, T 1 ms, 0.1 kg; above 1 it gains)",
             "set logscale xy\nset xlabel 'K [N/m]'\nset ylabel 'energy, last over first'\n"
             "plot for [i=2:" +
                 std::to_string(shown.size() + 1) +
                 "] 'swing.csv' using 1:i with linespoints lw 2, 1 with lines dt 2 lc 'black' "
                 "title 'no gain'");
}

}  // namespace

const char* to_string(verdict v) noexcept {
  switch (v) {
    case verdict::holds:
      return "holds";
    case verdict::refused:
      return "refused";
    case verdict::told:
      return "told";
    case verdict::outside:
      return "outside";
    case verdict::no_claim:
      return "no claim";
    case verdict::lost:
      return "LOST";
    case verdict::no_number:
      return "NO NUMBER";
    case verdict::silent:
      return "SILENT";
  }
  return "unknown verdict";
}

std::string why_outside(const controller& c, const world& w, const outcome& found) {
  if (w.clock == clockwork::missed_and_held) return "a late tick with no watchdog";
  if (!c.covers.any_clock && w.clock != clockwork::steady) return "ticks that vary";
  if (ph::kernels::is_finite(c.covers.stiffest) && w.stiffness > 2.0 * w.damping / w.tick) {
    return "stiffer than 2b/T";
  }
  if (!c.covers.any_motion && w.damping * w.tick > 0.1 * w.mass) return "b T/m > 0.1";
  if (!c.covers.rounding && found.blurred > 1e-3 * found.exchanged && found.blurred > 1e-12) {
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
  } else if (c.tag == ph::guarantee::none) {
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

std::vector<std::string> run_sweep(const session& s) {
  const auto jobs = jobs_of(s.judged);
  std::vector<row> rows;
  ex::csv_file csv(s.out.path("stability.csv"),
                   "controller,tag,scalar,dof,axis,value,stable,passive,finite,event,verdict,why,"
                   "least energy J,rounding slack J,position slack J,exchanged J,largest force N,"
                   "swing,events");
  ex::progress bar("stability", static_cast<int>(jobs.size()));
  const std::atomic<bool> never = false;
  ex::work_through(
      static_cast<int>(jobs.size()), s.chosen.threads, never,
      [&](int i) { return work(jobs[static_cast<std::size_t>(i)], s.chosen.quick); },
      [&](int, std::vector<row> some) {
        for (row& r : some) {
          csv.line(csv_line(r));
          rows.push_back(std::move(r));
        }
        bar.step();
      });
  csv.close();

  s.out.section(
      "Stiff and extreme cells",
      "Every controller of the catalogue, float and double, 1 and 3 dimensions. stable: a mass "
      "left alone on the wall gains no energy. passive: the true port energy fell no further below "
      "zero than rounding explains, derived run by run. finite: every number that came out. event: "
      "one told of debt, lateness or refusal. holds: the tag covers the cell and nothing was lost. "
      "refused: check() names the parameter. told: a late tick, reported. outside: the tag does "
      "not "
      "cover the cell, stability.csv says why. The last column fails the program.");
  const auto by_controller = grouped(rows, [](const row& r) {
    return std::vector<std::string>{r.controller, to_string(r.tag), r.scalar};
  });
  s.out.show(table_of({"controller", "tag", "scalar"}, by_controller));
  s.out.section("By axis",
                "The same cells by what they vary; the rest is K 1e4 N/m, b 0.03 N·s/m, "
                "T 1 ms, 0.1 kg, 1 mm at the origin.");
  s.out.show(
      table_of({"axis", "value"}, grouped(rows, [](const row& r) {
                 const bool single = r.where.axis != "anywhere" && r.where.axis != "refined";
                 return std::vector<std::string>{r.where.axis, single ? r.where.value : "random"};
               })));
  s.out.section("Outside, and why", "Cells of controllers with a tag that the tag does not cover.");
  ex::table reasons({"why", "cells", "lost there"});
  std::map<std::string, std::pair<int, int>> why;
  for (const row& r : rows) {
    if (r.why.empty()) continue;
    ++why[r.why].first;
    why[r.why].second += r.found.margin >= 0.0 ? 0 : 1;
  }
  for (const auto& [reason, n] : why) {
    reasons.add({reason, std::to_string(n.first), std::to_string(n.second)});
  }
  s.out.show(reasons);
  s.out.member("controllers", json_of(by_controller));
  plot_swing(s, rows);

  std::vector<std::string> found;
  for (const row& r : rows) {
    if (r.says != verdict::lost && r.says != verdict::no_number && r.says != verdict::silent) {
      continue;
    }
    found.push_back(r.controller + ", tagged " + to_string(r.tag) + ", " + r.scalar + ", " +
                    std::to_string(r.dof) + " DOF, " + r.where.axis + " " + r.where.value + ": " +
                    to_string(r.says) + ex::format(", least energy %.3g J", r.found.least_energy) +
                    ex::format(", explained by rounding %.3g J", r.found.slack + r.found.blurred));
  }
  return found;
}

}  // namespace stability
