// SPDX-License-Identifier: BSD-3-Clause
// Shapers that grow stiff: growth, caps, resets, what an increment costs. Against adversaries, with
// the strict bound behind them: tests/full/bounds_augmentation.cpp.
#include "published/growing.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A wall of 10 kN/m that pushes along −1; the device is `depth` inside and has moved by `moved`.
struct press {
  double depth, moved, energy;
  double stiffness = 1e4, dt = 1e-3;
  bool motion_known = true;
};
/// What a shaper leaves of the spring of that wall [N].
template <int Latency = 0>
double felt(auto& shaper, const press& now, double in_flight = 0.0) {
  const ph::contact_state<d1> contact{.normal = -1,
                                      .stiffness = now.stiffness,
                                      .depth = now.depth,
                                      .target_depth = now.depth,
                                      .local_force = 0,
                                      .target_changed = false};
  situation<d1, ph::isotropic_damping, Latency> port{
      .energy = now.energy, .dt = now.dt, .travel = now.moved, .motion_known = now.motion_known};
  port.commanded[0] = std::sqrt(in_flight * 120.0);  // f²/(4B)
  return -allowed(shaper, -now.stiffness * std::max(now.depth, 0.0), contact, port);
}

static_assert(obeys<d1>(ph::nonlinear_coupling{.initial = 50, .rate = 2e5}, 60));
static_assert(obeys<d1>(ph::stiffness_increment{.initial = 50, .step = 500}, 60));
static_assert(obeys<d1>(ph::force_augmentation{.low = 50, .step = 0.5}, 60));

}  // namespace

TEMPLATE_TEST_CASE("shapers that grow stiff obey the laws of strict bounds that only reduce",
                   "[shaper][law]", d1, f1, d2) {
  CHECK(obeys<TestType>(coupling, 1000));
  CHECK(obeys<TestType>(increments, 1000));
  CHECK(obeys<TestType>(offsets, 1000));
  CHECK_FALSE(obeys<TestType>(coupling, 1000, ph::no_bound{}));  // the control
}

TEST_CASE("nonlinear_coupling grows by rate·dt in series with the wall, up to its cap",
          "[shaper][augmentation]") {
  auto shaper = at<d1>(ph::nonlinear_coupling{.initial = 50, .rate = 2e5, .most = 600});
  const auto in_series = [](double Kc) { return Kc * 1e4 / (Kc + 1e4); };
  const press now{1e-3, 0.0, 1.0};
  for (const double Kc : {250.0, 450.0, 600.0, 600.0}) {
    CHECK_THAT(felt(shaper, now), WithinRel(in_series(Kc) * 1e-3, 1e-12));
    CHECK_THAT(shaper.coupling(), WithinRel(Kc, 1e-12));
  }
  SECTION("a longer tick grows more") {
    auto other = at<d1>(ph::nonlinear_coupling{.initial = 50, .rate = 2e5});
    (void)felt(other, {.depth = 1e-3, .moved = 0.0, .energy = 1.0, .dt = 2e-3});
    CHECK_THAT(other.coupling(), WithinRel(450.0, 1e-12));
  }
  SECTION("without a cap it comes as near to the wall as one likes") {
    auto other = at<d1>(ph::nonlinear_coupling{.initial = 50, .rate = 1e12});
    CHECK_THAT(felt(other, {1e-3, 0.0, 1e6}), WithinRel(10.0, 1e-4));
  }
  SECTION("it starts again when contact is lost") {
    CHECK(felt(shaper, {-1e-3, -1e-4, 1.0}) == 0.0);
    CHECK_THAT(felt(shaper, now), WithinRel(in_series(250) * 1e-3, 1e-12));
  }
  SECTION("it starts again when a sample is lost") {
    (void)felt(shaper, {.depth = 1e-3, .moved = 0.0, .energy = 1.0, .motion_known = false});
    CHECK(shaper.coupling() == 0.0);
  }
  SECTION("it starts again when it is reset") {
    CHECK(shaper.coupling() > 50.0);
    shaper.reset();
    CHECK(shaper.coupling() == 0.0);
  }
}

TEST_CASE("stiffness_increment grows once when a press follows a release",
          "[shaper][augmentation]") {
  auto shaper = at<d1>(ph::stiffness_increment{.initial = 50, .step = 500, .reset_after = 0.1});
  const press in{1e-3, 1e-5, 1.0}, out{1e-3, -1e-5, 1.0}, outside{-1e-3, -1e-4, 1.0};
  const auto tick = [&](const press& now) { return felt(shaper, now) / 1e-3; };
  CHECK_THAT(tick(in), WithinRel(50.0, 1e-12));
  CHECK_THAT(tick(in), WithinRel(50.0, 1e-12));
  CHECK_THAT(tick(out), WithinRel(50.0, 1e-12));
  CHECK_THAT(tick({1e-3, 0.0, 1.0}), WithinRel(50.0, 1e-12));  // at rest: neither
  CHECK_THAT(tick(in), WithinRel(550.0, 1e-12));
  CHECK_THAT(tick(in), WithinRel(550.0, 1e-12));  // once
  SECTION("up to the stiffness of the wall") {
    for (int n = 0; n < 30; ++n) {
      (void)tick(out);
      (void)tick(in);
    }
    CHECK(shaper.stiffness() == 1e4);
    CHECK(felt(shaper, in) == 1e4 * 1e-3);
  }
  SECTION("no stiffer than a wall that turns soft") {
    CHECK_THAT(tick({1e-3, 1e-5, 1.0, 300.0}), WithinRel(300.0, 1e-12));
  }
  SECTION("a bounce is a release") {
    for (int n = 0; n < 50; ++n) (void)felt(shaper, outside);  // 0.05 s
    CHECK_THAT(tick(in), WithinRel(1050.0, 1e-12));
  }
  SECTION("long enough away, it starts again") {
    for (int n = 0; n < 102; ++n) (void)felt(shaper, outside);
    CHECK_THAT(tick(in), WithinRel(50.0, 1e-12));
  }
  SECTION("it starts again when a sample is lost") {
    (void)felt(shaper, {.depth = 1e-3, .moved = 1e-5, .energy = 1.0, .motion_known = false});
    CHECK_THAT(tick(in), WithinRel(50.0, 1e-12));
  }
}

TEST_CASE("force_augmentation adds what is missing, a step at a turn", "[shaper][augmentation]") {
  auto shaper = at<d1>(ph::force_augmentation{.low = 50, .step = 0.5});
  const press in{1e-4, 1e-5, 1.0};
  const press out{1e-4, -1e-5, 1.0};  // missing: (10000 − 50)·1e-4 = 0.995 N
  CHECK_THAT(felt(shaper, in), WithinRel(0.005, 1e-12));
  CHECK_THAT(felt(shaper, in), WithinRel(0.005, 1e-12));  // no turn yet
  CHECK_THAT(felt(shaper, out), WithinRel(0.505, 1e-12));
  CHECK_THAT(felt(shaper, out), WithinRel(0.505, 1e-12));
  CHECK_THAT(felt(shaper, in), WithinRel(1.0, 1e-12));  // 0.495 N was left
  CHECK_THAT(shaper.offset(), WithinRel(0.995, 1e-12));
  SECTION("deeper, the offset stays and K_L presses on") {
    CHECK_THAT(felt(shaper, {2e-4, 1e-4, 1.0}), WithinRel(0.01 + 0.995, 1e-12));
  }
  SECTION("shallower, never more than the wall asks") {
    CHECK_THAT(felt(shaper, {5e-5, -5e-5, 1.0}), WithinRel(0.5, 1e-12));
    CHECK_THAT(shaper.offset(), WithinRel(0.4975, 1e-12));  // what is missing there
  }
  SECTION("down by a step at most") {
    shaper.set({.low = 50, .step = 0.1});
    (void)felt(shaper, {5e-5, -5e-5, 1.0});
    CHECK_THAT(shaper.offset(), WithinRel(0.895, 1e-12));
  }
  SECTION("it is gone with the contact") {
    CHECK(felt(shaper, {-1e-4, -2e-4, 1.0}) == 0.0);
    CHECK_THAT(felt(shaper, in), WithinRel(0.005, 1e-12));
  }
  SECTION("it is gone with a lost sample") {
    (void)felt(shaper, {.depth = 1e-4, .moved = 1e-5, .energy = 1.0, .motion_known = false});
    CHECK_THAT(felt(shaper, in), WithinRel(0.005, 1e-12));
  }
}

TEST_CASE("growth takes what the ledger has beyond release and worst tick, and no more",
          "[shaper][augmentation]") {
  // at d = 20 mm, K = 50: release U = K d²/2 = 10 mJ, worst tick (K d)²/4B = 8.33 mJ
  const double d = 0.02, U = 0.01;
  SECTION("stiffness_increment: ΔK = 2 E_free/d²") {
    for (const double spare : {-1e-3, 0.0, 1e-3, 0.02}) {
      auto shaper = at<d1>(ph::stiffness_increment{.initial = 50, .step = 500});
      (void)felt(shaper, {d, 1e-5, U});
      (void)felt(shaper, {d, -1e-5, U});
      (void)felt(shaper, {d, 1e-5, U + spare});
      CHECK_THAT((shaper.stiffness() - 50.0) * d * d / 2.0,
                 WithinAbs(std::max(spare, 0.0), 1e-15));  // charged in full
    }
  }
  SECTION("nonlinear_coupling: ΔK_c = 2 E_free/d²") {
    auto shaper = at<d1>(ph::nonlinear_coupling{.initial = 50, .rate = 1e7});
    (void)felt(shaper, {d, 0.0, 0.015, 1e12});  // K_f = K_c
    CHECK_THAT((shaper.coupling() - 50.0) * d * d / 2.0, WithinRel(0.005, 1e-6));
  }
  SECTION("force_augmentation: ΔF = E_free/d") {
    auto shaper = at<d1>(ph::force_augmentation{.low = 50, .step = 1e3});
    (void)felt(shaper, {d, 1e-5, U});
    (void)felt(shaper, {d, -1e-5, U + 3e-3});
    CHECK_THAT(shaper.offset() * d, WithinRel(3e-3, 1e-9));
    const double kept = shaper.offset();  // the next turn finds it promised
    (void)felt(shaper, {d, 1e-5, U + 3e-3});
    CHECK_THAT(shaper.offset(), WithinRel(kept, 1e-9));
  }
  SECTION("the same credit is not promised twice") {
    auto shaper = at<d1>(ph::nonlinear_coupling{.initial = 50, .rate = 1e3});
    for (int n = 0; n < 1000; ++n) (void)felt(shaper, {d, 0.0, U + 1e-3});
    const double K = shaper.coupling() * 1e4 / (shaper.coupling() + 1e4);
    CHECK(K * d * d / 2.0 <= U + 1e-3);
    CHECK(shaper.coupling() > 50.0);
  }
  SECTION("above 2B the worst tick is the larger claim") {
    auto shaper = at<d1>(ph::stiffness_increment{.initial = 600, .step = 500});
    const double outflow = 600 * d * 600 * d / 120.0, release = 300 * d * d;
    REQUIRE(outflow > release);
    const double E = outflow + 0.01;
    (void)felt(shaper, {d, 1e-5, E});
    (void)felt(shaper, {d, -1e-5, E});
    (void)felt(shaper, {d, 1e-5, E});
    CHECK_THAT((shaper.stiffness() - 600.0) * d * d / 2.0, WithinRel(0.01, 1e-9));
  }
  SECTION("what is in flight is not spare") {
    auto shaper = at<d1>(ph::nonlinear_coupling{.initial = 50, .rate = 1e7});
    (void)felt<1>(shaper, {d, 0.0, U + 1e-3}, 2e-3);
    CHECK(shaper.coupling() == 50.0);
    (void)felt<1>(shaper, {d, 0.0, U + 1e-3}, 0.0);
    CHECK(shaper.coupling() > 50.0);
  }
}

TEST_CASE("in any row of ticks shapers that grow stiff hold what their formulas say",
          "[shaper][augmentation]") {
  ph::laws::samples random(17);
  const auto one_of = [&](std::initializer_list<double> numbers) {
    return numbers.begin()[static_cast<int>((random.number<double>() + 1.0) * 0.5 *
                                            static_cast<double>(numbers.size()))];
  };
  constexpr double dt = 1.0 / 1024, initial = 64, most = 512, step = 96, away_for = 3 * dt;
  const ph::nonlinear_coupling grows{.initial = initial, .rate = 1e5, .most = most};
  const ph::stiffness_increment steps{.initial = initial, .step = step, .reset_after = away_for};
  const ph::force_augmentation adds{.low = initial, .step = 0.25};
  auto grown = at<d1>(grows);
  auto increment = at<d1>(steps);
  auto offset = at<d1>(adds);
  double Kc = 0.0, Ki = 0.0, F = 0.0, away = 0.0;
  bool released = false, leaving = false;
  int turns = 0, paid = 0;
  for (int n = 0; n < 4000; ++n) {
    if (n % 50 == 0) {
      grown.reset(), increment.reset(), offset.reset();
      Kc = Ki = F = away = 0.0;
      released = leaving = false;
      REQUIRE(increment.stiffness() == 0.0);
    }
    const double d = one_of({-1.0, 0.0, 1.0, 1.5, 2.0, 3.0}) / 128,
                 K = one_of({0.5, 32, 200, 1024, 4096});
    const double asked = K * std::max(d, 0.0) * one_of({0.0, 0.25, 1.0, 1.0, 2.0});
    const double outward = one_of({-1.0, 0.0, 1.0}) / 1024;
    const situation<d1> now{.energy = one_of({-1.0, 0.01, 0.03, 1.0}),
                            .dt = dt,
                            .longest_tick = dt,
                            .travel = -outward,
                            .motion_known = random.number<double>() < 0.9};
    const ph::contact_state<d1> contact{.normal = -1,
                                        .stiffness = K,
                                        .depth = d,
                                        .target_depth = d,
                                        .local_force = 0,
                                        .target_changed = false};
    const bool shapes = asked > 0.0 && d > 0.0 && now.motion_known;
    const auto spare = [&](double most_force, double release) {
      const double f = std::min(asked, most_force);
      return std::max(now.energy - std::max(release, f * f * dt / (4 * 0.03)), 0.0);
    };
    const auto agrees = [&](auto& shaper, double most_force) {
      const auto left = shaper.shape(-asked, contact, now.port());
      CAPTURE(n, d, K, asked, outward, now.energy, now.motion_known);
      REQUIRE_THAT(left.factor, WithinRel(shapes ? std::min(1.0, most_force / asked) : 1.0, 1e-12));
    };
    if (!shapes) {
      Kc = F = 0.0;
      leaving = false;
      away += dt;
      const bool forgotten = away > away_for || !now.motion_known;
      released = Ki > 0.0 && !forgotten;
      if (forgotten) Ki = 0.0;
      agrees(grown, 0.0), agrees(increment, 0.0), agrees(offset, 0.0);
    } else {
      Kc = std::max(Kc, initial);
      const auto in_series = [&] { return 1.0 / (1.0 / K + 1.0 / Kc); };
      const double half = d * d / 2.0;
      Kc += std::min({1e5 * dt, most - Kc, spare(in_series() * d, in_series() * half) / half});
      agrees(grown, in_series() * d);

      away = 0.0;
      Ki = std::min(std::max(Ki, initial), K);
      if (outward < 0.0 && released) {
        released = false;
        const double free = spare(Ki * d, Ki * half);
        paid += free > 0.0 && free / half < std::min(step, K - Ki) ? 1 : 0;
        Ki += std::min({step, K - Ki, free / half});
      }
      released = released || outward > 0.0;
      agrees(increment, Ki * d);

      const double low = std::min(initial, K);
      if (leaving ? outward < 0.0 : outward > 0.0) {
        leaving = !leaving;
        ++turns;
        const double free = spare(low * d + F, low * half + F * d);
        F += std::max(std::min({(K - low) * d - F, 0.25, free / d}), -0.25);
      }
      agrees(offset, low * d + F);
    }
    REQUIRE_THAT(grown.coupling(), WithinRel(Kc, 1e-12));
    REQUIRE_THAT(increment.stiffness(), WithinRel(Ki, 1e-12));
    REQUIRE_THAT(offset.offset(), WithinAbs(F, 1e-12));
  }
  CHECK(turns > 100);
  CHECK(paid > 10);
}

TEST_CASE("a release gives back what its increments were charged, ΔK d²/2, at the true port",
          "[shaper][augmentation]") {
  // pressed to d with K_0, grown at rest to K_1, released: −(K_1 − K_0) d²/2, but for the damper's
  // b v per metre and the hold's leak, both of the order of the step
  const double d = 0.01;
  sim::prescribed_motion<d1> device({.damping = 1e-6});
  const ph::nonlinear_coupling growing{.initial = 50, .rate = 1e4, .most = 400};
  const ph::nonlinear_coupling constant{.initial = 50, .rate = 0.0, .most = 400};
  auto shaper = at<d1>(constant);
  double charged = 0.0, x = 0.0;
  const auto go = [&](double next) {
    const double before = std::max(shaper.coupling(), 50.0);
    const double f = -felt(shaper, {x, 0.0, 1e9, 1e12});  // an energy that covers everything
    if (x > 0.0) charged += (shaper.coupling() - before) * x * x / 2.0;
    device.move_to(next);
    (void)device.exchange(f);
    x = next;
  };
  for (int n = 1; n <= 10000; ++n) go(d * n / 10000);
  shaper.set(growing);
  for (int n = 0; n < 100; ++n) go(d);
  REQUIRE_THAT(shaper.coupling(), WithinRel(400.0, 1e-12));
  shaper.set(constant);
  for (int n = 9999; n >= 0; --n) go(d * n / 10000);
  CHECK_THAT(charged, WithinRel(350 * d * d / 2, 1e-9));
  CHECK_THAT(device.meter().value(), WithinRel(-charged, 2e-4));
}

TEST_CASE("a shaper that grows stiff loses nothing in a quick run, growth that nobody pays does",
          "[passivity][augmentation]") {
  for (const attacks::conditions& when :
       {attacks::conditions{.ticks = 500}, attacks::conditions{.jumping = false, .ticks = 500}}) {
    CHECK(least_of_growing<d1>(coupling, when, 4) >= -1e-12);
    CHECK(least_of_growing<d1>(increments, when, 4) >= -1e-12);
    CHECK(least_of_growing<d1>(offsets, when, 4) >= -1e-12);
    CHECK(least_of_growing<d1>(unpaid_growth{}, when, 4, ph::no_bound{}) < -1e-3);
  }
}

TEST_CASE("shapers that grow stiff take new parameters, refuse bad ones and start anew",
          "[shaper][augmentation]") {
  const auto check = [](const auto& first, const auto& other, const auto& bad) {
    check_upkeep(following_half_space<d1>(ph::shaped{ph::spring{}, first}, thesis_ledger(),
                                          ph::strict_bound{}),
                 first, other, bad);
  };
  check(ph::nonlinear_coupling{.initial = 50, .rate = 2e5},
        ph::nonlinear_coupling{.initial = 20, .rate = 1e3}, ph::nonlinear_coupling{});
  check(ph::stiffness_increment{.initial = 50, .step = 500},
        ph::stiffness_increment{.initial = 20, .step = 5}, ph::stiffness_increment{});
  check(ph::force_augmentation{.low = 50, .step = 0.5},
        ph::force_augmentation{.low = 20, .step = 0.01}, ph::force_augmentation{});
}

TEST_CASE("parameters of shapers that grow stiff are refused with their name",
          "[shaper][augmentation]") {
  const double nan = std::nan("");
  CHECK(refused(coupling).empty());
  CHECK(refused(ph::nonlinear_coupling{}) == "initial");
  CHECK(refused(ph::nonlinear_coupling{.initial = 50, .rate = -1}) == "rate");
  CHECK(refused(ph::nonlinear_coupling{.initial = 50, .rate = 1, .most = 40}) == "most");
  CHECK(refused(ph::nonlinear_coupling{.initial = 50, .rate = 1, .most = 50}).empty());
  CHECK(refused(increments).empty());
  CHECK(refused(ph::stiffness_increment{.initial = 50, .reset_after = 0}).empty());
  CHECK(refused(ph::stiffness_increment{.initial = nan}) == "initial");
  CHECK(refused(ph::stiffness_increment{.initial = 50, .step = nan}) == "step");
  CHECK(refused(ph::stiffness_increment{.initial = 50, .reset_after = nan}) == "reset_after");
  CHECK(refused(offsets).empty());
  CHECK(refused(ph::force_augmentation{.low = 0}) == "low");
  CHECK(refused(ph::force_augmentation{.low = 50, .step = -1}) == "step");
}
