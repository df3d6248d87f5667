// SPDX-License-Identifier: BSD-3-Clause
#include "../bench/contacts/rigid_ports.hpp"
#include "support/catch.hpp"
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/laws.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using namespace rigid;
namespace k = ph::kernels;

namespace {

using damper = ph::part_at<ph::rigid_damping, body>;
using state = ph::port_state<body, damper>;
constexpr double T = 1e-3;
const damper b(damping);

/// A port in one tick: nothing held, with that motion and that energy.
struct moment {
  state::commands commanded{};
  body::coordinates held{};
  [[nodiscard]] state with(const body::motion& travel, double energy) const {
    return {.damping = b,
            .commanded = commanded,
            .energy = energy,
            .dt = T,
            .longest_tick = T,
            .held = held,
            .travel = travel,
            .travel_error = 0.0,
            .motion_known = true,
            .late = false};
  }
};
const moment quiet;

}  // namespace

TEMPLATE_TEST_CASE("rigid bounds obey the laws", "[rigid]", ph::rigid_body<double>,
                   ph::rigid_body<float>) {
  CHECK(ph::laws::all<ph::rigid_reachable_bound, TestType>(reachable));
  CHECK(ph::laws::all<ph::rigid_inertia, TestType>(
      {.mass = 0.1, .least = 1e-4, .spread = 2e-4, .offset = 0.03}));
  CHECK(ph::laws::all<ph::rigid_actuator_limit, TestType>({.force = 3.0, .torque = 0.1}));
  const ph::bound_chain both{ph::strict_bound{}, ph::rigid_actuator_limit{3.0, 0.1}};
  CHECK(ph::laws::all<std::remove_const_t<decltype(both)>, TestType>(both));
  STATIC_REQUIRE(both.traits.turns);
}

TEST_CASE("along one direction rigid_reachable_bound is reachable_bound", "[rigid]") {
  using d1 = ph::space<double, 1>;
  using one = ph::part_at<ph::isotropic_damping, d1>;
  const one b1(0.03);
  const ph::part_at<ph::rigid_reachable_bound, body> rigid(reachable);
  const ph::part_at<ph::reachable_bound, d1> plain({.mass = 0.15, .hand_force = 5.0});
  const ph::port_state<d1, one>::commands none{};
  const double held = 0.0;
  for (const double travel : {-1e-4, 0.0, 3e-6, 1e-4}) {
    for (const double energy : {0.0, 1e-6, 1e-4}) {
      for (const double f : {0.1, 1.0, 8.0}) {
        const body::effort w = body::join({0, f, 0}, {0, 0, 0});
        const body::motion moved = body::join({0, travel, 0}, {0, 0, 0});
        auto weak = reachable;  // a torque of the hand would count, too: its norm is one of both
        weak.hand_torque = 0.0;
        const ph::part_at<ph::rigid_reachable_bound, body> same(weak);
        const double left = same.limit(w, quiet.with(moved, energy)).factor;
        const ph::port_state<d1, one> state1{.damping = b1,
                                             .commanded = none,
                                             .energy = energy,
                                             .dt = T,
                                             .longest_tick = T,
                                             .held = held,
                                             .travel = travel,
                                             .travel_error = 0.0,
                                             .motion_known = true,
                                             .late = false};
        CHECK_THAT(left, WithinRel(plain.limit(f, state1).factor, 1e-9));
        CHECK(rigid.limit(w, quiet.with(moved, energy)).factor <= left * (1 + 1e-12));
      }
    }
  }
}

TEST_CASE("a wrench that is bounded at rest does not tremble as the ticks do", "[rigid]") {
  const ph::part_at<ph::rigid_reachable_bound, body> bound(reachable);
  const body::effort w = body::join({1, 0, -6}, {0, 0, 0});
  const auto left = [&](double dt) {
    auto now = quiet.with(body::zero(), 1e-6);
    now.dt = dt;
    now.recent.longest = T;
    return bound.limit(w, now).factor;
  };
  REQUIRE(left(T) < 1.0);
  for (const double share : {0.2, 0.5, 0.93}) CHECK(left(share * T) == left(T));
  CHECK(left(1.2 * T) < left(T));
}

TEST_CASE("no torque passes of which lemma C does not speak", "[rigid]") {
  const double most = 4 * damping.angular / T;
  const body::effort huge = body::join({1, 0, 0}, {0, 100 * most, 0});
  const ph::part_at<ph::rigid_reachable_bound, body> reach(reachable);
  const ph::part_at<ph::strict_bound, body> strict(ph::strict_bound{});
  const auto rich = quiet.with(body::zero(), 1e6);
  for (const double left : {reach.limit(huge, rich).factor, strict.limit(huge, rich).factor}) {
    CHECK_THAT(left, WithinRel(0.01, 1e-12));
    CHECK(left * 100 * most <= most);
  }
  CHECK(strict.limit(body::effort(huge * 0.0099), rich).factor == 1.0);
  CHECK(reach.limit(body::effort(huge * 0.0099), rich).factor == 1.0);
}

TEST_CASE("rigid_reachable_bound is strict_bound where it cannot know the motion", "[rigid]") {
  const ph::part_at<ph::rigid_reachable_bound, body> reach(reachable);
  const body::effort w = body::join({3, 0, 0}, {0, 0.1, 0});
  const body::motion inwards = body::join({-1e-3, 0, 0}, {0, -1e-3, 0});
  auto now = quiet.with(inwards, 1e-5);
  CHECK(reach.limit(w, now).factor == 1.0);
  now.motion_known = false;
  CHECK(reach.limit(w, now).factor == b.affordable(w, 1e-5, T));
  const auto spun = quiet.with(body::join({0, 0, 0}, {0, -1.1, 0}), 1e-5);  // more than a radian
  CHECK(reach.limit(w, spun).factor == b.affordable(w, 1e-5, T));
}

namespace {

/// What a handle that nobody sees does, over what rigid_reachable_bound allows: its work, and what its turn hides.
struct unseen_handle {
  ph::simulation::rigid_device_parameters device{};
  double hand_force = 5.0, hand_torque = 0.1;

  [[nodiscard]] std::array<double, 2> worst() const {
    const ph::rigid_reachable_bound told{
        {.mass = 0.15, .least = 1e-4, .spread = 2e-4}, 5.0, 0.1, 0.06, 2e-4};
    const ph::part_at<ph::rigid_reachable_bound, body> bound(told);
    ph::laws::samples random(7);
    const auto arrow = [&random] {
      const body::triple a(random.number<double>(), random.number<double>(),
                           random.number<double>());
      return body::triple(a / a.norm());
    };
    std::array<double, 2> most{};
    for (int i = 0; i < 150; ++i) {
      ph::simulation::rigid_device handle(device);
      const auto w = body::join(9.0 * random.number<double>() * arrow(),
                                0.1 * std::abs(random.number<double>()) * arrow());
      const bool with = random.number<double>() > 0.0;  // a hand that goes with the wrench
      const body::triple f = body::linear(w), t = body::angular(w);
      const body::triple push = with ? body::triple(f / f.norm()) : arrow();
      const body::triple twist = with ? body::triple(t / t.norm()) : arrow();
      handle.push(body::join(hand_force * push, hand_torque * twist));
      const auto from = handle.exchange(w).position;
      const auto seen = handle.exchange(w).position;
      const int ticks = 1 + i % 20;
      const double before = handle.energy();
      for (int n = 0; n < ticks; ++n) {
        if (!with) handle.push(body::join(hand_force * arrow(), hand_torque * arrow()));
        (void)handle.exchange(w);
      }
      const ph::detail::seen_tick<body> last{body::squared(body::between(from, seen)), T, 0.0, w};
      const auto said = bound.unseen(last, b, w, ticks * T);
      const body::motion m = body::between(seen, handle.at());
      const double gained = handle.energy() - before;
      most[0] = std::max(most[0], -gained / said.done);
      const double shown = b.dissipated(m, ticks * T) - body::work(w, m).joules;
      most[1] = std::max(most[1], (shown - gained) / said.beside);
    }
    return most;
  }
};

}  // namespace

TEST_CASE("a handle that nobody saw has done no more than its inertia allows", "[rigid][unseen]") {
  const auto [done, hidden] = unseen_handle{}.worst();
  INFO(done << " " << hidden);
  CHECK(done <= 1.0);
  CHECK(done > 0.3);
  CHECK(hidden <= 1.0);
  unseen_handle light{.device = {.mass = 0.015, .moments = {1e-5, 3e-5, 1.5e-5}}};
  CHECK(light.worst()[0] > 1.0);  // the controls
  CHECK(unseen_handle{.hand_force = 40.0, .hand_torque = 0.8}.worst()[0] > 1.0);
}

TEST_CASE("each term of an unseen path counts", "[rigid][unseen]") {
  const auto done = [](const ph::rigid_inertia& inertia, const body::effort& w, double most = 0.0,
                       double dt = T) {
    const ph::part_at<ph::rigid_reachable_bound, body> bound(
        ph::rigid_reachable_bound{inertia, 0.0, 0.0, most > 0.0 ? most : 1e-6, 1e-9});
    // 5 mm, or 50 mrad: 50 rad/s, were it a turn
    return bound.unseen({25e-6, T, 0.0, body::zero()}, b, w, dt).done;
  };
  const ph::rigid_inertia plain{.mass = 0.15, .least = 1e-4, .spread = 0.0};
  const auto force = body::join({1.0, 0, 0}, {0, 0, 0}),
             torque = body::join({0, 0, 0}, {0.1, 0, 0});
  CHECK(done(plain, torque) > 0.1 * 50.0 * T);
  auto arm = plain;
  arm.offset = 0.05;
  CHECK(done(arm, force) - done(plain, force) > 0.8 * 1.0 * 2.0 * 0.05 * 50.0 * T);
  auto long_body = plain;
  long_body.spread = 3e-4;  // may turn twice as fast, about its shortest axis
  CHECK(done(long_body, torque) > 1.9 * done(plain, torque));
  CHECK(done(plain, force, 10.0, 1.0) > 1e9);  // a damper that would stop it in a tick knows better
  const ph::part_at<ph::rigid_reachable_bound, body> any(reachable);
  CHECK(any.unseen({1e-4, T, 0.0, body::zero()}, b, torque, T).done < 1e9);
  CHECK(any.unseen({0.04, T, 0.0, body::zero()}, b, torque, T).done > 1e9);  // 2 rad in a tick
  const auto most =
      ph::part_at<ph::rigid_actuator_limit, body>(ph::rigid_actuator_limit{9.0, 0.3}).most_held();
  CHECK(most(0) == 18.0);
  CHECK(most(3) == 0.6);
  // The smaller of two bounds: of a short turn lemma C knows better.
  const ph::basic_reduced_energy<ph::rigid_damping> kept{damping, 1.0};
  ph::part_at<ph::basic_reduced_energy<ph::rigid_damping>, body> one(kept), two(kept);
  const auto turn = body::join({0, 0, 0}, {0, 1e-3, 0});
  REQUIRE(one.update(turn, torque, T));
  REQUIRE(two.update(turn, torque, T, 0.5));
  CHECK(one.value() == two.value());
}

TEST_CASE("from rest it has gone as far as the wrench held pushes it, and no farther",
          "[rigid][unseen]") {
  // For a tick that was seen, half of which counts as speed, and t that was not; a lever swings, too.
  const double t = 4 * T, f = 3.0, m = 0.15, least = 1e-4;
  for (const double lever : {0.0, 0.05}) {
    const ph::rigid_inertia inertia{.mass = m, .least = least, .spread = 0.0, .offset = lever};
    const ph::part_at<ph::rigid_reachable_bound, body> bound(
        ph::rigid_reachable_bound{inertia, 0.0, 0.0, 1e-9, 1e-9});
    const auto w = body::join({0, f, 0}, {0, 0, 0});
    const double norm = f * std::sqrt(1.0 / m + lever * lever / least);
    const double a = norm * std::sqrt(1.0 / m + lever * lever / least);  // [m/s²]
    const double way = a * (T + t) * t / 2.0;
    const double swung = 2.0 * lever * norm / std::sqrt(least) * (T / 2.0 + t) * t;
    CAPTURE(lever);
    CHECK_THAT(bound.unseen({0.0, T, 0.0, w}, b, w, t).done, WithinRel(f * (way + swung), 1e-4));
  }
}

TEST_CASE("a handle at rest that nothing pushes has done nothing unseen", "[rigid][unseen]") {
  const ph::part_at<ph::rigid_reachable_bound, body> bound(ph::rigid_reachable_bound{
      {.mass = 0.15, .least = 1e-4, .spread = 2e-4, .offset = 0.03}, 0.0, 0.0, 0.06, 2e-4});
  const body::effort none = body::zero();
  const auto said = bound.unseen({0.0, T, 0.0, none}, b, none, 5 * T);
  CHECK(said.done == 0.0);
  CHECK(said.beside == 0.0);
}

namespace {

/// The formulas of docs/design/six_dof.md § 4 and of mathematics.md § 2(a″), in plain words and not rounded.
struct plain_handle {
  double m, least, spread, c;  ///< of the inertia
  double force, torque;        ///< of the hand
  double b, b_turn;            ///< the largest damping
  [[nodiscard]] ph::rigid_reachable_bound told() const {
    return {{m, least, spread, c}, force, torque, b, b_turn};
  }

  [[nodiscard]] double norm(double f, double t) const {
    return std::sqrt(f * f / m + (t + c * f) * (t + c * f) / least);
  }
  [[nodiscard]] double norm(const body::effort& w) const {
    return norm(body::linear(w).norm(), body::angular(w).norm());
  }
  /// F in a tick of T₀ in which the handle moved and turned by so much.
  [[nodiscard]] double others(double moved, double turned, double T0) const {
    const double rate = 2 * turned / T0;
    return norm(force + 2 * b * moved / T0, torque + b_turn * rate) +
           rate * rate * std::sqrt(m * c * c + spread * spread / (4 * least));
  }
  /// The most by which the two ends of a turn hide of it, where the rate changes by α.
  static double hidden(double turned, double alpha, double T0) {
    return (turned + alpha * T0 * T0) * alpha * T0 * T0 / 12;
  }
  /// η of w in the first coming tick, while a wrench of norm `next` is held, after a tick like `now`.
  [[nodiscard]] double reach(const body::effort& w, double next, const state& now) const {
    const double turned = body::angular(now.travel).norm(), held = norm(body::effort(now.held));
    const double F = others(body::linear(now.travel).norm(), turned, now.dt);
    const double alpha = (held + F) / std::sqrt(least);
    const double before = (held + F) * std::max(now.dt, now.recent.longest) * T;
    return w.dot(now.travel) * T / now.dt + norm(w) * (before + (next + F) * T * T) / 2 +
           body::angular(w).norm() * hidden(turned, alpha, now.dt) * T / now.dt;
  }
  /// The largest share of a wrench that gives out no more than E: of a motion in which it does the work x up to η the
  /// damper takes x²/(4W) at least.
  static double share(double E, double W, double eta) {
    if (eta <= 0.0) return 1.0;
    double share = 0.0;
    for (double step = 0.5; step > 1e-12; step /= 2) {
      const double s = share + step, x = std::min(2 * W * s, eta);
      if (s * x - x * x / (4 * W) <= E) share = s;
    }
    return share;
  }
  /// The path of the handle point and of its turn in a time t that nobody saw; `beside` is the second.
  [[nodiscard]] std::array<double, 2> path(double moved, double turned, double T0, double held,
                                           double t) const {
    const double F = others(moved, turned, T0), alpha = (held + F) / std::sqrt(least);
    const double pace = std::sqrt(1 / m + c * c / least), rate = 1 / std::sqrt(least);
    const double v0 = moved / T0 + (held + F) * T0 / 2 * pace;
    const double w0 = (turned + hidden(turned, alpha, T0)) / T0 + (held + F) * T0 / 2 * rate;
    const auto turns = [&](double N, double s) {
      return std::sqrt(1 + spread / least) * (w0 + N * rate * s);
    };
    const auto moves = [&](double N, double s) { return v0 + N * pace * s + 2 * c * turns(N, t); };
    const double without = held + norm(force, torque);
    const double V = 2 * moves(without, t), rate_most = 2 * turns(without, t);
    const double N = held + norm(force + b * V, torque + b_turn * rate_most);
    const bool holds = turned <= 1 && moves(N, t) <= V && turns(N, t) <= rate_most;
    return {holds ? moves(N, t / 2) * t : HUGE_VAL, holds ? turns(N, t / 2) * t : HUGE_VAL};
  }
};

/// Handles with their centre of mass in the handle point and beside it, of which each number differs.
constexpr std::array<plain_handle, 3> handles{
    plain_handle{0.15, 1e-4, 2e-4, 0.0, 5.0, 0.2, 0.06, 2e-4},
    plain_handle{0.3, 5e-4, 1e-4, 0.04, 2.0, 0.05, 0.5, 1e-3},
    plain_handle{0.05, 2e-5, 8e-5, 0.02, 0.5, 0.01, 0.03, 1e-4}};

body::effort any_wrench(ph::laws::samples& random) {
  body::effort w = random.vector<body>();
  for (int i = 0; i < 6; ++i) w(i) *= i < 3 ? 6.0 : 0.1;
  return w * std::abs(random.number<double>());
}

}  // namespace

TEST_CASE("rigid_reachable_bound is its formula, in time and a tick late", "[rigid]") {
  using late_state = ph::port_state<body, damper, 1>;
  ph::laws::samples random(1);
  std::array<int, 2> cut{};
  for (int n = 0; n < 3000; ++n) {
    const plain_handle& handle = handles[static_cast<std::size_t>(n % 3)];
    const ph::part_at<ph::rigid_reachable_bound, body> bound(handle.told());
    moment now;
    now.held = any_wrench(random);
    body::motion travel = 1e-4 * random.vector<body>();
    if (n % 5 == 0) travel = 1e2 * travel;
    auto seen = now.with(travel, std::pow(10.0, -5.0 + 4.0 * random.number<double>()));
    seen.dt = T * (0.6 + 0.4 * random.number<double>());
    seen.recent.longest = n % 2 == 0 ? T : 0.0;
    const body::effort h = any_wrench(random);
    const body::effort w = (n % 4 == 0 ? 10.0 : 1.0) * any_wrench(random);
    const double passes = std::min(1.0, 4 * damping.angular / T / body::angular(w).norm());
    const body::effort known = passes * w;
    const auto W = [](const body::effort& of) { return b.worst_outflow(of, T); };
    const auto left = [&](double E, double eta) {
      return passes * (W(known) <= E ? 1.0 : plain_handle::share(E, W(known), eta));
    };
    const double norm = handle.norm(known), next = handle.norm(h);
    CAPTURE(n, passes);

    const double at_once = left(seen.energy, handle.reach(known, norm, seen));
    CHECK_THAT(bound.limit(w, seen).factor, WithinAbs(at_once, 1e-9));

    // a tick late: what is on its way has its part of E first
    const late_state::commands commanded{body::coordinates(h), body::coordinates(now.held)};
    const late_state late{.damping = b,
                          .commanded = commanded,
                          .energy = seen.energy,
                          .dt = seen.dt,
                          .longest_tick = T,
                          .recent = seen.recent,
                          .held = now.held,
                          .travel = travel,
                          .travel_error = 0.0,
                          .motion_known = true,
                          .late = false};
    const double F =
        handle.others(body::linear(travel).norm(), body::angular(travel).norm(), seen.dt);
    const double x = std::clamp(handle.reach(h, next, seen), 0.0, 2 * W(h));
    const double spent = x - x * x / (4 * W(h));
    const double eta = handle.reach(known, next, seen) + norm * (next + norm + 2 * F) * T * T / 2;
    // and what the ledger cuts is cut to its share, or w and h would take turns
    const double half = W(known) <= seen.energy - spent
                            ? passes
                            : left(seen.energy / 2, handle.reach(known, norm, seen));
    const double after = std::min(left(seen.energy - spent, eta), half);
    CHECK_THAT(bound.limit(w, late).factor, WithinAbs(after, 1e-9));
    cut[0] += at_once < 0.99 && at_once > 0.01;
    cut[1] += after < 0.99 && after > 0.01;
  }
  CHECK(cut[0] > 500);
  CHECK(cut[1] > 300);
}

TEST_CASE("a port of a handle says of its last tick what its ledger has booked", "[rigid]") {
  ph::laws::samples random(1);
  for (int n = 0; n < 50; ++n) {
    ph::part_at<ph::basic_reduced_energy<ph::rigid_damping>, body> ledger(
        ph::basic_reduced_energy<ph::rigid_damping>{damping, 0.0});
    moment now;
    const body::effort held = any_wrench(random);
    now.held = held;
    const body::motion travel = 0.6 * random.vector<body>();
    REQUIRE(ledger.update(travel, held, T));
    const auto then = now.with(travel, 0.0);
    CHECK_THAT(then.gain(), WithinRel(ledger.value(), 1e-12));
    CHECK(b.unsure(travel, held, T) >
          1e-9 * std::abs(then.gain()));  // the control: a turn hides something
  }
}

TEST_CASE("an unseen path is its formula", "[rigid][unseen]") {
  ph::laws::samples random(1);
  int open = 0, longer = 0;
  for (int n = 0; n < 2000; ++n) {
    const plain_handle& handle = handles[static_cast<std::size_t>(n % 3)];
    const ph::part_at<ph::rigid_reachable_bound, body> bound(handle.told());
    const body::effort w = any_wrench(random), held = any_wrench(random);
    // A move of r counts as a turn of 10 r, too; rarely more than a radian.
    const double gone = 1e-3 * std::pow(10.0, 2.4 * random.number<double>());
    const double T0 = T * (1.0 + 0.5 * random.number<double>());
    const double t = T * std::pow(10.0, random.number<double>());
    const double most = std::max(handle.norm(held), handle.norm(w));
    const auto [moved, turned] = handle.path(gone, 10 * gone, T0, most, t);
    const double f = body::linear(w).norm(), torque = body::angular(w).norm();
    const auto said = bound.unseen({gone * gone, T0, 0.0, held}, b, w, t);
    CAPTURE(n, moved, turned);
    if (moved < HUGE_VAL) {
      CHECK_THAT(said.done, WithinRel(f * moved + torque * turned, 1e-9));
      const bool within = turned <= 3.125;  // a little less than π
      const double hidden =
          within ? turned * turned / 4 + std::pow(turned, 3) / 29 : turned + 3.1875;
      CHECK_THAT(said.beside, WithinRel(torque * hidden, 1e-9));
      longer += !within;
    } else {
      CHECK(said.done == k::largest<double>());
      CHECK(said.beside == k::largest<double>());
      ++open;
    }
  }
  CHECK(open > 100);
  CHECK(longer > 100);
}

TEST_CASE("no cone hides more of its length than an unseen arc", "[rigid][unseen]") {
  double worst = 0.0, small = 0.0;
  for (double L = 0.2; L < 3.14; L += 0.2) {
    for (double along = 0.0; along <= 1.0; along += 0.125) {
      for (double winding = 0.25; winding <= 12.0; winding += 0.25) {
        constexpr int steps = 150;
        const double a = L * along, c = std::sqrt(L * L - a * a);
        auto q = body::pose{}.orientation;
        body::triple sum(0, 0, 0);
        for (int n = 0; n < steps; ++n) {
          const double angle = winding * (n + 0.5) / steps;
          const body::triple turn(c * std::cos(angle) / steps, c * std::sin(angle) / steps,
                                  a / steps);
          const double half = 0.5 * turn.norm(), scale = std::sin(half) / (2.0 * half);
          q = ph::rotation::product(
              {std::cos(half), scale * turn(0), scale * turn(1), scale * turn(2)}, q);
          sum += turn;
        }
        const double hidden = (sum - ph::rotation::log(q)).norm();
        worst = std::max(worst, hidden / k::unseen_arc(L));
        if (L < 1.0) small = std::max(small, hidden / (L * L));
      }
    }
  }
  CHECK(worst <= 1.0);
  CHECK(small >
        1.0 / 6.5);  // as a half circle hides L²/2π: 1/4 is no more than is needed for any path
  CHECK(k::unseen_arc(3.0) > 3.0);
  CHECK(k::unseen_arc(10.0) >= 10.0 + std::acos(-1.0));
}

TEST_CASE("of a long turn a ledger writes off what the inertia leaves open, not what a damper does",
          "[rigid][unseen]") {
  const auto left = [](auto bound) {
    ph::passive_port port{body{}, ph::given_force{},
                          ph::basic_reduced_energy<ph::rigid_damping>{damping, 3.0}, bound,
                          ph::loop_limits{.longest_tick = T}};
    const auto twist = body::join({0, 0, 0}, {0, 0, 0.1});
    for (int n = 0; n < 3; ++n) (void)port.tick(body::pose{}, ph::seconds{T}, twist);
    const double before = port.energy();
    (void)port.tick(body::pose{}, ph::seconds{5 * T}, twist);
    return before - port.energy();
  };
  const ph::rigid_actuator_limit motors{9.0, 0.3};
  CHECK_THAT(left(ph::bound_chain{ph::strict_bound{}, motors}),
             WithinRel(5 * T * 0.01 / (4.0 * damping.angular), 1e-6));
  CHECK(left(ph::bound_chain{reachable, motors}) > 0.0);
  CHECK(left(ph::bound_chain{reachable, motors}) <
        0.02 * left(ph::bound_chain{ph::strict_bound{}, motors}));
}

TEST_CASE("rigid_actuator_limit shortens the wrench as a whole", "[rigid]") {
  const ph::part_at<ph::rigid_actuator_limit, body> limit({.force = 3.0, .torque = 0.1});
  const auto now = quiet.with(body::zero(), 0.0);
  CHECK(limit.limit(body::join({0, 0, 3}, {0.1, 0, 0}), now).factor == 1.0);
  CHECK_THAT(limit.limit(body::join({0, 0, 6}, {0.1, 0, 0}), now).factor, WithinRel(0.5));
  CHECK_THAT(limit.limit(body::join({0, 0, 6}, {0.4, 0, 0}), now).factor, WithinRel(0.25));
  CHECK(limit.can_hold(body::join({0, 3, 0}, {0, 0, 0.1})));
  CHECK_FALSE(limit.can_hold(body::join({0, 30, 0}, {0, 0, 0.1})));  // either is too much
  CHECK_FALSE(limit.can_hold(body::join({0, 3, 0}, {0, 0, 1.0})));
}

TEST_CASE("rigid parts name the number that is wrong", "[rigid]") {
  const double nan = std::nan("");
  const auto says = [](const auto& part, const char* name) {
    CHECK(std::string(part.check().parameter) == name);
  };
  CHECK_FALSE(reachable.check());
  says(ph::rigid_damping{.linear = 0.0, .angular = 1.0}, "linear");
  says(ph::rigid_damping{.linear = 1.0, .angular = -1.0}, "angular");
  says(ph::rigid_inertia{.mass = 0.0, .least = 1.0}, "mass");
  says(ph::rigid_inertia{.mass = 1.0, .least = nan}, "least");
  says(ph::rigid_inertia{.mass = 1.0, .least = 1.0, .spread = -1.0}, "spread");
  says(ph::rigid_inertia{.mass = 1.0, .least = 1.0, .offset = HUGE_VAL}, "offset");
  auto wrong = reachable;
  wrong.inertia.mass = -1.0;
  says(wrong, "mass");
  wrong = reachable;
  wrong.hand_force = -1.0;
  says(wrong, "hand_force");
  wrong = reachable;
  wrong.hand_torque = nan;
  says(wrong, "hand_torque");
  wrong = reachable;
  wrong.linear_damping_most = 0.0;
  says(wrong, "linear_damping_most");
  wrong = reachable;
  wrong.angular_damping_most = 0.0;
  says(wrong, "angular_damping_most");
  says(ph::rigid_actuator_limit{.force = -1.0}, "force");
  says(ph::rigid_actuator_limit{.force = 1.0, .torque = nan}, "torque");

  const ph::part_at<ph::rigid_reachable_bound, body> part(reachable);
  CHECK(part.parameters().inertia.spread == reachable.inertia.spread);
  CHECK(part.parameters().angular_damping_most == reachable.angular_damping_most);
  CHECK(b.parameters().angular == damping.angular);
}
