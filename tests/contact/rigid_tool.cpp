// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/rigid_tool.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/energy_observer/forgiving.hpp>
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/simulation/rigid_device.hpp>
#include <passive_haptics/six_dof.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3;
constexpr ph::tool_spring light{.mass = 0.15, .least_inertia = 1e-4};

template <class Scalar>
using plane_of = ph::half_space<ph::space<Scalar, 3>>;
using body = ph::rigid_body<double>;
using pose = ph::rigid_pose<double>;
using plane = plane_of<double>;
using vector = d3::vector;

/// A port that gives what the tool asks for.
template <class Scalar, int Count, class Friction = ph::frictionless>
auto open_port(const Friction& friction = {}) {
  return ph::passive_port{
      ph::rigid_body<Scalar>{},
      ph::rigid_tool{light, ph::pursuit{}, friction, ph::slots<plane_of<Scalar>, Count>{}},
      ph::no_observer{}, ph::no_bound{}, thesis_loop};
}
const plane floor_{vector(0, 0, 0), vector(0, 0, 1), 1000.0};

}  // namespace

TEMPLATE_TEST_CASE("a point of a tool presses with its force and its torque", "[rigid_tool]",
                   double, float) {
  using scalar = TestType;
  auto port = open_port<scalar, 4>();
  const scalar tiny = sizeof(scalar) == 4 ? scalar(1e-4) : scalar(1e-12);
  const auto taken = port.source().update(0, {scalar(0.05), scalar(0), scalar(-0.02)},
                                          plane_of<scalar>{{0, 0, 0}, {0, 0, 1}, scalar(1000)});
  REQUIRE(taken);
  (void)port.tick({{0, 0, scalar(0.021)}, {}}, ph::seconds{scalar(T)});
  (void)port.tick({{0, 0, scalar(0.019)}, {}}, ph::seconds{scalar(T)});
  const auto out = port.tick({{0, 0, scalar(0.019)}, {}}, ph::seconds{scalar(T)});
  // k_v = K; k_ω = K ℓ² = 0.9 N·m/rad: 1/K_felt = 1/K + 0.05²/k_ω
  const double felt = 1.0 / (1.0 / 1000.0 + 0.05 * 0.05 / 0.9);
  CHECK_THAT(out.force(2), WithinRel(scalar(felt * 1e-3), scalar(1e-3)));
  CHECK_THAT(out.force(4), WithinRel(scalar(-0.05 * felt * 1e-3), scalar(1e-3)));  // r × f
  CHECK(std::abs(out.force(3)) <= tiny);
  CHECK_THAT(out.depth, WithinRel(scalar(1e-3), scalar(1e-3)));
  CHECK(out.what == ph::event::nominal);
  const auto said = port.explain();
  CHECK(said.asked == 1000.0);
  CHECK_THAT(said.shown, WithinRel(felt, 1e-3));
  CHECK_THAT(taken.stiffness, WithinRel(scalar(said.shown), scalar(1e-6)));
  CHECK_THAT(said.depth, WithinRel(1e-3, 1e-3));
  CHECK(said.force == static_cast<double>(out.force(2)));
  CHECK(said.stiffness == ph::softened_by::coupling);  // the lever gives
  CHECK(said.now == ph::softened_by::nothing);
}

TEST_CASE(
    "explain() says when the motors of a tool, or its damping, hold no larger force or torque",
    "[rigid_tool]") {
  const auto pressed = [](double angular_damping, double force_limit, double torque_limit) {
    auto port = ph::make_tool({.inertia = {.mass = 0.06, .least = 2e-4, .spread = 1e-6},
                               .damping = {.linear = 0.03, .angular = angular_damping},
                               .damping_most = {.linear = 0.06, .angular = 2 * angular_damping},
                               .force_limit = force_limit,
                               .torque_limit = torque_limit,
                               .lever = 0.05},
                              {.force = 7, .torque = 0.3}, ph::slots<plane, 1>{});
    REQUIRE_FALSE(port.check());
    REQUIRE(port.source().update(0, {0, 0, -0.05}, plane{{0, 0, -0.05}, {1, 0, 0}, 3000.0}));
    for (int n = 0; n < 1500; ++n) {
      (void)port.tick({vector(1e-3 - 6e-3 * std::min(n / 1000.0, 1.0), 0, 0), {}}, ph::seconds{T});
    }
    return port.explain();
  };
  const auto by_force = pressed(1e-3, 2.0, 0.5);
  CHECK(by_force.now == ph::softened_by::motors);
  CHECK_THAT(by_force.force, WithinRel(2.0, 1e-9));
  const auto by_torque = pressed(1e-3, 9.0, 0.05);
  CHECK(by_torque.now == ph::softened_by::motors);
  CHECK_THAT(by_torque.torque, WithinRel(0.05, 1e-9));
  const auto by_damping = pressed(2e-5, 9.0, 0.5);  // 4b_ω/T, lemma C
  CHECK(by_damping.now == ph::softened_by::damping_and_tick);
  CHECK_THAT(by_damping.torque, WithinRel(0.08, 1e-9));
  const auto whole = pressed(1e-3, 9.0, 0.5);
  CHECK(whole.now == ph::softened_by::nothing);
  CHECK_THAT(whole.torque, WithinRel(0.05 * whole.force, 1e-9));
}

TEST_CASE("explain() says whether the lever of a tool gives or its inertia", "[rigid_tool]") {
  const auto why = [](const ph::tool_spring& spring, const vector& at, double K) {
    ph::passive_port port{ph::rigid_body<double>{},
                          ph::rigid_tool{spring, ph::pursuit{}, ph::slots<plane, 1>{}},
                          ph::no_observer{}, ph::no_bound{}, thesis_loop};
    REQUIRE(port.source().update(0, at, plane{vector(0, 0, at.z()), vector(0, 0, 1), K}));
    for (const double z : {1e-3, -1e-3, -1e-3}) (void)port.tick({{0, 0, z}, {}}, ph::seconds{T});
    return port.explain();
  };
  const vector tip(0.05, 0, 0);
  ph::tool_spring pen{.mass = 0.15, .least_inertia = 1e-5, .lever = 0.05};  // κ I/T² = 1 N·m/rad
  const auto slender = why(pen, tip, 10000.0);
  CHECK(slender.stiffness == ph::softened_by::mass_and_tick);
  CHECK_THAT(slender.shown, WithinRel(1.0 / (1e-4 + 0.05 * 0.05), 1e-3));
  pen.least_inertia = 1e-3;  // 100 N·m/rad, more than K ℓ²
  const auto stout = why(pen, tip, 10000.0);
  CHECK(stout.stiffness == ph::softened_by::coupling);
  CHECK_THAT(stout.shown, WithinRel(5000.0, 1e-3));
  CHECK(why(pen, tip, 1e6).stiffness == ph::softened_by::mass_and_tick);
}

TEST_CASE("a tool is no stiffer with sixteen contacts than its coupling", "[rigid_tool][long]") {
  ph::laws::samples random(1);
  const double k = 1000.0 / 0.9, turns = 0.9 / 0.9;  // C⁻¹/(1 − ε)
  double steepest = 0.0;
  for (int n = 0; n < 50; ++n) {
    auto port = open_port<double, 16>();
    for (int i = 0; i < 16; ++i) {
      const vector at = random.vector<d3>() * 0.03, normal = random.direction<d3>();
      port.source().update(
          i, at, plane{vector(at + normal * (2e-3 * random.number<double>())), normal, 1000.0});
    }
    const auto rest =
        [&port](const pose& x) {  // the surfaces have caught up, and so have the sweeps
          for (int i = 0; i < 2000; ++i) (void)port.tick(x, ph::seconds{T});
          return port.tick(x, ph::seconds{T}).force;
        };
    const body::effort here = rest({});
    const vector way = random.vector<d3>() * 1e-5, turn = random.vector<d3>() * 1e-4;
    const body::effort there = rest(body::moved({}, body::join(way, turn)));
    const body::effort change = there - here;
    const double size = std::sqrt(body::linear(change).squaredNorm() / k +
                                  body::angular(change).squaredNorm() / turns);
    const double moved = std::sqrt(way.squaredNorm() * k + turn.squaredNorm() * turns);
    steepest = std::max(steepest, size / moved);
  }
  CHECK(steepest <= 1.02);  // a point of the tool goes round by r|θ|²/2 as well
  CHECK(steepest > 0.7);
}

TEST_CASE("a tool says what comes to rest on it, however late its loop", "[rigid_tool]") {
  const auto port = open_port<double, 2>();
  CHECK(port.source().settles(1e9));
  for (int late = 0; late <= 4; ++late) {
    ph::tool_spring::at<double> rule({.mass = 0.15, .least_inertia = 1e-5, .lever = 0.1});
    rule.adopt(T, late);
    for (double K = 10.0; K < 1e6; K *= 3.0) CHECK(rule.settles(K));
  }
  ph::tool_spring stiff{.mass = 0.15, .least_inertia = 1e-5, .stiffness_fraction = 0.6};
  CHECK((stiff.check().parameter == std::string_view("stiffness_fraction")));  // the control
  ph::tool_spring::at<double> rule(stiff);
  rule.adopt(T);
  CHECK_FALSE(rule.settles(1e9));
  CHECK(rule.settles(1000.0));
}

TEST_CASE("a tool refuses what is none, and goes on with what is", "[rigid_tool]") {
  auto port = open_port<double, 16>();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const pose above{{0, 0, 1e-3}, {}}, here{{0, 0, -1e-3}, {}};
  CHECK(port.tick(above, ph::seconds{T}).what == ph::event::no_target);
  REQUIRE(port.source().update(0, {0.0, 0.0, 0.0}, floor_));
  (void)port.tick(above, ph::seconds{T});
  (void)port.tick(here, ph::seconds{T});
  const body::effort before = port.tick(here, ph::seconds{T}).force;
  REQUIRE(before(2) > 0.9);
  const auto refused = [&] {
    const auto out = port.tick(here, ph::seconds{T});
    CHECK(out.what == ph::event::rejected_target);
    CHECK(out.force == before);
  };
  CHECK_FALSE(port.source().update(16, {0.0, 0.0, 0.0}, floor_));  // the 17th
  refused();
  CHECK_FALSE(port.source().update(-1, {0.0, 0.0, 0.0}, floor_));
  CHECK_FALSE(port.source().update(-1, floor_));
  refused();
  CHECK_FALSE(port.source().update(0, {nan, 0.0, 0.0}, floor_));
  refused();
  CHECK_FALSE(port.source().update(0, plane{vector(0, 0, 0), vector(0, 0, 0), 1000.0}));
  refused();
  CHECK(port.source().update(0, floor_));  // the same point
  CHECK(port.tick(here, ph::seconds{T}).force == before);

  const auto bad =
      port.tick({{0, 0, -1e-3}, {1.01, 0.0, 0.0, 0.0}}, ph::seconds{T});  // no rotation
  CHECK(bad.what == ph::event::rejected_sample);
  CHECK(bad.force == body::zero());
  (void)port.tick(here, ph::seconds{T});
  const auto rounded = port.tick({{0, 0, -1e-3}, {1.0005, 0.0, 0.0, 0.0}}, ph::seconds{T});
  CHECK(rounded.what == ph::event::nominal);
  CHECK_THAT(rounded.force(2), WithinRel(before(2), 1e-9));
}

TEST_CASE("a point moved along the tool keeps the force it has", "[rigid_tool]") {
  auto port = open_port<double, 1>();
  REQUIRE(port.source().update(0, {0.0, 0.0, 0.0}, floor_));
  (void)port.tick({{0, 0, 1e-3}, {}}, ph::seconds{T});
  const pose here{{0, 0, -1e-3}, {}};
  for (int i = 0; i < 5; ++i) (void)port.tick(here, ph::seconds{T});
  REQUIRE(port.source().update(0, {0.0, 0.0, -1e-3}, floor_));  // a millimetre deeper
  double last = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double f = port.tick(here, ph::seconds{T}).force(2);
    CHECK(std::abs(f - last) <= 1000.0 * 0.05 * T + 1e-9);
    last = f;
  }
  CHECK_THAT(last, WithinRel(2.0, 1e-9));
}

TEST_CASE("a tool that turns lets go of what is released no faster than its turn explains",
          "[rigid_tool]") {
  auto port = open_port<double, 1>();
  const double K = 3000.0, turn = 1e-4;
  const plane floor{vector(0, 0, 0), vector(0, 0, 1), K};
  REQUIRE(port.source().update(0, {0.0, 0.0, 0.0}, floor));
  pose x{{0, 0, 1e-3}, {}};
  double last = 0.0;
  const auto tick = [&] {  // about the normal, which by itself changes nothing
    x = body::moved(x, body::join(vector::Zero(), vector(0, 0, turn)));
    return port.tick(x, ph::seconds{T}).force(2);
  };
  (void)tick();
  x.position = {0, 0, -1e-3};
  for (int n = 0; n < 100; ++n) last = tick();
  CHECK_THAT(last, WithinRel(3.0, 1e-9));
  port.source().release(0);
  for (int n = 0; n < 10; ++n) {
    const double now = tick();
    CHECK(last - now <= 50.0 * T + 2.0 * K * light.lever * turn * (1.0 + 1e-6));
    CHECK(last - now > 50.0 * T);
    last = now;
  }
}

TEST_CASE("every rough point of a tool pushes inside its cone, with the torque that goes with it",
          "[rigid_tool]") {
  auto port = open_port<double, 1>(ph::stick_slip{});
  const vector arm(0.02, 0.01, -0.03);
  REQUIRE(port.source().update(0, arm, floor_));
  ph::laws::samples random(2);
  pose x{{0, 0, 0.0305}, {}};
  double closest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    vector place = vector(x.position) + random.vector<d3>() * 2e-4;
    place.z() = std::clamp(place.z(), 0.028, 0.031);
    x.position = place;
    x = body::moved(x, body::join(vector::Zero(), random.vector<d3>() * 1e-3));
    const auto out = port.tick(x, ph::seconds{T});
    const vector f = body::linear(out.force), at = ph::rotation::rotate<double>(x.orientation, arm);
    CHECK((body::angular(out.force) - d3::cross(at, f)).norm() <= 1e-12);
    const double normal = port.source().slot(0).pressed();
    CHECK(f.head<2>().norm() <= 0.6 * normal * (1.0 + 1e-12));
    if (normal > 0.0) closest = std::max(closest, f.head<2>().norm() / normal);
  }
  CHECK(closest > 0.59);
}

namespace {

/// The bristle of a contact of stiffness K at an arm r from the handle, one of `slots`:
///     k = K/N / (1 + r² γ K),   γ = max(1/(K ℓ²), T²/(κ I)),   B = k min(2√s, ½ s/T),   s = min(m/K, I γ)
/// so that all of them together are no stiffer at a point of the tool than one contact is there.
struct stated_bristle {
  double stiffness{};  ///< [N/m]
  double damping{};    ///< [N·s/m]
};
stated_bristle bristle_of(const ph::tool_spring& s, double K, double arm_squared, int slots) {
  const double per_turn =
      std::max(1.0 / (K * s.lever * s.lever), T * T / (s.stiffness_fraction * s.least_inertia));
  const double k = K / slots / (1.0 + arm_squared * per_turn * K);
  const double slowest = std::min(s.mass / K, s.least_inertia * per_turn);
  const double settles = std::min(2.0 * std::sqrt(slowest), 0.5 * slowest / T);
  return {k, k * settles};
}

/// A tool with `Count` rough slots, of which the first `arms.size()` press, is moved across by `aside`: what it
/// feels in that tick and when it has come to rest.
template <int Count>
void check_bristles(const ph::tool_spring& spring, double K, const std::vector<vector>& arms) {
  INFO(Count << " slots, " << arms.size() << " pressed, K " << K << ", I " << spring.least_inertia);
  ph::passive_port port{
      ph::rigid_body<double>{},
      ph::rigid_tool{spring, ph::pursuit{}, ph::stick_slip{}, ph::slots<plane_of<double>, Count>{}},
      ph::no_observer{}, ph::no_bound{}, thesis_loop};
  int slot = 0;
  for (const vector& arm : arms) {  // a floor for each, under its point
    REQUIRE(port.source().update(slot++, arm, plane{vector(0, 0, arm.z()), vector(0, 0, 1), K}));
  }
  (void)port.tick({{0, 0, 1e-3}, {}}, ph::seconds{T});
  const pose pressed{{0, 0, -1e-3}, {}};
  for (int i = 0; i < 2000; ++i) (void)port.tick(pressed, ph::seconds{T});
  const body::effort before = port.tick(pressed, ph::seconds{T}).force;

  const vector aside(3e-6, -2e-6, 0.0);
  const pose moved{{aside.x(), aside.y(), -1e-3}, {}};
  const body::effort moving = port.tick(moved, ph::seconds{T}).force - before;
  for (int i = 0; i < 20; ++i) (void)port.tick(moved, ph::seconds{T});
  const body::effort held = port.tick(moved, ph::seconds{T}).force - before;

  vector held_force(0, 0, 0), held_torque(0, 0, 0), moving_force(0, 0, 0);
  for (const vector& arm : arms) {
    const stated_bristle own = bristle_of(spring, K, arm.squaredNorm(), Count);
    const vector f = aside * -own.stiffness;
    held_force += f;
    held_torque += d3::cross(arm, f);
    moving_force += f + aside * (-own.damping / T);
  }
  CHECK((body::linear(held) - held_force).norm() <= 1e-6 * held_force.norm());
  CHECK((body::angular(held) - held_torque).norm() <= 1e-6 * held_force.norm() * 0.05);
  CHECK((body::linear(moving) - moving_force).norm() <= 1e-6 * moving_force.norm());
}

}  // namespace

TEST_CASE("a bristle of a rough tool is as stiff as its contact's share there", "[rigid_tool]") {
  // By hand, one point 0.05 m and 0.02 m off: 1/K + r²/(K ℓ²) = 1/1000 + 0.0029/0.9 m/N.
  CHECK_THAT(bristle_of(light, 1000.0, 0.0029, 1).stiffness, WithinRel(236.842105, 1e-8));
  constexpr ph::tool_spring turns_easily{.mass = 0.15, .least_inertia = 1e-5};  // κ I/T² < K ℓ²
  const vector none(0, 0, 0), far(0.05, 0.0, -0.02);
  const std::vector<vector> several{none, far, vector(-0.01, 0.03, 0.01)};
  for (const ph::tool_spring& spring : {light, turns_easily}) {
    for (const double K : {1000.0, 4000.0}) {
      check_bristles<1>(spring, K, {none});
      check_bristles<1>(spring, K, {far});
      check_bristles<4>(spring, K, {far});
      check_bristles<4>(spring, K, several);
      check_bristles<16>(spring, K, several);
      check_bristles<16>(spring, K, std::vector<vector>(16, far));
    }
  }
}

TEST_CASE("a contact of a tool settles as its slower mode does, in ticks at most", "[rigid_tool]") {
  for (const int late : {0, 1, 3}) {
    for (const double fraction : {0.05, 0.1, 0.3, 0.9}) {
      for (const double lever : {0.01, 0.05, 0.3}) {
        const ph::tool_spring rule{
            .mass = 0.15, .least_inertia = 1e-4, .lever = lever, .stiffness_fraction = fraction};
        ph::tool_spring::at<double> spring(rule);
        spring.adopt(T, late);
        for (const double K : {10.0, 300.0, 1e9}) {
          const auto s = spring.sampled(K);
          const double turn = 1.0 / spring.yield(s.compliance);  // k_ω [N·m/rad]
          const double slow = std::min(rule.mass / s.stiffness, rule.least_inertia / turn);
          const double ticks = late > 0 ? 2.25 * (late + 1) : 5.0;
          CAPTURE(late, fraction, lever, K);
          CHECK_THAT(s.settling, WithinRel(std::min(2.0 * std::sqrt(slow), ticks * T), 1e-12));
          CHECK(turn <= s.stiffness * lever * lever * (1 + 1e-12));
        }
      }
    }
  }
}

TEST_CASE("a contact of a tool comes to rest where its translation and its rotation do",
          "[rigid_tool]") {
  std::array<int, 4> met{};
  for (const int late : {0, 1, 3}) {
    for (double fraction = 0.05; fraction < 1.0; fraction *= 1.3) {
      for (const double lever : {0.01, 0.02, 0.05, 0.3}) {
        const ph::tool_spring rule{.mass = 0.15,
                                   .least_inertia = 1e-4,
                                   .lever = lever,
                                   .stiffness_fraction = fraction,
                                   .softness = 0.25};
        ph::tool_spring::at<double> spring(rule);
        spring.adopt(T, late);
        for (const double K : {300.0, 1e4, 5e4, 1e9}) {
          const auto s = spring.sampled(K);
          const auto rests = [&](double inertia, double k) {  // of which ε is not counted on
            return ph::settles(k * T * T / (0.75 * inertia), s.settling / T, late);
          };
          const bool moves = rests(rule.mass, s.stiffness),
                     turns = rests(rule.least_inertia, 1.0 / spring.yield(s.compliance));
          CAPTURE(late, fraction, lever, K);
          CHECK(spring.settles(K) == (moves && turns));
          ++met[(moves ? 1U : 0U) + (turns ? 2U : 0U)];
        }
      }
    }
  }
  for (const int times : met) CHECK(times > 0);
}

TEST_CASE("a tool_spring states what it was told", "[rigid_tool]") {
  const ph::tool_spring::at<double> spring({.mass = 0.5,
                                            .least_inertia = 0.25,
                                            .lever = 0.125,
                                            .stiffness_fraction = 0.0625,
                                            .softness = 0.03125});
  const ph::tool_spring stated = spring.parameters();
  CHECK(stated.mass == 0.5);
  CHECK(stated.least_inertia == 0.25);
  CHECK(stated.lever == 0.125);
  CHECK(stated.stiffness_fraction == 0.0625);
  CHECK(stated.softness == 0.03125);
}

TEST_CASE("a tool_spring out of range is refused by name", "[rigid_tool]") {
  const auto named = [](const ph::tool_spring& s) { return std::string(s.check().parameter); };
  CHECK_FALSE(light.check());
  CHECK(named({.least_inertia = 1e-4}) == "mass");
  CHECK(named({.mass = 0.1}) == "least_inertia");
  CHECK(named({.mass = 0.1, .least_inertia = 1e-4, .lever = 0.0}) == "lever");
  CHECK(named({.mass = 0.1, .least_inertia = 1e-4, .stiffness_fraction = 2.0}) ==
        "stiffness_fraction");
  CHECK(named({.mass = 0.1, .least_inertia = 1e-4, .softness = 1.0}) == "softness");
}

namespace {

/// The peg of example 22, pressed into its hole with 2 N, aside with 1 N and 10 mN·m, then tilted with 20 mN·m. At
/// 1.2 s one tick lasts `late` milliseconds.
struct pressed_peg {
  double deepest = 1.0, largest = 0.0,
         created = 0.0;  ///< the handle [m], the force [N], by the port [J]
  double last = 0.0;     ///< at the end [N]

  pressed_peg(double amends, int late) {
    ph::passive_port peg{
        body{},
        ph::rigid_tool{ph::tool_spring{.mass = 0.15, .least_inertia = 1e-4, .lever = 0.03},
                       ph::pursuit{}, ph::slots<plane, 20>{}},
        ph::forgiving{
            ph::basic_reduced_energy<ph::rigid_damping>{{.linear = 0.03, .angular = 1e-4}}, amends},
        ph::bound_chain{ph::rigid_reachable_bound{
                            {.mass = 0.15, .least = 1e-4, .spread = 2e-4}, 5, 0.1, 0.06, 2e-4},
                        ph::rigid_actuator_limit{.force = 9, .torque = 0.5}},
        ph::loop_limits{.longest_tick = T}};
    const double half = 0.01, length = 0.04, room = half + 0.00025;
    int slot = 0;
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        for (const double z : {-length, 0.0}) {
          const vector corner(half * x, half * y, z);
          peg.source().update(slot++, corner, plane{{room * x, 0, 0}, {-x, 0, 0}, 2000});
          peg.source().update(slot++, corner, plane{{0, room * y, 0}, {0, -y, 0}, 2000});
          if (z < 0) peg.source().update(slot++, corner, plane{{0, 0, 0}, {0, 0, 1}, 2000});
        }
    ph::simulation::rigid_device device({}, {.position = {0, 0, 0.05}, .orientation = {}});
    auto sample = device.exchange(body::zero());
    for (int n = 0; n < 2200; ++n) {
      const double aside = n >= 600 && n < 1000 ? 1.0 : 0.0;
      const double tilt = n < 600 ? 0.0 : n < 1000 ? 0.01 : 0.02;
      device.push(body::join(vector(aside, 0, -2), vector(0, tilt, 0)));
      const body::effort wrench = peg.tick(sample).force;
      const int ticks = n == 1200 ? late : 1;
      for (int i = 0; i < ticks; ++i) sample = device.exchange(wrench);
      sample.dt = T * ticks;
      last = body::linear(wrench).norm();
      largest = std::max(largest, last);
      if (n > 1200) deepest = std::min(deepest, device.at().position.values[2]);
      created = std::max(created, -device.energy());
    }
  }
};

}  // namespace

TEST_CASE("one late tick does not drop a peg, nor shake it", "[rigid_tool][faults][long]") {
  const pressed_peg right(0.02, 1);
  CHECK(right.deepest > 0.039);
  for (const int late : {10, 30, 100, 300}) {
    CAPTURE(late);
    const pressed_peg found(0.02, late);
    CHECK(found.deepest > right.deepest - 4e-3);
    CHECK(found.largest <= 9.0 * (1.0 + 1e-12));
    CHECK(found.created <= 0.02);
    CHECK_THAT(found.last, WithinRel(right.last, 0.1));
  }
  CHECK(pressed_peg(0.0, 300).deepest < right.deepest - 5e-3);  // the control forgives nothing
}

TEST_CASE("a tool whose motors' limits are not stated is refused, and not a wall that is none",
          "[rigid_tool]") {
  const auto refused = [](double force, double torque) {
    const auto port = ph::make_tool({.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},
                                     .damping = {.linear = 0.03, .angular = 1e-4},
                                     .damping_most = {.linear = 0.06, .angular = 2e-4},
                                     .force_limit = force,
                                     .torque_limit = torque},
                                    {.force = 5, .torque = 0.1},
                                    ph::slots<ph::half_space<ph::space<double, 3>>, 3>{});
    const auto fault = port.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(9.0, 0.5).empty());
  CHECK(refused(9.0, 0.0) == "torque");
  CHECK(refused(0.0, 0.5) == "force");
}

TEST_CASE("a tool that gives way to news is stepped by no more than they may change the force",
          "[rigid_tool]") {
  constexpr double length = 0.06, k = 400.0;
  for (const double m : {0.05, 0.5}) {
    for (const int points : {1, 3}) {
      constexpr double jump = -3e-3;  // [m]
      const double inertia = 1e-4 * m / 0.15;
      ph::simulation::rigid_device device({.mass = m,
                                           .moments = {inertia, 1.5 * inertia, 1.2 * inertia},
                                           .linear_damping = {0.1, 0.1, 0.1},
                                           .angular_damping = {2e-4, 2e-4, 2e-4}},
                                          {vector(0, 0, length + 0.005), {}});
      auto port = ph::make_tool({.inertia = {.mass = m, .least = inertia, .spread = 2.0 * inertia},
                                 .damping = {.linear = 0.1, .angular = 2e-4},
                                 .damping_most = {.linear = 0.2, .angular = 4e-4},
                                 .force_limit = 20,
                                 .torque_limit = 1},
                                {.force = 9, .torque = 0.4}, ph::slots<plane, 8>{});
      const auto tell = [&](double z) {
        for (int i = 0; i < points; ++i) {
          const double a = 2.0 * 3.14159265 * i / points, far = points > 1 ? 0.02 : 0.0;
          REQUIRE(port.source().update(i, vector(far * std::cos(a), far * std::sin(a), -length),
                                       plane{vector(0, 0, z), vector(0, 0, 1), 4000}));
        }
      };
      tell(0.0);
      auto sample = device.exchange(body::zero());
      vector last = vector::Zero();
      double step = 0.0;
      for (int n = 0; n < 2500; ++n) {
        if (n == 1500) tell(jump);
        const auto force = port.tick(sample).force;
        if (n >= 1500) step = std::max(step, (vector(body::linear(force)) - last).norm());
        last = body::linear(force);
        const vector goal(0, 0, length - 2e-3 - 5.0 / k);
        vector held = k * (goal - vector(device.at().position)) -
                      std::sqrt(k * m) * vector(device.velocity());
        if (held.norm() > 9.0) held *= 9.0 / held.norm();
        const vector turns = ph::rotation::log(device.at().orientation) * -4.0 -
                             vector(device.rate()) * 2.0 * std::sqrt(inertia);
        device.push(body::join(held, turns));
        sample = device.exchange(force);
      }
      CAPTURE(m, points, jump);
      CHECK(step < 0.06);  // R dt; 2 N where the way explains what the news did
      CHECK(device.energy() >= -1e-12);
    }
  }
}
