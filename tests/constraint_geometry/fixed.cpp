// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

TEST_CASE("fixed keeps one constraint for good, prepared", "[supply]") {
  constexpr ph::fixed supply{ph::half_space<d1>{0.0, -4.0, 100.0}};
  static_assert(!decltype(supply)::moves);
  static_assert(supply.local().normal == -1.0);
  static_assert(&supply.local() == &supply.target());  // no second copy
  static_assert(sizeof(supply) == sizeof(ph::half_space<d1>));
  CHECK_FALSE(supply.check());
}

TEST_CASE("fixed says what its constraint lacks", "[supply]") {
  const auto refused = [](const auto& constraint) {
    const auto fault = ph::fixed{constraint}.check();
    return std::string(fault ? fault.parameter : "");
  };
  const double nan = std::nan("");
  CHECK(refused(wall<d1>(100)).empty());
  CHECK(refused(wall<d1>(0.1)).empty());
  CHECK(refused(wall<d1>(0)) == "stiffness");
  CHECK(refused(wall<d1>(-5)) == "stiffness");
  CHECK(refused(wall<d1>(nan)) == "stiffness");
  CHECK(refused(wall<d1>(HUGE_VAL)) == "stiffness");
  CHECK(refused(ph::half_space<d1>{0.0, 0.0, 100.0}) == "constraint");
  CHECK(refused(ph::half_space<d1>{nan, 1.0, 100.0}) == "constraint");
  CHECK(refused(ph::triangle<d3>{
            .a = {0, 0, 0}, .b = {1, 0, 0}, .c = {2, 0, 0}, .stiffness = 100}) == "constraint");
  CHECK(std::string(ph::fixed<ph::half_space<d1>>{}.check().parameter) == "stiffness");
}

TEST_CASE("fixed prepares its constraint, which is its target as well", "[supply]") {
  ph::fixed supply{ph::half_space<d1>{0.5, -4.0, 100.0}};
  CHECK(supply.local().normal == -1.0);
  CHECK(supply.local().stiffness == 100.0);
  CHECK(supply.target().normal == -1.0);
  CHECK(supply.target().point == 0.5);
}
