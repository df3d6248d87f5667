// SPDX-License-Identifier: BSD-3-Clause
// The bench that judges the controllers, judged: it must find a liar, and lose no row.
#include "../bench/controllers/adversaries.hpp"
#include "../bench/controllers/compose.hpp"
#include "../bench/controllers/program.hpp"
#include "../bench/controllers/stiffness.hpp"
#include "../bench/controllers/wall.hpp"
#include "../bench/controllers/z_table.hpp"
#include "support/catch.hpp"

#include <set>

using namespace controllers;
using Catch::Matchers::WithinRel;
namespace fs = std::filesystem;

namespace {

const controller& named(const std::string& name) {
  for (const auto& c : catalogue()) {
    if (c.name == name) return c;
  }
  FAIL("no controller " << name);
  return catalogue().front();
}

/// Lets everything through, and says that it is safe.
template <class Space, ph::guarantee Claim>
struct liar : ph::no_bound<Space> {
  static constexpr ph::guarantee passivity = Claim;
};
template <ph::guarantee Claim>
controller lying(const std::string& name, const coverage& covers = {}) {
  return entry<3>({name, "a lie", covers}, []<class Space>(Space, const known_in<Space>& p) {
    return touch<Space>(p, ledger<Space>(p), liar<Space, Claim>{});
  });
}

/// A folder of its own for each run, gone afterwards.
class folder {
 public:
  explicit folder(const std::string& name)
      : path_(fs::temp_directory_path() / ("passive_haptics_bench_" + name)) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  folder(const folder&) = delete;
  folder& operator=(const folder&) = delete;
  ~folder() { fs::remove_all(path_); }
  [[nodiscard]] std::string operator/(const std::string& file) const {
    return (path_ / file).string();
  }

 private:
  fs::path path_;
};

std::string content(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}
std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

struct outcome {
  int code;
  std::string complaint;
};

/// The program, its output kept.
outcome run_quietly(const std::vector<std::string>& arguments,
                    const std::vector<controller>& judged, const std::atomic<bool>& stop) {
  std::ostringstream out, err;
  auto* const cout_buffer = std::cout.rdbuf(out.rdbuf());
  auto* const cerr_buffer = std::cerr.rdbuf(err.rdbuf());
  const int code = run(arguments, judged, stop);
  std::cout.rdbuf(cout_buffer);
  std::cerr.rdbuf(cerr_buffer);
  return {code, err.str()};
}
outcome run_quietly(const std::vector<std::string>& arguments,
                    const std::vector<controller>& judged = {}) {
  const std::atomic<bool> never = false;
  return run_quietly(arguments, judged, never);
}

bool mentions(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("every controller has a name and a file name of its own, and parameters in range",
          "[controllers]") {
  std::set<std::string> names, files;
  for (const auto& c : catalogue()) {
    INFO(c.name);
    CHECK(names.insert(c.name).second);
    CHECK(files.insert(z_plot_name(c.name)).second);
    CHECK_FALSE(mentions(c.name, "\""));  // a cell of a CSV file, and a string of gnuplot
    CHECK_FALSE(mentions(c.name, "'"));
    CHECK_FALSE(c.composition.empty());
    std::vector<premises> told{premises{}, premises{.quantum = 60e-6, .wall_damping = 1.0}};
    for (const auto& scene : wall_scenes()) told.push_back(known_of(scene));
    for (const auto& p : told) {
      CHECK_FALSE(c.in_1(p).check());
      if (c.in_2) CHECK_FALSE(c.in_2(p).check());
      if (c.in_3) CHECK_FALSE(c.in_3(p).check());
    }
  }
}

TEST_CASE("the tag of an entry is that of its type", "[controllers]") {
  CHECK(named("none").tag == ph::guarantee::none);
  CHECK(named("thesis").tag == ph::guarantee::none);
  CHECK(named("reachable").tag == ph::guarantee::conditional);
  CHECK(named("strict FBA").tag == ph::guarantee::strict);
  CHECK(named("PSPM + strict FBA").tag == ph::guarantee::strict);
  CHECK(lying<ph::guarantee::conditional>("x").tag == ph::guarantee::conditional);
}

TEST_CASE("S0 and S2 agree with section 5 in every row that is not explained, S1 in peak to peak",
          "[controllers]") {
  std::set<std::string> explained;
  for (const auto& scene : wall_scenes()) {
    if (scene.name == "S5") continue;
    for (const auto& p : section_5()) {
      if (p.scene != scene.name) continue;
      const wall_row row = judge_on_wall(named(p.controller), scene, 3);
      INFO(scene.name << ": " << p.controller);
      if (scene.name == "S1") {
        CHECK_THAT(row.mean.peak_to_peak * 1e3, WithinRel(p.peak_to_peak_mm, 0.1));
      } else if (agreement(row, p) != "yes") {
        CHECK(agreement(row, p) == p.reason);
        explained.insert(p.controller);
      }
    }
  }
  CHECK(explained == std::set<std::string>{"PSPM as published", "tank + level controller"});
}

TEST_CASE("a row that is off is called off, unless the seeds reach it", "[controllers]") {
  wall_row row;
  row.mean.peak_to_peak = 50e-3;
  row.mean.force_error = 1.0;
  row.least = row.most = row.mean;
  CHECK(agreement(row, {"x", "S0", 54.0, 1.05}) == "yes");
  CHECK(agreement(row, {"x", "S0", 60.0, 1.05}) == "NO");
  CHECK(agreement(row, {"x", "S0", 54.0, 1.5}) == "NO");
  CHECK(agreement(row, {"x", "S0", 54.0, 1.5, "a reason"}) == "a reason");
  row.most.force_error = 1.6;
  CHECK(agreement(row, {"x", "S1", 54.0, 1.5}) == "within the seeds");
}

TEST_CASE("a slow hand feels 2b/T of a strict bound, b/T of EBA, and all of an unbounded wall",
          "[controllers]") {
  CHECK_THAT(displayed_stiffness(named("strict FBA")), WithinRel(60.0, 0.01));  // L4
  CHECK_THAT(displayed_stiffness(named("EBA")), WithinRel(30.0, 0.01));
  CHECK_THAT(displayed_stiffness(named("none")), WithinRel(1e4, 0.02));
}

TEST_CASE("a liar that is tagged strict is found, by name, and fails the run", "[controllers]") {
  const folder out("liar");
  const std::vector<std::string> arguments{"--only", "adversaries", "--runs",
                                           "2",      "--out",       out / "r"};
  const auto lied =
      run_quietly(arguments, {lying<ph::guarantee::strict>("liar"), named("strict FBA")});
  CHECK(lied.code == 1);
  CHECK(mentions(lied.complaint, "liar, tagged strict, against nyquist in 1 DOF: lost "));
  CHECK(mentions(lied.complaint, "liar, tagged strict, against nyquist in 3 DOF: lost "));
  CHECK_FALSE(mentions(lied.complaint, "strict FBA"));
  CHECK(mentions(content(out / "r/controllers.json"), "liar, tagged strict, against nyquist"));

  const auto honest = run_quietly(arguments, {named("strict FBA")});  // the control
  CHECK(honest.code == 0);
  CHECK(honest.complaint.empty());
}

TEST_CASE("a conditional tag must hold where it covers and lose where it does not",
          "[controllers]") {
  const coverage hands_only{.any_motion = false, .any_clock = false};
  const auto judged = [](const controller& c) {
    std::vector<attack_row> rows;
    for (const auto& a : attacks()) rows.push_back(judge_under_attack(c, a, 1, 4));
    return contradictions(rows);
  };
  const auto inside = judged(lying<ph::guarantee::conditional>("liar", hands_only));
  REQUIRE_FALSE(inside.empty());
  CHECK(mentions(inside.front(), "against tapping in 1 DOF: lost "));
  CHECK(judged(named("reachable")).empty());  // the control
}

TEST_CASE("what never loses and never pushes is found as well", "[controllers]") {
  attack_row row{"x", ph::guarantee::none, "y", 1, 1, false, 0.0, 5.0, 1};
  CHECK(contradictions({row}).size() == 1);  // nothing lost: promise more
  row.tag = ph::guarantee::conditional;
  CHECK(contradictions({row}).size() == 1);
  row.least_energy = -1e-3;
  CHECK(contradictions({row}).empty());
  row.covered = true;
  CHECK(contradictions({row}).size() == 2);  // lost inside, and nothing outside
  row.tag = ph::guarantee::strict;
  row.least_energy = -1e-13;
  CHECK(contradictions({row}).empty());
  row.least_energy = std::nan("");
  CHECK(contradictions({row}).size() == 1);
  row.least_energy = 0.0;
  row.largest_force = 0.0;
  CHECK(contradictions({row}).size() == 1);
}

TEST_CASE("the stiffness sweep reproduces the published row without a bound, and strict gives none",
          "[controllers]") {
  const std::vector<std::pair<double, double>> row{
      {500, 3.1e-3}, {1000, 6.6e-3}, {2000, 19e-3}, {8000, 109e-3}, {16000, 320e-3}};
  for (const auto& [K, energy] : row) {
    const auto unbounded = judge_on_stiffness(named("none"), K);
    CHECK_THAT(unbounded.out_of_wall, WithinRel(energy, 0.1));
    CHECK_FALSE(unbounded.covered);
    const auto strict = judge_on_stiffness(named("strict FBA"), K);
    CHECK(strict.out_of_port <= 1e-12);
    CHECK(strict.covered);
  }
}

TEST_CASE("without a bound the Z-width is Colgate's region, and stability Gil and Hulin's line",
          "[controllers]") {
  const double b = 0.03, T = 1e-3;
  const z_grid grid = grid_of(true);
  int passive = 0, unstable = 0;
  for (int i = 0; i < grid.dampings; ++i) {
    for (int k = 0; k < grid.stiffnesses; ++k) {
      const double B = grid.damping(i), K = grid.stiffness(k);
      const z_row r = judge_z(named("none"), B, K);
      INFO(B << ' ' << K);
      CHECK((passive_for(r) == 2) == (b > K * T / 2 + B));
      passive += passive_for(r) == 2 ? 1 : 0;
      if (B <= 1.0) CHECK(stable(r) == (K < 2 * (b + B) / T));  // at larger B the mass matters
      unstable += stable(r) ? 0 : 1;
      CHECK(passive_for(judge_z(named("strict FBA"), B, K)) == 2);
    }
  }
  CHECK(passive > 0);
  CHECK(unstable > 0);
  for (const double B : {0.001, 0.01, 0.02}) {  // sharply
    const double line = 2 * (b - B) / T;
    CHECK(passive_for(judge_z(named("none"), B, 0.99 * line)) == 2);
    CHECK(passive_for(judge_z(named("none"), B, 1.01 * line)) < 2);
  }
}

TEST_CASE("parts of a Z-width sweep join to the run that was not split", "[controllers]") {
  const folder out("merge");
  const std::vector<controller> judged{named("none"), named("EBA")};
  const auto sweep = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--quick", "--only", "z_width"});
    return run_quietly(more, judged);
  };
  REQUIRE(sweep({"--out", out / "whole", "--threads", "1"}).code == 0);
  REQUIRE(sweep({"--out", out / "threads", "--threads", "3"}).code == 0);
  CHECK(content(out / "threads/z_width.csv") == content(out / "whole/z_width.csv"));
  for (const std::string part : {"1/3", "2/3", "3/3"}) {
    REQUIRE(sweep({"--out", out / "parts", "--shard", part}).code == 0);
  }
  const std::string one = out / "parts/z_width_1_of_3.csv", two = out / "parts/z_width_2_of_3.csv",
                    three = out / "parts/z_width_3_of_3.csv";
  const auto join = [&](std::vector<std::string> files) {
    files.insert(files.begin(), "--merge");
    files.insert(files.end(), {"--out", out / "joined"});
    return run_quietly(files, judged);
  };
  SECTION("all of them, in any order") {
    CHECK(join({three, one, two}).code == 0);
    const std::string whole = content(out / "whole/z_width.csv");
    CHECK(lines(whole).size() == 1 + 2 * 9 * 6);
    CHECK(content(out / "joined/z_width.csv") == whole);
  }
  SECTION("a part that is missing") {
    const auto r = join({one, three});
    CHECK(r.code == 1);
    CHECK(mentions(r.complaint, "36 rows are missing, the first is none, B = 0.001"));
  }
  SECTION("a part that is there twice") {
    const auto r = join({one, two, three, two});
    CHECK(r.code == 1);
    CHECK(mentions(r.complaint, "z_width_2_of_3.csv:2: none, B = 0.001"));
    CHECK(mentions(r.complaint, "already"));
  }
  SECTION("a part whose last row is torn") {
    const std::string text = content(two);
    std::ofstream(two) << text.substr(0, text.size() - 4);
    const auto r = join({one, two, three});
    CHECK(r.code == 1);
    CHECK(mentions(r.complaint, "z_width_2_of_3.csv:37: not a row"));
  }
  SECTION("another file") {
    std::ofstream(two) << "x,y\n1,2\n";
    CHECK(mentions(join({one, two, three}).complaint, "not a part of a Z-width sweep"));
    CHECK(mentions(join({one, out / "nothing"}).complaint, "nothing: cannot be read"));
  }
  SECTION("parts of other controllers") {
    const auto r = run_quietly({"--merge", one, two, three, "--out", out / "joined"},
                               {named("none"), named("thesis")});
    CHECK(r.code == 1);
    CHECK(mentions(r.complaint, "missing"));
  }
}

TEST_CASE("a run that is stopped leaves whole rows, says so, and exits with 130", "[controllers]") {
  const folder out("stopped");
  std::atomic<bool> stop = false;
  std::atomic<int> made = 0;
  controller c = named("EBA");
  c.in_1 = [&stop, &made, make = c.in_1](const premises& p) {
    if (++made == 30) stop = true;
    return make(p);
  };
  const auto r = run_quietly(
      {"--quick", "--only", "stiffness,z_width", "--threads", "2", "--out", out / "r"}, {c}, stop);
  CHECK(r.code == 130);
  CHECK(lines(content(out / "r/stiffness.csv")).size() == 7);  // the section before is complete
  const std::string text = content(out / "r/z_width.csv");
  REQUIRE_FALSE(text.empty());
  CHECK(text.back() == '\n');
  const auto rows = lines(text);
  CHECK(rows.size() > 20);
  CHECK(rows.size() < 30);
  for (const auto& row : rows) CHECK(std::count(row.begin(), row.end(), ',') == 7);
  CHECK(mentions(r.complaint, "z_width.csv has " + std::to_string(rows.size() - 1) + " of 54"));
}

TEST_CASE("arguments that make no sense are named, with the remedy", "[controllers]") {
  const auto refused = [](const std::vector<std::string>& arguments, const std::string& remedy) {
    const auto r = run_quietly(arguments);
    INFO(r.complaint);
    return r.code == 2 && mentions(r.complaint, remedy) && mentions(r.complaint, "usage:");
  };
  CHECK(refused({"--shard", "9/8"}, "--shard 9/8: there are only 8"));
  CHECK(refused({"--shard", "2"}, "give I/N"));
  CHECK(refused({"--shard", "0/4"}, "at least 1"));
  CHECK(refused({"--runs", "1e3"}, "--runs 1e3: give a whole number"));
  CHECK(refused({"--only", "wall,walls"}, "--only walls: there are wall, adversaries"));
  CHECK(refused({"--only", ""}, "--only: name some"));
  CHECK(refused({"--seeds"}, "its value is missing"));
  CHECK(refused({"--fast"}, "--fast: no such option"));
  CHECK(refused({"--merge", "--out", "x"}, "--merge: its value is missing"));
  CHECK(refused({"--shard", "1/2", "--merge", "x"}, "--merge joins what --shard wrote"));
  CHECK(refused({"--shard", "1/2", "--only", "wall"}, "--shard splits z_width alone"));
  CHECK(parse({"--quick"}).runs < parse({}).runs);
}
