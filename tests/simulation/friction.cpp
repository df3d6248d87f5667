// SPDX-License-Identifier: BSD-3-Clause
// The frictions of the simulated device by themselves: what they take, what they keep, and what may be
// claimed of them. On a device: friction_axis.cpp.
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>
#include <string>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double c = 0.2;    // [N]
constexpr double p = 15e-6;  // [m]

bool claims(const auto& model) {
  return model.claim().level > 0.0;
}

/// What is in the springs [J].
double stored(const auto& model, const auto& memory) {
  if constexpr (requires { model.level[0]; }) {
    double sum = 0.0;
    for (std::size_t i = 0; i < model.level.size(); ++i) {
      sum += model.level[i] / model.presliding[i] * memory[i] * memory[i] / 2;
    }
    return sum;
  } else {
    return model.stiffness() * memory * memory / 2;
  }
}

/// The deflection that its claim speaks of [m].
double deflection(const auto& model, const auto& memory) {
  if constexpr (requires { model.level[0]; }) {
    double moment = 0.0;
    for (std::size_t i = 0; i < model.level.size(); ++i) moment += model.level[i] * memory[i];
    return moment / model.claim().level;
  } else {
    return memory;
  }
}

/// Tries everything that can be said of a model along random ways.
void obeys(const auto& model) {
  REQUIRE_FALSE(model.check());
  sim::random_source random{3};
  auto memory = model.begin();
  double x = 0.0;
  double least_excess = infinity, farthest = 0.0;
  const auto [level, presliding] = model.claim();
  for (int n = 0; n < 4000; ++n) {
    const double way = (random.chance(0.5) ? 1.0 : -1.0) * p * std::exp(random.uniform(-6.0, 4.0));
    const double time = 1e-3 * std::exp(random.uniform(-4.0, 7.0));
    const double before = stored(model, memory), z = deflection(model, memory);
    const sim::friction_work took = model.slide(memory, x, way, time);
    const double slipped = std::abs(way - (deflection(model, memory) - z));
    const double rounding = 1e-12 * (std::abs(took.work) + c * std::abs(way) + c * p);
    REQUIRE(took.dissipated >= 0.0);
    REQUIRE_THAT(took.work - took.dissipated, WithinAbs(stored(model, memory) - before, rounding));
    least_excess = std::min(least_excess, took.dissipated - level * slipped + rounding);
    farthest = std::max(farthest, std::abs(deflection(model, memory)));
    if (claims(model)) {  // and its springs hold what those of the claim would, at least
      const double bent = deflection(model, memory);
      REQUIRE(stored(model, memory) >= level / presliding * bent * bent / 2 * (1 - 1e-12));
    }
    x += way;
  }
  if (claims(model)) {
    CHECK(least_excess >= 0.0);
    CHECK(farthest <= presliding * (1 + 1e-12));
    CHECK(farthest > presliding * 0.99);  // it could not be claimed smaller
  }
}

/// slide(a + b) is slide(a) and slide(b), at the same speed.
void adds_up(const auto& model, double accepted) {
  sim::random_source random{5};
  for (int n = 0; n < 500; ++n) {
    auto memory = model.begin();
    const double x = random.uniform(-1e-3, 1e-3), speed = std::exp(random.uniform(-12.0, 0.0));
    model.slide(memory, x, random.uniform(-2.0, 2.0) * p, 1e-3);
    const double way = random.uniform(-8.0, 8.0) * p, share = random.uniform();
    const double time = std::abs(way) / speed;
    auto in_two = memory;
    const auto whole = model.slide(memory, x, way, time);
    auto parts = model.slide(in_two, x, way * share, time * share);
    const auto rest = model.slide(in_two, x + way * share, way * (1 - share), time * (1 - share));
    CAPTURE(n, way, share, speed);
    REQUIRE_THAT(whole.work, WithinAbs(parts.work + rest.work, accepted * c * p));
    REQUIRE_THAT(deflection(model, memory), WithinAbs(deflection(model, in_two), accepted * p));
  }
}

const sim::slider_and_spring one{.level = {c}, .presliding = {p}};
const sim::maxwell_slip<3> three{.level = {0.05, 0.1, 0.05}, .presliding = {5e-6, 15e-6, 25e-6}};
const sim::dupont_friction dupont{.level = c, .breakaway = 8e-6, .presliding = p};
const sim::stribeck_friction stribeck{
    .kinetic = c, .static_level = 0.3, .stribeck_speed = 0.01, .presliding = p};
const sim::stribeck_friction rippled{.kinetic = c,
                                     .static_level = 0.3,
                                     .stribeck_speed = 0.01,
                                     .presliding = p,
                                     .ripple = 0.4,
                                     .wavelength = 0.2e-3};
const sim::dahl_friction dahl{.level = c, .presliding = p};
const sim::lugre_friction lugre{
    .kinetic = c, .static_level = 0.3, .stribeck_speed = 0.01, .presliding = p};

}  // namespace

TEST_CASE("every friction takes what it dissipates and stores, and keeps what it claims",
          "[simulation][friction][law]") {
  obeys(one);
  obeys(three);
  obeys(dupont);
  obeys(stribeck);
  obeys(rippled);
  obeys(dahl);
  obeys(lugre);
  CHECK_THAT(three.claim().level, WithinRel(0.2, 1e-14));
  CHECK_THAT(three.claim().presliding, WithinRel(15e-6, 1e-14));
  CHECK(one.claim().level == c);
  CHECK_THAT(rippled.claim().level, WithinRel(0.6 * c, 1e-14));
  CHECK_FALSE(claims(dahl));
  CHECK_FALSE(claims(lugre));
}

TEST_CASE("a friction takes the same along a way in one piece and in two",
          "[simulation][friction]") {
  adds_up(one, 1e-12);
  adds_up(three, 1e-12);
  adds_up(stribeck, 1e-12);
  adds_up(dahl, 1e-10);
  adds_up(lugre, 1e-10);
  adds_up(dupont, 1e-5);   // Runge and Kutta's error
  adds_up(rippled, 3e-2);  // a level for each 64th of a wave
}

TEST_CASE("presliding: all of it comes back from within p, and nothing of what is slipped",
          "[simulation][friction]") {
  auto z = one.begin();
  CHECK_THAT(one.slide(z, 0.0, p, 1e-3).work, WithinRel(c * p / 2, 1e-14));
  CHECK(one.slide(z, p, -p, 1e-3).dissipated == 0.0);
  CHECK(std::abs(z[0]) < 1e-20);
  CHECK_THAT(one.slide(z, 0.0, 3 * p, 1e-3).dissipated, WithinRel(2 * c * p, 1e-14));
  CHECK(z[0] == p);
  CHECK_THAT(one.slide(z, 0.0, -2 * p, 1e-3).work, WithinAbs(0.0, 1e-20));  // to the other side

  SECTION("Maxwell-slip slips altogether at the largest pᵢ, the first of it at the smallest") {
    auto many = three.begin();
    CHECK(three.slide(many, 0.0, 5e-6, 1e-3).dissipated == 0.0);
    CHECK_THAT(three.slide(many, 0.0, 1e-6, 1e-3).dissipated, WithinRel(0.05 * 1e-6, 1e-9));
    three.slide(many, 0.0, 20e-6, 1e-3);
    CHECK_THAT(three.slide(many, 0.0, 1e-6, 1e-3).dissipated, WithinRel(0.2 * 1e-6, 1e-9));
  }
  SECTION("Dupont's creeps from z_ba on, never farther than p") {
    auto u = dupont.begin();
    CHECK(dupont.slide(u, 0.0, 8e-6, 1e-3).dissipated == 0.0);
    CHECK_THAT(dupont.stiffness() * u, WithinRel(c, 1e-14));
    dupont.slide(u, 0.0, 1.0, 1e-3);
    CHECK_THAT(u, WithinRel(p, 1e-12));
    CHECK(dupont.slide(u, 0.0, -p, 1e-3).dissipated == 0.0);
  }
  SECTION("Stribeck's breaks away at its static level and slides at the kinetic one") {
    auto u = stribeck.begin();
    stribeck.slide(u, 0.0, 2 * p, 1e3);  // very slowly
    CHECK_THAT(stribeck.stiffness() * u, WithinRel(0.3, 1e-9));
    CHECK_THAT(stribeck.slide(u, 0.0, 1.0, 1.0).work, WithinRel(c, 1e-4));
    CHECK_THAT(stribeck.stiffness() * u, WithinRel(c, 1e-9));
    CHECK_THAT(rippled.level(0.05e-3, 1.0), WithinRel(1.4 * c, 1e-12));
    CHECK_THAT(rippled.level(0.15e-3, 1.0), WithinRel(0.6 * c, 1e-12));
  }
}

TEST_CASE("rippled friction takes the mean level over a wave", "[simulation][friction]") {
  auto u = rippled.begin();
  rippled.slide(u, 0.0, 0.2e-3, 1e-6);  // fast: the kinetic level
  CHECK_THAT(rippled.slide(u, 0.0, 0.2e-3, 1e-6).work, WithinRel(c * 0.2e-3, 1e-3));
}

namespace {

/// What a friction takes for each metre gained by "forward 2 a, back a" [N].
double under_dither(const auto& model, double a) {
  auto memory = model.begin();
  double x = 0.0;
  ph::compensated_sum<double> taken;
  const auto go = [&](double way) {
    taken += model.slide(memory, x, way, 1e-3).dissipated;
    x += way;
  };
  for (int n = 0; n < 2000; ++n) {
    go(2 * a);
    go(-a);
  }
  const double first = taken, from = x;
  for (int n = 0; n < 2000; ++n) {
    go(2 * a);
    go(-a);
  }
  return (taken - first) / (x - from);
}

}  // namespace

TEST_CASE(
    "forward 2, back 1 µm: what claims c takes c for each metre gained, Dahl and LuGre a third",
    "[simulation][friction][law]") {
  CHECK_THAT(under_dither(one, 1e-6), WithinRel(c, 1e-9));
  CHECK_THAT(under_dither(three, 1e-6), WithinRel(c, 1e-9));
  CHECK(under_dither(dupont, 1e-6) >= c);
  CHECK(under_dither(stribeck, 1e-6) >= c);
  CHECK(under_dither(rippled, 1e-6) >= 0.6 * c);
  CHECK_THAT(under_dither(dahl, 0.1e-6), WithinRel(c / 3, 1e-2));
  CHECK_THAT(under_dither(lugre, 0.1e-6), WithinRel(0.3 / 3, 1e-2));
  CHECK(under_dither(lugre, 1e-6) < 0.6 * c);
  // control: without the dither they take all of it
  CHECK_THAT(under_dither(dahl, 1e3 * p), WithinRel(3 * c, 1e-2));
}

TEST_CASE("a friction that cannot be is refused with a sentence", "[simulation][friction]") {
  CHECK(sim::slider_and_spring{{c}, {0.0}}.check());
  CHECK(sim::slider_and_spring{{-c}, {p}}.check());
  CHECK(sim::slider_and_spring{{not_a_number}, {p}}.check());
  CHECK(sim::slider_and_spring{{c}, {p}, 1.5}.check());
  CHECK(sim::dupont_friction{c, p, p}.check());
  CHECK(sim::dupont_friction{c, 0.0, p}.check());
  CHECK(sim::stribeck_friction{c, c / 2, 0.01, p}.check());
  CHECK(sim::stribeck_friction{c, c, 0.0, p}.check());
  CHECK(sim::stribeck_friction{c, c, 0.01, p, 0.5, 0.0}.check());
  CHECK(sim::lugre_friction{c, c / 2, 0.01, p}.check());
  CHECK(sim::lugre_friction{c, c, 0.01, p, -1.0}.check());
  CHECK(sim::dahl_friction{0.0, p}.check());
  CHECK(sim::friction_like{sim::friction_kind::dahl, c, 0.0}.check());
}

TEST_CASE("friction_like claims the level and the displacement it was made for",
          "[simulation][friction]") {
  for (const auto kind : sim::all_friction_kinds) {
    CAPTURE(to_string(kind));
    const sim::friction_like model{kind, c, p};
    CHECK_FALSE(model.check());
    const bool control = kind == sim::friction_kind::dahl || kind == sim::friction_kind::lugre;
    const auto claim = model.claim();
    if (control) {
      CHECK(claim.level == 0.0);
    } else {
      CHECK_THAT(claim.level, WithinRel(c, 1e-14));
      CHECK_THAT(claim.presliding, WithinRel(p, 1e-14));
    }
    auto memory = model.begin();
    model.slide(memory, 0.0, 1e-3, 1.0);
    const double sliding = model.slide(memory, 1e-3, 1e-3, 1.0).work / 1e-3;
    CHECK(sliding >= c * (1 - 1e-9));
    CHECK(sliding <= c * 1.5 / 0.7);
  }
  CHECK(std::string(to_string(static_cast<sim::friction_kind>(99))) == "unknown friction");
}
