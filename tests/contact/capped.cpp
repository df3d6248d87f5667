// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/contact/capped.hpp>

#include <string>

using Catch::Matchers::WithinRel;

namespace {

using capped_damper = ph::capped<ph::damped_spring>;
static_assert(ph::contact_law_for<capped_damper, d1> && ph::contact_law_for<capped_damper, f3>);
static_assert(ph::contact_law_for<ph::capped<ph::shaped<ph::spring>>, d1>);

}  // namespace

TEST_CASE("capped states what it was told, and no working capital as none", "[contact]") {
  for (const double capital : {0.0, 5.0 / 64.0}) {
    const ph::capped told{ph::damped_spring{.mass = 0.125}, 2000.0, capital};
    const ph::part_at<capped_damper, d1> law(told);
    CHECK(law.parameters().law.mass == 0.125);
    CHECK(law.parameters().most == 2000.0);
    CHECK(law.parameters().working_capital == capital);
  }
}

TEST_CASE("capped gives its law no more stiffness than it was told, and tells", "[contact]") {
  ph::part_at<capped_damper, d1> law(ph::capped{ph::damped_spring{.mass = 0.1}, 2000.0});
  law.adopt(5000.0, 1e-3);
  CHECK(law.stiffness() == 2000.0);
  CHECK(law.is_capped());
  CHECK_THAT(law.force(1e-3, 0.0), WithinRel(2.0, 1e-12));
  CHECK_THAT(law.depth(2.0, 0.0), WithinRel(1e-3, 1e-12));
  law.adopt(1500.0, 1e-3);
  CHECK(law.stiffness() == 1500.0);
  CHECK_FALSE(law.is_capped());

  SECTION("the law's own limit counts beside it") {
    law.set({ph::damped_spring{.mass = 0.01}, 2000.0});
    law.adopt(5000.0, 1e-3);
    CHECK_THAT(law.stiffness(), WithinRel(1000.0, 1e-12));  // κ m/T²
    CHECK(law.is_capped());
  }
  SECTION("it is refused where nothing is paid for") {
    CHECK(ph::capped{ph::spring{}, 0.0}.check());
    CHECK(std::string(ph::capped{ph::spring{}, -1.0}.check().parameter) == "most");
    CHECK(std::string(ph::capped{ph::damped_spring{}, 1.0}.check().parameter) == "mass");
    CHECK_FALSE(ph::capped{ph::damped_spring{.mass = 0.1}, 2000.0}.check());
  }
}

TEST_CASE("a capped law changes live, by its own parameters or by those of what it wraps",
          "[contact]") {
  auto model = following_half_space<d1>(ph::capped{ph::damped_spring{.mass = 0.1}, 2000.0},
                                        thesis_ledger(), ph::no_bound{});
  REQUIRE(model.update({0.0, 1.0, 5000.0}));
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(2.0, 1e-12));
  CHECK(model.law().is_capped());
  REQUIRE_FALSE(model.set(ph::capped{ph::damped_spring{.mass = 0.1}, 3000.0}));
  REQUIRE(model.update({0.0, 1.0, 5000.0}));
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(3.0, 1e-12));
  REQUIRE_FALSE(model.set(ph::damped_spring{.mass = 0.02}));
  REQUIRE(model.update({0.0, 1.0, 5000.0}));
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(2.0, 1e-12));  // κ m/T²
  CHECK(model.law().is_capped());
  CHECK(model.set(ph::capped{ph::damped_spring{.mass = 0.1}, 0.0}));
}

namespace {

/// What a port tells a law: its ledger [J], what was held [N], and ticks of 1 ms.
struct told {
  static constexpr int latency = 0;
  double energy = 0.0, held = 0.0, dt = 1e-3, longest_tick = 1e-3;
};
using following = ph::part_at<capped_damper, d1>;

}  // namespace

TEST_CASE("a cap with a working capital follows the free energy, and never in a step",
          "[contact][following]") {
  const double K = 2000.0, C = 1e-3, f = 1.0;
  following law(ph::capped{ph::damped_spring{.mass = 0.1}, K, C});
  law.adopt(5000.0, 1e-3);
  const double spring = f * f / (2.0 * K);

  SECTION("what the wall's own spring gives back is not free") {
    law.follow(true, told{.energy = spring + 0.21e-3, .held = -f});
    CHECK(law.stiffness() == K);
    law.follow(true, told{.energy = spring + 0.19e-3, .held = -f});
    CHECK(law.stiffness() < K);
    CHECK(law.stiffness() >= K * (1.0 - 0.3e-3));
  }
  SECTION("an empty ledger takes it to 0.15 of K in three seconds, and no farther") {
    double before = K;
    for (int n = 0; n < 6000; ++n) {
      law.follow(true, told{.energy = 0.0, .held = -f});
      REQUIRE(before - law.stiffness() <= K * 0.3e-3 * (1 + 1e-9));
      before = law.stiffness();
      if (n == 2800) CHECK(before < 0.17 * K);
    }
    CHECK_THAT(law.stiffness(), WithinRel(0.15 * K, 1e-9));
    // it comes back by 2 % a second while there is plenty, and stays where there is just enough
    for (int n = 0; n < 1000; ++n) {
      law.follow(true, told{.energy = f * f / (2.0 * 0.1 * K) + C, .held = -f});
    }
    CHECK_THAT(law.stiffness(), WithinRel(0.17 * K, 1e-3));
    law.follow(true, told{.energy = f * f / (2.0 * law.stiffness()) + C / 5.0 * 0.99, .held = -f});
    CHECK(law.stiffness() <= 0.17 * K * (1 + 1e-3));
    // news do not undo it, and a device that is let go does
    law.adopt(5000.0, 1e-3);
    CHECK(law.stiffness() < 0.18 * K);
    law.follow(false, told{});
    CHECK(law.stiffness() == K);
  }
  SECTION("without a working capital the cap stays") {
    following fixed(ph::capped{ph::damped_spring{.mass = 0.1}, K});
    fixed.adopt(5000.0, 1e-3);
    for (int n = 0; n < 3000; ++n) fixed.follow(true, told{.energy = -1.0, .held = -f});
    CHECK(fixed.stiffness() == K);
  }
  SECTION("numbers that are none, and ledgers in debt, leave a stiffness") {
    for (const double energy : {-1e300, 1e300, 0.0}) {
      for (const double held : {0.0, 1e200}) {
        law.follow(true, told{.energy = energy, .held = held});
        CHECK(law.stiffness() >= 0.15 * K * (1 - 1e-9));
        CHECK(law.stiffness() <= K);
      }
    }
    CHECK(std::string(ph::capped{ph::damped_spring{.mass = 0.1}, K, -1.0}.check().parameter) ==
          "working_capital");
  }
}
