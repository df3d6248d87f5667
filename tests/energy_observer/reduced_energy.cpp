// SPDX-License-Identifier: BSD-3-Clause
// reduced_energy and capped_energy: what is booked, what is forgotten, how it rounds; no_observer.
#include "force_bound/upkeep.hpp"
#include <passive_haptics/device/joint_space.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using axes = ph::basic_reduced_energy<ph::diagonal_damping<3>>;
using compensated = ph::basic_reduced_energy<ph::isotropic_damping, ph::ledger_sum::compensated>;

}  // namespace

TEST_CASE("the ledgers for exact positions obey the laws of observers", "[observer][law]") {
  const ph::capped_energy forgetful{.damping = 0.03, .cap = 1e-4, .reset_after = 5e-3};
  CHECK(broken_laws<d1, f3>(thesis_ledger()).empty());
  CHECK(broken_laws<d1, f3>(forgetful).empty());
  CHECK(broken_laws<f3>(compensated{.damping = 0.03}).empty());
  using arm = ph::joint_space<double, 4>;
  const ph::diagonal_damping<4> joints{{0.03, 0.1, 0.5, 0.01}};
  CHECK(broken_laws<arm>(ph::basic_reduced_energy<ph::diagonal_damping<4>>{.damping = joints})
            .empty());
  CHECK(broken_laws<d1>(ph::no_observer{}).empty());
}

TEST_CASE("reduced_energy grows when the hand presses in and falls when it leaves (A1)",
          "[observer]") {
  auto ledger = at<d1>(thesis_ledger());
  const double n = -1, f = 2.0 * n;     // outward force of 2 N: the wall fills x > 0
  (void)ledger.update(+1e-4, f, 1e-3);  // inwards
  CHECK_THAT(ledger.value(), WithinRel(30.0 * 1e-8 + 2e-4, 1e-12));
  const double before = ledger.value();
  (void)ledger.update(-1e-4, f, 1e-3);               // outwards
  const double exact = before + 30.0 * 1e-8 - 2e-4;  // rounded down, by 16 ε of what passed
  CHECK(ledger.value() <= exact);
  CHECK_THAT(ledger.value(), WithinAbs(exact, 32 * 2.3e-16 * 2e-4));
  CHECK(ledger.value() < before);
}

TEST_CASE("reduced_energy uses the measured dt", "[observer]") {
  auto ledger = at<d1>(thesis_ledger());
  (void)ledger.update(1e-3, 0.0, 2e-3);
  CHECK_THAT(ledger.value(), WithinRel(0.03 * 1e-6 / 2e-3, 1e-12));
}

TEST_CASE("where the device reports its work, the damping is booked with it (lemma J)",
          "[observer]") {
  auto ledger = at<d1>(thesis_ledger());
  const auto reported = [](double work) { return ph::detail::reported_effort<d1>{0.0, work}; };
  REQUIRE(ledger.update(1e-3, reported(0.0), 1e-3));
  CHECK_THAT(ledger.value(), WithinRel(0.03 * 1e-6 / 1e-3, 1e-12));
  REQUIRE(ledger.update(1e-3, reported(1e-5), 1e-3));
  CHECK_THAT(ledger.value(), WithinRel(0.06 * 1e-6 / 1e-3 - 1e-5, 1e-9));
}

TEST_CASE("reduced_energy starts from the loan it is given (A8)", "[observer]") {
  ph::reduced_energy lent{.damping = 0.03, .loan = 0.5};
  auto ledger = at<d1>(lent);
  CHECK(ledger.value() == 0.5);
  CHECK_FALSE(lent.check());
  (void)ledger.update(1e-3, 0.0, 1e-3);
  ledger.reset();
  CHECK(ledger.value() == 0.5);
  lent.loan = -0.5;
  CHECK(lent.check());
}

TEST_CASE("diagonal_damping credits and fears each axis by its own b", "[observer]") {
  axes start{.damping = {{0.03, 0.03, 0.008}}};
  auto ledger = at<d3>(start);
  (void)ledger.update({1e-3, 0, 0}, d3::zero(), 1e-3);
  CHECK_THAT(ledger.value(), WithinRel(30e-6, 1e-12));
  (void)ledger.update({0, 0, 1e-3}, d3::zero(), 1e-3);
  CHECK_THAT(ledger.value(), WithinRel(38e-6, 1e-12));
  CHECK_THAT(ledger.damping().worst_outflow({0, 0, 2}, 1e-3), WithinRel(4.0 / 32.0, 1e-12));
  CHECK_THAT(ledger.damping().worst_outflow({2, 0, 0}, 1e-3), WithinRel(4.0 / 120.0, 1e-12));
  start.damping.coefficients = {0.03, 0.0, 0.008};
  CHECK(start.check());
}

TEST_CASE("a cap lowers credit only (A9, L7)", "[observer]") {
  auto ledger = at<d1>(ph::capped_energy{.damping = 0.03, .cap = 1e-5});
  (void)ledger.update(1e-3, 0.0, 1e-3);
  CHECK(ledger.value() == 1e-5);
  (void)ledger.update(-1e-3, -1.0, 1e-3);  // leaving: pays out 1 mJ less 30 µJ
  CHECK_THAT(ledger.value(), WithinAbs(1e-5 + 30e-6 - 1e-3, 1e-15));
  const double debt = ledger.value();
  (void)ledger.update(0.0, 0.0, 1e-3);
  CHECK(ledger.value() == debt);
  CHECK_THAT(ph::kernels::bank_for_hold(0.35, 0.03, 1e-3), WithinRel(1.02e-3, 0.01));
}

TEST_CASE("a cap of zero keeps no credit at all, and is no fault (A9)", "[observer]") {
  const ph::capped_energy none{.damping = 0.03, .cap = 0.0};
  CHECK_FALSE(none.check());
  auto ledger = at<d1>(none);
  (void)ledger.update(1e-3, -1.0, 1e-3);  // pressing in
  CHECK(ledger.value() == 0.0);
  (void)ledger.update(-1e-3, -1.0, 1e-3);
  CHECK(ledger.value() < -9e-4);  // a debt stays
}

TEST_CASE("a reset voids credit after force-free time and never a debt (L7)", "[observer]") {
  auto ledger = at<d1>(ph::capped_energy{.damping = 0.03, .reset_after = 2.5e-3});
  (void)ledger.update(1e-3, -1.0, 1e-3);
  const double credit = ledger.value();
  REQUIRE(credit > 0);
  (void)ledger.update(0.0, 0.0, 1e-3);
  (void)ledger.update(0.0, 0.0, 1e-3);
  CHECK(ledger.value() == credit);
  (void)ledger.update(0.0, 0.0, 1e-3);
  CHECK(ledger.value() == 0.0);
  (void)ledger.update(-1e-3, -1.0, 1e-3);
  const double debt = ledger.value();
  REQUIRE(debt < 0);
  for (int i = 0; i < 10; ++i) (void)ledger.update(0.0, 0.0, 1e-3);
  CHECK(ledger.value() == debt);
}

TEST_CASE("forfeit writes off what the held force can have done, down to an empty ledger",
          "[observer]") {
  auto ledger = at<d1>(ph::reduced_energy{.damping = 0.03, .loan = 0.01});
  ledger.forfeit(0.6, 1e-3);  // 0.36/120 = 3 mJ
  CHECK_THAT(ledger.value(), WithinRel(0.007, 1e-12));
  ledger.forfeit(9.0, 1e-3);  // 675 mJ: all there is
  CHECK(ledger.value() == 0.0);
  (void)ledger.update(-0.2, -1.0, 1e6);  // 0.2 J are gone
  const double debt = ledger.value();
  CHECK_THAT(debt, WithinRel(-0.2, 1e-8));
  ledger.forfeit(9.0, 1e-3);
  CHECK(ledger.value() == debt);
}

TEST_CASE("compensated_sum keeps in float what plain float loses", "[observer]") {
  float plain = 1.0F;
  ph::compensated_sum<float> kept = 1.0F;
  double exact = 1.0;
  for (int i = 0; i < 1000000; ++i) {
    const float term = (i % 3 == 0) ? -0.5e-9F : 1e-9F;
    plain += term;
    kept += term;
    exact += static_cast<double>(term);
  }
  CHECK(plain == 1.0F);  // the control: every term was lost
  CHECK_THAT(static_cast<double>(static_cast<float>(kept)), WithinAbs(exact, 6e-8));
  CHECK(exact > 1.0004);
}

TEST_CASE("a float ledger with a compensated sum follows the double one", "[observer]") {
  static_assert(ph::energy_observer_for<compensated, f1>);
  const double b = static_cast<double>(0.03F);
  auto kept = at<f1>(compensated{.damping = b, .loan = 1.0});
  auto plain = at<f1>(ph::reduced_energy{.damping = b, .loan = 1.0});
  auto exact = at<d1>(ph::reduced_energy{.damping = b, .loan = 1.0});
  for (int i = 0; i < 200000; ++i) {
    const float dx = 1e-5F * std::sin(0.1F * static_cast<float>(i));
    const float f = 1e-3F * std::cos(0.07F * static_cast<float>(i));
    (void)kept.update(dx, f, 1e-3F);
    (void)plain.update(dx, f, 1e-3F);
    (void)exact.update(static_cast<double>(dx), static_cast<double>(f), static_cast<double>(1e-3F));
  }
  CHECK_THAT(static_cast<double>(kept.value()), WithinAbs(exact.value(), 2e-7));
  CHECK(std::abs(static_cast<double>(plain.value()) - exact.value()) > 1e-5);  // the control
}

TEST_CASE("parameters of an observer are refused with their name", "[observer]") {
  using plain = ph::reduced_energy;
  using capped = ph::capped_energy;
  const double nan = std::nan("");
  CHECK(refused(plain{.damping = 0.03}).empty());
  CHECK(refused(plain{.damping = 0.0}) == "damping");
  CHECK(refused(plain{.damping = -1.0}) == "damping");
  CHECK(refused(plain{.damping = nan}) == "damping");
  CHECK(refused(plain{.damping = std::numeric_limits<double>::infinity()}) == "damping");
  CHECK(refused(capped{.damping = 0.03}).empty());
  CHECK(refused(capped{.damping = 0.03, .cap = -1.0}) == "cap");
  CHECK(refused(capped{.damping = 0.03, .cap = nan}) == "cap");
  CHECK(refused(capped{.damping = 0.03, .reset_after = -1.0}) == "reset_after");
  CHECK(refused(capped{.damping = 0.03, .reset_after = 0.0}).empty());
  CHECK(refused(capped{.damping = 0.0}) == "damping");
  CHECK(refused(capped{.damping = 0.03, .loan = -1.0}) == "loan");
  CHECK(refused(plain{.damping = 0.03, .loan = nan}) == "loan");
}

TEST_CASE("observers take new parameters, keep their energy, refuse bad ones and start anew",
          "[observer]") {
  const ph::capped_energy first{.damping = 0.03, .loan = 1e-5}, bad{.damping = 0.03, .cap = -1.0};
  const auto model = following_half_space<d1>(ph::spring{}, first, ph::strict_bound{});
  check_upkeep(model, first, ph::capped_energy{.damping = 0.02}, bad);
  // a cap lowers the credit at the next tick, not before
  auto used = model;
  (void)run_of(used, 300, 1);
  REQUIRE(used.energy() > 1e-6);
  CHECK_FALSE(used.set(ph::capped_energy{.damping = 0.03, .cap = 1e-7}));
  CHECK(used.energy() > 1e-6);
  CHECK(used.tick(0.0, 1ms).energy <= 1e-7);
}
