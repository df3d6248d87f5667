// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

template <class Space, class Law = ph::spring>
auto moving(const Law& law = {}) {
  return ph::local_contact{ph::followed<ph::half_space<Space>>{}, ph::turn_limited{.rate = 4.0},
                           law};
}
template <class Space>
auto still(const ph::half_space<Space>& plane) {
  return ph::local_contact{ph::fixed{plane}, ph::turn_at_once{}, ph::spring{}};
}
/// A bound that does not reduce: it returns so many times the desired force, and this much more.
struct turning_bound {
  static constexpr ph::guarantee passivity = ph::guarantee::none;
  static constexpr ph::bound_traits traits{};
  double times = 1.0;
  double more = 0.0;
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class Port>
  struct on {
    double times;
    double more;
    constexpr explicit on(const turning_bound& p) noexcept : times(p.times), more(p.more) {}
    [[nodiscard]] typename Port::effort limit(const typename Port::effort& desired,
                                              const auto& /*state*/) const noexcept {
      return desired * times + Port::effort::UnitX() * more;
    }
  };
};

template <class Space, class Source, class Bound>
auto port_of(const Source& source, const Bound& bound, double loan = 0.0) {
  return ph::passive_port{Space{}, source, ph::reduced_energy{.damping = 0.03, .loan = loan}, bound,
                          thesis_loop};
}

const d2::vector right(1, 0), up(0, 1);

/// The least energy at a port of b = 0.03 N·s/m [J] while a velocity source goes against `force_at`(x):
/// towards the walls, and away from them by the worst Δx of all.
template <class ForceAt>
double least_energy(ForceAt force_at, double deep) {
  ph::laws::samples random(1);
  const double b = 0.03, T = 1e-3;
  double x = -5e-4, energy = 0.0, least = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const double f = force_at(x);
    const double chance = std::abs(random.number<double>());
    const double worst = f * T / (2 * b), inwards = (x < deep ? 6e-4 : -6e-4) * chance;
    const double dx = std::max(-1e-3, std::min(1e-3, f != 0.0 && chance < 0.6 ? worst : inwards));
    energy += b * dx * dx / T - f * dx;
    x += dx;
    least = std::min(least, energy);
  }
  return least;
}

}  // namespace

TEST_CASE("one contact among contacts does what it does by itself", "[contacts]") {
  auto one = port_of<d2>(ph::contacts{moving<d2>()}, ph::strict_bound{}, 0.001);
  auto alone = port_of<d2>(moving<d2>(), ph::strict_bound{}, 0.001);
  int limited = 0;
  for (int n = 0; n < 500; ++n) {
    if (n % 33 == 10) {
      const ph::half_space<d2> next{{0, 1e-3 * std::sin(n)}, {0.3 * std::cos(n), 1}, 800};
      REQUIRE(one.source().contact<0>().update(next));
      REQUIRE(alone.source().update(next));
    }
    const d2::vector x(1e-4 * n, 2e-3 * std::sin(0.02 * n));
    const auto a = one.tick(x, 1ms), b = alone.tick(x, 1ms);
    REQUIRE((a.force - b.force).norm() < 1e-12);
    REQUIRE(std::abs(a.depth - b.depth) < 1e-15);
    REQUIRE(std::abs(a.energy - b.energy) < 1e-14);
    REQUIRE(a.what == b.what);
    REQUIRE(a.limited == b.limited);
    const d2::vector here = one.source().contact<0>().local().point;
    REQUIRE((here - d2::vector(alone.source().local().point)).norm() < 1e-14);
    limited += a.limited ? 1 : 0;
  }
  CHECK(limited > 50);  // the bound was at work
}

TEST_CASE("in a corner both walls press, and the deepest contact is told", "[contacts]") {
  auto corner =
      port_of<d2>(ph::contacts{still<d2>({{0, 0}, right, 1000}), still<d2>({{0, 0}, up, 2000})},
                  ph::no_bound{});
  REQUIRE_FALSE(corner.check());
  const auto both = corner.tick({-0.001, -0.0005}, 1ms);
  CHECK_THAT(both.force(0), WithinRel(1.0, 1e-12));
  CHECK_THAT(both.force(1), WithinRel(1.0, 1e-12));
  CHECK(both.depth == 0.001);
  const auto one = corner.tick({0.001, -0.0005}, 1ms);
  CHECK(one.force(0) == 0.0);
  CHECK(one.depth == 0.0005);
  CHECK(corner.tick({0.001, 0.0005}, 1ms).force == d2::zero());
  const auto bad = corner.tick({std::nan(""), 0.0}, 1ms);
  CHECK(bad.what == ph::event::rejected_sample);
  CHECK(bad.depth == 0.0);
  CHECK_FALSE(bad.limited);
}

TEST_CASE(
    "what the bound leaves is shared out alike, and each local model stands where its part says",
    "[contacts]") {
  auto corner =
      port_of<d2>(ph::contacts{moving<d2>(), moving<d2>()}, ph::actuator_limit{.most = 2.5});
  auto& wall_here = corner.source().contact<0>();
  auto& floor_here = corner.source().contact<1>();
  REQUIRE(wall_here.update({{0, 0}, right, 1000}));
  REQUIRE(floor_here.update({{0, 0}, up, 1000}));
  const d2::vector x(-0.003, -0.004);  // asks for 3 N and 4 N
  const auto out = corner.tick(x, 1ms);
  CHECK(out.limited);
  CHECK_THAT(out.force(0), WithinRel(1.5, 1e-12));
  CHECK_THAT(out.force(1), WithinRel(2.0, 1e-12));
  CHECK_THAT(wall_here.local().at(x).depth, WithinRel(0.0015, 1e-12));
  CHECK_THAT(floor_here.local().at(x).depth, WithinRel(0.002, 1e-12));
  CHECK_THAT(out.depth, WithinRel(0.002, 1e-12));

  // the wall is let go of: who asks for nothing loses nothing
  const auto free = corner.tick({0.001, -0.004}, 1ms);
  CHECK_THAT(free.force(1), WithinRel(2.5, 1e-12));
  CHECK(wall_here.local().point.values == wall_here.target().point.values);
}

TEST_CASE(
    "a bound that turns a force round, or adds to it, moves no local model beyond its contact",
    "[contacts]") {
  const d2::vector x(-0.003, -0.004);
  const auto depths = [&x](const turning_bound& bound) {
    auto corner = port_of<d2>(ph::contacts{moving<d2>(), moving<d2>()}, bound);
    auto& wall_here = corner.source().contact<0>();
    auto& floor_here = corner.source().contact<1>();
    REQUIRE(wall_here.update({{0, 0}, right, 1000}));
    REQUIRE(floor_here.update({{0, 0}, up, 1000}));
    CHECK(corner.tick(x, 1ms).limited);
    return d2::vector(wall_here.local().at(x).depth, floor_here.local().at(x).depth);
  };
  CHECK((depths({.times = 0.5}) - d2::vector(0.0015, 0.002)).norm() < 1e-15);  // the control
  CHECK(depths({.times = -1.0}).norm() < 1e-15);
  CHECK((depths({.times = 2.0}) - d2::vector(0.003, 0.004)).norm() < 1e-15);

  // between two plates that ask for nothing together, nobody has a share of what is added
  auto plates = port_of<d2>(ph::contacts{moving<d2>(), moving<d2>()}, turning_bound{.more = 1.0});
  REQUIRE(plates.source().contact<0>().update({{0.002, 0}, right, 1000}));
  REQUIRE(plates.source().contact<1>().update({{-0.002, 0}, {-1, 0}, 1000}));
  CHECK(plates.tick({0, 0}, 1ms).force(0) == 1.0);
  CHECK(std::abs(plates.source().contact<0>().local().at({0, 0}).depth) < 1e-15);
  CHECK(std::abs(plates.source().contact<1>().local().at({0, 0}).depth) < 1e-15);
}

TEST_CASE("two plates that squeeze a device press on it with the difference", "[contacts]") {
  auto plates = port_of<d2>(
      ph::contacts{still<d2>({{0.002, 0}, right, 1000}), still<d2>({{-0.002, 0}, {-1, 0}, 1000})},
      ph::strict_bound{});
  (void)plates.tick({0, 0}, 1ms);
  CHECK(plates.tick({0, 0}, 1ms).force == d2::zero());
  CHECK(plates.tick({0, 0}, 1ms).depth == 0.002);
  CHECK(plates.tick({1e-6, 0}, 1ms).force(0) < 0.0);
}

TEST_CASE("two strict models on one device feed the hand, two contacts of one port do not",
          "[contacts][passivity]") {
  for (const bool facing : {false, true}) {
    const auto first = still<d1>(wall<d1>(1e4));
    const auto second = facing ? still<d1>({-1e-3, 1.0, 1e4}) : first;
    auto a = port_of<d1>(first, ph::strict_bound{});
    auto b = port_of<d1>(second, ph::strict_bound{});
    auto both = port_of<d1>(ph::contacts{first, second}, ph::strict_bound{});
    const double deep = facing ? -5e-4 : 1e-3;
    const double apart =
        least_energy([&](double x) { return a.tick(x, 1ms).force + b.tick(x, 1ms).force; }, deep);
    const double together = least_energy([&](double x) { return both.tick(x, 1ms).force; }, deep);
    CHECK(apart < -1e-4);
    CHECK(together >= -1e-12);
  }
}

TEST_CASE("each contact is updated and released by itself, and the worst news is told",
          "[contacts]") {
  auto pair = port_of<d1>(ph::contacts{moving<d1>(), moving<d1>()}, ph::no_bound{});
  CHECK(pair.tick(0.001, 1ms).what == ph::event::no_target);
  REQUIRE(pair.source().contact<0>().update(wall<d1>(1000)));
  auto out = pair.tick(0.001, 1ms);
  CHECK(out.what == ph::event::no_target);  // of the other one
  CHECK_THAT(out.force, WithinRel(-1.0, 1e-12));
  REQUIRE(pair.source().contact<1>().update(wall<d1>(500)));
  out = pair.tick(0.001, 1ms);
  CHECK(out.what == ph::event::nominal);
  CHECK_THAT(out.force, WithinRel(-1.5, 1e-12));
  CHECK_FALSE(pair.source().contact<1>().update(wall<d1>(-1)));
  CHECK(pair.tick(0.001, 1ms).what == ph::event::rejected_target);
  pair.source().contact<0>().release();
  for (int n = 0; n < 60; ++n) out = pair.tick(0.001, 1ms);
  CHECK(out.what == ph::event::nominal);
  CHECK_THAT(out.force, WithinRel(-0.5, 1e-12));
  pair.reset();
  CHECK(pair.tick(0.001, 1ms).what == ph::event::no_target);
}

TEST_CASE("contacts of different kinds compose, a shaped one among them", "[contacts]") {
  auto port = port_of<d1>(
      ph::contacts{still<d1>(wall<d1>(1000)),
                   moving<d1>(ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 100.0}})},
      ph::no_bound{});
  REQUIRE(port.source().contact<1>().update(wall<d1>(1000)));
  const auto out = port.tick(0.001, 1ms);
  CHECK_THAT(out.force, WithinRel(-1.1, 1e-12));  // it appears at 100 N/s
  CHECK(out.limited);
  CHECK_THAT(port.source().contact<1>().local().at(0.001).depth, WithinRel(0.0001, 1e-9));
}

TEST_CASE("a fault in any contact is named, and the port ticks with force zero", "[contacts]") {
  const auto sound = still<d1>(wall<d1>(1000)), flat = still<d1>(wall<d1>(0));
  auto port = port_of<d1>(ph::contacts{sound, flat}, ph::no_bound{});
  REQUIRE(port.check());
  CHECK(std::string(port.check().parameter) == "stiffness");
  CHECK(port.tick(0.001, 1ms).what == ph::event::rejected_parameters);
  CHECK(port.tick(0.001, 1ms).force == 0.0);
  CHECK_FALSE(port_of<d1>(ph::contacts{sound, sound}, ph::no_bound{}).check());
  static_assert(std::is_trivially_copyable_v<decltype(port)>);
}

TEST_CASE("contacts share one bad sample: each grows older, and none presses", "[contacts]") {
  auto pair = port_of<d1>(
      ph::contacts{still<d1>(wall<d1>(1000)),
                   ph::local_contact{ph::followed{wall<d1>(1000), {.stale_after = 0.01}},
                                     ph::turn_at_once{}, ph::spring{}}},
      ph::no_bound{});
  CHECK_THAT(pair.tick(0.001, 1ms).force, WithinRel(-2.0, 1e-12));
  for (int n = 0; n < 100; ++n) {
    const auto bad = pair.tick(std::nan(""), 1ms);
    CHECK(bad.what == ph::event::rejected_sample);
    CHECK(bad.force == 0.0);
  }
  const auto out = pair.tick(0.001, 1ms);
  CHECK(out.what == ph::event::stale_target);
  CHECK_THAT(out.force, WithinRel(-1.0, 1e-12));
}

TEST_CASE("parameters of one contact among contacts change while it runs, checked", "[contacts]") {
  ph::passive_port port{
      d1{},
      ph::contacts{
          ph::local_contact{ph::followed{wall<d1>(1000)}, ph::turn_at_once{}, ph::spring{}},
          ph::local_contact{ph::followed{wall<d1>(1000)}, ph::turn_limited{.rate = 4.0},
                            ph::damped_spring{.mass = 0.1}}},
      thesis_ledger(), ph::strict_bound{}, thesis_loop};
  CHECK_FALSE(port.set(ph::damped_spring{.mass = 0.2}));
  CHECK(port.source().contact<1>().law().parameters().mass == 0.2);
  CHECK(std::string(port.set(ph::damped_spring{.mass = -1.0}).parameter) == "mass");
  CHECK(port.source().contact<1>().law().parameters().mass == 0.2);  // a fault changes nothing
}

TEST_CASE("a force of one's own and a wall are two sources of one port, and a tick takes the force",
          "[contacts]") {
  ph::passive_port port{
      d1{},
      ph::contacts{ph::given_force{}, ph::local_contact{ph::fixed{ph::half_space<d1>{0, 1, 1000}},
                                                        ph::turn_at_once{}, ph::spring{}}},
      ph::reduced_energy{.damping = 0.3, .loan = 1.0}, ph::strict_bound{},
      ph::loop_limits{.longest_tick = 1e-3}};
  CHECK(port.tick(0.001, 1ms, 0.25).force == 0.25);  // in the air, the own force alone
  CHECK_THAT(port.tick(-0.001, 1ms, 0.25).force, WithinRel(1.25, 1e-9));
  CHECK_THAT(
      port.tick(ph::device_sample<d1>{.position = -0.001, .held = 1.25, .dt = 1e-3, .valid = true},
                -0.5)
          .force,
      WithinRel(0.5, 1e-9));
  CHECK(port.explain().asked ==
        1000.0);  // what presses explains itself, and the force is all of it
  CHECK(port.explain().depth == 0.001);
  CHECK_THAT(port.explain().force, WithinRel(0.5, 1e-9));
  CHECK(port.tick(-0.001, 1ms, std::nan("")).what == ph::event::rejected_target);
  CHECK_THAT(port.tick(-0.001, 1ms).force, WithinRel(0.5, 1e-9));  // the last good one
  for (int n = 0; n < 300; ++n) (void)port.tick(-0.001, 1ms);
  CHECK_THAT(port.tick(-0.001, 1ms).force, WithinRel(1.0, 1e-9));  // it has faded, the wall has not

  using two = ph::passive_port<d1, ph::contacts<ph::given_force, ph::given_force>,
                               ph::reduced_energy, ph::strict_bound>;
  static_assert(!ph::detail::takes_efforts<two::source_type, d1>);  // which of them?
}
