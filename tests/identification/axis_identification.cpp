// SPDX-License-Identifier: BSD-3-Clause
// One axis identified: the bounds hold, what cannot be found is not invented, and a hand, a weak force, a
// short stroke, a sensor that fails or a device that runs away end it with a sentence and no force.
#include "support/catch.hpp"
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/identification.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/presets.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <chrono>
#include <cmath>
#include <string>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace identification = ph::identification;
using identification::axis_found;
using identification::axis_identification;
using identification::identification_parameters;
using d1 = ph::space<double, 1>;
using d2 = ph::space<float, 2>;
using namespace std::chrono_literals;
using free_hand = sim::no_hand<d1>;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

namespace {

const sim::device_parameters<d1> grip{
    .mass = 0.1, .damping = 0.3, .quantum = 10e-6, .load = 0.2, .latency = 1};
const sim::slider_and_spring rubs{.level = {0.2}, .presliding = {15e-6}};

template <class Friction>
using rubbing = sim::device<d1, free_hand, Friction>;

/// What happened: the result, the largest command, and the one after the end.
struct session {
  axis_found found{};
  double largest = 0.0, last = 0.0, seconds = 0.0;

  [[nodiscard]] bool says(const std::string& words) const {
    return found.problem != nullptr && std::string(found.problem).find(words) != std::string::npos;
  }
};

/// spoil(tick, sample) may change what the identification is shown.
session identified(auto&& device, const identification_parameters& p, auto spoil) {
  axis_identification of(p);
  session s;
  double force = 0.0;
  for (int n = 0; !of.done() && n < 200000; ++n) {
    auto sample = device.exchange(force);
    spoil(n, sample);
    force = of.tick(sample.position, ph::seconds{sample.dt});
    s.largest = std::max(s.largest, std::abs(force));
  }
  s.last = std::abs(force) + std::abs(of.tick(0.0, 1ms));
  s.found = of.result();
  s.seconds = of.time();
  return s;
}
session identified(auto&& device, const identification_parameters& p = {}) {
  return identified(device, p, [](int, auto&) {});
}

}  // namespace

TEST_CASE("an axis is identified: each bound on its side of the truth, and near it",
          "[identification]") {
  const auto s = identified(rubbing<sim::slider_and_spring>(grip, {}, rubs));
  INFO((s.found.problem != nullptr ? s.found.problem : identification::table_of(s.found)));
  REQUIRE(s.found.problem == nullptr);
  CHECK(s.found.mass <= 0.1);
  CHECK(s.found.mass > 0.09);
  CHECK(s.found.damping <= 0.3);
  CHECK(s.found.damping > 0.24);
  CHECK(s.found.damping_max >= 0.3);
  CHECK(s.found.damping_max < 0.36);
  CHECK(s.found.friction <= 0.2);
  CHECK(s.found.friction > 0.16);
  CHECK(s.found.presliding >= 15e-6);
  CHECK(s.found.presliding < 35e-6);
  CHECK(s.found.quantum >= 10e-6);
  CHECK(s.found.quantum < 10.1e-6);
  CHECK(s.found.noise == 0.0);
  CHECK(s.found.latency == 1);
  CHECK(s.found.longest_tick == 1e-3);
  for (const int way : {0, 1}) {
    CHECK(s.found.breakaway_least[way] <= 0.2);
    CHECK(s.found.breakaway_most[way] >= 0.2);
  }
  CHECK(s.largest <= 3.0);
  CHECK(s.last == 0.0);
  CHECK(s.seconds < 60.0);
}

TEST_CASE("no more force than stated is ever commanded, nor any after the end",
          "[identification]") {
  const auto s =
      identified(rubbing<sim::slider_and_spring>(grip, {}, rubs), {.force = 1.2, .stroke = 6e-3});
  CHECK(s.largest <= 1.2);
  CHECK(s.largest > 1.0);
  CHECK(s.last == 0.0);
  CHECK(s.found.problem == nullptr);
}

TEST_CASE("friction and damping that are not there are not found", "[identification]") {
  auto slippery = grip;
  slippery.damping = 0.0;
  const auto s = identified(sim::device<d1>(slippery));
  REQUIRE(s.found.problem == nullptr);
  CHECK(s.found.friction == 0.0);
  CHECK(s.found.remark != nullptr);
  CHECK(s.found.damping < 0.01);
  CHECK(s.found.mass > 0.09);
  CHECK(s.found.mass <= 0.1);
}

TEST_CASE("friction that varies along the way is stated where it is least",
          "[identification][long]") {
  const sim::stribeck_friction even{0.2, 0.26, 5e-3, 15e-6, 0.0, 0.0, 0.0};
  const sim::stribeck_friction rippled{0.2, 0.26, 5e-3, 15e-6, 0.3, 0.5e-3, 0.0};
  const auto a = identified(rubbing<sim::stribeck_friction>(grip, {}, even)).found;
  const auto b = identified(rubbing<sim::stribeck_friction>(grip, {}, rippled)).found;
  CHECK(a.friction <= 0.2);
  CHECK(a.friction > 0.15);
  CHECK(a.uneven < 0.1);
  CHECK(b.friction <= 0.14);
  CHECK(b.friction > 0.05);
  CHECK(b.uneven > 0.2);
}

TEST_CASE("friction that creeps under a force that comes and goes is not relied on",
          "[identification][long]") {
  const auto lugre =
      identified(rubbing<sim::lugre_friction>(grip, {}, {0.2, 0.26, 5e-3, 30e-6, 0.0, 0.0}));
  REQUIRE(lugre.found.problem == nullptr);
  CHECK(lugre.found.friction == 0.0);
  REQUIRE(lugre.found.remark != nullptr);
  CHECK(std::string(lugre.found.remark).find("creeps") != std::string::npos);
  const auto dahl =
      identified(rubbing<sim::dahl_friction>(grip, {}, {.level = 0.2, .presliding = 30e-6}));
  CHECK(dahl.found.friction == 0.0);
  // Dupont's creeps from 0.12 N on, and slips at 0.2 N
  const auto dupont =
      identified(rubbing<sim::dupont_friction>(grip, {}, {0.12, 18e-6, 30e-6, 0.0}));
  CHECK(dupont.found.friction <= 0.12);
  CHECK(dupont.found.friction > 0.04);
  CHECK(dupont.found.likely_friction > 0.19);
}

TEST_CASE("a held hand is refused, with the remedy", "[identification][long]") {
  using held = sim::device<d1, sim::impedance_hand<d1>, sim::slider_and_spring>;
  for (const double stiffness : {60.0, 150.0, 300.0, 800.0, 3000.0}) {
    CAPTURE(stiffness);
    held device(grip, {.stiffness = stiffness, .damping = 2.0, .own_mass = 0.1}, rubs);
    const auto s = identified(device);
    CHECK(s.says("let go of the device"));
    CHECK(s.last == 0.0);
  }
}

TEST_CASE("a force too low, or a stroke too short, is said", "[identification]") {
  auto stiff = rubs;
  stiff.level = {0.5};
  CHECK(identified(rubbing<sim::slider_and_spring>(grip, {}, stiff), {.force = 0.25})
            .says("more force"));
  const auto s = identified(rubbing<sim::slider_and_spring>(grip, {}, rubs), {.stroke = 0.2e-3});
  CHECK(s.found.problem != nullptr);
  CHECK(s.says("longer stroke"));
}

TEST_CASE("a device that runs away is let go, with a sentence", "[identification]") {
  auto pulled = grip;
  pulled.load = 6.0;  // beyond the 3 N allowed
  const auto s = identified(sim::device<d1>(pulled));
  CHECK(s.says("left the workspace"));
  CHECK(s.last == 0.0);
  const auto later =
      identified(rubbing<sim::slider_and_spring>(grip, {}, rubs), {},
                 [](int n, auto& sample) { sample.position += n > 20000 ? 1.0 : 0.0; });
  CHECK(later.says("it changed while it was measured"));
  CHECK(later.last == 0.0);
}

TEST_CASE("samples that are no numbers give no force, few are borne, many end it",
          "[identification]") {
  const auto device = [] { return rubbing<sim::slider_and_spring>(grip, {}, rubs); };
  axis_identification of;
  (void)of.tick(0.0, 1ms);
  CHECK(of.tick(0.0, 1ms) != 0.0);  // the control
  CHECK(of.tick(no_number, 1ms) == 0.0);
  CHECK(of.tick(0.0, ph::seconds{no_number}) == 0.0);
  CHECK(of.tick(0.0, ph::seconds{0.0}) == 0.0);
  CHECK(of.tick(0.0, ph::seconds{-1e-3}) == 0.0);
  CHECK(of.lost() == 0.0);
  const auto few = identified(device(), {}, [](int n, auto& sample) {
    if (n % 997 == 0) sample.position = no_number;
  });
  REQUIRE(few.found.problem == nullptr);
  CHECK(few.found.mass <= 0.1);
  CHECK(few.found.mass > 0.09);
  CHECK(few.found.damping <= 0.3);
  CHECK(few.found.friction <= 0.2);
  const auto many = identified(device(), {}, [](int n, auto& sample) {
    if (n % 3 == 0) sample.position = no_number;
  });
  CHECK(many.says("too few good samples"));
  const auto silent = identified(device(), {}, [](int n, auto& sample) {
    if (n > 5000) sample.dt = no_number;
  });
  CHECK(silent.says("too few good samples"));
  CHECK(silent.last == 0.0);
}

TEST_CASE("jitter and noise are borne, and both are in what is found", "[identification]") {
  rubbing<sim::slider_and_spring> device(grip, {}, rubs);
  sim::random_source random(9);
  const auto s = identified(device, {}, [&](int, auto& sample) {
    sample.position += 15e-6 * (random.uniform() - 0.5);
    (void)device.set_period(1e-3 * random.uniform(0.7, 1.0));
  });
  INFO((s.found.problem != nullptr ? s.found.problem : identification::table_of(s.found)));
  REQUIRE(s.found.problem == nullptr);
  CHECK(s.found.mass <= 0.1);
  CHECK(s.found.mass > 0.085);
  CHECK(s.found.damping <= 0.3);
  CHECK(s.found.friction <= 0.2);
  CHECK((s.found.friction == 0.0 || s.found.presliding >= 15e-6));
  CHECK(s.found.quantum == 0.0);
  CHECK(s.found.noise >= 25e-6);
  CHECK(s.found.longest_tick > 0.99e-3);
}

TEST_CASE("a sensor slower than the loop is refused", "[identification]") {
  double shown = 0.0;
  const auto s =
      identified(rubbing<sim::slider_and_spring>(grip, {}, rubs), {}, [&](int n, auto& sample) {
        if (n % 4 == 0) shown = sample.position;
        sample.position = shown;
      });
  CHECK(s.says("slower than the loop"));
}

TEST_CASE("an identification can be stopped, and refuses parameters out of their range",
          "[identification]") {
  axis_identification of;
  CHECK(std::string(of.result().problem).find("not at its end") != std::string::npos);
  (void)of.tick(0.0, 1ms);
  CHECK(of.tick(0.0, 1ms) != 0.0);
  of.stop();
  CHECK(of.done());
  CHECK(of.tick(0.0, 1ms) == 0.0);
  CHECK(std::string(of.result().problem).find("stopped") != std::string::npos);
  CHECK_FALSE(identification_parameters{}.check());
  for (const identification_parameters& wrong :
       std::initializer_list<identification_parameters>{{.force = 0.0},
                                                        {.force = no_number},
                                                        {.stroke = -1.0},
                                                        {.workspace = 10e-3},
                                                        {.sweep_time = 0.1},
                                                        {.places = 1},
                                                        {.friction_time = 1.0},
                                                        {.creep_cycles = 1}}) {
    CHECK(wrong.check());
    axis_identification refused(wrong);
    CHECK(refused.done());
    CHECK(refused.tick(0.0, 1ms) == 0.0);
    CHECK(refused.problem() != nullptr);
  }
}

TEST_CASE("every axis of a device is identified, in float as well, and stop() ends it at once",
          "[identification][long]") {
  using device = sim::device<d2, sim::no_hand<d2>, sim::slider_and_spring>;
  const sim::device_parameters<d2> truth{
      .mass = 0.1, .damping = 0.3, .quantum = 10e-6, .load = {0.0, -0.3}, .latency = 2};
  device grip2(truth, {}, rubs);
  const auto found = identification::identify<d2>(grip2);
  REQUIRE(found.problem() == nullptr);
  const auto stated = found.stated();
  CHECK_FALSE(stated.check());
  CHECK(stated.mass <= 0.1);
  CHECK(stated.mass > 0.085);
  CHECK(stated.damping <= 0.3);
  CHECK(stated.friction <= 0.2);
  CHECK(stated.friction > 0.05);
  CHECK(stated.presliding >= 15e-6 * std::sqrt(2.0));
  CHECK(stated.quantum >= 10e-6);
  CHECK(found.latency() == 2);
  const std::string text = identification::composition_of(found);
  for (const char* part :
       {"ph::space<double, 2>", "ph::encoder_device device{.mass = 0.0", ".damping = 0.19",
        ".presliding = ", ".quantum = 1", "ph::late_loop_limits<2>", "walls of up to "}) {
    CAPTURE(part, text);
    CHECK(text.find(part) != std::string::npos);
  }

  device again(truth, {}, rubs);
  int asked = 0;
  const auto stopped = identification::identify<d2>(again, {}, [&asked] { return ++asked > 300; });
  CHECK(asked == 301);
  CHECK(std::string(stopped.problem()).find("stopped") != std::string::npos);
  CHECK(identification::composition_of(stopped).find("make_touch") == std::string::npos);
}
