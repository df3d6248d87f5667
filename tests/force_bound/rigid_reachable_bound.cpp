// SPDX-License-Identifier: BSD-3-Clause
#include "../bench/contacts/rigid_ports.hpp"
#include "support/catch.hpp"
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/laws.hpp>

#include <string>

using Catch::Matchers::WithinRel;
using namespace rigid;

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

TEST_CASE("rigid_actuator_limit shortens the wrench as a whole", "[rigid]") {
  const ph::part_at<ph::rigid_actuator_limit, body> limit({.force = 3.0, .torque = 0.1});
  const auto now = quiet.with(body::zero(), 0.0);
  CHECK(limit.limit(body::join({0, 0, 3}, {0.1, 0, 0}), now).factor == 1.0);
  CHECK_THAT(limit.limit(body::join({0, 0, 6}, {0.1, 0, 0}), now).factor, WithinRel(0.5));
  CHECK_THAT(limit.limit(body::join({0, 0, 6}, {0.4, 0, 0}), now).factor, WithinRel(0.25));
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
