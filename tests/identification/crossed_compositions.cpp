// SPDX-License-Identifier: BSD-3-Clause
// make_touch and make_detents, told of known_crossings: where they are used and where today's composition is left, what
// is refused, and what becomes of them where mass, hand force or acceleration are told wrong, or right for long.
#include "support/catch.hpp"
#include "support/half_told.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/identification/crossed_compositions.hpp>
#include <passive_haptics/identification/device_facts.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace sim = ph::simulation;
namespace design = ph::design;

namespace {

using pressed = sim::constant_hand<d1>;
constexpr ph::known_crossings known{};
constexpr double most_pushed = 5.0;  ///< by the hand [N]

ph::known_hand hand_on(const sim::device_preset& is) {
  return {.force = most_pushed + is.friction};
}

struct session {
  double least = 0.0;        ///< energy at the port [J]
  int outside = 0;           ///< events
  bool refuted = false;      ///< a crossing was
  std::string says;          ///< explain() of crossings, afterwards
  std::vector<double> told;  ///< every force [N] and every energy of the ledger [J]
};
/// A hand that jumps between pushes of at most 5 N, on a wall of 20 kN/m.
session jump(auto touch, const sim::device_preset& is, double p, int ticks, std::uint64_t seed) {
  sim::random_source random(seed);
  auto parameters = is.without_friction<d1>();
  parameters.start = -1e-3;
  sim::device<d1, pressed, sim::slider_and_spring> device(parameters, {1.0, most_pushed},
                                                          is.friction_of(p));
  REQUIRE_FALSE(touch.check());
  REQUIRE(touch.update({0.0, -1.0, 20e3}));
  session found;
  const auto person = [&](const auto& now) {
    if (now.tick > 300 && random.chance(0.02)) {
      device.hand().push =
          random.chance(0.7) ? random.uniform(-1.0, 5.0) : random.uniform(-5.0, 5.0);
    }
    if (now.position > 5e-3) device.hand().push = -2.0;
    if (now.position < -5e-3) device.hand().push = 2.0;
  };
  const auto watch = [&](const auto& now) {
    found.outside += now.out.what == ph::event::outside_force ? 1 : 0;
    found.told.push_back(now.force);
    found.told.push_back(now.out.energy);
    if constexpr (requires { touch.observer().steps().refuted(); }) {
      found.refuted |= touch.observer().steps().refuted();
    }
    return true;
  };
  found.least = sim::run(device, touch, ticks, sim::idle, person, watch).least_energy;
  found.says = touch.explain().crossings;
  return found;
}

}  // namespace

TEST_CASE("known_crossings are used where they pay, and say so", "[crossed][compositions]") {
  const auto asked = [](const sim::device_preset& is, double p) {
    auto touch = ph::make_touch<d1>(half_told(is, p), known, hand_on(is));
    REQUIRE_FALSE(touch.check());
    REQUIRE(touch.update({0.0, -1.0, 1e6}));
    const auto today = ph::make_touch<d1>(half_told(is, p), hand_on(is));
    CHECK(std::string(today.explain().crossings).empty());
    return std::pair{touch.law().parameters().most / today.law().parameters().most,
                     std::string(touch.explain().crossings)};
  };
  const auto wheel = sim::wheel_preset{}.at_rim();
  using bound = ph::bound_chain<ph::watched_crossings<ph::reachable_bound>, ph::thermal_limit>;
  const auto one = ph::make_touch<d1>(half_told(wheel, 0.0), known, hand_on(wheel));
  STATIC_REQUIRE(std::same_as<std::remove_cvref_t<decltype(one.bound())>, ph::part_at<bound, d1>>);
  CHECK_FALSE(ph::make_touch<f3>(half_told(wheel, 0.0), known, hand_on(wheel)).check());
  for (const double p : {0.0, 5e-6, 15e-6}) {
    const auto [gain, why] = asked(wheel, p);
    CHECK(gain > 1.1);
    CHECK(why.find("known well") != std::string::npos);
  }
  for (const auto& [is, p] : {std::pair{wheel, 30e-6},
                              {sim::falcon_like, 5e-6},
                              {sim::touch_like, 5e-6},
                              {sim::omega_like, 5e-6}}) {
    const auto [gain, why] = asked(is, p);
    CAPTURE(is.name);
    CHECK(gain == 1.0);
    CHECK(why.find("edge_observer") != std::string::npos);
  }
}

TEST_CASE("a knob told of known_crossings has stiffer detents, and loses nothing",
          "[crossed][compositions]") {
  const auto is = sim::wheel_preset{}.at_rim();
  const auto d = half_told(is, 5e-6);
  const ph::detents shape{.pitch = 0.02, .stiffness = 20e3};
  auto knob = ph::make_detents<d1>(d, known, hand_on(is), shape);
  const auto today = ph::make_detents<d1>(d, hand_on(is), shape);
  REQUIRE_FALSE(knob.check());
  CHECK(knob.explain().shown > 1.1 * today.explain().shown);
  CHECK(std::string(knob.explain().crossings).find("known well") != std::string::npos);
  auto parameters = is.without_friction<d1>();
  parameters.start = 0.0;
  sim::device<d1, pressed, sim::slider_and_spring> device(parameters, {1.0, most_pushed},
                                                          is.friction_of(5e-6));
  sim::random_source random(3);
  int outside = 0;
  const auto person = [&](const auto& now) {
    if (random.chance(0.01)) device.hand().push = random.uniform(-5.0, 5.0);
    if (std::abs(now.position) > 0.1) device.hand().push = now.position > 0.0 ? -5.0 : 5.0;
  };
  const auto watch = [&](const auto& now) {
    outside += now.out.what == ph::event::outside_force ? 1 : 0;
    return true;
  };
  const auto run = sim::run(device, knob, 10000, sim::idle, person, watch);
  CHECK(run.least_energy >= -1e-12);
  CHECK(run.largest_force > 5.0);
  CHECK(outside == 0);
}

TEST_CASE("known_crossings leave a device as it is where nothing is known of them",
          "[crossed][compositions]") {
  const auto same = [](const sim::device_preset& is) {
    const auto today =
        jump(ph::make_touch<d1>(half_told(is, 5e-6), hand_on(is)), is, 5e-6, 6000, 1);
    const auto asked =
        jump(ph::make_touch<d1>(half_told(is, 5e-6), known, hand_on(is)), is, 5e-6, 6000, 1);
    return today.told == asked.told;
  };
  CHECK(same(sim::touch_like));
  CHECK(same(sim::omega_like));
  CHECK_FALSE(same(sim::falcon_like));  // the ledger knows more there, if not the position
}

TEST_CASE("known_crossings name what cannot be", "[crossed][compositions]") {
  const auto wheel = half_told(sim::wheel_preset{}.at_rim(), 5e-6);
  const auto refused = [&](auto change, ph::known_crossings of = {}, double hand = 5.3) {
    auto d = wheel;
    change(d);
    const auto fault = ph::make_touch<d1>(d, of, {.force = hand}).check();
    const auto knob =
        ph::make_detents<d1>(d, of, {.force = hand}, {.pitch = 0.01, .stiffness = 1000.0}).check();
    CHECK(static_cast<bool>(knob) == static_cast<bool>(fault));
    return std::string(fault ? fault.parameter : "");
  };
  const auto as_it_is = [](auto&) {};
  CHECK(refused(as_it_is).empty());
  CHECK(refused([](auto& d) { d.mass = 0.0; }) == "mass");
  CHECK(refused([](auto& d) { d.quantum = -1e-6; }) == "quantum");
  CHECK(refused([](auto& d) { d.friction = 0.0; }) == "most");
  CHECK(refused([](auto& d) { d.latency = 1; }) == "longest_tick");
  CHECK(refused(as_it_is, {.acceleration = 0.0}) == "acceleration");
  CHECK(refused(as_it_is, {}, -1.0) == "hand_force");
}

TEST_CASE(
    "a mass, a hand or an acceleration that is told wrong is an event, and is counted on no more",
    "[crossed][compositions]") {
  const auto is = sim::heavy_1kg;
  auto light = is;
  light.mass /= 6.0;
  const auto d = half_told(is, 5e-6);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const auto session_of = [&](const ph::known_crossings& of, double hand, const auto& truth) {
      return jump(ph::make_touch<d1>(d, of, {.force = hand}), truth, 5e-6, 8000, seed);
    };
    const double hand = hand_on(is).force;
    // A hand that pushes harder may be found by the bound's own test first, which leaves nothing to be refuted.
    const session heavier = session_of(known, hand, light), stronger = session_of(known, 0.8, is),
                  quicker = session_of({.acceleration = 0.5}, hand, is);
    CHECK(heavier.refuted);
    CHECK(quicker.refuted);
    CHECK(heavier.says.find("has refuted") != std::string::npos);
    for (const session& s : {heavier, stronger, quicker}) {
      CHECK(s.outside > 0);
      CHECK(s.least >= -1e-9);
    }
    const auto honest = session_of(known, hand, is);  // the control
    CHECK(honest.outside == 0);
    CHECK_FALSE(honest.refuted);
    CHECK(honest.says.find("known well") != std::string::npos);
  }
}

TEST_CASE("after a blow that refutes crossings the wall is back", "[crossed][compositions]") {
  const auto is = sim::heavy_1kg;
  auto touch = ph::make_touch<d1>(half_told(is, 5e-6), known, hand_on(is));
  REQUIRE(touch.update({0.0, -1.0, 1e6}));
  const double most = touch.explain().shown;
  auto parameters = is.without_friction<d1>();
  parameters.start = -1e-4;
  sim::device<d1, pressed, sim::slider_and_spring> device(parameters, {3.0, 60.0},
                                                          is.friction_of(5e-6));
  bool strict = false, refuted = false;
  double force = 0.0, depth = 0.0;
  const auto person = [&](const auto& now) {
    const double kneading = 3.0 + std::sin(now.time * 6.28);
    const int blow = now.tick - 3000;
    device.hand().push = blow >= 0 && blow < 40 ? (blow < 20 ? 40.0 : -60.0) : kneading;
  };
  const auto watch = [&](const auto& now) {
    strict |= now.out.what == ph::event::outside_force;
    refuted |= touch.observer().steps().refuted();
    if (now.tick < 8000) return true;
    force -= now.force;
    depth += std::max(0.0, now.position);
    return true;
  };
  const auto run = sim::run(device, touch, 12000, sim::idle, person, watch);
  CHECK(strict);
  CHECK(refuted);
  CHECK(run.least_energy >= -1e-9);
  CAPTURE(force / depth, most);
  CHECK(force > 0.8 * most * depth);
}

TEST_CASE("known_crossings raise no event in a long session of a hand as it was told",
          "[crossed][compositions][long]") {
  std::vector<sim::device_preset> all(sim::all_presets.begin(), sim::all_presets.end());
  for (const auto& facts : design::devices::all) {  // of which enough is known; damping of none is
    if (!facts.mass || !facts.friction || !facts.quantum[0] || facts.rotary) continue;
    all.push_back({facts.name, facts.mass.value, 0.05, facts.friction.value, facts.quantum[0].value,
                   facts.peak_force.value});
  }
  int runs = 0;
  for (const auto& is : all) {
    if (!(is.friction > 0.0)) continue;
    for (const double p : {1e-6, 15e-6}) {
      const auto s =
          jump(ph::make_touch<d1>(half_told(is, p), known, hand_on(is)), is, p, 60000, 7);
      CAPTURE(is.name, p, s.least);
      CHECK(s.outside == 0);
      CHECK_FALSE(s.refuted);
      CHECK(s.least >= -1e-12);
      ++runs;
    }
  }
  CHECK(runs >= 14);
}
