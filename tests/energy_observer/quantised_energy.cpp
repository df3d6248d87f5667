// SPDX-License-Identifier: BSD-3-Clause
// Encoders with steps: what quantised_energy is sure of, against the true port energy. Bounds on it
// against adversaries: tests/full/bounds_quantised.cpp.
#include "energy_observer/stepped.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/device/joint_space.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

static_assert(ph::laws::never_overstates<d1>(sure(1e-5)));
static_assert(ph::laws::forfeit_never_credits<f1>(sure(1e-5)));

}  // namespace

TEMPLATE_TEST_CASE("quantised_energy never exceeds the true port energy, whatever the motion",
                   "[quantised]", d1, d3) {
  const auto [worst, plain] = overstatements<TestType>();
  CHECK(worst <= 1e-12);
  CHECK(plain > 1e-4);  // the control: the ledger that takes the positions for exact
}

TEST_CASE("quantised_energy without steps is reduced_energy", "[quantised]") {
  auto quantised = at<d3>(sure(0.0));
  auto reduced = at<d3>(thesis_ledger());
  ph::laws::samples random(1);
  for (int n = 0; n < 1000; ++n) {
    const d3::vector dx = random.vector<d3>() * 1e-4;
    const d3::vector held = random.vector<d3>();
    (void)quantised.update(dx, held, 1e-3);
    (void)reduced.update(dx, held, 1e-3);
    CHECK_THAT(quantised.value(), WithinAbs(reduced.value(), 1e-13));
  }
  CHECK(quantised.travel_error() == 0.0);
  CHECK_THAT(at<d3>(sure()).travel_error(), WithinRel(step * std::sqrt(3.0), 1e-12));
}

TEST_CASE("the window sees slow motions that no single tick can show (L1)", "[quantised]") {
  const auto credit = [](double window) {
    auto parameters = sure();
    parameters.window = window;
    auto observer = at<d1>(parameters);
    for (int n = 0; n < 1000; ++n) (void)observer.update(n % 3 == 0 ? step : 0.0, 0.0, 1e-3);
    return observer.value();
  };
  CHECK(credit(1e-3) == 0.0);  // 20 mm/s: a step every third tick, each within the doubt
  const double exact = 0.03 * 0.02 * 0.02;
  CHECK(credit(0.032) > 0.6 * exact);
  CHECK(credit(0.128) > 0.85 * exact);
  CHECK(credit(0.128) < exact);
}

TEST_CASE("a way back takes no credit away that the way out has earned", "[quantised]") {
  auto observer = at<d1>(sure());
  double last = 0.0;
  for (int n = 0; n < 60; ++n) {
    const double way = n % 20 < 10 ? step : -step;
    REQUIRE(observer.update(n % 2 == 0 ? way : 0.0, 0.0, 1e-3));
    CHECK(observer.value() >= last);
    last = observer.value();
  }
  CHECK(last > 0.0);
}

TEST_CASE("rounding only takes from what the damper has taken", "[quantised]") {
  const auto wide = [](float x) { return static_cast<double>(x); };
  ph::laws::samples random(1);
  for (int n = 0; n < 1000; ++n) {
    auto observer = at<f1>(sure(0.0));
    const float dx = random.number<float>(), dt = 1e-3F * (1.5F + random.number<float>() / 2.0F);
    REQUIRE(observer.update(dx, 0.0F, dt));
    const double exactly = wide(0.03F) * wide(dx) * wide(dx) / wide(dt);
    REQUIRE(wide(observer.value()) <= exactly);
    REQUIRE(wide(observer.value()) >=
            exactly * (1 - 256 * wide(std::numeric_limits<float>::epsilon())));
  }
}

TEST_CASE("a cap of zero keeps no credit on steps either, and a debt stays", "[quantised]") {
  auto parameters = sure(1e-7);
  parameters.cap = 0.0;
  CHECK_FALSE(parameters.check());
  auto observer = at<d1>(parameters);
  (void)observer.update(1e-3, -1.0, 1e-3);  // pressing in
  CHECK(observer.value() <= 0.0);
  CHECK_THAT(observer.value(), WithinAbs(0.0, 1e-15));
  (void)observer.update(-1e-3, -1.0, 1e-3);
  CHECK(observer.value() < -9e-4);
}

TEST_CASE("quantised_energy keeps the laws of an observer", "[quantised]") {
  CHECK(broken_laws<d1, f3>(sure(1e-5)).empty());
  using joints = ph::basic_quantised_energy<ph::diagonal_damping<4>>;
  const joints arm{.damping = {{0.03, 0.1, 0.5, 0.01}}, .quantum = 1e-5};
  CHECK(broken_laws<ph::joint_space<double, 4>>(arm).empty());
}

TEST_CASE("strict_bound on quantised_energy loses nothing in a quick run, on the plain one it does",
          "[quantised]") {
  CHECK(worst_attack<d1>(sure(), 4) >= -1e-12);
  CHECK(worst_attack<d1>(thesis_ledger(), 4) < -1e-5);  // the control
}

TEST_CASE("a bad parameter of quantised_energy is refused with its name", "[quantised]") {
  using ledger = ph::quantised_energy;
  CHECK(refused(ledger{.damping = 0.03, .quantum = step}).empty());
  CHECK(refused(ledger{.damping = 0.0, .quantum = step}) == "damping");
  CHECK(refused(ledger{.damping = 0.03, .quantum = -1.0}) == "quantum");
  CHECK(refused(ledger{.damping = 0.03, .quantum = std::nan("")}) == "quantum");
  CHECK(refused(ledger{.damping = 0.03, .cap = -1.0}) == "cap");
  CHECK(refused(ledger{.damping = 0.03, .window = 0.0}) == "window");
  CHECK(refused(ledger{.damping = 0.03, .loan = -1.0}) == "loan");
}

TEST_CASE("quantised_energy takes new parameters, keeps its energy and starts anew",
          "[quantised]") {
  const ph::quantised_energy first{.damping = 0.03, .quantum = 1e-7},
      coarse{.damping = 0.03, .quantum = 1e-5}, bad{.damping = 0.03, .quantum = -1.0};
  const auto model = following_half_space<d1>(ph::spring{}, first, ph::strict_bound{});
  check_upkeep(model, first, ph::quantised_energy{.damping = 0.02, .quantum = 1e-7}, bad);
  // a coarser step is a doubt about the force that is held now, too: half of it, and no more
  auto pressed = model;
  (void)pressed.update(wall<d1>(1e4));
  double held = 0.0, force = 0.0;  // over the last tick, and over the next
  for (int n = 0; n < 50; ++n) held = std::exchange(force, pressed.tick(n * 1e-4, 1ms).force);
  const double before = pressed.energy();
  REQUIRE(held < -0.1);
  CHECK_FALSE(pressed.set(coarse));
  CHECK_THAT(pressed.energy(), WithinAbs(before + 0.5 * (1e-5 - 1e-7) * held, 1e-15));
}

TEST_CASE("what nobody saw costs a ledger of steps the smaller of two bounds",
          "[quantised_energy]") {
  const auto left = [](double most) {
    auto ledger = at<d1>(ph::quantised_energy{.damping = {0.03}, .quantum = 1e-5, .loan = 1.0});
    ledger.forfeit(3.0, 1e-3, most);
    return ledger.value();
  };
  CHECK_THAT(1.0 - left(0.01), Catch::Matchers::WithinRel(0.01, 1e-9));
  CHECK_THAT(1.0 - left(10.0), Catch::Matchers::WithinRel(9.0 * 1e-3 / 0.12, 1e-9));
}
