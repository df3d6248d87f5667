// SPDX-License-Identifier: BSD-3-Clause
// The motion that the report feeds to every scalar. Compiled with -O3 whatever the build is: a
// compiler can lose its rounding only where it puts two numbers into one register.
#include "../bench/report/recording.hpp"

#include "support/catch.hpp"

namespace ex = experiments;

namespace {

/// Through memory that the compiler has to believe in.
double as_float(double x) {
  const volatile float near = static_cast<float>(x);
  return static_cast<double>(near);
}

}  // namespace

TEST_CASE("a recorded motion is a float's in double, too", "[report]") {
  using room = ex::ph::space<double, 3>;
  for (long n = 0; n < 100; ++n) {
    const room::vector at = ex::position_in<room>(ex::stroke_at(n));
    const auto surface = ex::constraint_from<ex::ph::triangle<room>>(ex::surface_at(n));
    const room::vector node = surface.b;
    for (int i = 0; i < 3; ++i) {
      REQUIRE(at[i] == as_float(at[i]));
      REQUIRE(node[i] == as_float(node[i]));
    }
  }
}
