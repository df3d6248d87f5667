// SPDX-License-Identifier: BSD-3-Clause
// The program that judges the controllers: it must find a liar, lose no row, and understand its
// arguments.
#include "../bench/controllers/tables.hpp"
#include "controllers.hpp"
#include "programs.hpp"
#include "support/catch.hpp"

#include <limits>

using namespace controllers;
using namespace programs;

namespace {

/// The program, its output kept.
outcome run_quietly(const std::vector<std::string>& arguments,
                    const std::vector<controller>& judged, const std::atomic<bool>& stop) {
  return programs::quietly([&] { return run(arguments, judged, stop); });
}
outcome run_quietly(const std::vector<std::string>& arguments,
                    const std::vector<controller>& judged = {}) {
  const std::atomic<bool> never = false;
  return run_quietly(arguments, judged, never);
}

}  // namespace

TEST_CASE("a liar that is tagged strict is found, by name, and fails the run", "[controllers]") {
  const scratch_folder out;
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

TEST_CASE("no controller of the catalogue loses what it promises in a first look",
          "[controllers]") {
  const scratch_folder out;
  const auto all =
      run_quietly({"--only", "adversaries", "--quick", "--out", out / "r"}, catalogue());
  INFO(all.complaint);
  CHECK(all.code == 0);
}

TEST_CASE("an assumption that creates while it is kept, or nothing once it is violated, is named",
          "[controllers]") {
  assumption_row sound{.composition = "make_touch", .assumption = "mass", .in_truth = "1 g"};
  sound.violated = 1e-3;
  CHECK(unfounded({sound}).empty());
  assumption_row untrue = sound;
  untrue.kept = 1e-11;
  assumption_row idle = sound;
  idle.violated = 0.0;
  assumption_row no_number = sound;
  no_number.kept = std::numeric_limits<double>::quiet_NaN();
  assumption_row unpaid = idle;
  unpaid.unpaid = true;  // it is said that nothing is created
  CHECK(unfounded({unpaid}).empty());
  assumption_row paid = sound;
  paid.unpaid = true;
  CHECK(mentions(unfounded({paid}).at(0), "0.001 J are created at 1 g, of which it is said"));
  const auto found = unfounded({sound, untrue, idle, no_number});
  REQUIRE(found.size() == 3);
  CHECK(mentions(found[0], "make_touch, mass: created 1e-11 J while it is kept"));
  CHECK(mentions(found[1], "make_touch, mass: nothing is created at 1 g"));
  CHECK(mentions(found[2], "while it is kept"));
}

TEST_CASE("parts of a Z-width sweep join to the run that was not split", "[controllers]") {
  const scratch_folder out;
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
  const scratch_folder out;
  std::atomic<bool> stop = false;
  std::atomic<int> made = 0;
  controller c = named("EBA");
  c.in<d1>() = [&stop, &made, make = c.in<d1>()](const premises& p) {
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
  CHECK(refused({"--seed", "0"}, "--seed 0: give a whole number of at least 1"));
  CHECK(refused({"--fast"}, "--fast: no such option"));
  CHECK(refused({"--merge", "--out", "x"}, "--merge: its value is missing"));
  CHECK(refused({"--shard", "1/2", "--merge", "x"}, "--merge joins what --shard wrote"));
  CHECK(refused({"--shard", "1/2", "--only", "wall"}, "--shard splits z_width alone"));
  CHECK(parse({"--quick"}).runs < parse({}).runs);
}

TEST_CASE("another seed draws other devices and hands, and none leaves what is stated",
          "[controllers]") {
  CHECK(parse({}).first() == 1);
  CHECK(parse({"--seed", "2"}).first() != 1);
  const auto stated = attacks(), drawn = attacks(2);
  REQUIRE(stated.size() == drawn.size());
  CHECK(stated.front().world.mass == sim::circumstances{}.mass);
  CHECK(drawn.front().world.mass != stated.front().world.mass);
  CHECK(drawn.front().world.mass != drawn[1].world.mass);
  CHECK(drawn.front().world.hand_force == attacks(2).front().world.hand_force);
}
