// SPDX-License-Identifier: BSD-3-Clause
// Every symptom of docs/troubleshooting.md: here it is, and here it ends with the remedy of the page.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/identification/measure_latency.hpp>
#include <passive_haptics/published/published.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace sim = ph::simulation;
using ph::event;

namespace {

/// What somebody at the device, and somebody with a scope, would see.
struct seen {
  std::array<int, 15> events{};  ///< ticks of each
  int limited = 0, ticks = 0;
  double deepest = 0.0;       ///< [m], truly
  double swing = 0.0;         ///< from the lowest to the highest in the last half second [m]
  double largest_step = 0.0;  ///< of the force from tick to tick [N]
  double force = 0.0;         ///< at the end [N]
  double energy = 0.0;        ///< of the ledger, at the end [J]
  double least_energy = 0.0;  ///< of the ledger, ever [J]
  double taken = 0.0;         ///< by the hand, truly, more than it gave [J]
  double place = 0.0;         ///< at the end [m]

  [[nodiscard]] int of(event e) const { return events[static_cast<std::size_t>(e)]; }
};

/// Two seconds of a model on a device. `before` comes before each tick, and may publish.
template <class Model, class Device>
seen looked_at(Model& model, Device& device, const std::function<void(int)>& before = {},
               int ticks = 2000) {
  seen s;
  auto sample = device.exchange(0.0);
  double last = 0.0, lowest = 1e9, highest = -1e9;
  for (int n = 0; n < ticks; ++n) {
    if (before) before(n);
    const auto out = model.tick(sample);
    ++s.events[static_cast<std::size_t>(out.what)];
    s.limited += out.limited;
    if (n > 0) s.largest_step = std::max(s.largest_step, std::abs(out.force - last));
    last = out.force;
    s.energy = out.energy;
    s.least_energy = std::min(s.least_energy, out.energy);
    sample = device.exchange(out.force);
    s.deepest = std::max(s.deepest, -device.position());
    if (n >= ticks - 500) {
      lowest = std::min(lowest, device.position());
      highest = std::max(highest, device.position());
    }
  }
  s.ticks = ticks;
  s.swing = highest - lowest;
  s.force = last;
  s.taken = -device.meter().minimum();
  s.place = device.position();
  return s;
}

/// A wall at 0 that never moves, outside is up.
template <class Law, class Bound, class Limits = ph::loop_limits>
auto wall_of(double stiffness, const Law& law, const Bound& bound,
             const Limits& limits = {.longest_tick = 1e-3},
             const ph::reduced_energy& ledger = {.damping = 0.3}) {
  return ph::local_model{d1{},
                         ph::fixed{ph::half_space<d1>{0.0, 1.0, stiffness}},
                         ph::turn_at_once{},
                         law,
                         ledger,
                         bound,
                         limits};
}

constexpr ph::damped_spring settling{.mass = 0.1};
constexpr ph::reachable_bound reachable{.mass = 0.1, .hand_force = 5.0};

/// A surface that the world publishes, by default one that it need not renew.
template <class Law>
auto published(const Law& law, const ph::freshness& rule = {}) {
  return ph::local_model{d1{},
                         ph::followed<ph::half_space<d1>>{rule},
                         ph::turn_at_once{},
                         law,
                         ph::reduced_energy{.damping = 0.3},
                         reachable,
                         ph::loop_limits{.longest_tick = 1e-3}};
}
/// Falls 10 mm onto the wall and is left alone with its weight.
auto fallen(int latency = 0) {
  return sim::device<d1>{{.damping = 0.3, .load = -1.0, .start = 0.01, .latency = latency}};
}
/// A hand comes slowly and presses with 3 N, and no more.
auto pressed() {
  return sim::device<d1, sim::impedance_hand<d1>>{
      {.damping = 0.3, .start = 0.002},
      {.stiffness = 300, .damping = 5, .limit = 3.0, .target = 0.002, .target_velocity = -0.02}};
}

/// Presses, and eases and presses again once a second: 1 N and 3 N on a spring of 300 N/m.
struct kneading_hand {
  [[nodiscard]] double force(double t, const double& x, const double& v) const noexcept {
    const double target = t < 1.0 ? 0.002 - 0.01 * t : -0.008 + 0.003 * std::sin(6.28 * (t - 1.0));
    return std::clamp(300.0 * (target - x) - 5.0 * v, -5.0, 5.0);
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};
/// On encoders of 0.1 mm, with the dry friction that most devices have.
auto kneaded() {
  return sim::device<d1, kneading_hand>{
      {.damping = 0.3, .friction = 0.3, .quantum = 1e-4, .start = 0.002}, {}};
}

constexpr ph::late_loop_limits<1> told{.longest_tick = 1e-3};

}  // namespace

TEST_CASE("it buzzes: a wall that bounces, and what stops it", "[troubleshooting]") {
  auto spring = wall_of(1e4, ph::spring{}, reachable);
  auto damped = wall_of(1e4, settling, reachable);
  auto first = fallen(), second = fallen();
  const seen before = looked_at(spring, first), after = looked_at(damped, second);
  CHECK(before.swing > 5e-3);
  CHECK(before.of(event::nominal) == before.ticks);  // passive all the while: no event says it
  CHECK(before.taken <= 1e-12);
  CHECK(after.swing < 1e-7);
  CHECK(after.place == Approx(-1e-4));  // 1 N on 10 kN/m
}

TEST_CASE("it buzzes: encoders whose steps are felt, and what hides them", "[troubleshooting]") {
  auto plain = wall_of(2e3, settling, reachable);
  auto aware = ph::make_touch<d1>(ph::encoder_device{.mass = 0.1,
                                                     .damping = 0.2,
                                                     .friction = 0.15,
                                                     .presliding = 1e-5,
                                                     .quantum = 1e-4,
                                                     .force_limit = 9.0,
                                                     .longest_tick = 1e-3},
                                  {.force = 5.0});
  REQUIRE(aware.update({0.0, 1.0, 2e3}));
  auto first = kneaded(), second = kneaded();
  const seen before = looked_at(plain, first), after = looked_at(aware, second);
  CHECK(before.largest_step > 2.5);  // 28 N·s/m times a step in a tick, 0.1 m/s
  CHECK(before.of(event::nominal) == before.ticks);
  CHECK(after.largest_step < 0.15);
  CHECK(after.force == Approx(before.force).epsilon(0.01));  // and it holds as much
}

TEST_CASE("it kicks: a device that is thrown, and what stops it", "[troubleshooting]") {
  SECTION(
      "a latency that is not stated: the ledger says debt, if the device reports what it held") {
    auto untold = wall_of(1e4, settling, reachable);
    auto stated = wall_of(1e4, settling, reachable, told);
    auto first = fallen(1), second = fallen(1);
    const seen before = looked_at(untold, first), after = looked_at(stated, second);
    CHECK(before.of(event::debt) > 1000);
    CHECK(before.least_energy < -0.01);
    CHECK(before.taken > 0.01);
    CHECK(before.swing > 0.02);  // it fell from 10 mm
    CHECK(after.of(event::debt) == 0);
    CHECK(after.taken <= 1e-12);
    CHECK(after.swing < 0.011);
    auto asked = fallen(1);
    const auto found = ph::measure_latency<d1>(asked, {.force = 1.0});
    CHECK(found.problem == nullptr);
    CHECK(found.ticks == 1);
  }
  SECTION("a force that is added behind the port") {
    // The same spring of 500 N/m towards 20 mm outside, once behind the port, once as a wish.
    const auto added = [](double x) { return 500.0 * (0.02 - x); };
    const auto swung = [&](bool behind) {
      auto port = ph::make_strict_guard<d1>({0.03}, ph::actuator_limit{9.0}, 1e-3);
      sim::device<d1> device{{.damping = 0.03}};
      auto sample = device.exchange(0.0);
      int debts = 0;
      for (int n = 0; n < 1000; ++n) {
        const double extra = added(sample.position);
        const auto out = port.tick(sample, behind ? 0.0 : extra);
        debts += out.what == event::debt;
        sample = device.exchange(behind ? out.force + extra : out.force);
      }
      return std::pair{debts, -device.meter().minimum()};
    };
    CHECK(swung(true).first > 100);
    CHECK(swung(true).second > 0.05);
    CHECK(swung(false).first == 0);
    CHECK(swung(false).second <= 1e-12);
  }
  SECTION("a surface that the world moves in jumps") {
    const auto beat = [](auto& model) {
      return [&model](int n) {
        const bool up = n > 500 && n / 33 % 2 == 1;
        if (n % 33 == 0) (void)model.update({up ? 1e-3 : 0.0, 1.0, 2000.0});
      };
    };
    auto jumping = published(settling);
    auto limited = published(ph::shaped{settling, ph::force_rate_limit{.rate = 100}});
    auto first = pressed(), second = pressed();
    const seen before = looked_at(jumping, first, beat(jumping));
    const seen after = looked_at(limited, second, beat(limited));
    CHECK(before.largest_step == Approx(2.0).epsilon(0.02));  // 1 mm at 2 kN/m, in one tick
    CHECK(before.of(event::nominal) == before.ticks);
    CHECK(after.largest_step < 0.4 * before.largest_step);
  }
}

TEST_CASE("it sinks: a wall that gives way, and what holds it", "[troubleshooting]") {
  auto firm = wall_of(2e3, settling, reachable);
  auto press = pressed();
  const seen held = looked_at(firm, press);
  CHECK(held.limited == 0);
  CHECK(held.deepest < 1.6e-3);  // 3 N on 2 kN/m
  SECTION("a bound that has to be ready for any hand") {
    auto strict = wall_of(2e3, settling, ph::strict_bound{});
    auto device = pressed();
    const seen before = looked_at(strict, device);
    CHECK(before.limited > 1800);  // the bound cuts, from the first touch on
    CHECK(before.of(event::nominal) == before.ticks);
    CHECK(before.deepest > 3.0 * held.deepest);
  }
  SECTION("a longest_tick that is much longer than the ticks are") {
    auto careful = wall_of(2e3, settling, reachable, {.longest_tick = 10e-3});
    auto device = pressed();
    const seen before = looked_at(careful, device);
    CHECK(before.limited > 300);
    CHECK(before.deepest > 10.0 * held.deepest);
  }
  SECTION("less damping than the device has") {
    auto modest =
        wall_of(2e3, settling, ph::strict_bound{}, {.longest_tick = 1e-3}, {.damping = 0.03});
    auto honest = wall_of(2e3, settling, ph::strict_bound{});
    auto first = pressed(), second = pressed();
    CHECK(looked_at(modest, first).deepest > 5.0 * looked_at(honest, second).deepest);
  }
  SECTION("a world that has fallen silent") {
    const auto talking = [](auto& model, int until) {
      return [&model, until](int n) {
        if (n % 33 == 0 && n < until) (void)model.update({0.0, 1.0, 2000.0});
      };
    };
    auto falls_silent = published(settling, {.stale_after = 0.1});
    auto goes_on = published(settling, {.stale_after = 0.1});
    auto first = pressed(), second = pressed();
    const seen before = looked_at(falls_silent, first, talking(falls_silent, 1000));
    CHECK(before.of(event::stale_target) > 800);
    CHECK(before.force == 0.0);
    const seen after = looked_at(goes_on, second, talking(goes_on, 9999));
    CHECK(after.of(event::stale_target) == 0);
    CHECK(after.deepest == held.deepest);
  }
}

TEST_CASE("it drags: a force where there is nothing, and what ends it", "[troubleshooting]") {
  SECTION("a bound that fills its tank by damping") {
    const auto coasting = [] {
      return sim::device<d1>{{.damping = 0.3, .start = 0.5, .start_velocity = 0.5}};
    };
    auto tank =
        wall_of(2e3, settling, ph::two_layer_tank{.wanted = 0.1, .refill = 100, .max_damping = 10});
    auto plain = wall_of(2e3, settling, reachable);
    auto first = coasting(), second = coasting();
    const seen before = looked_at(tank, first, {}, 300);
    const seen after = looked_at(plain, second, {}, 300);
    CHECK(before.largest_step > 1.0);
    CHECK(before.place < 0.506);  // stopped within 6 mm, in free space
    CHECK(before.limited > 290);
    CHECK(after.largest_step == 0.0);  // no force at all
    CHECK(after.place > 0.59);
  }
  SECTION("a normal that turns too slowly") {
    // The finger rests 1 mm deep on a floor that tilts to 30 degrees, once; what pulls it sideways, off the
    // new normal, 0.2 s later?
    const auto off_normal = [](double rate) {
      const d2::vector tilted(std::sin(0.5236), std::cos(0.5236));
      ph::local_model floor{d2{},
                            ph::followed<ph::half_space<d2>>{},
                            ph::turn_limited{.rate = rate},
                            ph::spring{},
                            ph::reduced_energy{.damping = 0.3, .loan = 0.1},
                            reachable,
                            ph::loop_limits{.longest_tick = 1e-3}};
      (void)floor.update({{0, 0}, {0, 1}, 1000.0});
      for (int n = 0; n < 10; ++n) (void)floor.tick({0, -1e-3}, 1ms);
      (void)floor.update({{0, 0}, tilted, 1000.0});
      d2::vector force = d2::zero();
      for (int n = 0; n < 200; ++n) force = floor.tick({0, -1e-3}, 1ms).force;
      REQUIRE(force.norm() > 0.5);
      return (force - tilted * tilted.dot(force)).norm() / force.norm();
    };
    CHECK(off_normal(0.2) > 0.4);
    CHECK(off_normal(4.0) < 1e-9);
  }
}

TEST_CASE("it is silent: no force at all, and what brings it", "[troubleshooting]") {
  const auto felt = [](auto& model) {
    auto device = pressed();
    return looked_at(model, device);
  };
  auto works = wall_of(2e3, settling, reachable);
  REQUIRE(felt(works).force > 2.9);
  SECTION("a parameter out of its range") {
    auto forgotten = wall_of(2e3, ph::damped_spring{}, reachable);
    const seen s = felt(forgotten);
    CHECK(s.of(event::rejected_parameters) == s.ticks);
    CHECK(std::string(forgotten.check().parameter) == "mass");
    REQUIRE_FALSE(forgotten.set(settling));
    CHECK(felt(forgotten).force > 2.9);
  }
  SECTION("nobody has published a surface") {
    auto unheard = published(settling), heard = published(settling);
    const seen s = felt(unheard);
    CHECK(s.of(event::no_target) == s.ticks);
    REQUIRE(heard.update({0.0, 1.0, 2000.0}));
    CHECK(felt(heard).force > 2.9);
  }
  SECTION("millimetres for metres") {
    const auto pushed = [](double unit) {
      auto model = wall_of(2e3, settling, reachable);
      auto out = model.tick(5.0 * unit, 1ms);
      for (int n = 1; n <= 100; ++n) out = model.tick((5.0 - 0.06 * n) * unit, 1ms);
      return out;
    };
    auto far_away = wall_of(2e3, settling, reachable);
    CHECK(far_away.tick(40.0, 1ms).what == event::outside_workspace);  // 40 m
    CHECK(pushed(1.0).what == event::rejected_sample);                 // nearer, but 60 m/s
    CHECK(pushed(1.0).force == 0.0);
    CHECK(pushed(1e-3).what == event::nominal);
    CHECK(pushed(1e-3).force > 1.0);
  }
  SECTION("a dt that is never measured") {
    const auto pushed = [](double dt) {
      auto model = wall_of(2e3, settling, reachable);
      auto out = model.tick(5e-3, ph::seconds{dt});
      for (int n = 1; n <= 100; ++n) out = model.tick(5e-3 - 6e-5 * n, ph::seconds{dt});
      return out;
    };
    CHECK(pushed(0.0).what == event::rejected_sample);
    CHECK(pushed(0.0).force == 0.0);
    CHECK(pushed(1e-3).force > 1.0);
  }
  SECTION("a normal that points into the wall") {
    const auto with_normal = [](double n) {
      return ph::local_model{d1{},
                             ph::fixed{ph::half_space<d1>{0.0, n, 2000.0}},
                             ph::turn_at_once{},
                             settling,
                             ph::reduced_energy{.damping = 0.3},
                             reachable,
                             ph::loop_limits{.longest_tick = 1e-3}};
    };
    auto inwards = with_normal(-1.0), outwards = with_normal(1.0);
    const seen s = felt(inwards);
    CHECK(s.force == 0.0);
    CHECK(s.of(event::nominal) == s.ticks);
    CHECK(felt(outwards).force > 2.9);
  }
  SECTION("a start inside the wall, where the ledger is empty and nothing fills it") {
    const auto left_inside = [](double loan) {
      auto model =
          wall_of(2e3, settling, reachable, {.longest_tick = 1e-3}, {.damping = 0.3, .loan = loan});
      sim::device<d1> device{{.damping = 0.3, .start = -2e-3}};
      return looked_at(model, device);
    };
    const seen empty = left_inside(0.0);
    CHECK(empty.limited == empty.ticks);
    CHECK(empty.energy == 0.0);
    CHECK(empty.of(event::nominal) == empty.ticks);  // a wall that nobody moves: explain() says it
    CHECK(empty.place == -2e-3);
    const seen lent = left_inside(1e-4);
    CHECK(lent.place > 0.0);
    CHECK(lent.taken <= 1e-4 + 1e-12);
  }
}
