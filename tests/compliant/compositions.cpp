// SPDX-License-Identifier: BSD-3-Clause
// What is said of a transmission picks the bound, and what contradicts itself is refused.
#include "support/catch.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>
#include <passive_haptics/simulation/hand.hpp>
#include <passive_haptics/simulation/quiet.hpp>

#include <array>
#include <cmath>
#include <span>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using d1 = ph::space<double, 1>;

namespace {

constexpr ph::exact_device arm{
    .mass = 0.1, .damping = 0.05, .force_limit = 9.0, .longest_tick = 1e-3};
constexpr ph::known_hand person{.force = 5.0};
const ph::chain_transmission<2> cable{ph::two_masses(0.1, 0.3, 90.0, 0.03, 0.1)};
const ph::observed_transmission belt{
    .rotor = 0.03, .slew = ph::slew_of(cable.device, 5.0, 9.0, 0.5), .damping_above = 0.13};

/// The least energy [J] of a hand that switches, on 0.1 kg of which 0.03 kg are the rotor's.
double least(auto touch) {
  sim::compliant_parameters<d1> p;
  p.share = 0.3;
  p.mode = 90.0;
  p.start = 0.002;
  REQUIRE_FALSE(touch.check());
  REQUIRE(touch.update({0.0, 1.0, 2000.0}));
  double worst = 0.0, f = 0.0;
  for (const double push : {-5.0, -3.0}) {
    sim::compliant_device<d1, sim::constant_hand<d1>> device(p, {.push = push, .limit = 5.0});
    for (int n = 0; n < 4000; ++n) {
      if (n % 60 == 0) device.hand().push = n % 120 == 0 ? push : 5.0 * (n % 240 == 60);
      f = touch.tick(device.exchange(f)).force;
    }
    worst = std::min(worst, device.minimum());
  }
  return worst;
}

}  // namespace

TEST_CASE("make_touch through a transmission loses nothing to a device that gives",
          "[compliant][compositions]") {
  CHECK(least(ph::make_touch<d1>(arm, ph::any_transmission{}, person)) >= -1e-9);
  CHECK(least(ph::make_touch<d1>(arm, belt, person)) >= -1e-9);
  CHECK(least(ph::make_touch<d1>(arm, cable, person)) >= -1e-9);
}

TEST_CASE("what is said of a transmission picks the bound", "[compliant][compositions]") {
  const auto strict = ph::make_touch<d1>(arm, ph::any_transmission{}, person);
  const auto observed = ph::make_guard<d1>(arm, belt, person);
  const auto modelled =
      ph::make_contacts<d1>(arm, cable, person, ph::slots<ph::half_space<d1>, 2>{});
  CHECK_FALSE(strict.check());
  CHECK_FALSE(observed.check());
  CHECK_FALSE(modelled.check());
  STATIC_REQUIRE_FALSE(std::same_as<decltype(ph::make_guard<d1>(arm, belt, person)),
                                    decltype(ph::make_guard<d1>(arm, cable, person))>);
}

TEST_CASE("a rotor heavier than the device, or a chain that is none, is refused",
          "[compliant][compositions]") {
  auto heavy = belt;
  heavy.rotor = 0.3;
  CHECK(std::string(ph::make_touch<d1>(arm, heavy, person).check().parameter) == "mass");
  auto none = cable;
  none.device.springs[0] = -1.0;
  CHECK(std::string(ph::make_touch<d1>(arm, none, person).check().parameter) == "springs");
  CHECK(ph::make_touch<d1>(arm, cable, {.force = -1.0}).check().value == -1.0);
  CHECK(std::string(ph::any_transmission{.rotor = -1.0}.check().parameter) == "rotor");
  CHECK(ph::make_touch<d1>(arm, ph::any_transmission{.rotor = 0.3}, person).check());
}

TEST_CASE("what swings slowly on the rotor leaves a late wall stiff", "[compliant][compositions]") {
  constexpr double T = 1e-3,
                   stiff = 0.05 * 0.03 / (T * T);  // κ m/T² of the rotor, one tick late [N/m]
  const auto shown = [&](const auto& transmission) {
    ph::exact_device late = arm;
    late.latency = 1;
    auto port =
        ph::make_touch<d1, ph::half_space<d1>, ph::late_loop_limits<1>>(late, transmission, person);
    REQUIRE_FALSE(port.check());
    REQUIRE(port.update({0.0, 1.0, 5000.0}));
    (void)port.tick(-0.001, ph::seconds{T});
    return port.explain().shown;
  };
  const auto through = [](double mode) {
    return ph::chain_transmission<2>{ph::two_masses(0.1, 0.3, mode, 0.03, 0.1), 0.0, 0.0};
  };
  ph::observed_transmission told = belt;
  CHECK(shown(told) == Approx(stiff / 2.0).epsilon(0.01));
  told.fastest_mode = 90.0;
  CHECK(shown(told) == Approx(stiff).epsilon(0.01));
  CHECK(shown(through(90.0)) == Approx(stiff).epsilon(0.01));
  CHECK(shown(through(100.0)) == Approx(stiff / 2.0).epsilon(0.01));
  auto roughly = through(90.0);
  roughly.tolerance = 0.1;  // up to 99 Hz
  CHECK(shown(roughly) == Approx(stiff / 2.2).epsilon(0.01));
  told.fastest_mode = -1.0;
  CHECK(told.check());
}

TEST_CASE("no mode of a chain is faster than fastest_mode", "[compliant][compositions]") {
  CHECK(ph::fastest_mode(ph::two_masses(0.1, 0.3, 90.0, 0.03, 0.1)) == Approx(90.0));
  const ph::chain<4> c{{0.02, 0.05, 0.01, 0.2}, {9e3, 2e4, 4e3}, {}, 0.0};
  Eigen::Matrix4d k = Eigen::Matrix4d::Zero(), m = k;
  for (int i = 0; i < 4; ++i) m(i, i) = c.masses[static_cast<std::size_t>(i)];
  for (int i = 0; i < 3; ++i) {
    const double spring = c.springs[static_cast<std::size_t>(i)];
    k.block<2, 2>(i, i) += spring * (Eigen::Matrix2d{} << 1.0, -1.0, -1.0, 1.0).finished();
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix4d> modes(k, m);
  const double fastest = std::sqrt(modes.eigenvalues()(3)) / (2.0 * 3.14159265358979);
  CHECK(ph::fastest_mode(c) >= fastest);
  CHECK(ph::fastest_mode(c) <= 1.2 * fastest);
}

TEMPLATE_TEST_CASE_SIG("a late wall rests on a cable that rings faster than its damper can follow",
                       "[compliant][compositions]", ((int Late), Late), 1, 2) {
  // A hand kneads until the ledger is full, and then holds still. Designed for the whole rotor eleven of these sixteen
  // ring on by 1 to 3 N, for half of it the slowest rests after 5.7 s.
  using limits = ph::late_loop_limits<Late>;
  constexpr double T = 1e-3, mass = 0.171, damping = 0.037, most = 9.0;
  const ph::known_hand person_here{.force = 4.5};
  const ph::exact_device d{
      .mass = mass, .damping = damping, .force_limit = most, .longest_tick = T, .latency = Late};
  for (const double mode : Late == 1 ? std::array{120.0, 150.0} : std::array{120.0, 168.0}) {
    for (const double share : {0.15, 0.3}) {
      const auto two = ph::two_masses(mass, share, mode, 0.05, damping);
      const ph::observed_transmission belt_here{.rotor = share * mass,
                                                .slew = ph::slew_of(two, 4.5, most, 0.5),
                                                .damping_above = 1.1 * damping};
      const auto rests = [&](auto port, auto show) {
        REQUIRE_FALSE(port.check());
        show(port);
        sim::compliant_parameters<d1> p{
            .mass = mass, .share = share, .mode = mode, .loss = 0.05, .damping = damping};
        p.force_limit = most;
        p.start = 0.004;
        p.substeps = 40;
        p.latency = Late;
        sim::compliant_device<d1, sim::impedance_hand<d1>> device(p, {.limit = 4.5});
        sim::quiet_judge<d1> judge;
        double f = 0.0;
        for (int n = 0; n < 8500; ++n) {
          const bool kneads = n < 2000;
          device.hand().stiffness = kneads ? 1e5 : 1000.0;
          device.hand().damping = kneads ? 0.0 : 2.0;
          device.hand().target = kneads ? (n / 38 % 2 == 0 ? -0.03 : 1.0) : -0.003;
          const double before = device.position();
          f = port.tick(device.exchange(f)).force;
          if (n == 2000) judge.news();
          const double up = 1.0;
          judge.add(f, (device.position() - before) / T, T, std::span(&up, f > 0.0 ? 1 : 0));
        }
        INFO(Late << " late, " << mode << " Hz, share " << share << ": " << judge.figures().step);
        CHECK(judge.settling() <= 6.0);
        CHECK(device.minimum() >= -1e-9);
      };
      const ph::half_space<d1> wall{0.0, 1.0, 2957.0};
      rests(ph::make_touch<d1, ph::half_space<d1>, limits>(d, belt_here, person_here),
            [&](auto& port) { REQUIRE(port.update(wall)); });
      rests(ph::make_contacts<d1, limits>(d, belt_here, person_here,
                                          ph::slots<ph::half_space<d1>, 2>{}),
            [&](auto& port) { REQUIRE(port.source().update(0, wall)); });
    }
  }
}
