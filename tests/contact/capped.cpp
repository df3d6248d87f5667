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
