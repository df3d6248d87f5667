// SPDX-License-Identifier: BSD-3-Clause
// Rounding must not break passivity: the force that a bound returns keeps its promise in EXACT
// arithmetic, whatever the energy, in all four rounding modes. The control of each test is the same
// formula without its margin. exhaustive.cpp tries every float there is.
#include "support/catch.hpp"
#include "support/exact.hpp"
#include "support/scenes.hpp"

#include <cfenv>

namespace k = ph::kernels;

namespace {

struct rounding {
  explicit rounding(int mode) { std::fesetround(mode); }
  ~rounding() { std::fesetround(FE_TONEAREST); }
  rounding(const rounding&) = delete;
  rounding& operator=(const rounding&) = delete;
};

int any_mode() {
  return GENERATE(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO);
}

template <class Scalar>
Scalar any_energy(ph::laws::samples& random) {
  if constexpr (std::is_same_v<Scalar, float>) {
    return exact::any_positive_float(random);
  } else {
    return std::ldexp(1.5 + random.number<double>() / 2.0,
                      static_cast<int>(random.bits() % 500U) - 300);
  }
}

/// A force near the one that costs all of E1: the branch "covered already" decides here.
template <class Scalar>
Scalar near_the_bound(Scalar E1, Scalar b, Scalar T, int steps) {
  const double wide =
      std::sqrt(4.0 * static_cast<double>(b) / static_cast<double>(T) * static_cast<double>(E1));
  const auto eps = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  return static_cast<Scalar>(std::fmin(wide * (1.0 + steps * eps / 2.0),
                                       static_cast<double>(std::numeric_limits<Scalar>::max())));
}

}  // namespace

TEMPLATE_TEST_CASE("strict_force_bound keeps f² ≤ 4BE1 in exact arithmetic in every rounding mode",
                   "[rounding]", float, double) {
  const rounding mode(any_mode());
  ph::laws::samples random(1);
  int naive_overdrafts = 0, tight = 0;
  const int samples = 300000;
  for (int i = 0; i < samples; ++i) {
    const TestType E = any_energy<TestType>(random);
    const TestType B = std::ldexp(TestType(1.5) + random.number<TestType>() / TestType(2),
                                  static_cast<int>(random.bits() % 30U) - 10);
    const TestType f = k::strict_force_bound(E, B);
    if (!exact::covered(f, E, B)) FAIL("E1 = " << E << ", B = " << B << ", f = " << f);
    const TestType naive = k::square_root(TestType(4) * B * E);
    naive_overdrafts += exact::covered(naive, E, B) ? 0 : 1;
    const TestType eps = std::numeric_limits<TestType>::epsilon();
    tight += !k::is_finite(naive) || f >= naive * (TestType(1) - TestType(64) * eps) ? 1 : 0;
  }
  const bool rounds_down = std::fegetround() == FE_DOWNWARD || std::fegetround() == FE_TOWARDZERO;
  if (!rounds_down) CHECK(naive_overdrafts > samples / 5);  // the control
  CHECK(tight > samples * 8 / 10);  // and the bound is no tighter than rounding asks for
}

TEST_CASE("an affordable force keeps Tf² ≤ 4bE1 in exact arithmetic, asked for much or just enough",
          "[rounding]") {
  const rounding mode(any_mode());
  ph::laws::samples random(2);
  // Where overflow ends at the largest number instead of infinity it goes unseen: § Rounding.
  const bool saturates = std::fegetround() == FE_DOWNWARD || std::fegetround() == FE_TOWARDZERO;
  const float most = saturates ? 1e16F : std::numeric_limits<float>::max();
  int naive_overdrafts = 0, whole = 0, cut = 0;
  for (const float b : {1e-6F, 0.03F, 7.0F, 1e3F}) {
    for (const float T : {1e-5F, 1e-3F, 0.1F}) {
      const ph::part_at<ph::isotropic_damping, f1> damping(static_cast<double>(b));
      for (int i = 0; i < 30000; ++i) {
        const float E = any_energy<float>(random);
        const int steps = static_cast<int>(random.bits() % 65U) - 48;
        const float asked = std::min(
            i % 2 == 0 ? near_the_bound(E, b, T, steps) : exact::any_positive_float(random), most);
        const float scale = damping.affordable(asked, E, T);
        if (!exact::covered(asked * scale, E, b, T)) {
          FAIL("E1 = " << E << ", b = " << b << ", T = " << T << ", f* = " << asked);
        }
        (scale == 1.0F ? whole : cut) += 1;
        const float naive = damping.worst_outflow(asked, T) <= E ? asked : 0.0F;
        naive_overdrafts += exact::covered(naive, E, b, T) ? 0 : 1;
      }
    }
  }
  CHECK(whole > 10000);
  CHECK(cut > 10000);
  if (std::fegetround() == FE_TONEAREST) CHECK(naive_overdrafts > 1000);  // the control
}

TEMPLATE_TEST_CASE("in three dimensions, with unequal axes, with friction: the same", "[rounding]",
                   f3, d3) {
  using scalar = typename TestType::scalar;
  using wide = long double;
  const rounding mode(any_mode());
  const wide margin = sizeof(wide) > sizeof(double) || sizeof(scalar) == 4 ? 1e-15L : 0.0L;
  ph::laws::samples random(3);
  const scalar T = scalar(1e-3);
  const auto same = at<TestType>(ph::isotropic_damping{0.03});
  const auto unequal = at<TestType>(ph::diagonal_damping<3>{{0.03, 0.011, 0.7}});
  const auto rubbing = at<TestType>(ph::damping_and_friction{0.03, 0.2, 1e-5});
  const auto outflow = [&](const auto& f, auto along) {
    wide sum = 0;
    for (int i = 0; i < 3; ++i) sum += wide(f(i)) * wide(f(i)) / wide(along(i));
    return sum * wide(T) / 4;
  };
  int cut = 0;
  for (int i = 0; i < 100000; ++i) {
    const scalar E = std::ldexp(scalar(1.5) + random.number<scalar>() / scalar(2),
                                static_cast<int>(random.bits() % 60U) - 50);
    const typename TestType::vector direction = random.direction<TestType>();
    const scalar length =
        near_the_bound(E, scalar(0.03), T, i % 2 == 0 ? static_cast<int>(i % 64) - 32 : 1 << 20);
    const typename TestType::vector asked = direction * length;
    const auto applied = [&](const auto& damping) {
      const scalar scale = damping.affordable(asked, E, T);
      cut += scale < scalar(1) ? 1 : 0;
      return typename TestType::vector(asked * scale);
    };
    const wide most = wide(E) * (1 + margin);
    const auto isotropic = [](int) { return wide(scalar(0.03)); };
    if (!(outflow(applied(same), isotropic) <= most)) FAIL("isotropic, E1 = " << E);
    const auto diagonal = [&](int j) { return wide(unequal.along_axis(j)); };
    if (!(outflow(applied(unequal), diagonal) <= most)) FAIL("diagonal, E1 = " << E);
    const typename TestType::vector rubbed = applied(rubbing);
    wide square = 0;
    for (int j = 0; j < 3; ++j) square += wide(rubbed(j)) * wide(rubbed(j));
    const wide beyond = std::max(wide(0), std::sqrt(square) - wide(scalar(0.2)));
    if (!(wide(T) * beyond * beyond / 4 <= most * wide(scalar(0.03)))) FAIL("friction, " << E);
  }
  CHECK(cut > 50000);
}

TEMPLATE_TEST_CASE(
    "reachable_force_bound keeps Fs − Bs² ≤ E1 on the whole reach in exact arithmetic",
    "[rounding]", float, double) {
  // A grid over twelve decades each way, and where the slack was least, random points around it.
  const rounding mode(any_mode());
  using wide = std::conditional_t<std::is_same_v<TestType, float>, double, long double>;
  ph::laws::samples random(4);
  const auto judged = [&](TestType E, TestType B, TestType reach) {
    const TestType F = k::reachable_force_bound(E, B, reach);
    if (!exact::reach_covered<wide>(F, E, wide(B), reach)) {
      FAIL("E1 = " << E << ", B = " << B << ", reach = " << reach << ", F = " << F);
    }
    // The control: the same without the margin, which is what the formula says.
    const TestType plain =
        B * reach * reach < E ? E / reach + B * reach : k::square_root(TestType(4) * B * E);
    return !exact::reach_covered<wide>(plain, E, wide(B), reach);
  };
  int naive_overdrafts = 0;
  for (int e = -40; e <= 12; e += 4) {
    for (int n = -12; n <= 24; n += 3) {
      for (int r = -32; r <= 4; r += 2) {
        for (int i = 0; i < 12; ++i) {
          const auto near = [&](int exponent) {
            return std::ldexp(TestType(1.5) + random.number<TestType>() / TestType(2), exponent);
          };
          const TestType E = near(e), B = near(n);
          naive_overdrafts += judged(E, B, near(r)) ? 1 : 0;
          // Refined: around the reach where the two branches meet, within 64 ulps of it.
          const TestType meet = k::square_root(E / B);
          const auto ulps = static_cast<TestType>(static_cast<int>(random.bits() % 129U) - 64);
          const TestType step = ulps * std::numeric_limits<TestType>::epsilon();
          naive_overdrafts += judged(E, B, meet * (TestType(1) + step)) ? 1 : 0;
        }
      }
    }
  }
  if (std::fegetround() == FE_TONEAREST) CHECK(naive_overdrafts > 1000);
}

TEMPLATE_TEST_CASE("reachable_bound's own force is covered over the reach it worked with",
                   "[rounding]", f3, d3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  using wide = long double;
  ph::laws::samples random(5);
  const auto damping = at<TestType>(ph::isotropic_damping{0.03});
  const auto bound = at<TestType>(ph::reachable_bound{.mass = 0.1, .hand_force = 5});
  int cut = 0;
  for (int i = 0; i < 100000; ++i) {
    const vector normal = random.direction<TestType>();
    const scalar E = std::ldexp(scalar(1), -static_cast<int>(random.bits() % 40U));
    const vector moved = random.direction<TestType>() *
                         std::ldexp(scalar(1), -static_cast<int>(8U + random.bits() % 16U));
    const vector held = normal * std::ldexp(scalar(1), static_cast<int>(random.bits() % 8U) - 4);
    const vector asked = normal * std::ldexp(scalar(1.3), static_cast<int>(random.bits() % 12U));
    const situation<TestType> now{.energy = E, .held = held, .travel = moved};
    const vector force = allowed(bound, asked, now);
    if (force == asked) continue;
    ++cut;
    const scalar B = damping.per_tick(asked, scalar(1e-3));
    const scalar outward = TestType::dot(moved, asked) / asked.norm();
    const scalar reach = k::outward_reach(outward, held.norm(), asked.norm(),
                                          scalar(5) + scalar(2) * B * moved.norm(), scalar(0.1),
                                          scalar(1e-3), scalar(1e-3));
    wide square = 0;
    for (int j = 0; j < 3; ++j) square += wide(force(j)) * wide(force(j));
    const wide F = std::sqrt(square);
    const wide exact_B = wide(scalar(0.03)) / wide(scalar(1e-3));
    if (!exact::reach_covered<wide>(F, wide(E), exact_B, wide(reach))) {
      FAIL("E1 = " << E << ", reach = " << reach << ", F = " << static_cast<double>(F));
    }
  }
  CHECK(cut > 10000);
}

TEMPLATE_TEST_CASE("the worst motion of a tick leaves no debt, however it rounds", "[rounding]",
                   float, double) {
  using line = ph::space<TestType, 1>;
  const rounding mode(any_mode());
  ph::laws::samples random(6);
  int debts_without_margin = 0;
  const TestType T = TestType(1e-3);
  for (int i = 0; i < 100000; ++i) {
    const TestType E = std::ldexp(TestType(1.5) + random.number<TestType>() / TestType(2),
                                  static_cast<int>(random.bits() % 40U) - 30);
    const auto worst_motion = [&](TestType force) {
      auto ledger = at<line>(ph::reduced_energy{.damping = 0.03, .loan = static_cast<double>(E)});
      const TestType off =
          TestType(1) + random.number<TestType>() * TestType(8) *
                            k::square_root(std::numeric_limits<TestType>::epsilon());
      (void)ledger.update(force / (TestType(2) * (TestType(0.03) / T)) * off, force, T);
      return ledger.value();
    };
    const TestType B = TestType(0.03) / T;
    const TestType most = k::strict_force_bound(E, B);
    if (worst_motion(most) < TestType(0)) FAIL("E1 = " << E);
    debts_without_margin += worst_motion(k::square_root(TestType(4) * B * E)) < TestType(0);
  }
  CHECK(debts_without_margin > 1000);  // the control
}

TEMPLATE_TEST_CASE("memoryless_bound carries no rounding from force to force", "[rounding]", f1,
                   d1) {
  using scalar = typename TestType::scalar;
  using wide = long double;
  const rounding mode(any_mode());
  ph::laws::samples random(7);
  const scalar T = scalar(0x1p-10), b = scalar(0.03125);
  const auto damping = at<TestType>(ph::isotropic_damping{0.03125});
  // Presses for a while, then takes back nearly all it can. What a force can cost, ¼ fᵀB⁻¹f, is what
  // the last one could and what the tick brought, and no more.
  const auto least_spare = [&](const auto& law) {
    const auto cost = [&](scalar f) { return wide(T) * wide(f) * wide(f) / (4 * wide(b)); };
    wide least = 0;
    scalar held(0);
    for (int n = 0; n < 200000; ++n) {
      const int close = 3 + static_cast<int>(random.bits() % 9U);  // the nearer, the less is left
      const scalar off = scalar(1) + std::ldexp(random.number<scalar>(), -close);
      const scalar moved = n % 20 < 10 ? -scalar(1e-4) * off : held / (scalar(2) * b / T) * off;
      const scalar force = law(held, moved);
      const wide brought = wide(b) * wide(moved) * wide(moved) / wide(T) - wide(held) * wide(moved);
      if (force > scalar(0)) least = std::min(least, cost(held) + brought - cost(force));
      held = force;
    }
    return least;
  };
  const auto bound = at<TestType>(ph::memoryless_bound{});
  CHECK(least_spare([&](scalar held, scalar moved) {
          const situation<TestType> now{
              .damping = damping, .dt = T, .longest_tick = T, .held = held, .travel = moved};
          return allowed(bound, scalar(1e3), now);
        }) >= 0);
  // The control: the formula as it stands.
  const wide naive = least_spare([&](scalar held, scalar moved) {
    const scalar credit =
        damping.worst_outflow(held, T) + damping.dissipated(moved, T) - held * moved;
    return credit > scalar(0) ? k::square_root(scalar(4) * b / T * credit) : scalar(0);
  });
  if (std::fegetround() == FE_TONEAREST) CHECK(naive < 0);
}

TEST_CASE("an empty ledger, one in debt and no number at all allow nothing", "[rounding]") {
  for (const float E : {0.0F, -0.0F, -1.0F, std::numeric_limits<float>::denorm_min(),
                        std::numeric_limits<float>::min(), -std::numeric_limits<float>::infinity(),
                        std::numeric_limits<float>::quiet_NaN()}) {
    CHECK(k::strict_force_bound(E, 30.0F) == 0.0F);
    CHECK(k::strict_scale(E, 1.0F) == 0.0F);
    CHECK(k::reachable_force_bound(E, 30.0F, 1e-3F) == 0.0F);
  }
  CHECK(k::strict_force_bound(1e-6F, 30.0F) > 0.0109F);  // the control: √(1.2e-4)
}
