// SPDX-License-Identifier: BSD-3-Clause
// A sample of the study of identified devices; `identify --study 1000` is the whole of it.
#include "../bench/identify/program.hpp"
#include "programs.hpp"
#include "support/catch.hpp"

using namespace programs;

namespace {

outcome run_quietly(const std::vector<std::string>& arguments, bool stopped = false) {
  const std::atomic<bool> stop = stopped;
  return quietly([&] { return identify::run(arguments, stop); });
}

}  // namespace

TEST_CASE("bounds hold on devices drawn at random, and are near the truth", "[identify]") {
  std::vector<double> masses, frictions;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto v = identify::identified(identify::draw(seed));
    CAPTURE(seed, to_string(v.truth.like), v.truth.friction, v.found.friction);
    CHECK(v.all());
    masses.push_back(v.found.mass / v.truth.mass);
    if (v.truth.friction > 0.05) frictions.push_back(v.found.friction / v.truth.friction);
  }
  std::sort(masses.begin(), masses.end());
  std::sort(frictions.begin(), frictions.end());
  CHECK(masses[masses.size() / 2] > 0.9);
  CHECK(frictions[frictions.size() / 2] > 0.5);
}

TEST_CASE(
    "what moves with the encoder is less than a gap or a mode that was found and dropped yields",
    "[identify]") {
  for (const std::uint64_t seed : {1700537, 2600097}) {  // a gap; a mode of 255 Hz
    auto truth = identify::draw_disturbed(seed);
    if (truth.has.gap > 0.0) {
      truth.has.gap = 19e-6;  // the control: one that is a little wider is found
      CHECK(identify::identified(truth).names(identify::disturbance::backlash));
      truth.has.gap = 16e-6;
    }
    const auto v = identify::identified(truth);
    CAPTURE(seed, v.truth.rotor(), v.found.moves_rigidly());
    REQUIRE_FALSE(v.refused());
    CHECK_FALSE(v.names(v.truth.has.gap > 0.0 ? identify::disturbance::backlash
                                              : identify::disturbance::mode));
    CHECK(v.mass());
    CHECK(v.found.mass > v.truth.rotor());  // the control: all that moves is more
  }
}

TEST_CASE("cogging of half a millimetre is found by name, and none where there is none",
          "[identify]") {
  auto truth = identify::draw_disturbed(7700053);
  REQUIRE(truth.has.wavelength < 0.6e-3);
  const auto with = identify::identified(truth);
  CHECK(with.names(identify::disturbance::cogging));
  const auto& found = with.found.wrong.of(identify::disturbance::cogging);
  CHECK(std::abs(found.size - truth.has.cogging) < 0.15 * truth.has.cogging);
  CHECK(std::abs(found.where - truth.has.wavelength) < 0.02 * truth.has.wavelength);
  truth.remedy(identify::disturbance::cogging);
  const auto without = identify::identified(truth);  // the control
  CHECK_FALSE(without.refused());
  CHECK_FALSE(without.names(identify::disturbance::cogging));
}

TEST_CASE("friction whose ramps have not met its least level is stated below that", "[identify]") {
  auto truth = identify::draw_disturbed(9950015);
  truth.remedy(identify::disturbance::filter);
  truth.remedy(identify::disturbance::cogging);
  truth.remedy(identify::disturbance::drift);
  const auto v = identify::identified(truth);
  REQUIRE_FALSE(v.refused());
  const double ripple = truth.rigid.ripple;
  // The control: by the ramps alone more would be stated.
  CHECK(v.found.likely_friction * (1.0 - v.found.uneven) > 1.1 * truth.rigid.friction);
  const double amplitude = ripple / (1.0 - ripple) * truth.rigid.friction;
  CHECK(v.found.wrong.ripple >= amplitude);
  CHECK(v.found.wrong.ripple < 1.02 * amplitude);
  CHECK(v.friction());
  CHECK(v.found.friction > 0.9 * truth.rigid.friction);
}

TEST_CASE("a hand on a handle behind a spring is refused by a sentence that names both",
          "[identify]") {
  auto truth = identify::draw_disturbed(9970173);  // 258 N/m that follow, and a mode of 26 Hz
  const auto held = identify::identified(truth);
  CHECK(held.of_two_names());
  CHECK(held.names_as_one_of_two(identify::disturbance::hand));
  CHECK(held.names_as_one_of_two(identify::disturbance::mode));
  truth.remedy(identify::disturbance::hand);
  const auto free = identify::identified(truth);
  CHECK_FALSE(free.of_two_names());
  CHECK(free.names(identify::disturbance::mode));
  CHECK((free.mass() && free.damping() && free.friction()));
  truth.remedy(identify::disturbance::mode);
  CHECK_FALSE(identify::identified(truth).refused());  // the control
}

TEST_CASE("a slow mode that hardly loses is found, and is no hand and no gap", "[identify]") {
  for (const std::uint64_t seed : {9980121, 9980126}) {  // 18 Hz, and 19 Hz with a loss of 0.011
    auto truth = identify::draw_disturbed(seed);
    const auto v = identify::identified(truth);
    CAPTURE(seed, v.found.wrong.unexplained);
    CHECK(v.names(identify::disturbance::mode));
    CHECK_FALSE(v.names(identify::disturbance::hand));
    CHECK_FALSE(v.names(identify::disturbance::backlash));
    const auto& mode = v.found.wrong.of(identify::disturbance::mode);
    CHECK(std::abs(mode.size - truth.has.mode) < 0.02 * truth.has.mode);
    CHECK(std::abs(mode.where - truth.has.share) < 0.02);
    truth.remedy(identify::disturbance::mode);
    CHECK_FALSE(identify::identified(truth).refused());  // the control
  }
}

TEST_CASE("a filter beside a fraction, late by a whole tick in all, is found", "[identify]") {
  auto truth = identify::draw_disturbed(9980070);
  REQUIRE(std::abs(truth.has.lag / 1e-3 + truth.has.fraction - 1.0) < 0.05);
  const auto v = identify::identified(truth);
  CHECK(v.refused());
  CHECK(v.found.wrong.of(identify::disturbance::filter).found);
  truth.remedy(identify::disturbance::filter);
  truth.remedy(identify::disturbance::fraction);
  const auto without = identify::identified(truth);  // the control
  CHECK_FALSE(without.refused());
  CHECK_FALSE(without.names(identify::disturbance::filter));
}

TEST_CASE("a filter is found alone, and is no gap", "[identify]") {
  for (const std::uint64_t seed : {9980008, 9980015}) {
    const auto truth = identify::draw_disturbed(seed);
    const auto v = identify::identified(truth);
    CAPTURE(seed);
    CHECK_FALSE(v.names(identify::disturbance::backlash));
    const auto& filter = v.found.wrong.of(identify::disturbance::filter);
    REQUIRE(filter.found);
    CHECK(std::abs(filter.size - truth.has.lag) < 0.05 * truth.has.lag);
  }
}

TEST_CASE("a mode that another part had passed for is found once that may not come first",
          "[identify]") {
  const auto truth = identify::draw_disturbed(9980082);  // 83 Hz, and a filter of 1.3 ms
  const auto v = identify::identified(truth);
  const auto& mode = v.found.wrong.of(identify::disturbance::mode);
  REQUIRE(mode.found);
  CHECK(std::abs(mode.size - truth.has.mode) < 0.03 * truth.has.mode);
}

TEST_CASE("a hand on a handle behind a spring that holds still is named, and so is the mode",
          "[identify]") {
  auto truth = identify::draw_disturbed(1700859);  // 95 N/m, and a mode of 106 Hz
  const auto held = identify::identified(truth);
  CHECK(held.refused());
  CHECK(held.names(identify::disturbance::hand));
  CHECK(held.names(identify::disturbance::mode));
  const double grip = held.found.wrong.of(identify::disturbance::hand).size;
  CHECK(std::abs(grip - truth.has.grip) < 0.1 * truth.has.grip);
  truth.remedy(identify::disturbance::hand);
  const auto free = identify::identified(truth);
  CHECK_FALSE(free.refused());
  CHECK_FALSE(free.names(identify::disturbance::hand));  // the control
  CHECK((free.mass() && free.damping() && free.friction()));
}

TEST_CASE("the study's judge knows a bound that does not hold", "[identify]") {
  identify::verdict v;
  v.truth = {.mass = 0.1, .damping = 0.1, .friction = 0.1, .presliding = 10e-6, .quantum = 1e-5};
  v.found = {.mass = 0.1,
             .damping = 0.1,
             .damping_max = 0.1,
             .friction = 0.1,
             .presliding = 10e-6,
             .quantum = 1e-5,
             .longest_tick = 1e-3};
  CHECK(v.all());
  auto wrong = v;
  wrong.found.mass = 0.101;
  CHECK_FALSE(wrong.all());
  wrong = v;
  wrong.found.friction = 0.101;
  CHECK_FALSE(wrong.all());
  wrong = v;
  wrong.found.presliding = 9.9e-6;
  CHECK_FALSE(wrong.all());
  wrong.found.friction = 0.0;  // nobody asks for it then
  CHECK(wrong.all());
  wrong = v;
  wrong.found.damping_max = 0.09;
  CHECK_FALSE(wrong.all());
}

TEST_CASE(
    "the identify program writes what it found, reads it back, and leaves nothing half written",
    "[identify]") {
  const scratch_folder out;
  const std::string file = out / "touch.txt";
  CHECK(run_quietly({"--device", "Touch", "--write", file}, true).code == 130);
  CHECK_FALSE(std::filesystem::exists(file));
  CHECK(run_quietly({"--device", "Touch", "--write", file}).code == 0);
  CHECK(run_quietly({"--read", file}).code == 0);
  std::ofstream(file, std::ios::app) << "more\n";
  const auto spoilt = run_quietly({"--read", file});
  CHECK(spoilt.code == 1);
  CHECK(spoilt.complaint.find("nothing may follow") != std::string::npos);
  CHECK(run_quietly({"--device", "Touch", "--force", "0.1"}).code == 1);
}

TEST_CASE("the identify program weighs a mass, and says which one would do", "[identify]") {
  CHECK(run_quietly({"--weigh-in", "0.15", "--gain", "0.9"}).code == 0);
  CHECK(run_quietly({"--weigh-in", "0.15", "--presliding", "0", "--device", "omega"}).code == 0);
  CHECK(run_quietly({"--weigh-in", "0.15", "--gain", "0.9"}, true).code == 130);
  CHECK(run_quietly({"--weigh-in", "0.002"}).code == 1);
  CHECK(run_quietly({"--weigh-in", "0.15", "--force", "0.5"}).code == 1);
  CHECK(run_quietly({"--weigh-in", "much"}).code == 2);
}

TEST_CASE("the identify program weighs at poses of a linkage, and keeps the gains with the device",
          "[identify]") {
  const scratch_folder out;
  const std::string file = out / "touch.json";
  const std::vector<std::string> linkage{"--weigh-in", "0.2",
                                         "--gain",     "0.9",
                                         "--pose",     "0,-1/-0.2,0.1/-0.1,0.15",
                                         "--pose",     "0,-1/0.1,0.3/0.05,0.2",
                                         "--json",     file};
  const auto missing = run_quietly(linkage);  // no description yet, and nothing is weighed
  CHECK(missing.code == 1);
  CHECK(missing.complaint.find(file + ": cannot be read") != std::string::npos);
  CHECK(run_quietly({"--device", "Touch", "--json", file}).code == 0);
  CHECK(run_quietly(linkage).code == 0);
  const auto kept = passive_haptics::identification::load_device(file);
  CHECK(kept.fault.empty());
  REQUIRE(kept.of.gains.size() == 2);
  for (const double g : kept.of.gains) CHECK(std::abs(g - 0.9) < kept.of.gain_tolerance);
  CHECK(kept.of.gain_tolerance < 0.05);
  for (const char* pose : {"up", "0,-1/0.1", "0,0,0,1", "0,-1/1,0"}) {
    CHECK(run_quietly({"--weigh-in", "0.2", "--pose", pose}).code == 2);
  }
  CHECK(run_quietly({"--weigh-in", "0.2", "--pose", "1", "--pose", "0,1"}).code == 2);
}

TEST_CASE("the identify program says what it does not understand", "[identify]") {
  CHECK(run_quietly({"--device", "Nobody"}).complaint.find("Touch") != std::string::npos);
  CHECK(run_quietly({"--force", "many"}).code == 2);
  CHECK(run_quietly({"--force", "0"}).code == 2);
  CHECK(run_quietly({"--nonsense"}).code == 2);
  CHECK(run_quietly({"--help"}).code == 0);
}
