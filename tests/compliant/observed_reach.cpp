// SPDX-License-Identifier: BSD-3-Clause
// observed_reach: anything within G and R pushes on the rotor, and the controls of each assumption.
#include "compliant/pushed.hpp"
#include <passive_haptics/compliant/modelled_reach.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/hand.hpp>
#include <passive_haptics/simulation/quiet.hpp>
#include <passive_haptics/simulation/schedule.hpp>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using d1 = ph::space<double, 1>;
using d3 = ph::space<double, 3>;
using f1 = ph::space<float, 1>;

namespace {
constexpr double rounding = 1e-12;  // [J]
constexpr auto as_it_is = [](ph::observed_reach&, const pushed::world&) {};
constexpr auto with_pull = [](ph::observed_reach& p, const pushed::world& w) { p.pull = w.G; };
}  // namespace

TEST_CASE("observed_reach loses nothing to whatever stays within its slew",
          "[compliant][observed_reach]") {
  CHECK(pushed::lost<d1>(60, 15, rounding, as_it_is) == 0);
  CHECK(pushed::lost<d1, 1>(40, 15, rounding, as_it_is) == 0);
  CHECK(pushed::lost<d1, 2>(40, 15, rounding, as_it_is) == 0);
  CHECK(pushed::lost<d1>(60, 15, rounding, with_pull) == 0);
}

TEST_CASE("observed_reach holds in three dimensions, and in float", "[compliant][observed_reach]") {
  CHECK(pushed::lost<d3>(30, 10, rounding, with_pull) == 0);
  CHECK(pushed::lost<f1>(30, 10, 2e-7, as_it_is) ==
        0);  // positions of a float are steps themselves
}

TEST_CASE("controls: observed_reach that is told a slower pull, or a heavier rotor, loses",
          "[compliant][observed_reach]") {
  // Rarely: what is added to the reach covers more than it is there for. Of the first 1500 such devices 4 and 84 lose.
  CHECK(pushed::lost<d1>(
            30, 15, rounding, [](ph::observed_reach& p, const pushed::world&) { p.slew /= 3.0; },
            100) > 0);
  CHECK(pushed::lost<d1>(60, 15, rounding, [](ph::observed_reach& p, const pushed::world&) {
          p.mass *= 3.0;
          p.mass_above = 0.0;
        }) > 0);
}

TEST_CASE("a motion that refutes what observed_reach was told is reported, and bounded strictly",
          "[compliant][observed_reach][event]") {
  const auto reports = [](auto port, const auto&... wanted) {
    double x = 0.0, v = 0.0;
    bool said = false;
    for (int n = 0; n < 20; ++n) {
      said = said || port.tick(x, ph::seconds{1e-3}, wanted...).what == ph::event::outside_force;
      v += n == 10 ? 0.1 : 0.0;  // 10 N in one tick
      x += v * 1e-3;
    }
    CHECK(said);
    port.reset();
    CHECK(port.tick(x, ph::seconds{1e-3}, wanted...).what == ph::event::nominal);
  };
  const ph::reduced_energy ledger{.damping = 0.1, .loan = 1e-3};
  const ph::observed_reach bound{.mass = 0.1, .slew = 100.0};
  const ph::loop_limits limits{.longest_tick = 1e-3};
  reports(ph::passive_port{d1{}, ph::given_force{}, ledger, bound, limits}, 0.0);
  const ph::fixed far_away{ph::half_space<d1>{-1.0, 1.0, 500.0}};  // which asks for nothing here
  const ph::bound_chain motors{bound, ph::thermal_limit{.peak = 5.0, .continuous = 5.0}};
  reports(ph::local_model{d1{}, far_away, ph::turn_at_once{}, ph::spring{}, ledger, bound, limits});
  reports(
      ph::local_model{d1{}, far_away, ph::turn_at_once{}, ph::spring{}, ledger, motors, limits});
}

TEST_CASE("a force that observed_reach bounds at rest does not tremble as the ticks do",
          "[compliant][observed_reach]") {
  const auto judge = [](const auto& ledger, double pull) {
    ph::passive_port port{
        d1{}, ph::given_force{}, ledger,
        ph::observed_reach{.mass = 0.1, .slew = 1000.0, .friction = 0.2, .pull = pull},
        ph::loop_limits{.longest_tick = 1e-3}};
    REQUIRE_FALSE(port.check());
    const auto tick = [&](double dt) { return port.tick(0.0, ph::seconds{dt}, 4.0).force; };
    for (int n = 0; n < 100; ++n) (void)tick(n < 50 ? 1e-3 : 0.5e-3);
    const double steady = tick(1e-3);
    REQUIRE(steady > 0.0);
    REQUIRE(steady < 4.0);
    for (const double dt : {0.95e-3, 1e-3, 0.5e-3, 0.7e-3}) {
      CHECK_THAT(tick(dt), Catch::Matchers::WithinRel(steady, 1e-3));
    }
  };
  for (const double pull : {5.0, ph::detail::no_limit}) {
    judge(ph::reduced_energy{.damping = 0.1, .loan = 1e-6}, pull);
    judge(ph::dual_ledger{.damping = {0.1, 0.05, 0.0}, .quantum = 2e-5, .loan = 2e-4}, pull);
  }
}

TEMPLATE_TEST_CASE_SIG(
    "what observed_reach and modelled_reach bound on encoders in a late loop does not take turns",
    "[compliant][observed_reach]", ((int Late), Late), 1, 2) {
  // Taking turns, forces rang by 0.03 to 0.11 N in 4 and 11 of 36 such settings, and their steps drained the ledger.
  const auto judge = [](const auto& bound, double quantum, double loan, double least) {
    ph::passive_port port{
        d1{}, ph::given_force{},
        ph::dual_ledger{.damping = {.coefficient = 0.9, .coulomb = 0.05, .presliding = 0.0},
                        .quantum = quantum,
                        .loan = loan},
        bound, ph::late_loop_limits<Late>{.longest_tick = 1e-3}};
    REQUIRE_FALSE(port.check());
    double force = 0.0;
    for (int n = 0; n < 300; ++n) {
      const double next = port.tick(0.0, ph::seconds{1e-3}, 4.0).force;
      if (n > 200) CHECK_THAT(next, Catch::Matchers::WithinRel(force, 1e-4));
      force = next;
    }
    CHECK(force > least);
  };
  for (const double pull : {4.4, ph::detail::no_limit}) {
    const ph::observed_reach bound{.mass = 0.9, .slew = 1000.0, .friction = 0.05, .pull = pull};
    judge(bound, 1e-4, 2e-4, Late == 1 ? 0.5 : 0.2);
    judge(bound, 2e-5, 5e-5, Late == 1 ? 0.35 : 0.25);
  }
  const ph::modelled_reach<2, Late> bound{.device = ph::two_masses(0.9, 0.3, 160.0, 0.03, 0.9),
                                          .hand_force = 4.4,
                                          .friction = 0.05,
                                          .tick = 1e-3};
  judge(bound, 1e-4, 2e-4, Late == 1 ? 0.5 : 0.35);
  judge(bound, 2e-5, 5e-5, 0.25);
}

TEMPLATE_TEST_CASE_SIG("what observed_reach bounds at an empty ledger rests in a hand",
                       "[compliant][observed_reach]", ((int Late), Late), 0, 1, 2) {
  // Without (3j − 1) f T²/4m in the reach two of these ring for ever.
  sim::random_source random(3);
  int still = 0;
  for (int i = 0; i < 48; ++i) {
    const double K = 300.0 * std::exp(random.uniform(0.0, 5.5)), most = random.uniform(3.0, 20.0);
    const bool stiff = i % 2 == 1;
    sim::device_parameters<d1> p{.mass = 0.05 * std::exp(random.uniform(0.0, 3.0)),
                                 .damping = 0.05 * std::exp(random.uniform(0.0, 3.0)),
                                 .force_limit = most};
    p.load = -random.uniform(0.3, 0.7) * most;
    p.latency = Late;
    const double told = p.mass * random.uniform(0.3, 1.0);
    const sim::impedance_hand<d1> hand{
        .stiffness = stiff ? 400.0 : 100.0, .damping = stiff ? 6.0 : 1.0, .limit = 1e9};
    sim::device<d1, sim::impedance_hand<d1>> device(p, hand);
    auto touch = ph::make_touch<d1, ph::half_space<d1>, ph::late_loop_limits<Late>>(
        ph::exact_device{.mass = told,
                         .damping = p.damping,
                         .force_limit = most,
                         .longest_tick = 1e-3,
                         .latency = Late},
        ph::observed_transmission{.rotor = told, .slew = random.uniform(500.0, 10e3)},
        ph::known_hand{.force = most});
    REQUIRE_FALSE(touch.check());
    sim::quiet_judge<d1> judge;
    const double swing = random.uniform(1e-4, 3e-3);
    double force = 0.0;
    for (int n = 0; n < 9000; ++n) {
      const auto sample = device.exchange(force);
      if (n % 25 == 0) (void)touch.update({n < 3000 ? swing * std::sin(0.03 * n) : 0.0, 1.0, K});
      force = touch.tick(sample).force;
      if (n == 3000) judge.news();
      const double normal = 1.0;
      judge.add(force, device.velocity(), 1e-3, std::span(&normal, force > 0.0 ? 1 : 0));
    }
    still += judge.settling() <= 5.0 ? 1 : 0;
    CHECK(device.meter().minimum() >= -rounding);
  }
  CHECK(still == 48);
}

TEST_CASE(
    "a rotor heavier than observed_reach was told refutes nothing, unless it was told how heavy at "
    "most",
    "[compliant][observed_reach][event]") {
  const auto refuted = [](double above) {
    ph::passive_port port{
        d1{}, ph::given_force{}, ph::reduced_energy{.damping = 0.1, .loan = 1.0},
        ph::observed_reach{.mass = 0.1, .mass_above = above, .slew = 100.0, .pull = 1.0},
        ph::loop_limits{.longest_tick = 1e-3}};
    double x = 0.0, v = 0.0, force = 0.0;
    bool said = false;
    for (int n = 0; n < 50; ++n) {
      const double gained = force / 0.3 * 1e-3;  // 0.3 kg, and no other force
      x += (v + gained / 2.0) * 1e-3;
      v += gained;
      const auto tick = port.tick(x, ph::seconds{1e-3}, n % 10 < 5 ? 4.0 : -4.0);
      said = said || tick.what == ph::event::outside_force;
      force = tick.force;
    }
    return said;
  };
  CHECK_FALSE(refuted(0.0));
  CHECK_FALSE(refuted(0.35));
  CHECK(refuted(0.12));
}

TEST_CASE("observed_reach names what is wrong with its numbers", "[compliant][observed_reach]") {
  ph::observed_reach p{.mass = 0.1, .slew = 100.0};
  CHECK_FALSE(p.check());
  p.mass_above = 0.05;
  CHECK(std::string(p.check().parameter) == "mass_above");
  p = {.mass = 0.0, .slew = 100.0};
  CHECK(std::string(p.check().parameter) == "mass");
  p = {.mass = 0.1, .slew = -1.0};
  CHECK(std::string(p.check().parameter) == "slew");
  p = {.mass = 0.1, .slew = 1.0, .pull = std::nan("")};
  CHECK(std::string(p.check().parameter) == "pull");
}
