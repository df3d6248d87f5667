// SPDX-License-Identifier: BSD-3-Clause
// reachable_bound and reachable_work_bound: formulas, late loops, the mass that has to be stated.
// Hands that are searched for are in tests/full/bounds_late.cpp.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"

using Catch::Matchers::WithinRel;
namespace k = ph::kernels;

namespace {

constexpr ph::reachable_bound told{.mass = 0.1, .hand_force = 5.0};

/// One degree of freedom, in a loop of that latency.
template <int Latency = 0>
double limit(const auto& parameters, double desired,
             const situation<d1, ph::isotropic_damping, Latency>& now) {
  const auto bound = at<d1>(parameters);
  return allowed(bound, desired, now);
}

}  // namespace

TEST_CASE("reachable_bound and reachable_work_bound obey the laws of bounds that reduce",
          "[bound][law]") {
  CHECK(broken_laws<d1, f3>(told).empty());
  CHECK(broken_laws<d1>(ph::reachable_work_bound<1>{.inertia = {{0.1}}, .hand = 15.0}).empty());
}

TEST_CASE("reachable_bound lets a device press that cannot turn round, and no other", "[bound]") {
  situation<d1> now{.energy = 1e-6};
  SECTION("fast inwards: no bound") {
    now.travel = 0.5e-3;  // 0.5 m/s
    CHECK(limit(told, -40.0, now) == -40.0);
  }
  SECTION("at rest: the work over the reach") {
    const double reach = k::outward_reach(0.0, 0.0, 4.0, 5.0, 0.1, 1e-3, 1e-3);
    const double most = k::reachable_force_bound(1e-6, 30.0, reach);
    REQUIRE(most < 4.0);
    CHECK_THAT(limit(told, -4.0, now), WithinRel(-most, 1e-12));
  }
  SECTION("fast outwards: the strict bound") {
    now.travel = -2e-3;
    CHECK_THAT(limit(told, -4.0, now), WithinRel(-std::sqrt(4 * 30 * 1e-6), 1e-12));
  }
  SECTION("after a lost sample it may be moving out at any speed: the strict bound") {
    now.motion_known = false;
    CHECK_THAT(limit(told, -4.0, now), WithinRel(-std::sqrt(4 * 30 * 1e-6), 1e-12));
  }
  SECTION("never below the strict bound") {
    for (int i = -20; i <= 20; ++i) {
      now.travel = 1e-4 * i;
      CHECK(limit(told, -4.0, now) <= limit(ph::strict_bound{}, -4.0, now));
    }
  }
  SECTION("nothing desired in debt is nothing") {
    now.energy = -1.0;
    CHECK(limit(told, 0.0, now) == 0.0);
    CHECK(limit(told, -4.0, now) == 0.0);
  }
}

TEST_CASE("a force that is bounded at rest does not tremble as the ticks do", "[bound]") {
  const ph::reachable_work_bound<1> in_joules{.inertia = {{0.1}}, .hand = 15.0};
  situation<d1> now{.energy = 1e-6, .recent = 1e-3, .held = 2.0};
  const double newtons = limit(told, -4.0, now), joules = limit(in_joules, -4.0, now);
  REQUIRE(newtons > -4.0);
  REQUIRE(joules > -4.0);
  for (const double dt : {0.2e-3, 0.5e-3, 0.93e-3}) {
    now.dt = dt;
    CHECK(limit(told, -4.0, now) == newtons);
    CHECK(limit(in_joules, -4.0, now) == joules);
  }
  now.dt = 1.2e-3;  // a late one counts in full
  CHECK(limit(told, -4.0, now) > newtons);
  CHECK(limit(in_joules, -4.0, now) > joules);

  ph::passive_port port{d1{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03, .loan = 4e-4},
                        told, ph::loop_limits{.longest_tick = 2e-3}};
  const auto tick = [&](double dt, double asked = 4.0) {
    return port.tick(0.0, ph::seconds{dt}, asked).force;
  };
  for (int n = 0; n < 100; ++n) (void)tick(1e-3);
  const double even = tick(1e-3);
  REQUIRE(even < 4.0);
  for (const double dt : {0.95e-3, 0.5e-3, 1e-3, 0.7e-3}) {
    CHECK_THAT(tick(dt), WithinRel(even, 1e-5));
  }
  const auto settled = [&] {
    for (int n = 0; n < 100; ++n) (void)tick(1e-3);
    return tick(1e-3);
  };
  (void)tick(1.5e-3);
  const double longer = settled();
  CHECK(longer < 0.95 * even);
  (void)tick(1e-3, 0.1);  // is not cut, so it is forgotten
  CHECK_THAT(settled(), WithinRel(even, 1e-9));
  (void)tick(2e-3);
  const double longest = settled();
  CHECK(longest < 0.95 * longer);
  (void)tick(5e-3);  // counts as the longest stated
  CHECK_THAT(settled(), WithinRel(longest, 1e-5));
  port.reset();
  CHECK_THAT(settled(), WithinRel(even, 1e-9));
}

TEST_CASE("a force that is bounded at rest on encoders does not tremble as the ticks do",
          "[bound]") {
  ph::passive_port port{
      d1{}, ph::given_force{},
      ph::dual_ledger{.damping = {.coefficient = 0.03, .coulomb = 0.05, .presliding = 0.0},
                      .quantum = 2e-5,
                      .loan = 2e-4},
      told, ph::loop_limits{.longest_tick = 1e-3}};
  REQUIRE_FALSE(port.check());
  const auto tick = [&](double dt) { return port.tick(0.0, ph::seconds{dt}, 4.0).force; };
  const auto settled = [&](double dt) {
    for (int n = 0; n < 100; ++n) (void)tick(dt);
    return tick(1e-3);
  };
  const double even = settled(1e-3), steady = settled(0.5e-3);
  REQUIRE(even < 4.0);
  CHECK(steady < 0.95 * even);
  for (const double dt : {0.95e-3, 0.5e-3, 0.7e-3, 1e-3})
    CHECK_THAT(tick(dt), WithinRel(steady, 1e-5));
  const double slow = settled(0.25e-3);
  CHECK(slow < 0.95 * steady);
  CHECK_THAT(settled(1e-3), WithinRel(slow, 1e-5));
  CHECK(tick(0.1e-3) < 0.95 * slow);  // less than T/4 counts in full,
  const double later = tick(1e-3);
  CHECK(later > 0.95 * slow);  // but is not kept
}

TEMPLATE_TEST_CASE_SIG("what is bounded on encoders in a late loop does not take turns", "[bound]",
                       ((int Late), Late), 1, 2) {
  // Taking turns, a force of 0.24 N rang a tick late, and two ticks late the steps of force drained the ledger.
  ph::passive_port port{
      d1{}, ph::given_force{},
      ph::dual_ledger{.damping = {.coefficient = 0.9, .coulomb = 0.05, .presliding = 0.0},
                      .quantum = 1e-4,
                      .loan = 2e-4},
      ph::reachable_bound{.mass = 0.9, .hand_force = 4.4},
      ph::late_loop_limits<Late>{.longest_tick = 1e-3}};
  REQUIRE_FALSE(port.check());
  double force = 0.0;
  for (int n = 0; n < 200; ++n) {
    const double next = port.tick(0.0, ph::seconds{1e-3}, 4.0).force;
    if (n > 100) CHECK_THAT(next, WithinRel(force, 1e-4));
    force = next;
  }
  CHECK(force > (Late == 1 ? 0.5 : 0.15));
  CHECK(force < 4.0);
}

TEMPLATE_TEST_CASE_SIG("what is bounded in a late loop with exact positions does not take turns",
                       "[bound]", ((int Late), Late), 1, 2) {
  // Where f < 2B δ(1) the damper pays for all of it, so W = f²/4B whatever the reach: 0 and 2.1 N took turns for ever.
  ph::passive_port port{d1{}, ph::given_force{}, ph::reduced_energy{.damping = 5.0, .loan = 2.2e-4},
                        ph::reachable_bound{.mass = 0.05, .hand_force = 10.0},
                        ph::late_loop_limits<Late>{.longest_tick = 1e-3}};
  REQUIRE_FALSE(port.check());
  double force = 0.0;
  for (int n = 0; n < 200; ++n) {
    const double next = port.tick(0.0, ph::seconds{1e-3}, 6.0).force;
    if (n > 100) CHECK(std::abs(next - force) < 5e-3);
    force = next;
  }
  CHECK(force >
        (Late == 1 ? 1.4 : 1.1));  // 2b/((k + 1) T) of L4, and more where the reach is short
  CHECK(force < 6.0);
}

TEST_CASE("reachable_bound with friction lets out what no reachable travel can spend",
          "[bound][friction]") {
  // F s − B s² − f_c s ≤ E for 0 ≤ s ≤ δ: the F of § 2(a′), plus f_c
  sim::random_source random(17);
  int bent = 0;
  const auto bound = at<d1>(told);
  for (int i = 0; i < 300; ++i) {
    const double fc = random.uniform(0.0, 0.5);
    const double E = std::pow(10.0, random.uniform(-8.0, -3.0));
    const double held = random.uniform(0.0, 2.0), travel = random.uniform(-1e-4, 1e-3);
    const situation<d1, ph::damping_and_friction> now{
        .damping = at<d1>(ph::damping_and_friction{0.03, fc, 0.0}),
        .energy = E,
        .held = held,
        .travel = travel};
    const double asked = random.uniform(0.0, 20.0);
    const double f = allowed(bound, asked, now);
    const double B = 30.0;
    const double delta =
        k::outward_reach(travel, held, asked, 5.0 + 2 * B * std::abs(travel), 0.1, 1e-3, 1e-3);
    const auto spent = [&](double force) {
      double most = 0.0;
      for (int n = 0; n <= 2000; ++n) {
        const double s = delta * n / 2000;
        most = std::max(most, force * s - B * s * s - fc * s);
      }
      return most;
    };
    REQUIRE(f <= asked);
    if (!(delta > 0.0)) continue;
    REQUIRE(spent(f) <= E * (1 + 1e-12));
    if (f < asked) {
      ++bent;
      REQUIRE(spent(f * 1.001 + 1e-6) > E);  // and not a thousandth more
    }
  }
  CHECK(bent > 50);
}

TEST_CASE("reachable_bound on an encoder reckons with the doubt: as travel, and as what is damped",
          "[bound]") {
  const double error = 6e-5, travel = 1e-4, f = 4.0;
  situation<d1, ph::isotropic_damping, 0, false> now{
      .damping = at<d1>(ph::isotropic_damping{1.0}),  // B = 1 kN/m: the damper counts
      .energy = 1e-4,
      .travel = -travel,  // outwards
      .travel_error = error};
  const double other = 5.0 + 2 * 1000 * (travel + error);
  const double reach = k::outward_reach(travel + error, 0.0, f, other, 0.1, 1e-3, 1e-3);
  const auto bound = at<d1>(told);
  const double most = k::reachable_force_bound(1e-4, 1000.0, reach);
  REQUIRE(most > 1.01 * k::strict_force_bound(1e-4, 1000.0));  // it is the reach that bounds
  REQUIRE(most < f);
  CHECK_THAT(allowed(bound, -f, now), WithinRel(-most, 1e-9));
  // pressing in, it is the damper alone that may turn the device round
  now.travel = travel;
  now.energy = 1e-5;
  const double back = k::outward_reach(error - travel, 0.0, f, other, 0.1, 1e-3, 1e-3);
  const double little = k::reachable_force_bound(1e-5, 1000.0, back);
  REQUIRE(little > 1.01 * k::strict_force_bound(1e-5, 1000.0));
  REQUIRE(little < f);
  CHECK_THAT(allowed(bound, -f, now), WithinRel(-little, 1e-9));
}

TEST_CASE("reachable_bound takes what friction holds off what is in flight, and gives none in debt",
          "[bound][friction]") {
  const double fc = 0.5, h = 2.0, f = 10.0, travel = 1e-4, T = 1e-3;
  situation<d1, ph::damping_and_friction, 1> now{
      .damping = at<d1>(ph::damping_and_friction{0.03, fc, 0.0}),
      .energy = 1e-3,
      .travel = -travel,
      .commanded = {-h, 0.0}};
  const double other = 5.0 + 2 * 30 * travel;
  const double first = k::outward_reach(travel, 0.0, h, other, 0.1, T, T);
  const double second = first + k::outward_reach(0.0, h, f, other, 0.1, T, T);
  const double credit = 1e-3 - k::reachable_outflow(h - fc, 30.0, first);
  const double most = fc + k::reachable_force_bound(credit, 30.0, second);
  REQUIRE(most < f);
  const auto bound = at<d1>(told);
  CHECK_THAT(allowed(bound, -f, now), WithinRel(-most, 1e-9));
  now.energy = 1e-4;  // less than is on its way: not even what friction would hold
  REQUIRE(1e-4 < k::reachable_outflow(h - fc, 30.0, first));
  CHECK(allowed(bound, -f, now) == 0.0);
}

TEST_CASE(
    "reachable_bound keeps 2 c p for each tick in flight, which elastic friction may hold back",
    "[bound][friction]") {
  const double fc = 0.5, p = 20e-6, f = 10.0, T = 1e-3;
  situation<d1, ph::damping_and_friction, 2> now{
      .damping = at<d1>(ph::damping_and_friction{0.03, fc, p}), .energy = 1e-3};
  double reach = 0.0;  // from rest, nothing being on its way for two ticks
  for (const double next : {0.0, 0.0, f}) {
    reach += k::outward_reach(0.0, 0.0, next, 5.0, 0.1, T, T);
  }
  const auto bound = at<d1>(told);
  const double most = fc + k::reachable_force_bound(1e-3 - 2 * (2 * fc * p), 30.0, reach);
  REQUIRE(most < f);
  CHECK_THAT(allowed(bound, -f, now), WithinRel(-most, 1e-9));
}

TEST_CASE("reachable_outflow is the most that a force can hand over within its reach",
          "[kernels]") {
  for (const double B : {3.0, 30.0, 300.0}) {
    for (const double f : {0.01, 1.0, 20.0}) {
      for (const double reach : {-1e-3, 0.0, 1e-6, 1e-4, 1e-2, 1.0}) {
        double most = 0.0;
        for (int i = 0; i <= 10000; ++i) {
          const double s = std::clamp(reach, 0.0, f / B) * i / 10000.0;
          most = std::max(most, f * s - B * s * s);
        }
        const double said = k::reachable_outflow(f, B, reach);
        CHECK(said >= most * (1 - 1e-12));
        CHECK(said <= most * (1 + 1e-6));
      }
      CHECK(k::reachable_outflow(f, B, 1e9) == k::worst_outflow(f, B));
      CHECK(k::reachable_outflow(-f, B, 1.0) == 0.0);
      // What reachable_force_bound allows costs just what there is.
      const double F = k::reachable_force_bound(1e-3, B, 1e-3);
      CHECK(k::reachable_outflow(F, B, 1e-3) <= 1e-3);
      CHECK_THAT(k::reachable_outflow(F, B, 1e-3), WithinRel(1e-3, 1e-9));
    }
  }
}

namespace {

/// What a point that nobody sees brings, and what reachable_bound says that it brings, at most [J].
struct unseen_point {
  double mass = 0.1, hand = 5.0;
  double ratio(ph::laws::samples& random) const {
    const double b = 0.03 + 0.03 * std::abs(random.number<double>()), h = 1e-5;
    const double T0 = 1e-3, dt = std::pow(10.0, -3.0 + 1.7 * std::abs(random.number<double>()));
    const double held = 9.0 * random.number<double>(), f = 9.0 * std::abs(random.number<double>());
    double v = 0.3 * random.number<double>(), x = 0.0, out = 0.0;
    const auto move = [&](double seconds, double force, double push) {
      for (int n = 0; n < std::lround(seconds / h); ++n) {
        const double next = v + h * (force + push - b * v) / mass, mean = 0.5 * (v + next);
        x += h * mean;
        out += h * (force * mean - b * mean * mean);
        v = next;
      }
    };
    const double push = random.number<double>() < 0.5 ? hand : hand * random.number<double>();
    move(T0, held, push);
    const ph::detail::seen_tick<d1> seen{
        .square = x * x, .dt = T0, .travel_error = 0.0, .held = held};
    const auto damping = at<d1>(ph::isotropic_damping{0.03});
    const double most = at<d1>(told).unseen(seen, damping, f, dt).done;
    out = 0.0;
    move(dt, f, push);
    return most > 0.0 ? out / most : 0.0;
  }
  [[nodiscard]] double worst() const {
    ph::laws::samples random(5);
    double most = 0.0;
    for (int i = 0; i < 400; ++i) most = std::max(most, ratio(random));
    return most;
  }
};

}  // namespace

TEST_CASE("what nobody saw has brought no more than the mass allows, of the mass and hand stated",
          "[bound][unseen]") {
  CHECK(unseen_point{}.worst() <= 1.0);
  CHECK(unseen_point{}.worst() > 0.8);
  CHECK(unseen_point{.mass = 0.05}.worst() > 1.2);  // the controls
  CHECK(unseen_point{.hand = 15.0}.worst() > 1.2);
  const auto damping = at<d1>(ph::isotropic_damping{0.03});
  CHECK(
      at<d1>(told).unseen(ph::detail::seen_tick<d1>{0.0, 1e-3, 0.0, 0.0}, damping, 9.0, 1.0).done >
      1e9);
}

TEST_CASE("a lost sample costs what a mass can have moved, and a strict port what a damper allows",
          "[bound][unseen]") {
  const auto cost = [](const auto& bound, const auto& limits, int lost) {
    ph::passive_port port{d1{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03, .loan = 5.0},
                          bound, limits};
    for (int n = 0; n < 5; ++n) (void)port.tick(0.0, ph::seconds{1e-3}, 9.0);
    const double before = port.energy();
    for (int n = 0; n < lost; ++n) (void)port.tick(std::nan(""), ph::seconds{1e-3}, 9.0);
    (void)port.tick(0.0, ph::seconds{1e-3}, 9.0);
    return before - port.energy();
  };
  const ph::bound_chain known{told, ph::actuator_limit{.most = 9.0}};
  const ph::loop_limits now{.longest_tick = 1e-3};
  const ph::late_loop_limits<2> later{.longest_tick = 1e-3};
  // 9 N over (2 · 9 + 5)/0.1 m/s² for 1 ms, and the half ms before it: nobody knows what was held there
  CHECK_THAT(cost(known, now, 1), WithinRel(9.0 * 230.0 * 1e-6, 0.01));
  CHECK(cost(known, now, 1) == cost(known, now, 30));  // nothing is held any more
  // Three commands were on their way: the paths of 1, 2 and 3 ms.
  CHECK_THAT(cost(known, later, 30), WithinRel(9.0 * 230.0 * 10e-6, 0.01));
  CHECK_THAT(cost(ph::strict_bound{}, now, 1), WithinRel(0.675, 0.01));
}

TEST_CASE("what is known of the last tick counts: its length, its doubt, and that there was one",
          "[bound][unseen]") {
  // (v + (a + r V)(T0 + t)/2) t with V = (v + a (T0/2 + t))/(1 − r (T0/2 + t))
  CHECK_THAT(k::longest_path(0.1, 1.0, 2.0, 0.1, 0.1),
             WithinRel(0.1 * (0.1 + (1.0 + 2.0 * 0.25 / 0.7) * 0.1), 1e-9));
  CHECK_THAT(k::longest_path(0.0, 1.0, 0.5, 1.0, 0.5), WithinRel(0.75, 1e-9));  // r of the most
  CHECK(k::longest_path(0.0, 1.0, 0.51, 1.0, 0.5) == std::numeric_limits<double>::max());
  const auto damping = at<d1>(ph::isotropic_damping{0.03});
  const auto done = [&](const ph::detail::seen_tick<d1>& seen) {
    return at<d1>(told).unseen(seen, damping, 9.0, 1e-3).done;
  };
  CHECK_THAT(done({0.0, 1e-3, 1e-4, 9.0}) - done({0.0, 1e-3, 0.0, 9.0}), WithinRel(9e-4, 0.01));

  const ph::bound_chain known{told, ph::actuator_limit{.most = 9.0}};
  const auto cost = [&](const ph::loop_limits& limits, auto&& happens) {
    ph::passive_port port{d1{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03, .loan = 5.0},
                          known, limits};
    for (int n = 0; n < 5; ++n) (void)port.tick(0.0, ph::seconds{1e-3}, 9.0);
    return happens(port);
  };
  const auto lose = [](auto& port, double dt = 1e-3) {
    const double before = port.energy();
    (void)port.tick(std::nan(""), ph::seconds{dt}, 9.0);
    return before - port.energy();
  };
  const ph::loop_limits plain{.longest_tick = 1e-3};
  const double usual = cost(plain, [&](auto& port) { return lose(port); });
  CHECK(cost(plain, [&](auto& port) { return lose(port, 1e-5); }) == usual);  // held for T, perhaps
  CHECK(cost(plain, [&](auto& port) {
          (void)port.tick(1e-4, ph::seconds{2.5e-4}, 9.0);
          return lose(port);
        }) > 9.0 * 0.4 * 1e-3);  // 0.1 mm in a quarter of a tick are 0.4 m/s
  CHECK(cost(plain, [&](auto& port) {
          (void)lose(port);
          (void)port.tick(0.0, ph::seconds{1e-3}, 9.0);  // from where, nobody knows
          return lose(port);
        }) > 0.6);
  CHECK(cost(plain, [&](auto& port) {
          CHECK_FALSE(port.set(ph::actuator_limit{.most = 8.0}));
          return lose(port);
        }) > 0.6);
  const ph::loop_limits watched{.longest_tick = 1e-3, .watchdog = 1e-3};
  const double cut = cost(watched, [](auto& port) {
    const double before = port.energy();
    (void)port.tick(0.0, ph::seconds{1e-2}, 9.0);  // dropped after 1 ms, or not
    return before - port.energy();
  });
  CHECK_THAT(cut, WithinRel(9.0 * 230.0 * 1e-6, 0.01));
  // The smaller of two bounds: of a force of 1 mN the damper knows better.
  auto ledger = at<d1>(ph::reduced_energy{.damping = 0.03, .loan = 1.0});
  ledger.forfeit(1e-3, 1e-3, 1.0);
  CHECK(ledger.value() > 1.0 - 1e-7);
}

TEST_CASE("reachable_bound in a late loop pays for what is in flight", "[bound]") {
  situation<d1, ph::isotropic_damping, 1> now{.energy = 1e-5, .travel = -1e-4};
  const double first = -limit(told, -10.0, now);
  CHECK(first > 0.0);
  now.commanded = {-first, 0.0};
  const double second = -limit(told, -10.0, now);  // the same again, `first` being on its way
  CHECK_THAT(second, WithinRel(first, 1e-9));  // each has its share, so that they do not take turns
  now.commanded = {-1.5 * first, 0.0};
  CHECK(-limit(told, -10.0, now) < 0.8 * first);
  SECTION("pressing costs nothing, in flight or not") {
    now.commanded = {};
    now.travel = 1e-3;
    now.energy = 0.0;
    CHECK(limit(told, -10.0, now) == -10.0);
    now.commanded = {-10.0, 0.0};
    CHECK(limit(told, -10.0, now) == -10.0);
  }
  SECTION("after a lost sample it is the strict bound with latency") {
    now.commanded = {};
    now.motion_known = false;
    const double most = -limit(told, -10.0, now);
    CHECK_THAT(most, WithinRel(std::sqrt(4 * 30 * 1e-5 / 2), 1e-9));
    now.commanded = {-most, 0.0};
    CHECK_THAT(-limit(told, -10.0, now), WithinRel(most, 1e-6));
    now.commanded = {-most * std::sqrt(2.0), 0.0};
    CHECK(-limit(told, -10.0, now) < 1e-6);
  }
}

TEMPLATE_TEST_CASE_SIG("reachable_work_bound is reachable_bound in one degree of freedom",
                       "[bound]", ((int Latency), Latency), 0, 1, 2, 3) {
  sim::random_source random(29);
  int cut = 0;
  for (int i = 0; i < 5000; ++i) {
    const double mass = std::pow(10.0, random.uniform(-2.0, 0.5)), hand = random.uniform(0.0, 10.0);
    const ph::reachable_bound one{.mass = mass, .hand_force = hand};
    const ph::reachable_work_bound<1> other{.inertia = {{mass}}, .hand = hand / std::sqrt(mass)};
    situation<d1, ph::isotropic_damping, Latency> now{
        .energy = random.chance(0.1) ? -1e-5 : std::pow(10.0, random.uniform(-8.0, -2.0)),
        .dt = random.uniform(0.5e-3, 1.5e-3),
        .held = random.uniform(-2.0, 2.0),
        .travel = random.uniform(-2e-4, 1e-3),
        .motion_known = random.chance(0.95)};
    for (double& f : now.commanded) f = random.uniform(-2.0, 2.0) * std::abs(random.uniform());
    const double desired = -20.0 * random.uniform();
    const double f = limit(one, desired, now);
    REQUIRE_THAT(limit(other, desired, now), WithinRel(f, 1e-9));
    cut += f < 0.0 && f > desired ? 1 : 0;
  }
  CHECK(cut > 200);
}

namespace {

/// A force-limited hand in a loop that is really `late` ticks late, while the model is told
/// `Latency` and nothing but positions; the least port energy.
template <int Latency, class Bound>
double tapped_late(const Bound& bound, int late, std::uint64_t seed) {
  const ph::late_loop_limits<Latency> limits{
      .longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};
  auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), bound, limits);
  sim::random_source random(seed);
  const double K = random.uniform(500.0, 20000.0);
  (void)model.update(wall<d1>(K));
  sim::device<d1, sim::tapping_hand<d1>> device({.mass = 0.1, .start = -1e-3, .latency = late},
                                                {.surface = 0.0, .normal = -1.0, .limit = 5.0});
  double x = -1e-3;
  for (int n = 0; n < 1500; ++n) {
    if (n % 35 == 0) (void)model.update({random.uniform(-2e-3, 2e-3), -1.0, K});
    x = device.exchange(model.tick(x, 1ms).force).position;
  }
  return device.meter().minimum();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "reachable_bound loses nothing to a tapping hand in a loop as late as stated",
    "[bound][passivity]", ((int Latency), Latency), 0, 1, 2, 3) {
  double as_stated = 0.0, later = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    as_stated = std::min(as_stated, tapped_late<Latency>(told, Latency, seed));
    later = std::min(later, tapped_late<Latency>(told, Latency + 1, seed));
  }
  CHECK(as_stated >= -1e-12);
  CHECK(later < -1e-2);  // the control: really one tick later than stated
}

TEST_CASE("reachable_work_bound does so, too", "[bound][passivity]") {
  const ph::reachable_work_bound<1> work{.inertia = {{0.1}}, .hand = 5.0 / std::sqrt(0.1)};
  CHECK(tapped_late<2>(work, 2, 1) >= -1e-12);
  CHECK(tapped_late<2>(work, 3, 1) < -1e-2);  // the control
}

namespace {

/// M = diag(0.1, 1), a wall at 45° and a hand of 5 N that pushes and pulls at random, not along the
/// wall's normal n but along M⁻¹n: the worst port energy.
double worst_across(const auto& bound) {
  const double T = 1e-3, b = 0.03, F = 5.0, c = std::sqrt(0.5);
  const d2::vector m(0.1, 1.0), n(-c, -c);
  const d2::vector hand = n.cwiseQuotient(m).normalized();
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double K = seed % 2 == 0 ? 1e4 : 1e5;
    ph::local_model model{d2{},
                          ph::fixed{ph::half_space<d2>{{0.0, 0.0}, n, K}},
                          ph::turn_at_once{},
                          ph::spring{},
                          ph::reduced_energy{.damping = b},
                          bound,
                          thesis_loop};
    sim::random_source random(seed);
    d2::vector x = d2::zero(), v = d2::zero();
    double E = 0.0, push = -F;
    for (int tick = 0; tick < 3000; ++tick) {
      const d2::vector f = model.tick(x, ph::seconds{T}).force;
      if (random.chance(0.15)) push = random.chance(0.5) || x.dot(n) > 1e-3 ? -F : F;
      for (int i = 0; i < 2; ++i) {  // exact for a constant force, but for the damper, as in L1
        const double rate = b / m(i), steady = (push * hand(i) + f(i)) / b, rest = v(i) - steady;
        const double dx = steady * T - rest * std::expm1(-rate * T) / rate;
        E += b * dx * dx / T - f(i) * dx;
        x(i) += dx;
        v(i) = steady + rest * std::exp(-rate * T);
      }
      worst = std::min(worst, E);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("reachable_bound needs the smallest mass of all directions, not the one along the normal",
          "[bound][passivity]") {
  const double along_normal = 1.0 / (0.5 / 0.1 + 0.5 / 1.0);
  CHECK(worst_across(ph::reachable_bound{.mass = along_normal, .hand_force = 5.0}) < -1e-4);
  CHECK(worst_across(ph::reachable_bound{.mass = 0.1, .hand_force = 5.0}) >= -1e-12);
  // in joules the hand is measured by the mass it may find: 5 N along the lightest axis
  const ph::reachable_work_bound<2> work{.inertia = {{0.1, 1.0}}, .hand = 5.0 / std::sqrt(0.1)};
  CHECK(worst_across(work) >= -1e-12);
}

TEST_CASE("parameters of bounds are refused with their name", "[bound]") {
  const double nan = std::nan("");
  CHECK_FALSE(ph::reachable_bound{.mass = 0.1, .hand_force = 0}.check());
  CHECK(refused(ph::reachable_bound{.hand_force = 5}) == "mass");
  CHECK(refused(ph::reachable_bound{.mass = 1, .hand_force = -1}) == "hand_force");
  CHECK(refused(ph::reachable_bound{.mass = 1, .hand_force = nan}) == "hand_force");
  CHECK(refused(ph::actuator_limit{.most = nan}) == "most");
  CHECK(refused(ph::force_rate_limit{.rate = 0}) == "rate");
  using work = ph::reachable_work_bound<2>;
  CHECK_FALSE(work{.inertia = {{0.1, 1.0}}, .hand = 0.0}.check());
  CHECK(refused(work{.inertia = {{0.1, 0.0}}, .hand = 1.0}) == "masses");
  CHECK(refused(work{.inertia = {{0.1, 1.0}}, .hand = nan}) == "hand");
}

TEST_CASE("a bad parameter of reachable_bound in a late loop is refused with its name", "[bound]") {
  const ph::late_loop_limits<1> limits{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};
  const ph::reachable_bound lighter{.mass = 0.02, .hand_force = 5.0}, none{.hand_force = 5.0};
  auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), told, limits);
  CHECK_FALSE(model.check());
  check_upkeep(model, told, lighter, none);
  CHECK(std::string(model.set(none).parameter) == "mass");
  CHECK(std::string(model.set(ph::reachable_bound{.mass = 0.1, .hand_force = -1.0}).parameter) ==
        "hand_force");
}
