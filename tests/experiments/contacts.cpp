// SPDX-License-Identifier: BSD-3-Clause
// The program that tries several contacts at once: all its promises hold in a first look, its controls lose, and it
// understands its arguments.
#include "../bench/common/quiet.hpp"
#include "../bench/contacts/program.hpp"
#include "programs.hpp"
#include "support/catch.hpp"

using namespace programs;

namespace {

outcome run_quietly(const std::vector<std::string>& arguments) {
  const std::atomic<bool> never = false;
  return quietly([&] { return contacts::run(arguments, never); });
}

}  // namespace

TEST_CASE("contacts keep every promise in a first look, and what stands beside them does not",
          "[contacts]") {
  const scratch_folder out;
  const outcome found = run_quietly({"--quick", "--out", out / ""});
  INFO(found.complaint);
  CHECK(found.code == 0);  // the controls among them: one that loses nothing is a failure
  const std::string json = content(out / "contacts.json");
  for (const char* key :
       {"quiet",         "quiet_late",      "quiet_tool",  "settling",    "touch",
        "motion",        "frames",          "frames_near", "touch_news",  "of_what_it_comes_to",
        "news",          "greedy_news",     "heart",       "stroke",      "loops",
        "drift",         "stick_slip",      "stopping",    "cone",        "static",
        "passive",       "rigid",           "tool",        "guards",      "guards_sums",
        "guards_drops",  "guards_encoders", "failures",    "rest_step_N", "rest_mm_per_s",
        "shown_N_per_m", "meshes"}) {
    CAPTURE(key);
    CHECK(json.find('"' + std::string(key) + '"') != std::string::npos);
  }
}

TEST_CASE("the columns on quiet tell a contact that rests from one that rings",
          "[contacts][quiet]") {
  namespace ex = experiments;
  using line = contacts::ph::space<double, 1>;
  const auto held = [](double swing, const ex::sim::quiet_bars& bars) {
    ex::sim::quiet_judge<line> judge(bars);
    const std::array<double, 1> normal{1.0};
    for (int n = 0; n < 6000; ++n) {  // swings by so much at 50 Hz, and for half a second by 1 N
      const double x = (n < 500 ? 1.0 : swing) * std::sin(0.314 * n);
      judge.add(2.0 + x, 0.0, 1e-3, normal);
    }
    return judge;
  };
  ex::at_rest row;
  CHECK(row.share() == "-");
  row.add(held(0.01, {}), {1000.0, 950.0});
  CHECK(row.share() == "1 of 1");
  CHECK(row.all_quiet());
  row.add(held(0.1, {}), {1000.0, 950.0});
  CHECK(row.share() == "1 of 2: q1 force");
  CHECK_FALSE(row.all_quiet());
  ex::at_rest coarse;  // the same swing is within the floor of 60 µm under 4 kN/m
  coarse.add(held(0.1, ex::sim::quiet_bars{}.on_encoders(60e-6, 4000.0, 0.1)));
  CHECK(coarse.all_quiet());
  const ex::record columns = row.columns();
  CHECK(columns[1].shown == "0.60");
  CHECK(columns[5].shown == "950");
  const auto spring = [](const contacts::vector& x) -> contacts::vector { return -800.0 * x; };
  CHECK(std::abs(ex::shown_by(spring, contacts::vector(1e-3, 2e-3, 0.0)) - 800.0) < 1e-3);
}

TEST_CASE("contacts names the sections that there are", "[contacts]") {
  CHECK(run_quietly({"--only", "nothing"}).code == 2);
  CHECK(run_quietly({"--only", ""}).code == 2);
  CHECK(run_quietly({"--help"}).code == 0);
}
