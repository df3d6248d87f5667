// SPDX-License-Identifier: BSD-3-Clause
// cost: what a tick costs, composed from the library and written by hand.
//
//     cost --count PROGRAM --count PROGRAM --baseline FILE --out DIR
//     cost --quick …                 instructions only, no clock
//     cost --rewrite …               writes the baseline anew, from this machine's compilers
//
// Instructions are counted by callgrind and exact; growth of more than 1 % over the committed baseline
// fails, by name. Times are paired and interleaved, and worth their ratios only.

#include "../common/report.hpp"
#include "counts.hpp"
#include "paired.hpp"
#include "parts.hpp"

#include <iostream>

namespace {

namespace ex = experiments;

struct settings {
  std::filesystem::path out = "cost";
  std::filesystem::path baseline;
  std::vector<std::filesystem::path> programs;
  bool quick = false;
  bool rewrite = false;
};

constexpr const char* usage =
    "\nusage: cost [--quick] [--rewrite] [--count PROGRAM]... [--baseline FILE] [--out DIR]";

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw std::invalid_argument(name + ": its value is missing");
      return arguments[++i];
    };
    if (name == "--quick") {
      chosen.quick = true;
    } else if (name == "--rewrite") {
      chosen.rewrite = true;
    } else if (name == "--count") {
      chosen.programs.emplace_back(value());
    } else if (name == "--baseline") {
      chosen.baseline = value();
    } else if (name == "--out") {
      chosen.out = value();
    } else {
      throw std::invalid_argument(name + ": no such option" + usage);
    }
  }
  if (chosen.rewrite && chosen.baseline.empty()) {
    throw std::invalid_argument("--rewrite: name the --baseline to write");
  }
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
  std::vector<std::string> heading{"compiler", "scene", "scalar", "composed / by hand"};
  for (const auto path : cost::all_paths) heading.emplace_back(cost::to_string(path));
  ex::table table(heading);
  std::vector<std::string> json;
  for (const auto& build : all) {
    for (const auto& scene : scenes) {
      for (const auto& scalar : scalars) {
        const double ratio = build.ratio(scene, scalar);
        std::vector<std::string> row{build.compiler, scene, scalar, ex::format("%.3f", ratio)};
        for (const auto path : cost::all_paths) {
          row.push_back(side_by_side(build, scene, scalar, cost::to_string(path)));
        }
        table.add(row);
        json.push_back(ex::json_object({{"compiler", ex::json_string(build.compiler)},
                                        {"scene", ex::json_string(scene)},
                                        {"scalar", ex::json_string(scalar)},
                                        {"ratio", ex::json_number(ratio)}}));
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
  out.show(table);
  out.member("instructions", ex::json_array(json));
}

/// One row for a part: instructions per tick of each build, state in bytes.
template <template <class, int> class Part>
void show_part(ex::table& table, const std::vector<cost::counts>& all, const std::string& scene) {
  const auto row = [&](auto part, const char* port, const char* scalar) {
    using chosen = decltype(part);
    std::vector<std::string> cells{chosen::name, port};
    for (const auto& build : all) {
      cells.push_back(ex::format("%.1f", build.per_tick(scene, scalar)));
    }
    cells.push_back(std::to_string(sizeof(chosen::composed({}))));
    table.add(cells);
  };
  row(Part<float, 1>{}, "1-DOF float", "float");
  row(Part<double, 3>{}, "3-DOF double", "double");
}

/// What each part costs; returns which parts that a scene has no use for cost instructions.
std::vector<std::string> show_parts(ex::report& out, const std::vector<cost::counts>& all) {
  std::vector<std::string> heading{"scene", "port"};
  for (const auto& build : all) heading.push_back(build.compiler);
  heading.emplace_back("state bytes");
  ex::table table(heading);
  show_part<cost::part_bare>(table, all, "part_bare");
  show_part<cost::part_turning>(table, all, "part_turning");
  show_part<cost::part_counting>(table, all, "part_counting");
  show_part<cost::part_strict>(table, all, "part_strict");
  show_part<cost::part_limited>(table, all, "part_limited");
  show_part<cost::part_following>(table, all, "part_following");
  out.section("What each part costs",
              "Instructions per tick, composed, of the same rigid wall with one part more each "
              "time. A part that a scene has no use for must cost none.");
  out.show(table);

  std::vector<std::string> found;
  for (const auto& build : all) {
    for (const auto& scalar : scalars) {
      const double without = build.per_tick("part_bare", scalar);
      const double with = build.per_tick("part_turning", scalar);
      if (with > without) {
        found.push_back(build.compiler + ": rotate_limited on a rigid wall costs " +
                        ex::format("%.2f instructions per tick, ", with - without) + scalar);
      }
    }
  }
  return found;
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
void show_time(ex::table& pairs, ex::table& paths, std::vector<std::string>& json,
               const char* scene, const char* scalar) {
  const cost::timing t = cost::time_pairs<Scene>(200);
  const auto bytes = [](auto n) { return std::to_string(n); };
  pairs.add({scene, scalar, ex::format("%.1f", t.p50), ex::format("%.1f", t.p999),
             ex::format("%.1f", t.max), ex::format("%.1f", t.by_hand), ex::format("%.3f", t.ratio),
             bytes(sizeof(Scene::composed({}))), bytes(sizeof(Scene::by_hand({})))});
  std::vector<std::string> row{scene, scalar};
  for (const double ns : cost::time_paths<Scene>(2000)) row.push_back(ex::format("%.1f", ns));
  paths.add(row);
  json.push_back(ex::json_object({{"scene", ex::json_string(scene)},
                                  {"scalar", ex::json_string(scalar)},
                                  {"p50", ex::json_number(t.p50)},
                                  {"p99_9", ex::json_number(t.p999)},
                                  {"max", ex::json_number(t.max)},
                                  {"by_hand_p50", ex::json_number(t.by_hand)},
                                  {"paired_ratio", ex::json_number(t.ratio)}}));
}

void show_times(ex::report& out) {
  ex::table pairs({"scene", "scalar", "p50 ns", "p99.9", "max", "by hand p50", "paired ratio",
                   "state bytes", "by hand bytes"});
  std::vector<std::string> heading{"scene", "scalar"};
  for (const auto path : cost::all_paths) heading.push_back(cost::to_string(path));
  ex::table paths(heading);
  std::vector<std::string> json;
  show_time<cost::wall<float>>(pairs, paths, json, "wall", "float");
  show_time<cost::wall<double>>(pairs, paths, json, "wall", "double");
  show_time<cost::half_space<float>>(pairs, paths, json, "half_space", "float");
  show_time<cost::half_space<double>>(pairs, paths, json, "half_space", "double");
  show_time<cost::triangle<float>>(pairs, paths, json, "triangle", "float");
  show_time<cost::triangle<double>>(pairs, paths, json, "triangle", "double");
  out.section("Nanoseconds per tick",
              "Blocks of 100 ticks, composed and by hand in turns; p50, p99.9 and max of blocks. "
              "The machine's own noise is in all but the ratio.");
  out.show(pairs);
  out.section("Nanoseconds per tick, by path",
              "Composed, p50 of batches of up to 64 ticks that take the same path, each from the "
              "state in which it happened.");
  out.show(paths);
  out.member("nanoseconds", ex::json_array(json));
}

int run(const settings& chosen) {
  ex::report out(chosen.out, {.json = "cost.json", .markdown = "cost.md"});
  std::vector<std::string> found;
  if (chosen.programs.empty() || !cost::valgrind_is_here()) {
    std::cout << "skipped: instructions are not counted, "
              << (chosen.programs.empty() ? "no --count program" : "valgrind is not installed")
              << '\n';
  } else {
    std::vector<cost::counts> all;
    for (const auto& program : chosen.programs) all.push_back(cost::count(program, chosen.out));
    ex::csv_file csv(out.path("cost.csv"),
                     "compiler,scene,scalar,side,path,instructions per tick,ticks");
    show_counts(out, csv, all);
    csv.close();
    found = show_parts(out, all);
    if (chosen.rewrite) {
      ex::output_file file(chosen.baseline);
      cost::write_baseline(file.stream(), all);
      file.close();
      std::cout << "baseline written: " << chosen.baseline.string() << '\n';
    } else if (!chosen.baseline.empty()) {
      std::ifstream file(chosen.baseline);
      if (!file) throw std::runtime_error(chosen.baseline.string() + ": cannot be read");
      for (auto& grown : judge(cost::read_baseline(file), all)) found.push_back(std::move(grown));
    }
  }
  if (!chosen.quick) show_times(out);
  out.finish("passive_haptics: what a tick costs");
  std::cout << "results: " << out.path("cost.md").string() << '\n';
  for (const auto& sentence : found) std::cerr << "cost: " << sentence << '\n';
  return found.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse({argv + 1, argv + argc}));
  } catch (const std::invalid_argument& problem) {
    std::cerr << "cost: " << problem.what() << '\n';
    return 2;
  } catch (const std::exception& problem) {
    std::cerr << "cost: " << problem.what() << '\n';
    return 1;
  }
}
