// SPDX-License-Identifier: BSD-3-Clause
// How a ledger is kept. Whole ledgers are in energy_observer/, all roundings in rounding/.
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace

TEST_CASE("what a tick has brought is less what rounding can have done to each axis", "[ledger]") {
  const d2::vector held(2.0, -1.0), motion(0.5, 0.5);  // 0.5 J of work, 1.5 J to and fro
  CHECK(ph::detail::sure_gain<d2>(1.0, held, motion) == 0.5 - 16 * eps * 2.5);
  CHECK(ph::detail::sure_gain<d1>(0.0, -1.0, 1.0) == 1.0 - 16 * eps);
}

TEST_CASE("an entry that is too small to see is booked against the ledger", "[ledger]") {
  double energy = 1.0;
  ph::detail::book(energy, eps / 8);
  CHECK(energy == 1.0);
  ph::detail::book(energy, -eps / 8);
  CHECK(energy < 1.0);
  CHECK_THAT(energy, WithinAbs(1.0, 2 * eps));
  ph::compensated_sum<double> kept = 1.0;
  for (int n = 0; n < 16; ++n) ph::detail::book(kept, eps / 8);
  CHECK_THAT(static_cast<double>(kept), WithinAbs(1.0 + 2 * eps, eps));
  CHECK(static_cast<double>(kept) > 1.0);
}

TEST_CASE("the worst of a force is written off, rounded up, down to an empty ledger", "[ledger]") {
  using ph::detail::written_off;
  CHECK(written_off(1.0, 0.0) == 1.0);
  CHECK(written_off(1.0, 0.25) <= 0.75 - 4 * eps);
  CHECK_THAT(written_off(1.0, 0.25), WithinAbs(0.75, 8 * eps));
  CHECK(written_off(1.0, 5.0) == 0.0);
  CHECK(written_off(0.0, 5.0) == 0.0);
  CHECK(written_off(-1.0, 5.0) == -1.0);  // a debt is neither forgiven nor made larger
  CHECK(written_off(-1.0, 0.0) == -1.0);
  for (const double beyond : {HUGE_VAL, std::nan("")}) {
    CHECK(written_off(1.0, beyond) == 0.0);
    CHECK(written_off(-1.0, beyond) == -1.0);
  }
}
