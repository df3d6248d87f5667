// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/contact_set.hpp>

#include <string>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3;

/// A port that gives what its source asks for.
template <class Space, class Source>
auto open_port(const Source& source) {
  return ph::passive_port{Space{}, source, ph::no_observer{}, ph::no_bound{}, thesis_loop};
}
template <class Space, int Count, class Friction = ph::frictionless>
auto planes(const ph::pursuit& pace = {}, const Friction& friction = {}) {
  return open_port<Space>(ph::contact_set{ph::proxy_spring{.mass = 0.1}, pace, friction,
                                          ph::slots<ph::half_space<Space>, Count>{}});
}
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
    double last = 2.0;
    for (int i = 0; i < 100; ++i) {
      const double f = port.tick(x, ph::seconds{T}).force.x();
      CHECK(std::abs(f - last) <= 1000.0 * 0.06 * T);
      last = f;
    }
    CHECK_THAT(last, WithinRel(K * 3e-3, 1e-12));
  }
}

TEST_CASE("what is released recedes, under a finger that follows it as well, and frees its slot",
          "[contact_set]") {
  for (const double follows : {0.0, 0.1}) {  // [m/s], faster than any surface recedes
    auto port = corner<d3, 1>();
    d3::vector x(-2e-3, 0.0, 0.0);
    for (int i = 0; i < 5; ++i) (void)port.tick(x, ph::seconds{T});
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
  CHECK(named({.mass = 0.1}, {.stale_after = -1.0}) == "stale_after");

  auto port = corner<d3, 3>();
  const d3::vector x(-1e-3, 0.02, 0.02);
  (void)port.tick(x, ph::seconds{T});
  CHECK_THAT(port.tick(x, ph::seconds{T}).force.x(), WithinRel(1.0, 1e-12));
  CHECK_FALSE(port.set(ph::proxy_spring{.mass = 0.001}));  // K is capped at (1 − ε) κ m/T²
  CHECK_THAT(port.tick(x, ph::seconds{T}).force.x(), WithinRel(0.095, 1e-12));
  CHECK(port.set(ph::pursuit{.speed = -1.0}));
  port.reset();
  CHECK(port.tick(x, ph::seconds{T}).what == ph::event::no_target);
}
