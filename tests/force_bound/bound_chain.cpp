// SPDX-License-Identifier: BSD-3-Clause
// bound_chain: the order, what survives of the promises, and how late a loop may be.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/published/energy_bounding.hpp>
#include <passive_haptics/published/energy_tank.hpp>
#include <passive_haptics/shaper/force_rate_limit.hpp>
#include <passive_haptics/shaper/thesis_rule.hpp>

using Catch::Matchers::WithinRel;

namespace {

using ph::guarantee;
using strict = ph::strict_bound;
using motors = ph::actuator_limit;
using reachable = ph::reachable_bound;
using raises = ph::two_layer_tank;  // promises nothing, and may push harder than it was asked
using rate = ph::force_rate_limit;

template <class Space, class... Bounds>
constexpr guarantee promised = ph::promise_of<ph::bound_chain<Bounds...>, Space>();

}  // namespace

TEST_CASE("a chain obeys the laws of the bounds in it", "[bound][law]") {
  CHECK(broken_laws<f3>(ph::bound_chain{strict{}, motors{.most = 0.5}}).empty());
}

TEST_CASE("bound_chain applies its bounds in order and promises what survives", "[bound]") {
  static_assert(promised<d1, strict, motors> == guarantee::strict);
  static_assert(promised<d1, motors, strict> == guarantee::strict);
  static_assert(promised<d1, reachable, motors> == guarantee::conditional);
  static_assert(promised<d1, reachable, strict> == guarantee::strict);
  static_assert(promised<d1, strict, raises> == guarantee::none);
  static_assert(promised<d1, raises, strict> == guarantee::strict);
  static_assert(promised<d1, raises, motors> == guarantee::none);
  static_assert(ph::bound_chain<motors, strict>::traits.latency == ph::any_latency);
  static_assert(ph::bound_chain<strict, ph::per_axis_bound>::traits.latency == 0);
  static_assert(ph::bound_chain<motors, strict>::traits.needs_ledger);
  static_assert(!ph::bound_chain<motors, motors>::traits.needs_ledger);
  static_assert(ph::bound_chain<motors, ph::memoryless_bound>::traits.exact_travel);
  static_assert(!ph::bound_chain<motors, strict>::traits.exact_travel);
  static_assert(sizeof(ph::part_at<ph::bound_chain<strict, strict>, d1>) <= 2);
  static_assert(ph::shaped<ph::spring, rate>::needs_local_model);

  // what looks at the contact stands before the chain
  auto shapers = at<d1>(ph::shaped{ph::spring{}, rate{.rate = 100.0}});
  auto chain = at<d1>(ph::bound_chain{strict{}, motors{.most = 0.5}});
  const ph::contact_state<d1> contact{.normal = -1,
                                      .stiffness = 1e4,
                                      .depth = 0,
                                      .target_depth = 1e-3,
                                      .local_force = 2.0,
                                      .target_changed = false};
  const auto limit = [&](double energy) {
    const situation<d1> now{.energy = energy};
    return allowed(chain, allowed(shapers.shapers(), -3.0, contact, now), now);
  };
  CHECK(limit(0.01) == -0.5);
  CHECK_THAT(limit(1e-6), WithinRel(-std::sqrt(4 * 30 * 1e-6), 1e-14));
  CHECK(refused(ph::bound_chain{strict{}, motors{.most = -1}}) == "most");
  CHECK(refused(ph::shaped{ph::spring{}, rate{.rate = -1}}) == "rate");

  SECTION("each sees what those before it have left") {
    auto tight = at<d1>(ph::bound_chain{motors{.most = 0.5}, motors{.most = 2.0}});
    CHECK(allowed(tight, -3.0, situation<d1>{}) == -0.5);
    const ph::energy_bounding pushes_on;  // after the contact is lost, from −1 to −0.7 N
    const situation<d1> leaving{.held = -1.0, .travel = -0.01};
    auto first = at<d1>(ph::bound_chain{pushes_on, motors{.most = 0.5}});
    auto last = at<d1>(ph::bound_chain{motors{.most = 0.5}, pushes_on});
    CHECK(allowed(first, 0.0, leaving) == -0.5);
    CHECK_THAT(allowed(last, 0.0, leaving), WithinRel(-0.7, 1e-12));
  }
}

TEST_CASE("a chain knows which of these bounds keep the direction", "[bound]") {
  using axes = ph::per_axis_bound;
  using eba = ph::energy_bounding;
  static_assert(promised<d2, axes, motors> == guarantee::strict);
  static_assert(promised<d2, reachable, axes> == guarantee::strict);
  static_assert(promised<d2, axes, reachable> == guarantee::strict);
  static_assert(promised<d2, eba, raises> == guarantee::none);
  using chain = ph::bound_chain<axes, motors>;
  static_assert(!ph::detail::reduces<chain, d2, situation<d2>::state_type>());
  static_assert(
      ph::detail::reduces<ph::bound_chain<strict, motors>, d2, situation<d2>::state_type>());
  SUCCEED();
}

TEST_CASE("a chain in a late loop keeps what each of its bounds promises there", "[bound]") {
  // per_axis_bound knows no latency: the compiler refuses it, in a chain or alone
  static_assert(ph::bound_chain<reachable, ph::per_axis_bound>::traits.latency == 0);
  const ph::bound_chain chain{reachable{.mass = 0.1, .hand_force = 5.0}, motors{.most = 5.0}};
  const auto late = [&](const auto& limits) {
    return following_half_space<d1>(ph::spring{}, thesis_ledger(), chain, limits);
  };
  const ph::late_loop_limits<1> told{.longest_tick = 1e-3};
  static_assert(decltype(late(told))::passivity == guarantee::conditional);
  CHECK(attacks::tapped(late(told), 1) >= -1e-12);
  CHECK(attacks::tapped(late(thesis_loop), 1) < -1e-5);  // the control: nobody told it
}

TEST_CASE("a chain takes new parameters for its parts, refuses bad ones and starts anew",
          "[bound]") {
  const ph::per_axis_bound unlimited, little{.cap = 1e-7}, none{.cap = -1};
  const ph::bound_chain chain{unlimited, motors{.most = 0.5}};
  check_upkeep(following_half_space<d1>(ph::spring{}, thesis_ledger(), chain), unlimited, little,
               none);
  const ph::bound_chain other{little, motors{.most = 0.5}}, bad{unlimited, motors{.most = -0.5}};
  check_upkeep(following_half_space<d1>(ph::spring{}, thesis_ledger(), chain), chain, other, bad);
}

TEST_CASE("a device is not believed to hold more than twice what its motors can",
          "[bound][faults]") {
  const auto refuses = [](auto&& bound, double held) {
    ph::passive_port port{d3{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03}, bound,
                          thesis_loop};
    (void)port.tick(d3::vector(0, 0, 0), ph::seconds{1e-3});
    const double before = port.energy();
    const auto out = port.tick({.position = d3::vector(-1e-4, 0, 0),
                                .held = d3::vector(held, 0, 0),
                                .dt = 1e-3,
                                .valid = true});
    CHECK((out.what == ph::event::rejected_sample) == !(port.energy() > before));
    return out.what == ph::event::rejected_sample;
  };
  const auto try_all = [&refuses](const auto& bound) {
    for (const double held : {0.0, 9.0, 17.9}) CHECK_FALSE(refuses(bound, held));
    for (const double held : {18.1, 1e3, 1e160, std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      CHECK(refuses(bound, held));
    }
  };
  try_all(ph::actuator_limit{9.0});
  try_all(ph::motor_limits<3>{{9.0, 9.0, 9.0}});
  try_all(ph::thermal_limit{.peak = 9.0, .continuous = 9.0, .time_constant = 10.0});
  try_all(ph::bound_chain{ph::strict_bound{}, ph::actuator_limit{9.0}});
  try_all(ph::bound_chain{ph::actuator_limit{9.0}, ph::strict_bound{}});
  try_all(
      ph::bound_chain{ph::actuator_limit{90.0}, ph::actuator_limit{9.0}});  // whichever is first
  CHECK_FALSE(
      refuses(ph::strict_bound{}, 1e3));  // who is not told of motors asks for a number only
  CHECK(refuses(ph::strict_bound{}, HUGE_VAL));
}

TEST_CASE("a chain within a chain lets through what both together do", "[bound]") {
  auto inner = at<d1>(ph::bound_chain{motors{.most = 2.0}, motors{.most = 0.5}});
  const situation<d1> now{.energy = 0.01};
  CHECK(inner.limit(-3.0, now.port()) == -0.5);
  CHECK(inner.limit(0.25, now.port()) == 0.25);
}
