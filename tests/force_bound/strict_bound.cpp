// SPDX-License-Identifier: BSD-3-Clause
// strict_bound: its formula, in a late loop, with dry friction, and how it rounds. Adversaries are in
// tests/full/.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"

using Catch::Matchers::WithinRel;
namespace k = ph::kernels;

TEST_CASE("strict_bound obeys the laws of strict bounds", "[bound][law]") {
  CHECK(broken_laws<d1, f3>(ph::strict_bound{}).empty());
}

TEST_CASE("strict_bound is √(4 B E1) in one dimension (2.17)", "[bound]") {
  const auto bound = at<d1>(ph::strict_bound{});
  const auto limit = [&](double desired, double energy) {
    return allowed(bound, desired, situation<d1>{.energy = energy});
  };
  CHECK_THAT(limit(-50.0, 0.01), WithinRel(-std::sqrt(1.2), 1e-14));
  CHECK(limit(-1.0, 0.01) == -1.0);
  CHECK(limit(-1.0, 0.0) == 0.0);
  CHECK(limit(-1.0, -1.0) == 0.0);
}

TEST_CASE("strict_bound keeps the direction where all axes are damped alike (2.15, A4, A7)",
          "[bound]") {
  const situation<d3> now{.energy = 0.01};
  const d3::vector desired(3, 0, 4);
  const auto bound = at<d3>(ph::strict_bound{});
  const d3::vector f = allowed(bound, desired, now);
  CHECK((f.normalized() - desired.normalized()).norm() < 1e-15);
  CHECK_THAT(f.norm(), WithinRel(std::sqrt(4 * 0.01 * 30), 1e-14));  // 2.17
}

TEST_CASE("strict_bound with latency counts what is in flight (§ 3)", "[bound]") {
  const auto bound = at<d1>(ph::strict_bound{});
  static_assert(ph::strict_bound::traits.latency == ph::any_latency);
  using two_ticks_late = situation<d1, ph::isotropic_damping, 2>;
  const auto limit = [&](double newest, double before, double held) {
    const two_ticks_late now{.energy = 0.01, .commanded = {newest, before, held}};
    return allowed(bound, -50.0, now);
  };
  // f²/(4B) of each: 3 mJ and 4 mJ; the last is held already and in the ledger
  CHECK_THAT(limit(std::sqrt(0.36), -std::sqrt(0.48), 9.0),
             WithinRel(-std::sqrt(4 * 30 * 0.003), 1e-13));
  CHECK_THAT(limit(0.0, 0.0, 9.0), WithinRel(-std::sqrt(4 * 30 * 0.01 / 3), 1e-13));  // its share
  CHECK(limit(std::sqrt(2.4), 0.0, 0.0) == 0.0);                                      // 20 mJ
}

TEST_CASE("strict_bound with friction is f_c + √(4 B E1), and the worst motion just empties it",
          "[bound][friction]") {
  sim::random_source random(13);
  const auto bound = at<d1>(ph::strict_bound{});
  for (int i = 0; i < 300; ++i) {
    const double b = random.uniform(0.005, 0.1), fc = random.uniform(0.0, 0.5);
    const double T = random.uniform(0.2e-3, 2e-3), B = b / T;
    const double E = random.chance(0.1) ? 0.0 : std::pow(10.0, random.uniform(-7.0, -1.0));
    const ph::damping_and_friction damping{b, fc, 0.0};
    situation<d1, ph::damping_and_friction> now{
        .damping = at<d1>(damping), .energy = E, .dt = T, .longest_tick = T};
    const double f = allowed(bound, 1e6, now);
    REQUIRE_THAT(f, WithinRel(fc + std::sqrt(4 * B * E), 1e-13));
    const double worst = (f - fc) / (2 * B);
    double least = attacks::inf;
    for (int step = 0; step <= 4000; ++step) {
      const double s = worst * step / 1000;  // up to four times the worst
      least = std::min(least, E + B * s * s + fc * s - f * s);
    }
    REQUIRE(least >= -1e-15 * (1 + E));
    const double passed = E + f * std::abs(worst);
    // only rounding is left: the margin of 64 ε, and what this very sum rounds
    REQUIRE(least <= 72 * std::numeric_limits<double>::epsilon() * passed);
    now.energy = -1e-9;
    REQUIRE(allowed(bound, 1e6, now) == 0.0);
  }
}

TEMPLATE_TEST_CASE("rounding leaves no debt with friction but a few ulps of what was counted",
                   "[bound][rounding]", d1, f1) {
  using scalar = typename TestType::scalar;
  const ph::dual_ledger started{.damping = {0.03, 0.2, 0.0}};
  const auto bound = at<TestType>(ph::strict_bound{});
  const scalar T = scalar(1e-3), B = scalar(0.03) / T, fc = scalar(0.2);
  auto observer = at<TestType>(started);
  ph::laws::samples random(1);
  scalar by_hand(0), least(0), least_by_hand(0), most(0);
  int filled = 0;
  for (int n = 0; n < 100000; ++n) {
    situation<TestType, ph::damping_and_friction> now{.damping = observer.damping(),
                                                      .energy = observer.value()};
    const scalar asked = random.number<scalar>() * scalar(50);
    const scalar force = allowed(bound, asked, now);
    const bool worst = n % 8 != 0;
    const scalar off = scalar(1) + random.number<scalar>() * scalar(8) *
                                       k::square_root(std::numeric_limits<scalar>::epsilon());
    // The worst motion against the force allowed; or a push, which pays for the next ones.
    const auto motion = [&](scalar f) {
      const scalar beyond = k::larger(k::magnitude(f) - fc, scalar(0)) / (scalar(2) * B);
      const scalar push = (f == scalar(0) ? scalar(0.1) : -f) * scalar(1e-4);
      return worst ? (f < scalar(0) ? -beyond : beyond) * off : push;
    };
    REQUIRE(observer.update(motion(force), force, T));
    least = k::smaller(least, observer.value());
    most = k::larger(most, observer.value());
    filled += observer.value() > scalar(1e-6) ? 1 : 0;

    // The control: the same formulas as they stand, and nothing forgiven.
    const scalar limit = fc + k::square_root(scalar(4) * B * k::larger(by_hand, scalar(0)));
    const scalar plain = asked < scalar(0) ? k::larger(asked, -limit) : k::smaller(asked, limit);
    const scalar dx = motion(plain);
    by_hand += B * dx * dx + fc * k::magnitude(dx) - plain * dx;
    least_by_hand = k::smaller(least_by_hand, by_hand);
  }
  CHECK(filled > 10000);
  CHECK(least >= scalar(-4) * std::numeric_limits<scalar>::epsilon() * most);
  CAPTURE(least / most / std::numeric_limits<scalar>::epsilon(),
          least_by_hand / most / std::numeric_limits<scalar>::epsilon());
  CHECK(least_by_hand < scalar(-4) * std::numeric_limits<scalar>::epsilon() * most);
}

TEST_CASE("strict_bound loses nothing to motions in a quick run, one that gives more does",
          "[passivity]") {
  const attacks::conditions troubles{
      .jitter = true, .lost = 0.02, .late = 0.02, .longest_tick = 1.5e-3, .force_limit = 0.3};
  for (const auto& when : {attacks::conditions{}, troubles}) {
    CHECK(attacks::least_of<d1>(ph::strict_bound{}, when, 4) >= -1e-12);
    CHECK(attacks::least_of<d3>(ph::strict_bound{}, when, 4) >= -1e-12);
    CHECK(attacks::least_of<d1>(attacks::generous<ph::strict_bound>{}, when, 4) < -1e-8);
  }
}
