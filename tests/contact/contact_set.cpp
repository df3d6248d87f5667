// SPDX-License-Identifier: BSD-3-Clause
#include "../bench/contacts/stroke.hpp"
#include "support/catch.hpp"
#include "support/contact_sets.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/constraint_geometry/sphere.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <array>
#include <string>
#include <vector>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace sim = ph::simulation;

namespace {

constexpr double T = 1e-3;

/// A set that has met the planes of a corner from outside.
template <class Space, int Count>
auto corner(typename Space::scalar K = 1000) {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  auto port = planes<Space, Count>();
  for (int i = 0; i < std::min(Count, Space::dof); ++i) {
    port.source().update(i,
                         ph::half_space<Space>{vector(Space::zero()), vector(vector::Unit(i)), K});
  }
  (void)port.tick(vector(vector::Constant(scalar(0.02))), ph::seconds{scalar(T)});
  return port;
}

/// A surface that shows what it is told to, whatever that is.
struct rogue {
  using scalar = double;
  double stiffness = 1000.0;
  double depth = 1e-3;
  ph::stored_vector<double, 3> normal{0.0, 0.0, 1.0};
  bool covers = true;

  [[nodiscard]] bool prepare() noexcept { return stiffness > 0.0; }
  struct probe {
    double depth;
    const rogue& of;
    [[nodiscard]] d3::vector outward() const noexcept { return of.normal; }
    [[nodiscard]] bool covered() const noexcept { return of.covers; }
  };
  [[nodiscard]] probe at(const d3::vector& /*x*/) const noexcept { return {depth, *this}; }
};
static_assert(ph::surface_for<rogue, d3> && !ph::constraint_for<rogue, d3>);

}  // namespace

TEMPLATE_TEST_CASE("a corner presses back along every wall that is entered", "[contact_set]", d2,
                   d3, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  auto port = corner<TestType, 3>();
  const vector deep = vector::Constant(scalar(-1e-3));
  (void)port.tick(deep, ph::seconds{scalar(T)});
  const auto at_rest = port.tick(deep, ph::seconds{scalar(T)});
  for (int i = 0; i < TestType::dof; ++i)
    CHECK_THAT(at_rest.force(i), WithinRel(scalar(1), scalar(1e-4)));
  CHECK_THAT(at_rest.depth, WithinRel(scalar(1e-3), scalar(1e-4)));
  CHECK(at_rest.what == ph::event::nominal);

  vector beside = vector::Constant(scalar(1e-3));
  beside(0) = scalar(-2e-3);
  (void)port.tick(beside, ph::seconds{scalar(T)});
  const auto one = port.tick(beside, ph::seconds{scalar(T)});
  CHECK_THAT(one.force(0), WithinRel(scalar(2), scalar(1e-4)));
  CHECK(one.force(1) == scalar(0));
}

TEST_CASE("a set says what comes to rest in its loop", "[contact_set]") {
  const auto set_in = [](const auto& limits) {
    return ph::passive_port{d1{},
                            ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{},
                                            ph::slots<ph::half_space<d1>, 2>{}},
                            ph::reduced_energy{.damping = 0.03}, ph::strict_bound{}, limits};
  };
  constexpr auto port = set_in(ph::loop_limits{.longest_tick = T});
  static_assert(port.source().settles(500.0) && port.source().settles(1e9));
  CHECK(set_in(ph::late_loop_limits<3>{.longest_tick = T}).source().settles(1e9));
  auto springy = port;  // without a damper it is left to the device's own, and does not say so
  REQUIRE_FALSE(springy.set(ph::proxy_spring{.mass = 0.1, .damping_ratio = 0.0}));
  CHECK_FALSE(springy.source().settles(500.0));
  CHECK(springy.set(ph::proxy_spring{.mass = 0.1, .stiffness_fraction = 1.0}));
}

TEST_CASE("one degree of freedom needs no vectors: two walls with a gap between", "[contact_set]") {
  auto port = planes<d1, 2>();
  port.source().update(0, ph::half_space<d1>{0.0, 1.0, 1000.0});
  port.source().update(1, ph::half_space<d1>{0.01, -1.0, 500.0});
  (void)port.tick(0.005, ph::seconds{T});
  (void)port.tick(-1e-3, ph::seconds{T});
  CHECK_THAT(port.tick(-1e-3, ph::seconds{T}).force, WithinRel(1.0, 1e-12));
  (void)port.tick(0.012, ph::seconds{T});
  CHECK_THAT(port.tick(0.012, ph::seconds{T}).force, WithinRel(-1.0, 1e-12));
}

TEST_CASE("a finger between two plates is held by both", "[contact_set]") {
  auto port = planes<d3, 3>();
  const d3::vector z = d3::vector::UnitZ();
  port.source().update(0, ph::half_space<d3>{d3::vector::Zero(), z, 1000.0});
  port.source().update(1, ph::half_space<d3>{d3::vector::Zero(), d3::vector(-z), 1000.0});
  d3::vector f;
  for (int i = 0; i < 200; ++i) f = port.tick(d3::vector(z * 1e-3), ph::seconds{T}).force;
  CHECK_THAT(f.z(), WithinAbs(-1000.0 * 1e-3, 0.2));  // the one that is entered pushes
  for (int i = 0; i < 200; ++i) f = port.tick(d3::vector(z * -1e-3), ph::seconds{T}).force;
  CHECK_THAT(f.z(), WithinAbs(1000.0 * 1e-3, 0.2));
}

TEST_CASE("a surface that appears over a finger is not felt at once, and then is",
          "[contact_set]") {
  auto port = planes<d3, 3>();
  (void)port.tick(d3::vector::Zero(), ph::seconds{T});
  port.source().update(1, ph::half_space<d3>{d3::vector(0, 0, 2e-3), d3::vector::UnitZ(), 1000.0});
  double last = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double f = port.tick(d3::vector::Zero(), ph::seconds{T}).force.z();
    CHECK(f >= last);
    CHECK(f - last <= 1000.0 * 0.05 * T + 1e-12);  // K ρ dt
    last = f;
  }
  CHECK_THAT(last, WithinRel(2.0, 1e-12));
}

TEST_CASE(
    "a surface that is moved keeps its force and then follows, also when its stiffness changes",
    "[contact_set]") {
  for (const double K : {1000.0, 400.0}) {
    auto port = corner<d3, 1>();
    const d3::vector x(-2e-3, 0.0, 0.0);
    for (int i = 0; i < 5; ++i) (void)port.tick(x, ph::seconds{T});
    port.source().update(0, ph::half_space<d3>{d3::vector(1e-3, 0, 0), d3::vector::UnitX(), K});
    const auto& slot = port.source().slot(0);
    double last = 2.0, lag = std::abs(slot.lag());
    CHECK(slot.speed() == std::max(0.05, lag / 0.04));  // ρ, or ℓ within t_c
    for (int i = 0; i < 100; ++i) {
      const double f = port.tick(x, ph::seconds{T}).force.x();
      CHECK(std::abs(f - last) <= 1000.0 * 0.06 * T);
      lag = std::max(0.0, lag - slot.speed() * T);
      CHECK_THAT(std::abs(slot.lag()), WithinAbs(lag, 1e-15));
      last = f;
    }
    CHECK_THAT(last, WithinRel(K * 3e-3, 1e-12));
  }
}

TEST_CASE("a plane that has been let go is met where it is, whatever it lagged by",
          "[contact_set]") {
  auto port = corner<d3, 1>();
  const d3::vector pressed(-2e-3, 0.0, 0.0), away(0.02, 0.0, 0.0);
  for (int i = 0; i < 5; ++i) (void)port.tick(pressed, ph::seconds{T});
  port.source().update(0, ph::half_space<d3>{d3::vector(4e-3, 0, 0), d3::vector::UnitX(), 1000.0});
  CHECK(port.tick(pressed, ph::seconds{T}).force.x() < 2.5);
  for (int i = 0; i < 3; ++i) (void)port.tick(away, ph::seconds{T});
  (void)port.tick(d3::vector::Zero(), ph::seconds{T});
  CHECK_THAT(port.tick(d3::vector::Zero(), ph::seconds{T}).force.x(), WithinRel(4.0, 1e-9));
}

TEST_CASE("a device that comes back to the very surface that it had left feels nothing there",
          "[contact_set]") {
  for (const double above : {0.0, 1e-9}) {
    auto port = corner<d3, 2>();
    const auto tick = [&](double x) {
      return port.tick(d3::vector(x, 0.02, 0.02), ph::seconds{T}).force.x();
    };
    for (int i = 0; i < 5; ++i) (void)tick(-2e-3);
    const d3::vector farther(-4e-3, 0, 0);  // by as much as its force still presses with
    port.source().update(0, ph::half_space<d3>{farther, d3::vector::UnitX(), 1000.0});
    CHECK(port.source().slot(0).lag() < -3.9e-3);
    CHECK(tick(0.02) == 0.0);
    CHECK(tick(-4e-3 + above) == 0.0);
    CHECK(port.source().slot(0).lag() == 0.0);
  }
}

TEST_CASE("a set that is reset is as a new one, wherever it is then and whatever it was following",
          "[contact_set]") {
  const auto made = [] { return planes<d3, 2>({}, ph::stick_slip{}); };
  const auto push = [](auto& port, const d3::vector& x) {
    const auto out = port.tick(x, ph::seconds{T});
    return std::array<double, 5>{out.force.x(), out.force.y(), out.force.z(), out.depth,
                                 double(out.what)};
  };
  const auto plane = [](const d3::vector& normal, double K) {
    return ph::half_space<d3>{d3::zero(), normal, K};
  };
  const auto stroked = [&](auto& port) {  // on what is stiff, and it ends amid news
    (void)port.tick(d3::vector(0, 0, 1e-3), ph::seconds{T});
    REQUIRE(port.source().update(0, plane({0, 0, 1}, 5000.0)));
    for (int n = 0; n < 50; ++n) (void)port.tick(d3::vector(1e-4 * n, 0, -1e-3), ph::seconds{T});
    REQUIRE(port.source().update(0, plane({0.5, 0, 1}, 5000.0)));
    for (int n = 50; n < 55; ++n) (void)port.tick(d3::vector(1e-4 * n, 0, -1e-3), ph::seconds{T});
    REQUIRE_FALSE(port.source().update(0, plane({0, 0, 1}, -1.0)));
  };
  const auto lived = [&](auto& port) {  // deep in what is soft, and its normal turns far
    std::vector<std::array<double, 5>> all;
    double z = -0.03;
    REQUIRE(port.source().update(0, plane({0, 0, 1}, 300.0)));
    for (int n = 0; n < 300; ++n) {
      if (n == 200) REQUIRE(port.source().update(0, plane({1, 0, -0.5}, 300.0)));
      all.push_back(push(port, {0.1, 1e-4 * n, z}));
    }
    return all;
  };
  auto fresh = made(), worn = made();
  const auto as_new = lived(fresh);
  CHECK(as_new[199][2] > 2.0);
  for (int n = 0; n < 2; ++n) {
    stroked(worn);
    worn.reset();
    CHECK(lived(worn) == as_new);
    worn.reset();
  }
}

TEST_CASE("what is released lets go no faster than news may, whatever else is there",
          "[contact_set]") {
  auto port = planes<d3, 2>();
  const double K = 3000.0, way = 1e-5;
  (void)port.tick(d3::vector(0, 0, 1e-3), ph::seconds{T});
  REQUIRE(port.source().update(0, ph::half_space<d3>{d3::zero(), d3::vector::UnitZ(), K}));
  const d3::vector far(0, -0.1, 0);
  REQUIRE(port.source().update(1, ph::half_space<d3>{far, d3::vector::UnitY(), 3.0 * K}));
  double x = 0.0, last = 0.0;
  const auto tick = [&] {
    x += way;
    return port.tick(d3::vector(x, 0, -1e-3), ph::seconds{T}).force.z();
  };
  for (int n = 0; n < 100; ++n) last = tick();
  CHECK_THAT(last, WithinRel(3.0, 1e-9));
  port.source().release(0);
  for (int n = 0; n < 10; ++n) {
    const double now = tick();
    CHECK(last - now <= 50.0 * T + 2.0 * K * way + 1e-12);  // R dt, and what the way explains
    CHECK(last - now > 50.0 * T);
    last = now;
  }
}

TEST_CASE("a finger that was lifted sticks anew where it touches again", "[contact_set]") {
  const auto stroke = [](auto& port, double from, double to, double z) {
    d3::vector f;
    for (int n = 0; n <= 100; ++n) {
      f = port.tick(d3::vector(from + (to - from) * n / 100.0, 0, z), ph::seconds{T}).force;
    }
    return f;
  };
  const auto touched = [&](auto port) {
    REQUIRE(port.source().update(0, ph::half_space<d3>{d3::zero(), d3::vector::UnitZ(), 1000.0}));
    (void)stroke(port, 0.0, 0.0, 1e-3);
    CHECK(stroke(port, 0.0, 0.02, -1e-3).x() < -0.3);
    (void)stroke(port, 0.02, 0.02, 1e-3);
    const d3::vector f = stroke(port, 0.02, 0.02, -1e-3);
    CHECK_THAT(f.z(), WithinRel(1.0, 1e-9));
    CHECK(f.x() == 0.0);
  };
  touched(planes<d3, 1>({}, ph::stick_slip{}));
  touched(planes<d3, 2>({}, ph::stick_slip{}));
}

TEST_CASE("what is released recedes, under a finger that follows it as well, and frees its slot",
          "[contact_set]") {
  for (const double follows : {0.0, 0.1}) {  // [m/s], faster than any surface recedes
    auto port = corner<d3, 1>();
    d3::vector x(-2e-3, 0.0, 0.0);
    for (int i = 0; i < 100; ++i) (void)port.tick(x, ph::seconds{T});
    port.source().release(0);
    CHECK(port.source().slot(0).taken());
    int ticks = 0;
    double last = 2.0 + 0.1 * 20.0;
    ph::tick_result<d3> out{};
    while (port.source().slot(0).taken() && ticks < 1000) {
      x.x() -= follows * T;
      out = port.tick(x, ph::seconds{T});
      if (ticks > 0) CHECK(out.force.x() <= last);
      last = out.force.x();
      ++ticks;
    }
    CHECK(ticks <= 45);  // 2 mm at 50 mm/s
    CHECK(port.tick(x, ph::seconds{T}).what == ph::event::no_target);
    CHECK(
        port.source().update(0, ph::half_space<d3>{d3::vector::Zero(), d3::vector::UnitX(), 1.0}));
  }
}

TEST_CASE("news under a hand that gives way step by no more than under one that holds still",
          "[contact_set]") {
  using hand = sim::impedance_hand<d3>;
  using room = ph::slots<ph::half_space<d3>, 3>;
  for (const double m : {0.05, 0.3}) {        // [kg]
    for (const double k : {400.0, 1000.0}) {  // of the hand [N/m]
      constexpr double jump = -3e-3;          // [m]
      const auto steps = [&](auto port) {
        const auto tell = [&](double z) {
          port.source().update(0, ph::half_space<d3>{{0, 0, z}, d3::vector::UnitZ(), 4000.0});
        };
        tell(0.0);
        sim::device<d3, hand> device{
            {.mass = m, .damping = 0.1, .start = {0.0, 0.0, 5e-3}},
            {.stiffness = k, .damping = 2.0 * std::sqrt(k * m), .limit = 9.0}};
        device.hand().target = {0.0, 0.0, -5.0 / k - 2e-3};
        auto sample = device.exchange(d3::vector::Zero());
        d3::vector last = d3::vector::Zero();
        double step = 0.0;
        for (int n = 0; n < 2500; ++n) {
          if (n == 1500) tell(jump);
          const d3::vector force = port.tick(sample).force;
          if (n >= 1500) step = std::max(step, (force - last).norm());
          last = force;
          sample = device.exchange(force);
        }
        CAPTURE(m, k, jump);
        CHECK(step <= 50.0 * T + 2e-3);  // R dt; 0.92 N where the way explains what the news did
        CHECK(last.z() == Approx(4000.0 * (jump - device.position().z())).epsilon(0.01));
        CHECK(device.meter().minimum() >= -1e-12);
      };
      const ph::exact_device stated{.mass = m, .damping = 0.1, .force_limit = 20.0};
      steps(ph::make_contacts<d3>(stated, {.force = 9.0}, room{}));
      steps(ph::make_contacts<d3>(stated, {.force = 9.0}, ph::stick_slip{}, room{}));
      steps(ph::make_contacts<d3>(stated, {.force = 9.0}, room{}, ph::slots<ph::sphere<d3>, 1>{}));
    }
  }
}

TEST_CASE("a set without news for too long lets go", "[contact_set]") {
  auto port = planes<d3, 1>({.stale_after = 0.02});
  port.source().update(0, ph::half_space<d3>{d3::vector::Zero(), d3::vector::UnitZ(), 1000.0});
  (void)port.tick(d3::vector(0, 0, 1e-3), ph::seconds{T});
  ph::event worst{};
  double least = 1e9;
  for (int i = 0; i < 100; ++i) {
    const auto out = port.tick(d3::vector(0, 0, -1e-3), ph::seconds{T});
    if (out.what == ph::event::stale_target) worst = out.what;
    least = std::min(least, out.force.z());
  }
  CHECK(worst == ph::event::stale_target);
  CHECK(least == 0.0);
}

TEST_CASE("a surface is stale when it is older than it may be, and not when it is just as old",
          "[contact_set]") {
  const double tick = 0x1p-10;
  auto port = planes<d3, 2>({.stale_after = 4.0 * tick});
  port.source().update(0, ph::half_space<d3>{d3::vector::Zero(), d3::vector::UnitZ(), 1000.0});
  for (int n = 1; n <= 5; ++n) {
    const auto out = port.tick(d3::vector(0, 0, 1e-3), ph::seconds{tick});
    CHECK(out.what == (n == 5 ? ph::event::stale_target : ph::event::nominal));
  }
}

TEST_CASE("a surface grows older while samples are refused", "[contact_set]") {
  const double tick = 0x1p-10;
  for (const int refused : {2, 3}) {
    auto port = planes<d3, 2>({.stale_after = 4.0 * tick});
    port.source().update(0, ph::half_space<d3>{d3::vector::Zero(), d3::vector::UnitZ(), 1000.0});
    const d3::vector above(0, 0, 1e-3), nowhere(std::nan(""), 0, 0);
    CHECK(port.tick(above, ph::seconds{tick}).what == ph::event::nominal);
    for (int n = 0; n < refused; ++n) {
      const auto none = port.tick(nowhere, ph::seconds{tick});
      CHECK(none.depth == 0.0);
      CHECK_FALSE(none.limited);
    }
    const auto out = port.tick(above, ph::seconds{tick});
    CHECK(out.what == (refused == 3 ? ph::event::stale_target : ph::event::nominal));
  }
}

TEMPLATE_TEST_CASE("an empty set, one slot too many and what is unusable say so and push nothing",
                   "[contact_set]", d3, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  using plane = ph::half_space<TestType>;
  auto port = planes<TestType, 2>();
  const vector here(scalar(0), scalar(0), scalar(-1e-3)), up = vector::UnitZ();
  const auto tick = [&] { return port.tick(here, ph::seconds{scalar(T)}); };
  CHECK(tick().what == ph::event::no_target);
  CHECK(tick().force == vector::Zero());

  const plane good{vector(vector::Zero()), up, scalar(1000)};
  CHECK(port.source().update(1, good));
  CHECK(tick().what == ph::event::nominal);
  for (int i = 0; i < 100; ++i) (void)tick();
  const vector before = tick().force;
  CHECK(before.z() > scalar(0.9));

  const scalar nan = std::numeric_limits<scalar>::quiet_NaN();
  const plane bad[] = {{vector(vector::Zero()), vector(vector::Zero()), scalar(1000)},
                       {vector(vector::Zero()), up, scalar(-1)},
                       {vector(vector::Zero()), up, nan},
                       {vector(vector::Constant(nan)), up, scalar(1000)},
                       {vector(vector::Zero()), vector(vector::Constant(nan)), scalar(1000)}};
  for (const plane& one : bad) {
    CHECK_FALSE(port.source().update(1, one));
    const auto out = tick();
    CHECK(out.what == ph::event::rejected_target);
    CHECK(out.force == before);  // the last good one stays
    CHECK(tick().what == ph::event::nominal);
  }
  for (const int i : {-1, 2, 17}) {
    CHECK_FALSE(port.source().update(i, good));
    CHECK(tick().what == ph::event::rejected_target);
    port.source().release(i);
    CHECK(tick().force == before);
  }
}

TEST_CASE("a surface that shows no number presses nothing and is seen through afterwards",
          "[contact_set]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const rogue& bad :
       {rogue{.depth = nan}, rogue{.depth = HUGE_VAL}, rogue{.normal = {nan, 0.0, 0.0}}}) {
    auto port = ph::passive_port{
        d3{},
        ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::stick_slip{},
                        ph::slots<ph::half_space<d3>, 1>{}, ph::slots<rogue, 2>{}},
        ph::reduced_energy{.damping = 0.03}, ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
        thesis_loop};
    const d3::vector here(0, 0, -1e-3);
    port.source().update(0, ph::half_space<d3>{d3::vector::Zero(), d3::vector::UnitZ(), 1000.0});
    (void)port.tick(d3::vector(0, 0, 1e-3), ph::seconds{T});
    (void)port.tick(here, ph::seconds{T});
    const double before = port.energy();
    port.source().update(0, bad);
    const auto out = port.tick(here, ph::seconds{T});
    CHECK(out.what == ph::event::rejected_target);
    CHECK(out.force.allFinite());
    CHECK(out.energy <= before + 1e-15);
    port.source().update(0, rogue{.depth = -1.0});
    const auto after = port.tick(here, ph::seconds{T});
    CHECK(after.what == ph::event::nominal);
    CHECK(after.force.z() > 0.5);  // the other surface was there all the time
  }
}

namespace {

/// A surface that shows an absurd depth to whoever is beyond x = 0.
struct abyss {
  using space_type = d3;
  using scalar = double;
  double stiffness = 1000.0;
  [[nodiscard]] bool prepare() noexcept { return true; }
  struct probe {
    double depth;
    [[nodiscard]] d3::vector outward() const noexcept { return {1, 0, 0}; }
    [[nodiscard]] bool covered() const noexcept { return true; }
  };
  [[nodiscard]] probe at(const d3::vector& x) const noexcept {
    return {x.x() > 0.0 ? 1e308 : -1.0};
  }
};

}  // namespace

TEST_CASE("a force beyond all numbers is none, and the force goes there and back as with any news",
          "[contact_set]") {
  auto port =
      open_port<d3>(ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::stick_slip{},
                                    ph::slots<ph::half_space<d3>, 1>{}, ph::slots<abyss, 1>{}});
  const auto tick = [&](double x, double z) {
    return port.tick(d3::vector(x, 0, z), ph::seconds{T});
  };
  REQUIRE(port.source().update(0, ph::half_space<d3>{d3::zero(), d3::vector::UnitZ(), 1000.0}));
  REQUIRE(port.source().update(0, abyss{}));
  (void)tick(-2e-3, 1e-3);
  for (int n = 0; n < 100; ++n) (void)tick(-2e-3 + 2e-5 * n, -1e-3);  // its bristle is bent
  for (int n = 0; n < 100; ++n) (void)tick(0.0, -1e-3);
  const d3::vector before = tick(0.0, -1e-3).force;
  CHECK_THAT(before.z(), WithinRel(1.0, 1e-9));
  CHECK(before.x() < -0.1);
  const auto out = tick(1e-12, -1e-3);
  const double most = 50.0 * T + 1e-6;  // R dt
  CHECK((out.force - before).norm() <= most);
  CHECK(out.force.norm() < before.norm() - 0.9 * most);
  CHECK(out.depth == 0.0);
  CHECK(out.what == ph::event::rejected_target);
  CHECK(port.source().slot(0).pressed() == 0.0);
  CHECK(port.source().template slot<abyss>(0).pressed() == 0.0);
  d3::vector last = out.force;
  for (const int absurd : {0, 60}) {  // ticks more, in which the force has long been 0
    for (int n = 0; n < absurd; ++n) last = tick(1e-12, -1e-3).force;
    CHECK((absurd == 0 || last.norm() == 0.0));
    for (int n = 0; n < 40; ++n) {
      const auto next = tick(0.0, -1e-3);
      CHECK(next.what == ph::event::nominal);
      CHECK((next.force - last).norm() <= most);
      last = next.force;
    }
    CHECK_THAT(last.z(), WithinRel(1.0, 1e-9));
    CHECK(std::abs(tick(0.0, -1e-3).force.x()) < 1e-6);  // it sticks anew
  }
}

TEST_CASE("a surface that is left over its edge recedes, and is met anew", "[contact_set]") {
  auto port = open_port<d3>(
      ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<rogue, 1>{}});
  port.source().update(0, rogue{.depth = 1e-3});
  for (int i = 0; i < 50; ++i) (void)port.tick(d3::vector::Zero(), ph::seconds{T});
  CHECK_THAT(port.tick(d3::vector::Zero(), ph::seconds{T}).force.z(), WithinRel(1.0, 1e-12));
  port.source().update(0, rogue{.depth = 1e-3, .covers = false});
  double last = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double f = port.tick(d3::vector::Zero(), ph::seconds{T}).force.z();
    CHECK((f < last || f == 0.0));
    CHECK(last - f <= 1000.0 * 0.05 * T + 1e-12);
    last = f;
  }
  CHECK(last == 0.0);
  port.source().update(0, rogue{.depth = 1e-3});
  CHECK(port.tick(d3::vector::Zero(), ph::seconds{T}).force.z() <= 1000.0 * 0.05 * T + 1e-12);
}

TEST_CASE("parameters of a set out of range are named, and change while it works",
          "[contact_set]") {
  const auto fault = [](const ph::proxy_spring& s, const ph::pursuit& p) {
    return open_port<d3>(ph::contact_set{s, p, ph::slots<ph::half_space<d3>, 3>{}}).check();
  };
  const auto named = [&](const ph::proxy_spring& s, const ph::pursuit& p) {
    return std::string(fault(s, p).parameter);
  };
  CHECK_FALSE(fault({.mass = 0.1}, {}));
  CHECK(named({}, {}) == "mass");
  CHECK(named({.mass = 0.1, .stiffness_fraction = 2.0}, {}) == "stiffness_fraction");
  CHECK(named({.mass = 0.1, .damping_ratio = -1.0}, {}) == "damping_ratio");
  CHECK(named({.mass = 0.1, .damping_fraction = 2.0}, {}) == "damping_fraction");
  CHECK(named({.mass = 0.1, .softness = 0.0}, {}) == "softness");
  CHECK(named({.mass = 0.1, .force_limit = 0.0}, {}) == "force_limit");
  CHECK(named({.mass = 0.1}, {.speed = 0.0}) == "speed");
  CHECK(named({.mass = 0.1}, {.catch_up = 0.0}) == "catch_up");
  CHECK(named({.mass = 0.1}, {.turn_rate = std::nan("")}) == "turn_rate");
  CHECK(named({.mass = 0.1}, {.force_rate = 0.0}) == "force_rate");
  CHECK(named({.mass = 0.1}, {.edge = 0.0}) == "edge");
  CHECK(named({.mass = 0.1}, {.stale_after = -1.0}) == "stale_after");
  CHECK(named({.mass = 0.1}, {.stale_after = 0.0}) == "stale_after");

  auto rough = planes<d3, 3>({}, ph::stick_slip{});
  const ph::stick_slip backwards{.static_coefficient = 0.4, .kinetic_coefficient = 0.6};
  CHECK(std::string(planes<d3, 3>({}, backwards).check().parameter) == "kinetic_coefficient");
  CHECK(std::string(rough.set(backwards).parameter) == "kinetic_coefficient");
  CHECK_FALSE(rough.set(ph::stick_slip{.static_coefficient = 0.9}));
  CHECK(rough.source().parameters().friction.static_coefficient == 0.9);

  auto port = corner<d3, 3>();
  const d3::vector x(-1e-3, 0.02, 0.02);
  (void)port.tick(x, ph::seconds{T});
  CHECK_THAT(port.tick(x, ph::seconds{T}).force.x(), WithinRel(1.0, 1e-12));
  CHECK_FALSE(port.set(ph::proxy_spring{.mass = 0.001}));  // K is capped at (1 − ε) κ m/T²
  CHECK_THAT(port.tick(x, ph::seconds{T}).force.x(), WithinRel(0.95, 1e-12));  // by 50 N/s
  for (int i = 0; i < 20; ++i) (void)port.tick(x, ph::seconds{T});
  CHECK_THAT(port.tick(x, ph::seconds{T}).force.x(), WithinRel(0.095, 1e-12));
  CHECK(port.set(ph::pursuit{.speed = -1.0}));
  port.reset();
  CHECK(port.tick(x, ph::seconds{T}).what == ph::event::no_target);
}

TEST_CASE("a surface that is told to be stiffer keeps the force that it presses with",
          "[contact_set]") {
  const double K = GENERATE(200.0, 5000.0);
  auto port = planes<d3, 1>({.force_rate = 1e9});  // the set limits nothing: the slot does
  const auto told = [&port](double stiffness) {
    return port.source().update(0, ph::half_space<d3>{d3::zero(), {0, 0, 1}, stiffness});
  };
  REQUIRE(told(1000.0));
  (void)port.tick(d3::vector(0, 0, 1e-3), ph::seconds{T});
  const d3::vector x(0, 0, -1e-3);
  (void)port.tick(x, ph::seconds{T});
  CHECK_THAT(port.tick(x, ph::seconds{T}).force.z(), WithinRel(1.0, 1e-12));
  REQUIRE(told(K));
  const double rate = std::max(0.05, std::abs(1e-3 - 1.0 / K) / 0.04);  // ρ, or within t_c [m/s]
  CHECK_THAT(port.tick(x, ph::seconds{T}).force.z(), WithinAbs(1.0, 1.001 * K * rate * T));
  for (int n = 0; n < 100; ++n) (void)port.tick(x, ph::seconds{T});
  CHECK_THAT(port.tick(x, ph::seconds{T}).force.z(), WithinRel(1e-3 * K, 1e-12));
}

TEST_CASE("no news steps a device that holds still, and the truth is there within a second",
          "[contact_set]") {
  using ball = ph::sphere<d3>;
  using set =
      ph::contact_set<ph::frictionless, ph::slots<ph::half_space<d3>, 4>, ph::slots<ball, 2>>;
  for (const double rate : {50.0, 1e9}) {  // the second is the control
    ph::laws::samples random(7);
    set parts;
    parts.spring = {.mass = 0.1};
    parts.pace = {.force_rate = rate};
    auto port = open_port<d3>(parts);
    const d3::vector x{0.02, -0.03, 0.01};  // inside of what it meets before its first tick
    REQUIRE(
        port.source().update(0, ph::half_space<d3>{x + d3::vector(0, 0, 2e-3), {0, 0, 1}, 2e3}));
    d3::vector last = d3::zero();
    double widest = 0.0, off = 0.0;
    for (int n = 0; n < 6000; ++n) {
      if (n % 3000 == 2300) {
        REQUIRE_FALSE(port.set(ph::loop_limits{.longest_tick = 4.0 * T}));
      } else if (n % 3000 == 2400) {
        REQUIRE_FALSE(port.set(ph::loop_limits{.longest_tick = T}));
      }
      if (n % 33 == 32 && n % 3000 < 2000) {
        const auto normal = random.direction<d3>();
        const double depth = 1.5e-3 + 1.5e-3 * random.number<double>();
        const double K = std::pow(10.0, 3.0 + random.number<double>());
        const int slot = n % 4;
        if (n % 5 == 0) {
          port.source().release(slot);
        } else if (n % 7 == 0) {
          (void)port.source().update(slot / 2, ball{x + normal * (depth - 0.02), 0.02, K});
        } else {
          (void)port.source().update(slot, ph::half_space<d3>{x + normal * depth, normal, K});
        }
      }
      const d3::vector f = port.tick(x, ph::seconds{T}).force;
      widest = std::max(widest, (f - last).norm());
      last = f;
      if (n % 3000 == 2999) {  // as one would be that has met the same surfaces just now
        d3::vector meant = d3::vector::Zero();
        auto same = port;
        for (int i = 0; i < 3000; ++i) meant = same.tick(x, ph::seconds{T}).force;
        off = std::max(off, (meant - f).norm());
      }
    }
    CAPTURE(rate);
    CHECK((widest <= 0.05 * (1.0 + 1e-9)) == (rate == 50.0));
    CHECK(off < 1e-9);
  }
}

TEST_CASE("a ball told by its tangent planes may be stroked fast", "[contact_set]") {
  const stroking::round_a_ball ball;
  const auto felt = stroking::stroke({}, ball, 1500);
  CHECK(felt.off < 0.18);  // 10 degrees
  CHECK(felt.largest_step < 0.05);
  const auto control = stroking::stroke(stroking::limited, ball, 1500);
  CHECK(control.off > 1.0);  // 4 rad/s, where 2 may be turned
}

TEST_CASE("a plane that is told anew in every tick of a stroke does not lag", "[contact_set]") {
  for (const double radius : {0.05, 0.02, 0.012}) {
    for (const int every : {1, 4, 10}) {
      const stroking::round_a_ball ball{.radius = radius};
      const auto felt = stroking::stroke({}, ball, 1000, every);
      // by then it has turned by as much since the last news, and a tick more
      const double since = ball.turned_in(every);
      // the control: a wide round for its edges, so that the way explains next to nothing, and any time for news
      const auto lags = stroking::stroke(stroking::limited, ball, 1000, every);
      CAPTURE(radius, every, since, felt.off, felt.largest_step, lags.off, lags.largest_step);
      CHECK(felt.off < since);
      CHECK(lags.off > since + 0.1);
      CHECK(felt.largest_step < 0.05);
    }
  }
}

TEST_CASE("a plane that turns by itself and is told often is felt as it turns", "[contact_set]") {
  const stroking::turning_plane plane;
  for (const int every : {1, 4, 10}) {
    const auto felt = stroking::stroke({}, plane, 3000, every);
    const auto late = stroking::stroke({.catch_up = 0.32}, plane, 3000, every);
    CAPTURE(every, felt.off, felt.largest_step, late.off);
    CHECK(felt.off < plane.fastest() * 1e-3 * (std::max(every, 5) + 1));  // an update late
    CHECK(felt.largest_step < 0.02);
    CHECK(late.off > 0.07);  // the control: updates are made up for in 40 ms
  }
}

TEST_CASE("a ridge turns the force where the finger passes it, as if it were rounded",
          "[contact_set]") {
  stroking::over_a_ridge ridge;
  REQUIRE(ridge.prepare());
  const int ticks = 5 * ridge.loop();
  const auto felt = stroking::stroke({.edge = 1e-3}, ridge, ticks);
  const auto bars = ridge.as_rounded(1e-3, 0.033, 5);
  CHECK(felt.leaning < bars.leaning);
  CHECK(felt.largest_step < bars.largest_step);
  CHECK(felt.work > -bars.work);
  CHECK(felt.work < 0.0);
  const auto control = stroking::stroke(stroking::limited, ridge, ticks);
  CHECK(control.leaning > 1.0);  // at 2 rad/s
  CHECK(control.work < -10 * 2.0 * 1e-3);
}

TEST_CASE("a plane that is sent again as it is, is no news", "[contact_set]") {
  ph::laws::samples random(1);
  for (int n = 0; n < 20; ++n) {
    auto port = planes<d3, 3>();
    const auto tell = [&](int i, const d3::vector& normal) {
      REQUIRE(port.source().update(i, ph::half_space<d3>{d3::zero(), normal, 2000.0}));
    };
    std::array<d3::vector, 3> normals{d3::vector(0, 0, 1), {}, {}};
    for (int i : {1, 2}) {
      const d3::vector side = random.direction<d3>();
      normals[static_cast<std::size_t>(i)] = (d3::vector(0, 0, 1.5) + side).normalized();
    }
    for (int i = 0; i < 3; ++i) tell(i, normals[static_cast<std::size_t>(i)]);
    d3::vector x(0, 0, 5e-3), v = d3::zero(), goal = x;
    double lag = 0.0;
    for (int tick = 0; tick < 1500; ++tick) {
      if (tick % 100 == 0) goal = 4e-3 * random.direction<d3>() - d3::vector(0, 0, 8e-3);
      const d3::vector f = port.tick(x, ph::seconds{T}).force;
      for (int i = 0; i < 3; ++i) lag = std::max(lag, std::abs(port.source().slot(i).lag()));
      if (tick % 33 == 0) {
        for (int i = 0; i < 3; ++i) tell(i, normals[static_cast<std::size_t>(i)]);
      }
      v += (f + 200.0 * (goal - x) - 3.0 * v) * (T / 0.1);
      x += v * T;
    }
    CHECK(lag < 1e-12);
  }
}

TEST_CASE("a plane that is told to be tilted turns under a finger that rests", "[contact_set]") {
  auto port = planes<d3, 1>();
  const d3::vector tilted = d3::vector(0.2, 0, 1).normalized();
  port.source().update(0, ph::half_space<d3>{d3::zero(), d3::vector(0, 0, 1), 1000.0});
  (void)port.tick(d3::vector(0, 0, 1e-3), ph::seconds{T});
  for (int n = 0; n < 50; ++n) (void)port.tick(d3::vector(0, 0, -1e-3), ph::seconds{T});
  port.source().update(0, ph::half_space<d3>{d3::zero(), tilted, 1000.0});
  d3::vector f;
  for (int n = 0; n < 20; ++n) f = port.tick(d3::vector(0, 0, -1e-3), ph::seconds{T}).force;
  const double turned = std::atan2(f.x(), f.z());
  CHECK(turned > 0.03);  // within t_c, or at 2 rad/s if that is faster
  CHECK(turned < 0.15);
  for (int n = 0; n < 100; ++n) f = port.tick(d3::vector(0, 0, -1e-3), ph::seconds{T}).force;
  CHECK_THAT(f.normalized().dot(tilted), WithinRel(1.0, 1e-12));
}

TEST_CASE("a set explains what presses most, what does not yet, and that it follows news",
          "[contact_set]") {
  auto port = planes<d3, 2>();
  CHECK(port.explain().stiffness == ph::softened_by::no_surface);
  port.source().update(0, ph::half_space<d3>{d3::zero(), d3::vector(0, 0, 1), 300.0});
  (void)port.tick(d3::vector(0, 0, 1e-3), ph::seconds{T});
  CHECK(port.explain().asked == 300.0);  // in the air, the first one
  CHECK(port.explain().stiffness == ph::softened_by::nothing);
  port.source().update(1, ph::half_space<d3>{d3::zero(), d3::vector(1, 0, 0), 700.0});
  for (int n = 0; n < 50; ++n) (void)port.tick(d3::vector(-1e-3, 0, 1e-3), ph::seconds{T});
  CHECK(port.explain().asked == 700.0);
  CHECK(port.explain().now == ph::softened_by::nothing);
  port.source().update(1, ph::half_space<d3>{d3::vector(1e-3, 0, 0), d3::vector(1, 0, 0), 700.0});
  (void)port.tick(d3::vector(-1e-3, 0, 1e-3), ph::seconds{T});
  CHECK(port.explain().now == ph::softened_by::news);
  for (int n = 0; n < 500; ++n) (void)port.tick(d3::vector(-1e-3, 0, 1e-3), ph::seconds{T});
  CHECK(port.explain().now == ph::softened_by::nothing);
  for (double K = 300.0; K < 400.0; K += 0.37) {  // 1/(1/K) may be less than K by a rounding
    port.source().update(1, ph::half_space<d3>{d3::zero(), d3::vector(1, 0, 0), K});
    CHECK(port.explain().stiffness == ph::softened_by::nothing);
  }
}

TEST_CASE("news that overflow under a pressed contact are refused, and it presses on",
          "[contact_set]") {
  auto port = planes<d3, 1>();
  port.source().update(0, ph::half_space<d3>{d3::zero(), d3::vector(0, 0, 1), 1000.0});
  (void)port.tick(d3::vector(0, 0, 1e-3), ph::seconds{T});
  for (int n = 0; n < 5; ++n) (void)port.tick(d3::vector(0, 0, -1e-3), ph::seconds{T});
  const double beyond = 1.5e308;
  CHECK_FALSE(port.source().update(
      0, ph::half_space<d3>{d3::vector(beyond, beyond, beyond), d3::vector(1, 1, 1), 1000.0}));
  const auto out = port.tick(d3::vector(0, 0, -1e-3), ph::seconds{T});
  CHECK(out.what == ph::event::rejected_target);
  CHECK_THAT(out.force.z(), WithinRel(1.0, 1e-3));
}
