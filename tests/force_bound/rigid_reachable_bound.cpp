// SPDX-License-Identifier: BSD-3-Clause
#include "../bench/contacts/rigid_ports.hpp"
#include "support/catch.hpp"
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/laws.hpp>

#include <string>

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
