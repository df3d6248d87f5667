// SPDX-License-Identifier: BSD-3-Clause
// What a device can do is known, so a sample that it cannot have reached is refused, and one that it has reached
// after all is believed soon (guard.hpp, motion_check; § 13).
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/device.hpp>

namespace sim = ph::simulation;

namespace {

constexpr double T = 1e-3;
constexpr ph::exact_device told{.mass = 0.1, .damping = 0.05, .force_limit = 9.0};
constexpr ph::encoder_device stepped{.mass = 0.1,
                                     .damping = 0.05,
                                     .friction = 0.13,
                                     .presliding = 15e-6,
                                     .quantum = 20e-6,
                                     .force_limit = 9.0};
constexpr ph::known_hand person{.force = 5.0};

/// A hand presses a wall, or knocks at it, and one sample in `every` is off by `off`, for `lasts` ticks.
struct session {
  double off = 0.0, beside = 0.0;  ///< [m]
  int every = 97, lasts = 1;
  double blow = 0.0;  ///< push for 2 ms twice a second [N]
  int slow = 1;       ///< ticks for which the sensor shows the same
  double mass = 0.1;  ///< true one [kg]
  bool knocks = true;
};
struct outcome {
  int ticks = 0, refused = 0,
      wrong = 0;     ///< ticks, samples refused, and those of them that were true
  int believed = 0;  ///< outliers that were not refused
  int in_a_row = 0;
  int contact = 0, soft = 0;  ///< ticks deeper than 1 mm, and those of them with no force
  double lost = 0.0;          ///< [J]
};
template <class Device, class Hand>
outcome played(const Device& device, const Hand& hand, const session& how, int ticks = 10000) {
  auto port = ph::make_touch<d3>(device, hand);
  (void)port.update({{0, 0, 0}, {0, 0, 1}, 1500});
  sim::device_parameters<d3> p{.mass = how.mass, .damping = 0.1, .start = d3::vector(0, 0, 5e-3)};
  if constexpr (std::same_as<Device, ph::encoder_device>) {
    p.quantum = device.quantum;
    p.friction = device.friction;
  }
  sim::device<d3, sim::impedance_hand<d3>> d(p, {.stiffness = 300, .damping = 2, .limit = 4.5});
  auto s = d.exchange(d3::vector::Zero());
  d3::vector shown = s.position;
  outcome all;
  int row = 0;
  for (int n = 0; n < ticks; ++n) {
    const bool struck = how.blow > 0.0 && n % 500 < 2;
    d.hand().limit = struck ? how.blow : 4.5;
    d.hand().stiffness = struck ? 1e6 : 300;
    const double depth = how.knocks ? 3e-3 - 7e-3 * std::cos(6.2832e-3 * n) : 8e-3;
    d.hand().target = d3::vector(0, 0, struck ? 1.0 : -depth);
    if (n % how.slow == 0) shown = s.position;
    const bool off = n > 200 && n % how.every < how.lasts && (how.off != 0.0 || how.beside != 0.0);
    const d3::vector jump = off ? d3::vector(how.beside, 0, how.off) : d3::vector::Zero();
    const auto out = port.tick(d3::vector(shown + jump), ph::seconds{T});
    const bool refused = out.what == ph::event::rejected_sample;
    all.refused += refused;
    all.wrong += refused && !off;
    all.believed += off && !refused;
    row = refused ? row + 1 : 0;
    all.in_a_row = std::max(all.in_a_row, row);
    all.contact += d.position()(2) < -1e-3;
    all.soft += d.position()(2) < -1e-3 && out.force(2) < 0.5;
    s = d.exchange(out.force);
  }
  all.ticks = ticks;
  all.lost = -d.meter().minimum();
  return all;
}

}  // namespace

TEST_CASE("an outlier of 0.2 to 5 mm is refused, and the sample after it believed",
          "[port][motion_check][long]") {
  for (const double mm : {0.2, 0.3, 0.5, 1.0, 2.0, 4.0, 4.9}) {
    for (const double sign : {1.0, -1.0}) {
      CAPTURE(mm, sign);
      for (const session& how :
           {session{.off = sign * mm * 1e-3}, session{.beside = sign * mm * 1e-3}}) {
        const outcome found = played(told, person, how);
        CHECK(found.refused > 90);
        CHECK(found.believed == 0);
        CHECK(found.wrong == 0);
        CHECK(found.lost < 1e-9);
      }
    }
  }
  const outcome on_steps = played(stepped, person, {.off = -0.3e-3});
  CHECK(on_steps.believed == 0);
  CHECK(on_steps.wrong == 0);
  // The control: where nobody knows what is possible they are believed.
  CHECK(played(told, ph::trusted_hand{person}, {.off = -4e-3}).refused == 0);
}

TEST_CASE("no true sample is refused, of a device with encoders either",
          "[port][motion_check][long]") {
  for (const double mass : {0.1, 0.3, 2.0}) {
    CHECK(played(told, person, {.mass = mass}, 20000).refused == 0);
    CHECK(played(stepped, person, {.mass = mass}, 20000).refused == 0);
  }
}

TEST_CASE("a place that stays is believed after five samples at most, however far it is off",
          "[port][motion_check]") {
  for (const double mm : {0.3, 1.0, 4.9}) {
    CAPTURE(mm);
    const outcome found = played(told, person, {.beside = mm * 1e-3, .every = 2000, .lasts = 1000});
    CHECK(found.refused > 0);
    CHECK(found.in_a_row <= 5);
    CHECK(found.refused <= 50);  // of five jumps there and back
  }
}

TEST_CASE("a rejected sample doubles the accepted distance, and only one that was far off keeps it",
          "[port][motion_check]") {
  ph::motion_check<d1> check;
  const auto judge = [&check](double travel) {
    return check.judge(travel, 1.0, [](double, double, double) { return 1.0; });
  };
  check.see(0.0, 1.0);
  CHECK_FALSE(judge(3.0));
  CHECK(judge(0.2));
  CHECK_FALSE(judge(1.5));
  CHECK(judge(1.5));
  CHECK(judge(1.5));
}

TEST_CASE("a blow on the handle costs some samples and not the wall", "[port][motion_check]") {
  for (const double blow : {20.0, 50.0, 200.0}) {
    CAPTURE(blow);
    const outcome found = played(told, person, {.blow = blow});
    const outcome trusted = played(told, ph::trusted_hand{person}, {.blow = blow});
    CHECK(found.refused > 0);
    CHECK(found.in_a_row <= 5);
    CHECK(found.refused <= 40);  // of 20 blows
    CHECK(found.soft <= trusted.soft + found.refused + 20);
  }
}

TEST_CASE("what is not as stated is doubted, and after a while no more", "[port][motion_check]") {
  const outcome lighter = played(told, person, {.blow = 5.0, .mass = 0.02});
  CHECK(lighter.refused > 0);
  CHECK(lighter.refused < lighter.ticks / 50);
  for (const int slow : {2, 3, 4}) {  // a sensor that is slower than the loop
    CAPTURE(slow);
    CHECK(played(told, person, {.slow = slow}).refused <= 100);
  }
}

TEST_CASE("what has moved on meanwhile is believed after any number of lost ticks",
          "[port][motion_check]") {
  for (const int lost : {1, 5, 50, 300}) {
    auto port = ph::make_touch<d1>(told, person);
    (void)port.update({0, 1, 1500});
    double x = 0.2;
    for (int n = 0; n < 20; ++n) CHECK(port.tick(x -= 5e-4, 1ms).what == ph::event::nominal);
    for (int n = 0; n < lost; ++n) {
      x -= 2e-4;
      (void)port.tick(std::nan(""), 1ms);
    }
    CAPTURE(lost);
    if (lost < 5) CHECK(port.tick(x - 4e-3, 1ms).what == ph::event::rejected_sample);
    CHECK(port.tick(x -= (lost < 5 ? 4e-4 : 2e-4), 1ms).what == ph::event::nominal);
  }
}

TEST_CASE("what is off is told in the distance that is possible and a quarter of the step",
          "[port][motion_check]") {
  // Numbers that nothing rounds: 4 m in 2 s would be 2 m in the next second.
  ph::motion_check<d1> check;
  const auto possible = [](double T0, double t, double v) {
    return T0 == 2.0 && t == 1.0 && v > 0.0 ? v / 8.0 : 1e9;
  };
  CHECK(check.is_possible(1e9, 1.0, possible));  // there was no motion to compare with
  CHECK(check.judge(1e9, 1.0, possible));
  CHECK(check.last()[0] == ph::kernels::largest<double>());
  CHECK(check.last()[1] == 1.0);
  check.see(4.0, 2.0);
  CHECK(check.last()[0] == 16.0);
  CHECK(check.last()[1] == 2.0);
  // At 3.25 m in 1 s the speeds add up to 5.25, and 5.25/8 + 2/4 is less than the 1.25 m beside.
  const auto largest = 22.0 / 7.0;  // |x − 2| = (2 + x)/8 + 1/2
  CHECK(check.is_possible(largest - 1e-12, 1.0, possible));
  CHECK_FALSE(check.is_possible(largest + 1e-12, 1.0, possible));
  const auto least = 10.0 / 9.0;  // on the other side of 2
  CHECK(check.is_possible(least + 1e-12, 1.0, possible));
  CHECK_FALSE(check.is_possible(least - 1e-12, 1.0, possible));
}

TEST_CASE("what is off by just what is accepted is believed, and a quarter of it keeps nothing",
          "[port][motion_check]") {
  ph::motion_check<d1> check;
  const auto one = [](double, double, double) { return 1.0; };
  const auto off = [&](double by) { return check.is_possible(by, 1.0, one); };
  const auto judge = [&](double by) { return check.judge(by, 1.0, one); };
  check.see(0.0, 1.0);
  CHECK(judge(1.0));
  CHECK(off(1.0));
  CHECK_FALSE(off(1.0000001));
  CHECK_FALSE(judge(1.5));
  CHECK(off(2.0));
  CHECK(judge(0.25));
  CHECK_FALSE(off(1.0000001));
  CHECK_FALSE(judge(1.5));
  CHECK(judge(0.2500001));
  CHECK(off(2.0));
  CHECK_FALSE(off(2.0000001));
  for (int n = 0; n < 20; ++n) CHECK_FALSE(judge(1e9));
  CHECK(off(1024.0));
  CHECK_FALSE(off(1024.001));
  CHECK(judge(1024.0));
  CHECK(off(1024.0));
  check.ease(one, 1.0, 8.0);  // 0.2 % less
  CHECK(off(1024.0 * 0.998));
  CHECK_FALSE(off(1024.0 * 0.9981));
  for (int n = 0; n < 5000; ++n) check.ease(one, 1.0, 8.0);
  CHECK(off(1.0));
  CHECK_FALSE(off(1.0000001));
}

TEST_CASE("a motion is easy up to the change that is possible, and calm in ticks that are long",
          "[port][motion_check]") {
  ph::motion_check<d1> check;
  const auto far_off = [](double T0, double t, double v) {
    return T0 == 2.0 && t == 2.0 && v == 0.0 ? 4.0 : 1e9;
  };
  CHECK_FALSE(check.is_calm(0.0, 1.0));  // nothing is, until it has been eased
  CHECK_FALSE(check.is_easy(0.0));
  check.ease(far_off, 2.0, 8.0);
  CHECK(check.is_calm(16.0, 0.5));
  CHECK_FALSE(check.is_calm(16.1, 0.5));
  CHECK_FALSE(check.is_calm(16.0, 0.49));
  check.see(10.0, 2.0);
  CHECK(check.is_easy(14.0));
  CHECK(check.is_easy(6.0));
  CHECK_FALSE(check.is_easy(14.1));
  CHECK_FALSE(check.is_easy(5.9));
  check.think();
  CHECK_FALSE(check.is_easy(10.0));
  CHECK_FALSE(check.is_calm(0.0, 1.0));
}
