// SPDX-License-Identifier: BSD-3-Clause
// Passive set-position modulation: what the gate lets through, what it does not see, and what comes in
// over an edge or fades out. All the runs: tests/full/bounds_time_domain.cpp.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/constraint_geometry/segment.hpp>
#include <passive_haptics/published/set_position_modulation.hpp>

using attacks::drop, attacks::fall, attacks::model_of, attacks::tapped, attacks::worst_of;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double B = 30.0;  // of the thesis' device [N/m]
constexpr double T = 1e-3;

using gate = ph::set_position_modulation;
using published_gate = ph::published_set_position_modulation;

template <class Shaper>
auto gated(const Shaper& shaper) {
  return ph::shaped{ph::spring{}, shaper};
}
/// Behind nothing but the spring: what it promises by itself.
template <class Space, class Law>
auto by_itself(const Law& law) {
  return model_of<Space>(ph::no_bound{}, thesis_loop, law);
}

static_assert([] {
  auto pspm = at<f1>(gate{});
  const ph::contact_state<f1> contact{-1.0F, 50.0F, 0.0F, 0.02F, 0.0F, true};
  return allowed(pspm, -1.0F, contact, situation<f1>{.energy = 0.001F}) == 0.0F;
}());

}  // namespace

TEST_CASE("the gate lets an update add only what its tank holds", "[time domain]") {
  gate parameters{.loan = 1e-3};
  auto pspm = at<d1>(parameters);
  ph::contact_state<d1> contact{.normal = -1,
                                .stiffness = 50.0,
                                .depth = 1e-3,
                                .target_depth = 0.0,
                                .local_force = 1,
                                .target_changed = true};
  situation<d1> now;
  const auto force = [&](double desired) { return allowed(pspm, desired, contact, now); };
  CHECK(force(0.0) == 0.0);
  contact.target_depth = 2e-3;  // K d²/2 = 0.1 mJ: covered
  CHECK(force(-0.1) == -0.1);
  CHECK_THAT(pspm.energy(), WithinRel(0.9e-3, 1e-12));
  SECTION("too far: K d²/2 = U_old + E") {
    contact.target_depth = 10e-3;  // 2.5 mJ are asked, 1 mJ is there
    const double covered = std::sqrt(2e-3 / 50.0), gap = 10e-3 - covered;
    CHECK_THAT(force(-0.5), WithinRel(-50.0 * covered, 1e-12));
    CHECK_THAT(pspm.energy(), WithinAbs(0.0, 1e-15));
    contact.target_changed = false;
    now.held = -50.0 * covered;
    SECTION("the gap stays while the spring is left alone") {
      now.travel = 1e-3;
      contact.target_depth = 11e-3;
      CHECK_THAT(force(-0.55), WithinRel(-50.0 * (11e-3 - gap), 1e-9));
      now.held = -50.0 * (11e-3 - gap);
      contact.target_depth = 12e-3;
      CHECK_THAT(force(-0.6), WithinRel(-50.0 * (12e-3 - gap), 1e-9));
    }
    SECTION("the surface follows the device out") {
      now.travel = -8e-3;
      contact.target_depth = 2e-3;
      CHECK(force(-0.1) == 0.0);
      now.travel = 1e-3;  // the gap is 2 mm now
      now.held = 0.0;
      contact.target_depth = 3e-3;
      CHECK_THAT(force(-0.15), WithinRel(-50.0 * 1e-3, 1e-9));
    }
    SECTION("the target is asked for again") {
      parameters.loan = 5e-3;
      pspm = at<d1>(parameters);
      contact = {-1.0, 50.0, 0.0, 20e-3, 1.0, true};  // 10 mJ are asked, 5 mJ are there
      now.held = 0.0;
      const double there = std::sqrt(2.0 * 5e-3 / 50.0);
      CHECK_THAT(force(-1.0), WithinRel(-50.0 * there, 1e-12));
      contact.target_changed = false;
      now.held = -50.0 * there - 50.0;  // 50 N more than the spring had, pressed in:
      now.travel = 2e-4;                // 10 mJ come in
      contact.target_depth += 2e-4;
      REQUIRE(force(-1.01) > -1.01);
      now.held = -50.0 * (there + 2e-4);
      now.travel = 0.0;
      for (int n = 0; n < 18; ++n) REQUIRE(force(-1.01) > -1.01);
      CHECK(force(-1.01) == -1.01);
    }
  }
  SECTION("a retreating surface refills the tank, up to its cap") {
    pspm.set({.loan = 1e-3, .cap = 0.95e-3});
    now.held = -0.1;
    contact.target_depth = 1e-3;  // 0.075 mJ come back
    static_cast<void>(force(-0.05));
    CHECK(pspm.energy() == 0.95e-3);
  }
  SECTION("the damper refills it: (b − KT/2) range²/time") {
    contact.target_changed = false;
    for (const double travel : {3e-4, 3e-4, -1e-4}) {
      now.held = -50.0 * contact.target_depth;
      now.travel = travel;
      contact.target_depth += travel;
      static_cast<void>(force(-50.0 * contact.target_depth));
    }
    CHECK_THAT(pspm.energy(), WithinRel(0.9e-3, 1e-9));
    now.travel = 0.0;
    now.held = -50.0 * contact.target_depth;
    contact.target_changed = true;  // four ticks after the last one
    static_cast<void>(force(-50.0 * contact.target_depth));
    CHECK_THAT(pspm.energy(), WithinRel(0.9e-3 + (0.03 - 0.025) * 36e-8 / 4e-3, 1e-9));
  }
  SECTION("what was not held is booked") {
    contact.target_changed = false;
    now.travel = 1e-3;
    contact.target_depth = 3e-3;
    now.held = -0.04;  // 0.06 N less than the spring had
    static_cast<void>(force(-0.15));
    CHECK_THAT(pspm.energy(), WithinRel(0.9e-3 - 0.06e-3, 1e-9));
  }
  SECTION("a lost or late tick leaves neither spring nor credit") {
    contact.target_changed = false;
    SECTION("lost") {
      now.motion_known = false;
    }
    SECTION("late") {
      now.dt = 1.1e-3;
    }
    CHECK(force(-0.1) == 0.0);
    CHECK(pspm.energy() == 0.0);
  }
}

TEST_CASE("in any row of ticks the gate holds what its formulas say", "[time domain]") {
  ph::laws::samples random(23);
  const auto one_of = [&](std::initializer_list<double> numbers) {
    return numbers.begin()[static_cast<int>((random.number<double>() + 1.0) * 0.5 *
                                            static_cast<double>(numbers.size()))];
  };
  constexpr double dt = 1.0 / 1024, b = 0.03;
  const gate p{.loan = 1e-3, .cap = 0.25, .ask_again = 5 * dt};
  auto pspm = at<d1>(p);
  struct spring {
    double K = 0.0, d = 0.0, gap = 0.0;
  } was;
  struct interval {
    double x = 0.0, least = 0.0, most = 0.0, time = 0.0, pays = HUGE_VAL;
  } since;
  double E = p.loan, at_target = -0.5, K = 16.0;
  int cut = 0, asked_again = 0, pays = 0;
  const auto stored = [](double stiffness, double d) {
    return d > 0.0 ? stiffness * d * d / 2.0 : 0.0;
  };
  for (int n = 0; n < 6000; ++n) {
    if (n % 60 == 0) {
      pspm.reset();
      E = p.loan;
      was = {};
      since = {};
    }
    const double travel = one_of({-2.0, -1.0, 0.0, 0.0, 0.0, 1.0, 2.0}) / 1024;
    const bool changes = random.number<double>() > 0.8;
    at_target = changes ? one_of({-4.0, 0.0, 1.0, 4.0, 32.0}) / 1024 : at_target + travel;
    if (changes) K = one_of({1.0 / 64, 16, 32, 80});
    const double before = was.K * std::max(was.d, 0.0);
    const situation<d1> now{.dt = one_of({dt, dt, dt, dt, dt, dt, 0.5 * dt, 2 * dt}),
                            .longest_tick = dt * one_of({1.0, 1.0, 1.5}),
                            .held = -before * one_of({1.0, 1.0, 0.5, 1.25}),
                            .travel = travel,
                            .motion_known = random.number<double>() < 0.97};
    double kept = 0.0;
    if (was.K > 0.0 && (!now.motion_known || now.dt > now.longest_tick)) {
      E = std::min(E, 0.0);
      since = {};
    } else if (was.K > 0.0) {
      E += (-before - now.held) * travel;
      since.x += travel;
      since.least = std::min(since.least, since.x);
      since.most = std::max(since.most, since.x);
      since.time += now.dt;
      since.pays = std::min(since.pays, b - was.K * now.longest_tick / 2.0);
      kept = stored(was.K, was.d + travel);
    }
    const bool again = was.gap > 0.0 && since.time >= p.ask_again;
    asked_again += again && !changes ? 1 : 0;
    if (changes || again) {
      const double range = since.most - since.least;
      if (since.time > 0.0 && since.pays > 0.0) {
        E += since.pays * range * range / since.time;
        pays += range > 0.0 ? 1 : 0;
      }
      since = {};
      was.gap = 0.0;
    }
    double d = std::min(at_target, std::max(at_target - was.gap, 0.0));
    const double budget = std::max(E + kept, 0.0);
    if (stored(K, d) > budget) {
      d = std::sqrt(2.0 * budget / K);
      ++cut;
    }
    E = std::min(E + kept - stored(K, d), p.cap);
    was = {K, d, at_target - d};
    const ph::contact_state<d1> contact{.normal = -1,
                                        .stiffness = K,
                                        .depth = at_target,
                                        .target_depth = at_target,
                                        .local_force = 0,
                                        .target_changed = changes};
    const double share = pspm.shape(-1.0, contact, now.port()).factor;
    CAPTURE(n, at_target, K, travel, now.held, now.dt);
    REQUIRE_THAT(pspm.energy(), WithinAbs(E, 1e-12));
    REQUIRE_THAT(share, WithinAbs(d < at_target ? d / at_target : 1.0, 1e-6));
    E = pspm.energy();  // no gap comes of rounding alone
    if (std::abs(was.gap) < 1e-12) was.gap = 0.0;
  }
  CHECK(std::min({cut, asked_again, pays}) > 30);
}

TEST_CASE("on a static wall stiffer than 2b/T the gate is the same as no bound", "[time domain]") {
  const fall bare = drop(model_of<d1>(ph::no_bound{}));
  const fall through = drop(by_itself<d1>(gated(published_gate{})));
  CHECK(bare.energy < -1.0);
  CHECK_THAT(through.energy, WithinRel(bare.energy, 1e-6));
  CHECK_THAT(through.swing, WithinRel(bare.swing, 1e-6));
  CHECK(tapped(by_itself<d1>(gated(gate{}))) < -1.0);
}

TEST_CASE("with K ≤ 2b/T the gate loses nothing to a surface that jumps, a spring does",
          "[time domain]") {
  const attacks::conditions jumps{.low = 20, .high = 2 * B}, stiff{.low = 4 * B, .high = 4 * B};
  const auto gate_alone = by_itself<d1>(gated(gate{}));
  CHECK(worst_of<d1>(gate_alone, jumps, 8).least >= -1e-12);
  CHECK(worst_of<d2>(by_itself<d2>(gated(gate{})), jumps, 4).least >= -1e-12);
  CHECK(worst_of<d1>(by_itself<d1>(ph::spring{}), jumps, 8).least < -1e-5);  // the control
  CHECK(worst_of<d1>(gate_alone, stiff, 8).least < -1e-6);  // outside its assumption
}

TEST_CASE("the gate as published spends the damper twice: once on the hold, once on the update",
          "[time domain]") {
  const auto press_jump_leave = [](const auto& shaper) {
    auto model = by_itself<d1>(gated(shaper));
    (void)model.update(wall<d1>(2 * B));
    sim::prescribed_motion<d1> device;
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 40; ++n) {
      if (n == 8) (void)model.update({-4e-3, -1.0, 2 * B});
      const double force = model.tick(sample).force;
      device.move_to(device.position() + (n < 8 ? 0.5e-3 : -0.25e-3));
      sample = device.exchange(force);
    }
    return device.meter().minimum();
  };
  CHECK_THAT(press_jump_leave(published_gate{.ask_again = 1.0}), WithinRel(-8 * B * 0.25e-6, 0.05));
  CHECK(press_jump_leave(gate{.ask_again = 1.0}) >= -1e-12);
}

namespace {

template <class Law>
auto segment_model(const Law& law, const ph::freshness& rule) {
  return ph::local_model{d2{},
                         ph::followed<ph::segment<d2>>{rule},
                         ph::turn_at_once{},
                         law,
                         thesis_ledger(),
                         ph::no_bound{},
                         thesis_loop};
}

}  // namespace

TEST_CASE("the gate covers what comes in over an edge and what fades out", "[time domain]") {
  const auto wander = [](const auto& law, const ph::freshness& rule, std::uint64_t seed) {
    auto model = segment_model(law, rule);
    sim::prescribed_motion<d2> device({.damping = 0.03});
    sim::random_source random(seed);
    sim::jumping_surface jumps(1e-3, seed);
    auto sample = device.exchange(d2::zero());
    double offset = 1.0;
    for (int n = 0; n < 3000; ++n) {
      const double moved = jumps.offset(device.time());
      if (moved != offset) {
        offset = moved;
        (void)model.update({.a = {1e-3, moved}, .b = {-1e-3, moved}, .stiffness = 2 * B});
      }
      const d2::vector force = model.tick(sample).force;
      device.move_to(
          d2::vector(device.position() + random.direction<d2>() * random.uniform(0.0, 0.3e-3)) *
          0.98);
      sample = device.exchange(force);
    }
    return device.meter().minimum();
  };
  const ph::freshness never{}, soon{.stale_after = 0.01, .fade = 0.02};
  for (const auto& rule : {never, soon}) {
    double worst = 0.0, control = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      worst = std::min(worst, wander(gated(gate{}), rule, seed));
      control = std::min(control, wander(ph::spring{}, rule, seed));
    }
    CHECK(worst >= -1e-12);
    CHECK(control < -1e-5);
  }
}

TEST_CASE("the gate gives no spring for a way in that was not paid", "[time domain]") {
  // 4 mm in without a force, then into a full contact at once, then slowly out again
  const double step = 0.25e-3;
  const auto beside_then_under = [step](const auto& law) {
    auto model = segment_model(law, {});
    (void)model.update({.a = {1e-3, 0}, .b = {-1e-3, 0}, .stiffness = 2 * B});
    sim::prescribed_motion<d2> device({.damping = 0.03, .start = {1.5e-3, 0}});
    auto sample = device.exchange(d2::zero());
    for (int n = 0; n < 60; ++n) {
      const d2::vector force = model.tick(sample).force;
      const d2::vector way = n < 16   ? d2::vector(0, -step)
                             : n < 20 ? d2::vector(-step, 0)
                                      : d2::vector(0, step / 2);
      device.move_to(device.position() + way);
      sample = device.exchange(force);
    }
    return device.meter().value();
  };
  const auto faded_then_back = [step](const auto& law) {
    ph::local_model model{d1{},
                          ph::followed<ph::half_space<d1>>{{.stale_after = 2e-3, .fade = T}},
                          ph::turn_at_once{},
                          law,
                          thesis_ledger(),
                          ph::no_bound{},
                          thesis_loop};
    sim::prescribed_motion<d1> device;
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 60; ++n) {
      if (n == 0 || n >= 20) (void)model.update(wall<d1>(2 * B));
      const double force = model.tick(sample).force;
      device.move_to(device.position() + (n < 4 ? 0.0 : n < 20 ? step : -step / 2));
      sample = device.exchange(force);
    }
    return device.meter().value();
  };
  CHECK(beside_then_under(gated(gate{})) >= -1e-12);
  CHECK(beside_then_under(ph::spring{}) < -1e-4);
  CHECK(faded_then_back(gated(gate{})) >= -1e-12);
  CHECK(faded_then_back(ph::spring{}) < -1e-4);
}

TEST_CASE("the gate in front of strict_bound is strict at any stiffness", "[time domain]") {
  const auto chain = model_of<d1>(ph::strict_bound{}, thesis_loop, gated(gate{}));
  const auto alone = by_itself<d1>(gated(gate{}));
  static_assert(decltype(chain)::passivity == ph::guarantee::strict);
  static_assert(decltype(alone)::passivity == ph::guarantee::none);
  CHECK(worst_of<d1>(chain, {}).least >= -1e-12);
  CHECK(worst_of<d1>(chain, {.lost = 0.05, .late = 0.05}).least >= -1e-12);
  CHECK(tapped(chain) >= -1e-12);
  CHECK(worst_of<d1>(alone, {}).least < -1e-3);  // without it, at 2 to 22 kN/m
}

TEST_CASE("the gate takes new parameters, refuses bad ones and starts anew", "[time domain]") {
  CHECK_FALSE(gate{.cap = 0.0}.check());
  const gate first{.loan = 1e-3}, full{.loan = 1e-3, .cap = 1e-9}, none{.cap = -1};
  check_upkeep(by_itself<d1>(gated(first)), first, full, none);
}

TEST_CASE("a tank in debt lets no update through, and a lost tick does not forgive it",
          "[time domain]") {
  auto pspm = at<d1>(gate{.loan = 1e-4});
  ph::contact_state<d1> contact{-1.0, 50.0, 0.0, 2e-3, 1.0, true};  // ½ K d² is all of the loan
  situation<d1> now;
  now.damping = ph::part_at<ph::isotropic_damping, d1>(0.025);  // K T/2: the damper pays nothing in
  const auto force = [&] { return allowed(pspm, -50.0 * contact.target_depth, contact, now); };
  REQUIRE_THAT(force(), WithinRel(-0.1, 1e-9));
  now.held = -1.1;  // the motors push out 1 N harder than the spring, for 0.1 mm
  now.travel = -1e-4;
  contact.target_depth -= 1e-4;
  const double debt = 1e-4 - 50.0 * 1.9e-3 * 1.9e-3 / 2.0;  // less what the spring gives back
  CHECK(force() == 0.0);
  CHECK_THAT(pspm.energy(), WithinRel(-debt, 1e-9));
  now.motion_known = false;
  now.travel = 0.0;
  CHECK(force() == 0.0);
  CHECK_THAT(pspm.energy(), WithinRel(-debt, 1e-9));
  now.motion_known = true;
  now.held = -1.0;  // the hand presses in against 1 N: 12 µJ, of which the debt is paid first
  now.travel = 12e-6;
  contact.target_depth += 12e-6;
  const double paid =
      12e-6 + 50.0 * 12e-6 * 12e-6 / 2.0;  // and what the spring holds over that way
  CHECK_THAT(force(), WithinRel(-50.0 * std::sqrt(2.0 * (paid - debt) / 50.0), 1e-9));
}
