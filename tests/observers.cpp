// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("reduced_energy grows when the hand presses in and falls when it leaves (A1)",
          "[observer]") {
  auto ledger = thesis_ledger<d1>();
  const double n = -1, f = 2.0 * n;  // outward force of 2 N: the wall fills x > 0
  ledger.update(+1e-4, f, 1e-3);     // inwards
  CHECK_THAT(ledger.value(), WithinRel(30.0 * 1e-8 + 2e-4, 1e-12));
  const double before = ledger.value();
  ledger.update(-1e-4, f, 1e-3);                     // outwards
  const double exact = before + 30.0 * 1e-8 - 2e-4;  // rounded down, by 16 ε of what passed
  CHECK(ledger.value() <= exact);
  CHECK_THAT(ledger.value(), WithinAbs(exact, 32 * 2.3e-16 * 2e-4));
  CHECK(ledger.value() < before);
}

TEST_CASE("reduced_energy uses the measured dt", "[observer]") {
  auto ledger = thesis_ledger<d1>();
  ledger.update(1e-3, 0.0, 2e-3);
  CHECK_THAT(ledger.value(), WithinRel(0.03 * 1e-6 / 2e-3, 1e-12));
}

TEST_CASE("reduced_energy starts from the loan it is given (A8)", "[observer]") {
  auto ledger = thesis_ledger<d1>();
  ledger.energy = 0.5;
  CHECK(ledger.value() == 0.5);
  CHECK_FALSE(ledger.check());
  ledger.energy = -0.5;
  CHECK(ledger.check());
}

TEST_CASE("diagonal_damping credits and fears each axis by its own b", "[observer]") {
  const ph::reduced_energy<d3, ph::diagonal_damping<d3>> start{.damping = {{0.03, 0.03, 0.008}}};
  auto ledger = start;
  ledger.update({1e-3, 0, 0}, d3::zero(), 1e-3);
  CHECK_THAT(ledger.value(), WithinRel(30e-6, 1e-12));
  ledger.update({0, 0, 1e-3}, d3::zero(), 1e-3);
  CHECK_THAT(ledger.value(), WithinRel(38e-6, 1e-12));
  CHECK_THAT(ledger.damping.worst_outflow({0, 0, 2}, 1e-3), WithinRel(4.0 / 32.0, 1e-12));
  CHECK_THAT(ledger.damping.worst_outflow({2, 0, 0}, 1e-3), WithinRel(4.0 / 120.0, 1e-12));
  auto none = start;
  none.damping.coefficients = {0.03, 0.0, 0.008};
  CHECK(none.check());
}

TEST_CASE("a cap lowers credit only (A9, L7)", "[observer]") {
  ph::reduced_energy<d1> ledger{.damping = 0.03, .cap = 1e-5};
  ledger.update(1e-3, 0.0, 1e-3);
  CHECK(ledger.value() == 1e-5);
  ledger.update(-1e-3, -1.0, 1e-3);  // leaving: pays out 1 mJ less 30 µJ
  CHECK_THAT(ledger.value(), WithinAbs(1e-5 + 30e-6 - 1e-3, 1e-15));
  const double debt = ledger.value();
  ledger.update(0.0, 0.0, 1e-3);
  CHECK(ledger.value() == debt);
  CHECK_THAT(ph::kernels::bank_for_hold(0.35, 0.03, 1e-3), WithinRel(1.02e-3, 0.01));
}

TEST_CASE("a reset voids credit after force-free time and never a debt (L7)", "[observer]") {
  ph::reduced_energy<d1> ledger{.damping = 0.03, .reset_after = 2.5e-3};
  ledger.update(1e-3, -1.0, 1e-3);
  const double credit = ledger.value();
  REQUIRE(credit > 0);
  ledger.update(0.0, 0.0, 1e-3);
  ledger.update(0.0, 0.0, 1e-3);
  CHECK(ledger.value() == credit);
  ledger.update(0.0, 0.0, 1e-3);
  CHECK(ledger.value() == 0.0);
  ledger.update(-1e-3, -1.0, 1e-3);
  const double debt = ledger.value();
  REQUIRE(debt < 0);
  for (int i = 0; i < 10; ++i) ledger.update(0.0, 0.0, 1e-3);
  CHECK(ledger.value() == debt);
}

TEST_CASE("forfeit writes off what the held force can have done, down to an empty ledger",
          "[observer]") {
  auto ledger = thesis_ledger<d1>();
  ledger.energy = 0.01;
  ledger.forfeit(0.6, 1e-3);  // 0.36/120 = 3 mJ
  CHECK_THAT(ledger.value(), WithinRel(0.007, 1e-12));
  ledger.forfeit(9.0, 1e-3);  // 675 mJ: all there is
  CHECK(ledger.value() == 0.0);
  ledger.energy = -0.2;
  ledger.forfeit(9.0, 1e-3);
  CHECK(ledger.value() == -0.2);
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
  using ledger_type = ph::reduced_energy<f1, ph::isotropic_damping<f1>, ph::compensated_sum<float>>;
  static_assert(ph::energy_observer_for<ledger_type, f1>);
  ledger_type kept{.damping = 0.03F, .energy = 1.0F};
  ph::reduced_energy<f1> plain{.damping = 0.03F, .energy = 1.0F};
  ph::reduced_energy<d1> exact{.damping = static_cast<double>(0.03F), .energy = 1.0};
  for (int i = 0; i < 200000; ++i) {
    const float dx = 1e-5F * std::sin(0.1F * static_cast<float>(i));
    const float f = 1e-3F * std::cos(0.07F * static_cast<float>(i));
    kept.update(dx, f, 1e-3F);
    plain.update(dx, f, 1e-3F);
    exact.update(static_cast<double>(dx), static_cast<double>(f), static_cast<double>(1e-3F));
  }
  CHECK_THAT(static_cast<double>(kept.value()), WithinAbs(exact.value(), 2e-7));
  CHECK(std::abs(static_cast<double>(plain.value()) - exact.value()) > 1e-5);  // the control
}

TEST_CASE("parameters of an observer are refused with their name", "[observer]") {
  const auto refused = [](ph::reduced_energy<d1> ledger) {
    const auto fault = ledger.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({.damping = 0.03}).empty());
  CHECK(refused({.damping = 0.0}) == "damping");
  CHECK(refused({.damping = -1.0}) == "damping");
  CHECK(refused({.damping = std::nan("")}) == "damping");
  CHECK(refused({.damping = std::numeric_limits<double>::infinity()}) == "damping");
  CHECK(refused({.damping = 0.03, .cap = -1.0}) == "cap");
  CHECK(refused({.damping = 0.03, .cap = std::nan("")}) == "cap");
  CHECK(refused({.damping = 0.03, .reset_after = -1.0}) == "reset_after");
  CHECK(refused({.damping = 0.03, .energy = std::nan("")}) == "energy");
}
