// SPDX-License-Identifier: BSD-3-Clause
// observed_reach: anything within G and R pushes on the rotor, and the controls of each assumption.
#include "compliant/pushed.hpp"
#include <passive_haptics/compliant/modelled_reach.hpp>

namespace ph = passive_haptics;
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
  CHECK(pushed::lost<d1>(60, 15, rounding,
                         [](ph::observed_reach& p, const pushed::world&) { p.slew /= 3.0; }) > 0);
  CHECK(pushed::lost<d1>(60, 15, rounding, [](ph::observed_reach& p, const pushed::world&) {
          p.mass *= 1.5;
          p.mass_above = 0.0;
        }) > 0);
}

TEST_CASE("a motion that refutes what observed_reach was told is reported, and bounded strictly",
          "[compliant][observed_reach][event]") {
  ph::passive_port port{d1{}, ph::given_force{}, ph::reduced_energy{.damping = 0.1, .loan = 1e-3},
                        ph::observed_reach{.mass = 0.1, .slew = 100.0},
                        ph::loop_limits{.longest_tick = 1e-3}};
  double x = 0.0, v = 0.0;
  bool said = false;
  for (int n = 0; n < 20; ++n) {
    said = said || port.tick(x, ph::seconds{1e-3}, 0.0).what == ph::event::outside_force;
    v += n == 10 ? 0.1 : 0.0;  // 10 N in one tick
    x += v * 1e-3;
  }
  CHECK(said);
  port.reset();
  CHECK(port.tick(x, ph::seconds{1e-3}, 0.0).what == ph::event::nominal);
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
