// SPDX-License-Identifier: BSD-3-Clause
// cost: what a tick costs, composed from the library and written by hand.
//
//     cost --count PROGRAM --count PROGRAM --baseline FILE --out DIR
//     cost --help                                       all options
//
// Instructions are counted by callgrind and exact; growth of more than 1 % over the committed baseline
// fails, by name. Times are paired and interleaved, and worth their ratios only.

#include "../common/rows.hpp"
#include "counts.hpp"
#include "paired.hpp"
#include "parts.hpp"

#include <cmath>

namespace {

namespace ex = experiments;

struct settings {
  std::string out = "cost";
  std::string baseline;
  std::string page;
  std::vector<std::filesystem::path> programs;
  std::string meshes;
  bool quick = false;
  bool rewrite = false;
};

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  ex::read_options(
      "cost",
      {ex::a_switch("--quick", "instructions only, no clock", chosen.quick),
       {"--count PROGRAM...", "builds of count.cpp, whose instructions are counted",
        [&](const std::string& program) { chosen.programs.emplace_back(program); }},
       ex::a_text("--meshes PROGRAM", "a build of count_meshes.cpp, counted tick by tick",
                  chosen.meshes),
       ex::a_text("--baseline FILE", "fails if a count has grown by more than 1 % over it",
                  chosen.baseline),
       ex::a_text("--page FILE", "fails if its counted lines are more than 1 % off", chosen.page),
       ex::a_switch("--rewrite", "writes baseline and page anew instead", chosen.rewrite),
       ex::a_text("--out DIR", "where the results go (default: " + chosen.out + ")", chosen.out)},
      arguments, [&] {
        if (chosen.rewrite && chosen.baseline.empty()) {
          ex::complain("--rewrite: name the --baseline to write");
        }
      });
  return chosen;
}

const std::vector<std::string> scenes{"wall", "half_space", "triangle"};
const std::vector<std::string> scalars{"float", "double"};

/// "104.0 / 104.5 = 0.995", all paths of a scene together, or one.
std::string side_by_side(const cost::counts& build, const std::string& scene,
                         const std::string& scalar, const std::string& path) {
  const auto* ours = build.find(scene + ", " + scalar + ", composed, " + path);
  const auto* theirs = build.find(scene + ", " + scalar + ", by hand, " + path);
  if (ours == nullptr || theirs == nullptr) return "-";
  return ex::format("%.0f / ", ours->per_tick()) + ex::format("%.0f = ", theirs->per_tick()) +
         ex::format("%.3f", ours->per_tick() / theirs->per_tick());
}

void show_counts(ex::report& out, ex::csv_file& csv, const std::vector<cost::counts>& all) {
  std::vector<ex::record> rows;
  for (const auto& build : all) {
    for (const auto& scene : scenes) {
      for (const auto& scalar : scalars) {
        ex::record row{{"compiler", build.compiler},
                       {"scene", scene},
                       {"scalar", scalar},
                       {"relative to by hand", build.ratio(scene, scalar), "%.3f"}};
        for (const auto path : cost::all_paths) {
          const char* const way = cost::to_string(path);
          row.emplace_back(way, side_by_side(build, scene, scalar, way));
        }
        rows.push_back(row);
      }
    }
    for (const auto& row : build.rows) {
      csv.line(build.compiler + ',' + row.scene + ',' + row.scalar + ',' + row.side + ',' +
               row.path + ',' + ex::format("%.2f", row.per_tick()) + ',' +
               std::to_string(row.ticks));
    }
  }
  out.section("Instructions per tick",
              "Counted by callgrind, -O3 -ffp-contract=off. The ratio is over the whole workload; "
              "then composed / by hand for each path of a tick.");
  ex::show_rows(out, "instructions", rows);
}

/// The rows of the parts, and the same as lines of the page: a part a line.
struct part_rows {
  std::vector<ex::record> rows{};
  std::string page =
      "| scene | 1-DOF float | bytes | 3-DOF double | bytes |\n|---|---|---|---|---|\n";
};
/// Two rows for a part: instructions per tick of each build, state in bytes.
template <template <class, int> class Part>
void add_part(part_rows& to, const std::vector<cost::counts>& all, const std::string& scene) {
  std::string line = std::string("| ") + Part<float, 1>::name;
  const auto add = [&](auto part, const char* port, const char* scalar) {
    using chosen = decltype(part);
    constexpr auto bytes = sizeof(chosen::composed({}));
    ex::record row{{"scene", std::string(chosen::name)}, {"port", port}};
    std::string counts;
    for (const auto& build : all) {
      row.emplace_back(build.compiler, build.per_tick(scene, scalar), "%.1f");
      counts += (counts.empty() ? "" : " / ") + ex::format("%.0f", build.per_tick(scene, scalar));
    }
    row.emplace_back("state bytes", bytes);
    to.rows.push_back(row);
    line += " | " + counts + " | " + std::to_string(bytes);
  };
  add(Part<float, 1>{}, "1-DOF float", "float");
  add(Part<double, 3>{}, "3-DOF double", "double");
  to.page += line + " |\n";
}

/// The ratios to what is written by hand, as lines of the page: a scene a line.
std::string ratio_lines(const std::vector<cost::counts>& all) {
  std::string heading = "| composed / by hand |", rule = "|---|", lines;
  for (const auto& scene : scenes) {
    lines += "| " + scene + " |";
    for (const auto& build : all) {
      for (const auto& scalar : scalars) {
        if (scene == scenes.front()) heading += ' ' + build.compiler + ", " + scalar + " |";
        if (scene == scenes.front()) rule += "---|";
        lines += ex::format(" %.3f |", build.ratio(scene, scalar));
      }
    }
    lines += '\n';
  }
  return heading + '\n' + rule + '\n' + lines;
}

/// What each part costs; returns which parts that a scene has no use for cost instructions, and crowds that cost too much.
std::vector<std::string> show_parts(ex::report& out, const std::vector<cost::counts>& all,
                                    part_rows& rows) {
  add_part<cost::part_bare>(rows, all, "part_bare");
  add_part<cost::part_turning>(rows, all, "part_turning");
  add_part<cost::part_counting>(rows, all, "part_counting");
  add_part<cost::part_strict>(rows, all, "part_strict");
  add_part<cost::part_limited>(rows, all, "part_limited");
  add_part<cost::part_following>(rows, all, "part_following");
  add_part<cost::part_stepped>(rows, all, "part_stepped");
  add_part<cost::part_rubbing>(rows, all, "part_rubbing");
  add_part<cost::part_reachable>(rows, all, "part_reachable");
  add_part<cost::part_plane>(rows, all, "part_plane");
  add_part<cost::part_rough>(rows, all, "part_rough");
  add_part<cost::part_corner>(rows, all, "part_corner");
  add_part<cost::part_six>(rows, all, "part_six");
  add_part<cost::part_sixteen>(rows, all, "part_sixteen");
  add_part<cost::part_hardest_three>(rows, all, "part_hardest_three");
  add_part<cost::part_hardest_six>(rows, all, "part_hardest_six");
  add_part<cost::part_hardest_sixteen>(rows, all, "part_hardest_sixteen");
  add_part<cost::part_crowd>(rows, all, "part_crowd");
  add_part<cost::part_tool>(rows, all, "part_tool");
  add_part<cost::part_tool_sixteen>(rows, all, "part_tool_sixteen");
  out.section(
      "What each part costs",
      "Instructions per tick, composed, of the same fixed wall with one part more each "
      "time. A part that a scene has no use for must cost none, and 64 planes of which three are "
      "near at most twice what three cost.");
  ex::show_rows(out, "parts", rows.rows);

  std::vector<std::string> found;
  for (const auto& build : all) {
    for (const auto& scalar : scalars) {
      const double without = build.per_tick("part_bare", scalar);
      const double with = build.per_tick("part_turning", scalar);
      if (with > without) {
        found.push_back(build.compiler + ": turn_limited on a fixed wall costs " +
                        ex::format("%.2f instructions per tick, ", with - without) + scalar);
      }
      const double near = build.per_tick("part_corner", scalar);
      const double crowd = build.per_tick("part_crowd", scalar);
      if (!(crowd <= 2.0 * near)) {
        found.push_back(build.compiler + ": 64 planes, three of them near, cost " +
                        ex::format("%.2f times what three cost, ", crowd / near) + scalar);
      }
    }
  }
  return found;
}

/// What a tick on a mesh costs, a tick each, also as lines of the page; returns what is too large, or grows too fast.
std::vector<std::string> show_meshes(ex::report& out, const std::vector<cost::mesh_ticks>& all,
                                     std::string& page) {
  std::vector<ex::record> rows;
  std::vector<std::string> found;
  page +=
      "\n| triangles | m/s | news a second | instructions, mean | largest | of the mean |\n"
      "|---|---|---|---|---|---|\n";
  const auto& first = all.front();
  for (const auto& row : all) {
    rows.push_back({{"triangles", row.triangles},
                    {"m/s", row.speed, "%g"},
                    {"news a second", row.news},
                    {"mean", row.mean(), "%.0f"},
                    {"largest", row.largest},
                    {"of the mean", row.spread(), "%.2f"}});
    page += "| " + std::to_string(row.triangles) + ex::format(" | %g | ", row.speed) +
            std::to_string(row.news) + ex::format(" | %.0f | ", row.mean()) +
            std::to_string(row.largest) + ex::format(" | %.2f |\n", row.spread());
    const std::string which = "a mesh of " + std::to_string(row.triangles) + " triangles at " +
                              ex::format("%g m/s", row.speed);
    if (row.spread() > 2.5) found.push_back(which + ": the largest tick is over 2.5 mean ones");
    const double logarithms = std::log(double(row.triangles)) / std::log(double(first.triangles));
    const bool judged = row.speed == first.speed && row.news == 0 && row.triangles < 100'000;
    if (judged && row.mean() > logarithms * first.mean()) {
      found.push_back(which + ": a tick grows faster than the logarithm of their number");
    }
  }
  out.section("Instructions per tick, a finger on a mesh",
              "mesh::proxy::step, r = 0.5 mm, pressed 2 mm into a dome of 100 mm on a circle of 30 "
              "mm, 300 ticks each, news by which it breathes.");
  ex::show_rows(out, "meshes", rows);
  return found;
}

/// What stands between the marks of the page: brought to `counted`, or compared, with 1 % of each number.
std::vector<std::string> see_to_page(const settings& chosen, const std::string& counted) {
  const std::string head = "<!-- counted -->\n", tail = "<!-- so far -->";
  std::ifstream file(chosen.page);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto from = text.find(head), to = text.find(tail);
  if (from == std::string::npos || to == std::string::npos) {
    throw std::runtime_error(chosen.page + ": has no lines between " + head + " and " + tail);
  }
  const auto first = from + head.size();
  if (chosen.rewrite) {
    ex::output_file out(chosen.page);
    out.stream() << text.substr(0, first) << counted << text.substr(to);
    out.close();
    return {};
  }
  const auto numbers_of = [](const std::string& in) {
    std::vector<double> all;
    for (const char* at = in.c_str(); *at != '\0';) {
      char* end = nullptr;
      const bool digit = *at >= '0' && *at <= '9';
      if (digit) all.push_back(std::strtod(at, &end));
      at = digit ? end : at + 1;
    }
    return all;
  };
  const auto told = numbers_of(text.substr(first, to - first)), now = numbers_of(counted);
  const auto same = [](double x, double y) { return std::abs(x - y) <= std::max(0.01 * y, 1e-3); };
  if (std::equal(told.begin(), told.end(), now.begin(), now.end(), same)) return {};
  return {chosen.page +
          " has other counts than these, which `cmake --build build/cost --target "
          "rewrite_cost_baseline` writes:\n" +
          counted};
}

/// Compares with the committed counts; returns what grew.
std::vector<std::string> judge(const cost::baseline& committed,
                               const std::vector<cost::counts>& all) {
  std::vector<std::string> found;
  for (const auto& build : all) {
    const cost::growth grown = cost::compare(committed, build);
    if (!grown.known) {
      std::cout << "skipped: the baseline has no counts of " << build.compiler << '\n';
    } else if (grown.sentences.empty()) {
      std::cout << build.compiler << ": no count has grown by more than 1 %\n";
    }
    found.insert(found.end(), grown.sentences.begin(), grown.sentences.end());
  }
  return found;
}

template <class Scene>
void add_times(std::vector<ex::record>& pairs, std::vector<ex::record>& paths, const char* scene,
               const char* scalar) {
  const cost::timing t = cost::time_pairs<Scene>(200);
  pairs.push_back({{"scene", scene},
                   {"scalar", scalar},
                   {"p50 ns", t.p50, "%.1f"},
                   {"p99.9", t.p999, "%.1f"},
                   {"max", t.max, "%.1f"},
                   {"by hand p50", t.by_hand, "%.1f"},
                   {"paired ratio", t.ratio, "%.3f"},
                   {"state bytes", sizeof(Scene::composed({}))},
                   {"by hand bytes", sizeof(Scene::by_hand({}))}});
  const auto times = cost::time_paths<Scene>(2000);
  ex::record row{{"scene", scene}, {"scalar", scalar}};
  for (std::size_t i = 0; i < times.size(); ++i) {
    row.emplace_back(cost::to_string(cost::all_paths[i]), times[i], "%.1f");
  }
  paths.push_back(row);
}

/// Several contacts, rough ones and tools, each as a multiple of one plane under the same bound.
template <template <class, int> class Part>
void add_contact(std::vector<ex::record>& rows) {
  using part = Part<double, 3>;
  const cost::timing t = cost::time_part<part, cost::part_reachable<double, 3>>(100);
  rows.push_back({{"scene", std::string(part::name)},
                  {"p50 ns", t.p50, "%.1f"},
                  {"p99.9", t.p999, "%.1f"},
                  {"of one plane", t.ratio, "%.2f"},
                  {"state bytes", sizeof(part::composed({}))}});
}
void show_contacts(ex::report& out) {
  std::vector<ex::record> rows;
  add_contact<cost::part_reachable>(rows);
  add_contact<cost::part_rough>(rows);
  add_contact<cost::part_corner>(rows);
  add_contact<cost::part_sixteen>(rows);
  add_contact<cost::part_tool>(rows);
  add_contact<cost::part_tool_sixteen>(rows);
  out.section("Nanoseconds per tick, several contacts",
              "3-DOF and 6-DOF, double, blocks of 100 ticks in turns with one plane under "
              "reachable_bound; the ratio is the median of the pairs.");
  ex::show_rows(out, "contacts", rows);
}

void show_times(ex::report& out) {
  std::vector<ex::record> pairs, paths;
  add_times<cost::wall<float>>(pairs, paths, "wall", "float");
  add_times<cost::wall<double>>(pairs, paths, "wall", "double");
  add_times<cost::half_space<float>>(pairs, paths, "half_space", "float");
  add_times<cost::half_space<double>>(pairs, paths, "half_space", "double");
  add_times<cost::triangle<float>>(pairs, paths, "triangle", "float");
  add_times<cost::triangle<double>>(pairs, paths, "triangle", "double");
  out.section("Nanoseconds per tick",
              "Blocks of 100 ticks, composed and by hand in turns; p50, p99.9 and max of blocks. "
              "The machine's own noise is in all but the ratio.");
  ex::show_rows(out, "nanoseconds", pairs);
  out.section("Nanoseconds per tick, by path",
              "Composed, p50 of batches of up to 64 ticks that take the same path, each from the "
              "state in which it happened.");
  ex::show_rows(out, "nanoseconds_by_path", paths);
}

int run(const settings& chosen) {
  ex::report out(chosen.out, {.json = "cost.json", .markdown = "cost.md"});
  ex::failures found;
  if (chosen.programs.empty() || !cost::valgrind_works()) {
    std::cout << "skipped: instructions are not counted, "
              << (chosen.programs.empty() ? "no --count program"
                                          : "there is no valgrind that works")
              << '\n';
  } else {
    std::vector<cost::counts> all;
    for (const auto& program : chosen.programs) all.push_back(cost::count(program, chosen.out));
    ex::csv_file csv(out.path("cost.csv"),
                     "compiler,scene,scalar,side,path,instructions per tick,ticks");
    show_counts(out, csv, all);
    csv.close();
    part_rows parts;
    found = show_parts(out, all, parts);
    std::vector<cost::mesh_ticks> ticks;
    if (!chosen.meshes.empty()) ticks = cost::count_meshes(chosen.meshes, chosen.out);
    if (ticks.empty()) {
      std::cout << "skipped: ticks on meshes are not counted, "
                << (chosen.meshes.empty() ? "no --meshes program" : "no valgrind/callgrind.h")
                << '\n';
    } else {
      for (auto& off : show_meshes(out, ticks, parts.page)) found.push_back(std::move(off));
    }
    if (!chosen.page.empty() && all.size() == 2 && !ticks.empty()) {
      const auto off = see_to_page(chosen, ratio_lines(all) + "\n" + parts.page);
      found.insert(found.end(), off.begin(), off.end());
    }
    if (chosen.rewrite) {
      ex::output_file file(chosen.baseline);
      cost::write_baseline(file.stream(), all);
      file.close();
      std::cout << "baseline written: " << chosen.baseline << '\n';
    } else if (!chosen.baseline.empty()) {
      std::ifstream file(chosen.baseline);
      if (!file) throw std::runtime_error(chosen.baseline + ": cannot be read");
      for (auto& grown : judge(cost::read_baseline(file), all)) found.push_back(std::move(grown));
    }
  }
  if (!chosen.quick) {
    show_times(out);
    show_contacts(out);
  }
  return ex::conclude(
      out, "cost", "passive_haptics: what a tick costs",
      "Instructions, nanoseconds and bytes of a tick: composed from parts of this library, and "
      "written by hand without it.",
      found);
}

}  // namespace

int main(int argc, char** argv) {
  return ex::guarded("cost", [&] { return run(parse({argv + 1, argv + argc})); });
}
