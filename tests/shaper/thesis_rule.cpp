// SPDX-License-Identifier: BSD-3-Clause
// thesis_rule: what it binds, what it does not, and that the strict bound behind it answers for both.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/shaper/thesis_rule.hpp>

using Catch::Matchers::WithinRel;

TEST_CASE("thesis_rule binds when leaving and on updates, and keeps what there is going in",
          "[shaper]") {
  const auto rule = at<d1>(ph::thesis_rule{});
  const double f_max = std::sqrt(1.2);
  situation<d1> now{.energy = 0.01};
  const auto limit = [&](double desired, double local_force) {
    const ph::contact_state<d1> contact{.normal = -1,
                                        .stiffness = 1e4,
                                        .depth = 0,
                                        .target_depth = 1e-3,
                                        .local_force = local_force,
                                        .target_changed = false};
    return allowed(rule, desired, contact, now);
  };
  SECTION("leaving") {
    now.travel = -1e-5;
    CHECK_THAT(limit(-8.0, 5.0), WithinRel(-f_max, 1e-13));
  }
  SECTION("going in, an update asks for more than there is") {
    now.travel = 1e-5;
    CHECK(limit(-8.0, 5.0) == -5.0);
  }
  SECTION("going in, less there than the ledger allows") {
    now.travel = 1e-5;
    CHECK_THAT(limit(-8.0, 0.1), WithinRel(-f_max, 1e-13));
  }
  SECTION("going in, the surface retreats") {
    now.travel = 1e-5;
    CHECK(limit(-2.0, 5.0) == -2.0);
  }
  SECTION("in debt, leaving") {
    now.energy = -1.0;
    now.travel = -1e-5;
    CHECK(limit(-8.0, 5.0) == 0.0);
  }
}

TEST_CASE("thesis_rule by itself is not passive, with strict_bound behind it it is",
          "[shaper][passivity]") {
  const ph::shaped rule{ph::spring{}, ph::thesis_rule{}};
  const auto alone = attacks::model_of<d1>(ph::no_bound{}, thesis_loop, rule);
  static_assert(decltype(alone)::passivity == ph::guarantee::none);
  CHECK(attacks::worst_of<d1>(alone, {}, 4).least < -1e-3);
  const auto behind = attacks::model_of<d1>(ph::strict_bound{}, thesis_loop, rule);
  static_assert(decltype(behind)::passivity == ph::guarantee::strict);
  CHECK(attacks::worst_of<d1>(behind, {}, 4).least >= -1e-12);
}
