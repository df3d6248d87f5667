// SPDX-License-Identifier: BSD-3-Clause
// What is said of a transmission picks the bound, and what contradicts itself is refused.
#include "support/catch.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>

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
