// SPDX-License-Identifier: BSD-3-Clause
// What a composition says of the stiffness that it shows, against the slope that a finger finds.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/contact/virtual_coupling.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/hand.hpp>
#include <passive_haptics/simulation/presets.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace sim = ph::simulation;
using Catch::Matchers::WithinRel;
using ph::event;
using ph::softened_by;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr ph::exact_device grip{
    .mass = 0.1, .damping = 0.1, .force_limit = 9.0, .longest_tick = 1e-3};
constexpr ph::known_hand hand{.force = 5.0};
constexpr ph::half_space<d1> wall(double K) {
  return {.point = 0.0, .normal = 1.0, .stiffness = K};
}

struct pressed {
  double slope = 0.0;   ///< of force on true depth [N/m]
  bool covered = true;  ///< the ledger bound in no tick
};
/// A finger comes from 100 mm at 0.1 m/s and presses at 5 mm/s: from 1 to 3 N, or from 0.3 to 0.9 of what the
/// motors hold if that is less. Positions are shown in steps of q.
template <class Touch>
pressed press(Touch touch, double T, double q, double motors) {
  const auto shown = [q](double x) { return q > 0.0 ? q * (std::floor(x / q) + 0.5) : x; };
  pressed found;
  double x = 0.1, n = 0.0, d = 0.0, f = 0.0, dd = 0.0, df = 0.0;
  for (double force = 0.0; force < std::min(3.0, 0.9 * motors) && x > -0.2;) {
    x -= (x > 1e-4 ? 0.1 : 5e-3) * T;
    force = touch.tick(shown(x), ph::seconds{T}).force;
    if (force < std::min(1.0, 0.3 * motors)) continue;
    if (touch.explain().now == softened_by::ledger) found.covered = false;
    n += 1.0;
    d -= x;
    f += force;
    dd += x * x;
    df -= x * force;
  }
  found.slope = (n * df - d * f) / (n * dd - d * d);
  return found;
}

/// A force of one's own that says what it was told to say.
struct told {
  double shown{}, depth{};  // [N/m], [m]
  softened_by now{};
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class P>
  struct on;
};
template <class P>
struct told::on : ph::part_at<ph::given_force, P> {
  told own;
  constexpr explicit on(const told& p) noexcept
      : ph::part_at<ph::given_force, P>(ph::given_force{}), own(p) {}
  constexpr void explain(ph::explanation& e, const auto& /*x*/, double /*T*/,
                         int /*late*/) const noexcept {
    e.shown = own.shown;
    e.depth = own.depth;
    e.now = own.now;
  }
};
/// A bound that leaves so many percent of any force; or one that could as well leave others tomorrow.
template <int Percent, bool Remembers>
struct leaves {
  static constexpr ph::guarantee passivity = ph::guarantee::none;
  static constexpr ph::bound_traits traits{};
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class P>
  struct on {
    constexpr explicit on(const leaves& /*p*/) noexcept {}
    [[nodiscard]] constexpr ph::share<double> limit(double /*f*/,
                                                    const auto& /*state*/) const noexcept
        requires(!Remembers) {
      return {Percent / 100.0};
    }
    [[nodiscard]] constexpr ph::share<double> limit(
        double /*f*/, const auto& /*state*/) noexcept requires Remembers {
      return {Percent / 100.0};
    }
  };
};

}  // namespace

TEST_CASE("the stiffness that explain() says is the slope that a finger finds", "[port]") {
  int true_to_it = 0, of = 0;
  const auto judge = [&](auto touch, double K, double T, double q, double motors) {
    const auto news = touch.update(wall(K));
    REQUIRE(news);
    const auto said = touch.explain();
    CHECK(said.asked == K);
    CHECK_THAT(said.shown, WithinRel(news.stiffness, 1e-12));
    CHECK((said.stiffness == softened_by::nothing) == (said.shown == K));
    const pressed found = press(touch, T, q, motors);
    const double off = std::abs(found.slope / said.shown - 1.0);
    ++of;
    true_to_it += off < 0.05;
    CAPTURE(K, T, q, motors, to_string(said.stiffness));
    if (found.covered) CHECK(off < 0.06);
  };
  for (const auto& d : sim::all_presets) {
    for (const double K : {300.0, 1000.0, 3000.0, 10e3, 30e3}) {
      for (const double T : {0.5e-3, 1e-3, 2e-3, 5e-3}) {
        const double b = d.damping / 2.0;
        judge(ph::make_touch<d1>(
                  {.mass = d.mass, .damping = b, .force_limit = d.force_limit, .longest_tick = T},
                  {.force = 5.0}),
              K, T, 0.0, d.force_limit);
        if (!(d.friction > 0.0)) continue;
        judge(ph::make_touch<d1>(ph::encoder_device{.mass = d.mass,
                                                    .damping = b,
                                                    .friction = d.friction / 2.0,
                                                    .presliding = 5e-6,
                                                    .quantum = d.quantum,
                                                    .force_limit = d.force_limit,
                                                    .longest_tick = T},
                                 hand),
              K, T, d.quantum, d.force_limit);
      }
    }
  }
  CAPTURE(true_to_it, of);
  CHECK(true_to_it > of * 19 / 20);
}

TEST_CASE("explain() says what makes a surface softer than it was asked for", "[port]") {
  const auto why = [](auto touch, double K) {
    touch.update(wall(K));
    return touch.explain().stiffness;
  };
  const auto with = [](auto law, auto bound) {
    return ph::local_model{d1{},
                           ph::followed<ph::half_space<d1>>{},
                           ph::turn_limited{.rate = 2.0},
                           law,
                           ph::reduced_energy{.damping = 0.1},
                           bound,
                           ph::loop_limits{.longest_tick = 1e-3}};
  };
  const ph::damped_spring law{.mass = 0.1};
  auto slow = grip;
  slow.longest_tick = 2e-2;
  CHECK(why(ph::make_touch<d1>(grip, hand), 2000.0) == softened_by::nothing);
  CHECK(why(ph::make_touch<d1>(slow, hand), 2000.0) == softened_by::mass_and_tick);
  CHECK(why(with(law, ph::strict_bound{}), 150.0) == softened_by::nothing);
  CHECK(why(with(law, ph::strict_bound{}), 2000.0) == softened_by::damping_and_tick);
  CHECK(why(with(law, ph::memoryless_bound{}), 2000.0) == softened_by::damping_and_tick);
  CHECK(why(with(law, ph::bound_chain{ph::strict_bound{}, ph::actuator_limit{9.0}}), 2000.0) ==
        softened_by::damping_and_tick);
  CHECK(why(with(ph::virtual_coupling{.stiffness = 100.0}, ph::strict_bound{}), 150.0) ==
        softened_by::coupling);
  CHECK(why(with(ph::capped{law, 500.0}, ph::no_bound{}), 2000.0) == softened_by::encoder_steps);
  CHECK(why(with(law, ph::actuator_limit{-1.0}), 2000.0) == softened_by::parameters);
  CHECK(ph::make_touch<d1>(grip, hand).explain().stiffness == softened_by::no_surface);
  const auto guard = ph::make_guard<d1>(grip, hand);
  CHECK(guard.explain().asked == infinity);
  CHECK(guard.explain().shown == guard.source().parameters().most_stiffness(1e-3));
  // 2b/T sampled at 1 kHz, 0.1 N·s/m
  auto strict = with(law, ph::strict_bound{});
  CHECK_THAT(strict.update(wall(2000.0)).stiffness, WithinRel(2000.0, 1e-12));  // the law's own
  CHECK_THAT(strict.explain().shown, WithinRel(200.0, 1e-12));
}

TEST_CASE("explain() says what keeps the force of this tick below that", "[port]") {
  auto touch = ph::make_touch<d1>(grip, hand);
  const auto still = [&](double x, int ms) {
    for (int n = 0; n < ms; ++n) (void)touch.tick(x, 1ms);
    return touch.explain();
  };
  REQUIRE(touch.update(wall(2000.0)));
  auto said = still(1e-5, 1);
  CHECK(said.depth == 0.0);
  CHECK(said.force == 0.0);
  CHECK(said.now == softened_by::nothing);
  for (int n = 1; n < 200; ++n) said = still(1e-5 - 1e-6 * n, 1);  // 1 mm/s, from an empty ledger
  CHECK_THAT(said.depth, WithinRel(189e-6, 1e-9));
  CHECK(said.now == softened_by::ledger);
  for (int n = 0; n < 180; ++n) said = still(-0.2e-3 - 1e-5 * n, 1);
  said = still(-2e-3, 1);
  CHECK(said.now == softened_by::nothing);
  CHECK_THAT(said.force, WithinRel(4.0, 1e-9));
  REQUIRE(touch.update({.point = 1e-3, .normal = 1.0, .stiffness = 2000.0}));
  CHECK(still(-2e-3, 2).now == softened_by::news);
  CHECK(still(-2e-3, 400).now == softened_by::nothing);
  CHECK_THAT(touch.explain().force, WithinRel(6.0, 1e-9));
  touch.release();
  CHECK(still(-2e-3, 20).now == softened_by::silence);
  CHECK(still(-2e-3, 500).stiffness == softened_by::no_surface);
  REQUIRE(touch.update(wall(2000.0)));
  for (int n = 0; n < 900; ++n) {
    if (n % 30 == 0) REQUIRE(touch.update(wall(2000.0)));
    said = still(-1e-5 * n, 1);
  }
  CHECK(said.now == softened_by::motors);
  CHECK_THAT(said.force, WithinRel(9.0, 1e-9));
}

TEST_CASE("a start inside has an event and an explanation of its own, until something is paid in",
          "[port]") {
  constexpr ph::encoder_device steps{.mass = 0.1,
                                     .damping = 0.1,
                                     .friction = 0.15,
                                     .presliding = 1e-5,
                                     .quantum = 6e-5,
                                     .force_limit = 9.0};
  const auto says = [](auto port, double start) {
    for (int n = 0; n < 1500; ++n) {
      const auto out = port.tick(start, 1ms);
      INFO(n);
      if (n > 5) CHECK(out.what == (start < 0.0 ? event::started_inside : event::nominal));
      CHECK(out.force == 0.0);
      CHECK((port.explain().now == softened_by::started_inside) == (start < 0.0));
    }
    if (start > 0.0) return;
    auto out = port.tick(start, 1ms);
    for (int n = 1; n < 5; ++n) out = port.tick(start - 1e-4 * n, 1ms);  // the hand pays
    CHECK(out.what == event::nominal);
    CHECK(out.force > 0.0);
    CHECK(port.explain().now != softened_by::started_inside);
  };
  const auto touching = [](auto port) {
    REQUIRE(port.update(wall(2000.0)));
    return port;
  };
  ph::passive_port pair{
      d1{},
      ph::contacts{ph::local_contact{ph::followed{wall(2000.0)}, ph::turn_at_once{}, ph::spring{}},
                   ph::given_force{.stale_after = 1e9}},
      ph::reduced_energy{.damping = 0.1}, ph::strict_bound{},
      ph::loop_limits{.longest_tick = 1e-3}};
  (void)pair.source().update(0.0);
  auto set = ph::make_contacts<d1>(grip, hand, ph::slots<ph::half_space<d1>, 2>{});
  set.source().update(0, wall(2000.0));
  for (const double start : {-2e-3, 2e-3}) {
    says(touching(ph::make_touch<d1>(grip, hand)), start);
    says(touching(ph::make_touch<d1>(grip, ph::any_hand)), start);
    says(touching(ph::make_touch<d1>(steps, hand)), start);
    says(set, start);
  }
  for (int n = 0; n < 9; ++n) CHECK(pair.tick(-1e-3, 1ms).what == event::started_inside);
}

TEST_CASE(
    "the motors are what binds where they hold what they can, and not where the ledger is empty",
    "[port]") {
  auto touch = ph::make_touch<d1>(grip, hand);
  REQUIRE(touch.update(wall(2000.0)));
  for (int n = 0; n < 1200; ++n) (void)touch.tick(-8e-3, 1ms);  // 16 N asked, nothing paid
  CHECK(touch.explain().now == softened_by::started_inside);
  (void)touch.tick(-8.001e-3, 1ms);
  CHECK(touch.explain().now == softened_by::ledger);
}

TEST_CASE("a surface that comes onto a hand waits for the ledger, and explain() says so",
          "[port]") {
  const auto check = [](auto port, auto tell) {
    sim::device<d1, sim::impedance_hand<d1>> dev(
        {.mass = 0.1, .damping = 0.03, .start = 0.01},
        {.stiffness = 200.0, .damping = 2.0, .limit = 5.0});
    auto sample = dev.exchange(0.0);
    for (int n = 0; n < 5000; ++n) {
      dev.hand().target = n < 1000 ? 0.01 - 2e-5 * n : -0.01;  // 2 N
      if (n % 30 == 0) tell(port, n < 2000 ? 0.0 : 0.02);
      sample = dev.exchange(port.tick(sample).force);
      const auto said = port.explain();
      CAPTURE(n);
      if (n == 1990) CHECK(said.now == softened_by::nothing);
      if (n == 2020) CHECK(said.now == softened_by::news);
      if (n < 3500) continue;
      REQUIRE(said.force < 0.1 * said.shown * said.depth);  // it has stopped far below
      REQUIRE(said.now == softened_by::ledger);
    }
  };
  check(ph::make_touch<d1>(grip, hand), [](auto& port, double at) {
    REQUIRE(port.update({.point = at, .normal = 1.0, .stiffness = 2000.0}));
  });
  check(ph::make_contacts<d1>(grip, hand, ph::slots<ph::half_space<d1>, 1>{}),
        [](auto& port, double at) {
          port.source().update(0, {at, 1.0, 2000.0});
        });
}

TEST_CASE("a gentle press shows the stiffness from 8 K F T^2/m on, and less of it below",
          "[port]") {
  // The share of what explain() says that a hand of 200 N/m feels, which comes at 2.5 mm/s and presses by `newtons`.
  const auto share = [](ph::exact_device d, double states, double K, double newtons) {
    auto touch = ph::make_touch<d1>(d, {.force = states});
    REQUIRE(touch.update(wall(K)));
    sim::device<d1, sim::impedance_hand<d1>> dev(
        {.mass = d.mass, .damping = d.damping, .start = 0.01},
        {.stiffness = 200.0, .damping = 2.0, .limit = 5.0});
    auto sample = dev.exchange(0.0);
    for (int n = 0; n < 8000; ++n) {
      const double way = std::min(n / 4000.0, 1.0);
      dev.hand().target = 0.01 * (1.0 - way) - way * newtons / 200.0;
      sample = dev.exchange(touch.tick(sample).force);
    }
    const auto said = touch.explain();
    CHECK((said.now == softened_by::ledger) == (said.force < 0.95 * said.shown * said.depth));
    return said.force / (said.shown * said.depth);
  };
  ph::exact_device light = grip;
  light.damping = 0.03;
  for (const double mass : {0.05, 0.1, 0.3}) {
    for (const double K : {1000.0, 3000.0, 10000.0}) {
      for (const double F : {5.0, 15.0}) {
        light.mass = mass;
        const double shown = std::min(K, 0.095 * mass / 1e-6), f = shown * F * 1e-6 / mass;
        if (8.0 * f > 4.5) continue;
        CAPTURE(mass, K, F);
        CHECK(share(light, F, K, 8.0 * f) > 0.9);
      }
    }
  }
  light.mass = 0.05;
  CHECK(share(light, 5.0, 10000.0, 0.2) < 0.2);
  light.mass = 0.1;
  const double told_well = share(light, 5.0, 3000.0, 0.45);
  CHECK(told_well > 0.9);
  CHECK(share(light, 15.0, 3000.0, 0.45) < 0.3 * told_well);
}

TEST_CASE("explain() of a set is about the contact that presses most", "[port][contacts]") {
  ph::passive_port corner{
      d3{},
      ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{},
                      ph::slots<ph::half_space<d3>, 3>{}},
      ph::reduced_energy{.damping = 0.1},
      ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0}, ph::actuator_limit{9.0}},
      ph::loop_limits{.longest_tick = 1e-3}};
  CHECK(corner.explain().stiffness == softened_by::no_surface);
  corner.source().update(0, {d3::zero(), d3::vector(0, 0, 1), 800.0});
  corner.source().update(1, {d3::zero(), d3::vector(0, 1, 0), 20e3});
  for (int n = 0; n < 100; ++n) (void)corner.tick({0, 0, -1e-5 * n}, 1ms);
  auto said = corner.explain();
  CHECK(said.asked == 800.0);
  CHECK(said.stiffness == softened_by::nothing);
  CHECK(said.now == softened_by::nothing);
  for (int n = 0; n < 40; ++n) (void)corner.tick({0, -1e-5 * n, -1e-3}, 1ms);
  said = corner.explain();
  CHECK(said.asked == 20e3);
  CHECK_THAT(said.shown, WithinRel(0.95 * 0.1 * 0.1 / 1e-6, 1e-9));
  CHECK(said.stiffness == softened_by::mass_and_tick);

  // What presses most is where it was told, however much the slot before it has to make up for.
  ph::passive_port lagging{d2{},
                           ph::contact_set{ph::proxy_spring{.mass = 0.1, .force_limit = 4.0},
                                           ph::pursuit{}, ph::slots<ph::half_space<d2>, 2>{}},
                           ph::no_observer{}, ph::no_bound{},
                           ph::loop_limits{.longest_tick = 1e-3, .top_speed = 100.0}};
  lagging.source().update(0, {d2::zero(), d2::vector(1, 0), 800.0});
  lagging.source().update(1, {d2::zero(), d2::vector(0, 1), 2000.0});
  for (int n = 0; n < 500; ++n) (void)lagging.tick({-1e-6 * n, -1e-5 * n}, 1ms);
  CHECK(lagging.explain().now == softened_by::nothing);  // 4 N of 10
  lagging.source().update(0, {d2::vector(2e-3, 0), d2::vector(1, 0), 800.0});
  (void)lagging.tick({-5e-4, -5e-3}, 1ms);
  REQUIRE_FALSE(lagging.source().slot(0).lag() == 0.0);
  CHECK(lagging.explain().asked == 2000.0);
  CHECK(lagging.explain().now == softened_by::nothing);
}

TEST_CASE("every reason has a name and a sentence", "[port]") {
  for (int i = 0; i <= static_cast<int>(softened_by::sample); ++i) {
    ph::explanation e;
    e.stiffness = static_cast<softened_by>(i);
    CHECK(std::string(to_string(e.stiffness)) != "unknown reason");
    CHECK(std::string(e.because()).size() > 25);
    ph::explanation now{.stiffness = softened_by::mass_and_tick};
    now.now = static_cast<softened_by>(i);
    if (i > 0) CHECK(std::string(now.because()) == e.because());
  }
  CHECK(std::string(to_string(static_cast<softened_by>(99))) == "unknown reason");
}

TEST_CASE("less by a millionth is no softer, and motors hold back from 95 % of their limit on",
          "[explain]") {
  using ph::softened_by;
  ph::explanation e{.asked = 1000.0, .shown = 1000.0};
  for (const double most : {2000.0, 1000.0, 1000.0 * (1.0 - 1e-6), std::nan("")}) {
    e.soften(most, softened_by::coupling);
    CHECK(e.shown == 1000.0);
    CHECK(e.stiffness == softened_by::nothing);
  }
  e.soften(999.9, softened_by::coupling);
  CHECK(e.shown == 999.9);
  CHECK(e.stiffness == softened_by::coupling);

  const auto held_back = [](double asked, double depth, double force) {
    ph::explanation of{.asked = asked, .shown = 1024.0, .depth = depth, .force = force};
    of.saturate(8.0);
    CHECK((of.now == softened_by::nothing || of.now == softened_by::motors));
    return of.now == softened_by::motors;
  };
  CHECK(held_back(1024.0, 0.01, 7.7));
  CHECK_FALSE(held_back(1024.0, 0.01, 0.95 * 8.0));
  CHECK_FALSE(held_back(1024.0, 8.0 / 1024.0, 8.0));  // it asks for no more than they hold
  CHECK(held_back(HUGE_VAL, 0.0, 7.7));               // of a given force no depth tells
  CHECK_FALSE(held_back(HUGE_VAL, 0.0, 7.5));
}

TEST_CASE("a force that the ledger has cut is no news in the air, nor after a reset", "[explain]") {
  const auto check = [](const auto& bound) {
    ph::local_model wall{d1{},
                         ph::followed<ph::half_space<d1>>{},
                         ph::turn_at_once{},
                         ph::spring{},
                         thesis_ledger(),
                         bound,
                         thesis_loop};
    const auto press = [&] {
      REQUIRE(wall.update({0.0, 1.0, 1000.0}));
      for (int n = 0; n < 50; ++n) (void)wall.tick(1e-3 - 1e-4 * n, 1ms);
    };
    press();
    CHECK(wall.explain().now == ph::softened_by::ledger);
    for (int n = 0; n < 80; ++n) (void)wall.tick(-4e-3 + 1e-4 * n, 1ms);
    CHECK(wall.explain().now == ph::softened_by::nothing);
    press();
    CHECK(wall.explain().now == ph::softened_by::ledger);
    wall.reset();
    CHECK(wall.explain().now == ph::softened_by::nothing);
  };
  check(ph::strict_bound{});
  check(ph::bound_chain{ph::thermal_limit{.peak = 1e3, .continuous = 500.0, .time_constant = 1.0},
                        ph::strict_bound{}});
}

TEST_CASE("a contact has started inside if it has neither force nor energy", "[explain]") {
  const auto told = [](double force, double energy) {
    return ph::detail::cut_short<d1>({force, energy, ph::event::nominal, true});
  };
  CHECK(told(0.0, 0.0) == ph::event::started_inside);
  CHECK(told(0.0, 0.5) == ph::event::nominal);
  CHECK(told(1.0, 0.0) == ph::event::nominal);
  CHECK(told(0.0, -1.0) == ph::event::started_inside);
}

TEST_CASE("a debt is no start inside", "[explain]") {
  ph::passive_port port{d1{}, told{1000.0, 1e-3, softened_by::nothing},
                        ph::reduced_energy{.damping = 0.03, .loan = 1e-3}, leaves<100, true>{},
                        thesis_loop};
  const auto out = [&] {
    (void)port.tick(0.0, 1ms, 1.0);
    return port.tick(2e-3, 1ms, 0.0);  // the device was pushed by 1 N for 2 mm
  }();
  CHECK(out.what == event::debt);
  CHECK(port.explain().now == softened_by::ledger);
  port.reset();
  CHECK(port.tick(0.0, 1ms, 0.0).force == 0.0);
  CHECK(port.explain().now != softened_by::ledger);
}

TEST_CASE("what keeps a force low is what cut it, or else what its surface says", "[explain]") {
  int of[3] = {0, 0, 0};
  const auto check = [&]<int Percent, bool Remembers>(leaves<Percent, Remembers> bound) {
    for (const double shown : {1024.0, 4.0}) {
      for (const double depth : {0.0, 0x1p-10}) {
        for (const double wanted : {0.0, 0.5, 0.95, 0.96, 4.0}) {
          for (const double loan : {0.0, 0.5, 2.0}) {
            for (const softened_by says : {softened_by::nothing, softened_by::news}) {
              ph::passive_port port{d1{}, told{shown, depth, says},
                                    ph::reduced_energy{.damping = 0.03, .loan = loan}, bound,
                                    thesis_loop};
              const double force = port.tick(0.0, 1ms, wanted).force;
              // Of a bound that remembers nothing a force of 0 is no cut in the air.
              const bool cut = force < wanted && (Remembers || depth > 0.0 || force > 0.0);
              const bool none = (cut || depth > 0.0) && force == 0.0 && loan == 0.0;
              const bool all = !cut && depth > 0.0 && force > 0.95 * shown * depth;
              const softened_by expected = none  ? softened_by::started_inside
                                           : all ? softened_by::nothing
                                           : cut ? softened_by::ledger
                                                 : says;
              CAPTURE(Percent, Remembers, shown, depth, wanted, loan, int(says));
              CHECK(port.explain().now == expected);
              ++of[none ? 0 : all ? 1 : 2];
              port.reset();
              if (depth == 0.0) CHECK(port.explain().now == says);
            }
          }
        }
      }
    }
  };
  check(leaves<100, false>{});
  check(leaves<50, false>{});
  check(leaves<0, false>{});
  check(leaves<50, true>{});
  check(leaves<0, true>{});
  for (const int n : of) CHECK(n > 10);
}

TEST_CASE("the floor of a force on encoders is the stiffness times what a position may be off",
          "[explain]") {
  ph::local_model wall{
      d1{},         ph::fixed{ph::half_space<d1>{0.0, 1.0, 1000.0}},       ph::turn_at_once{},
      ph::spring{}, ph::quantised_energy{.damping = 0.1, .quantum = 5e-5}, ph::strict_bound{},
      thesis_loop};
  (void)wall.tick(0.01, 1ms);
  CHECK(wall.explain().floor == wall.explain().shown * wall.observer().travel_error());
  CHECK(wall.explain().floor >= 0.01);
}

TEST_CASE("the floor of a force is no larger than the force on a ledger that is all but empty",
          "[explain]") {
  constexpr double q = 2e-5, K = 2000.0;
  const ph::encoder_device pen{.mass = 0.1,
                               .damping = 0.2,
                               .friction = 0.1,
                               .presliding = 5e-6,
                               .quantum = q,
                               .force_limit = 9.0};
  auto port = ph::make_touch<d1>(pen, ph::known_hand{.force = 5.0});
  REQUIRE(port.update({0.0, 1.0, K}));
  double most = 0.0;
  for (int n = 0; n < 5000; ++n) {  // inside from the start, and wriggles
    (void)port.tick(std::floor((-0.002 + 1e-4 * std::sin(0.01 * n)) / q) * q, ph::seconds{1e-3});
    const auto said = port.explain();
    most = std::max(most, said.floor - std::max(said.force, 1.01 * K * q));
  }
  CHECK(most <= 0.0);
}

TEST_CASE("a late loop that bears less than the encoder steps is what is named", "[explain]") {
  const auto why = [](auto port) {
    REQUIRE(port.update({0.0, 1.0, 5000.0}));
    (void)port.tick(0.001, ph::seconds{1e-3});
    const auto said = port.explain();
    CHECK(said.shown < 5000.0);
    return said.stiffness;
  };
  const ph::known_hand person{.force = 5.0};
  ph::encoder_device pen{.mass = 0.05,
                         .damping = 0.1,
                         .friction = 0.1,
                         .presliding = 5e-6,
                         .quantum = 2e-5,
                         .force_limit = 9.0};
  CHECK(why(ph::make_touch<d1>(pen, person)) == softened_by::encoder_steps);
  pen.latency = 1;
  CHECK(why(ph::make_touch<d1, ph::half_space<d1>, ph::late_loop_limits<1>>(pen, person)) ==
        softened_by::mass_and_tick);
}

TEST_CASE("a wall that is softened because the ledger runs low is not put down to mass and tick",
          "[explain]") {
  auto pen = ph::make_touch<d1>(ph::encoder_device{.mass = 0.1,
                                                   .damping = 0.1,
                                                   .friction = 0.1,
                                                   .presliding = 1e-5,
                                                   .quantum = 2e-6,
                                                   .force_limit = 9.0},
                                ph::known_hand{.force = 5.0});
  REQUIRE(pen.update(wall(600.0)));
  for (int n = 0; n < 100; ++n) (void)pen.tick(1e-3 - 3e-5 * n, ph::seconds{1e-3});
  CHECK(pen.explain().stiffness == softened_by::nothing);
  CHECK(pen.explain().shown == 600.0);
  // The wall comes against a hand that holds, until that has used up what was paid in, and then stands.
  for (int n = 0; n < 4000; ++n) {
    if (n % 20 == 0) {
      REQUIRE(pen.update({.point = std::min(n, 2000) * 1e-6, .normal = 1.0, .stiffness = 600.0}));
    }
    (void)pen.tick(-1.97e-3 + std::min(n, 2000) * 0.9e-6, ph::seconds{1e-3});
  }
  const auto said = pen.explain();
  CAPTURE(said.shown, said.force, said.depth, pen.energy());
  CHECK(said.shown < 0.5 * said.asked);
  CHECK(said.stiffness == softened_by::ledger);
}

TEST_CASE(
    "contacts in which the device was found deep say that their force follows at a limited rate",
    "[explain]") {
  // With the forces off it has sunk 0.1 m; a dead load then rides up on a force that is never K d.
  auto port = ph::make_contacts<d1>(grip, hand, ph::slots<ph::half_space<d1>, 2>{});
  REQUIRE(port.source().update(0, wall(4000.0)));
  sim::device<d1> device({.mass = 0.1, .damping = 0.1, .load = -1.0}, {});
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 3000; ++n) {
    if (n == 300) port.enable_forces(false);
    if (n == 450) port.enable_forces(true);
    if (n % 20 == 0) REQUIRE(port.source().update(0, wall(4000.0)));
    sample = device.exchange(port.tick(sample).force);
    const auto said = port.explain();
    if (n < 1000) continue;
    CAPTURE(n, said.force, said.depth);
    REQUIRE(said.depth > 0.01);
    REQUIRE(said.force < 0.1 * said.shown * said.depth);
    REQUIRE(said.now == softened_by::news);
  }
}

TEST_CASE("the floor of a force that the ledger limits is that of the bound's own spring",
          "[explain]") {
  // Pressed by what the ledger pays for, a step of the encoder is felt as up to 1.3 N, where K q is 0.15.
  constexpr double q = 5e-5, K = 3000.0;
  for (const double load : {1.0, 3.0}) {
    auto port =
        ph::make_contacts<d1>(ph::encoder_device{.mass = 0.1,
                                                 .damping = 0.5,
                                                 .friction = 0.3,
                                                 .presliding = 1e-5,
                                                 .quantum = q,
                                                 .force_limit = 9.0,
                                                 .longest_tick = 1e-3},
                              ph::known_hand{.force = 5.0}, ph::slots<ph::half_space<d1>, 2>{});
    REQUIRE(port.source().update(0, {0.0, 1.0, K}));
    sim::device_parameters<d1> p{.mass = 0.1, .damping = 0.5, .friction = 0.3, .quantum = q};
    p.start = -0.001;  // inside, so little has been paid
    p.load = -load;
    sim::device<d1, sim::impedance_hand<d1>> device(p, {.stiffness = 100.0, .damping = 1.0});
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 6000; ++n) sample = device.exchange(port.tick(sample).force);
    const auto said = port.explain();
    REQUIRE(said.now == softened_by::ledger);
    const auto force_at = [&](double further) {
      auto copy = port;
      auto there = sample;
      there.position += further;
      return copy.tick(there).force;
    };
    const double step = std::max(force_at(-q) - force_at(0.0), force_at(0.0) - force_at(q));
    CAPTURE(load, step, said.floor);
    CHECK(step > 3.0 * K * q);
    CHECK(step < 1.2 * said.floor);
  }
}

TEST_CASE("a sample that was refused is named, and not the ledger or the surface", "[explain]") {
  auto touch = ph::make_touch<d1>(grip, hand);
  REQUIRE(touch.update(wall(1000.0)));
  (void)touch.tick(0.001, 1ms);
  for (const double wrong : {std::nan(""), 30.0, -25.0}) {  // the others are millimetres
    CHECK(touch.tick(wrong, 1ms).what >= event::rejected_sample);
    CHECK(touch.explain().stiffness == softened_by::sample);
    CHECK(std::string(touch.explain().because()).find("metres") != std::string::npos);
    for (int n = 0; n < 3; ++n) (void)touch.tick(-0.001, 1ms);
    CHECK(touch.explain().stiffness == softened_by::nothing);
  }
}
