// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/base/kernels.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>

namespace k = passive_haptics::kernels;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// min over |Δx| ≤ reach of BΔx² − fΔx, by looking.
double worst_motion(double f, double B, double from, double to) {
  double least = 0;
  for (int i = 0; i <= 200000; ++i) {
    const double dx = from + (to - from) * i / 200000.0;
    least = std::min(least, B * dx * dx - f * dx);
  }
  return least;
}

}  // namespace

/// A number that is none of the language's own: what a user brings, as a fixed-point one would be.
struct own_number {
  double value = 0.0;
  own_number() = default;
  explicit own_number(double of) : value(of) {}
  friend own_number operator+(own_number a, own_number b) { return own_number(a.value + b.value); }
  friend own_number operator-(own_number a, own_number b) { return own_number(a.value - b.value); }
  friend own_number operator*(own_number a, own_number b) { return own_number(a.value * b.value); }
  friend own_number operator/(own_number a, own_number b) { return own_number(a.value / b.value); }
  friend own_number operator-(own_number a) { return own_number(-a.value); }
  friend bool operator==(own_number a, own_number b) = default;
  friend std::partial_ordering operator<=>(own_number a, own_number b) = default;
};

template <>
struct std::numeric_limits<own_number> : std::numeric_limits<double> {
  static own_number max() { return own_number(std::numeric_limits<double>::max()); }
};

TEST_CASE("worst_outflow is the minimum over all motions of the next tick (L3)", "[kernels]") {
  for (const double f : {0.0, 0.3, -2.0, 9.0}) {
    for (const double B : {0.5, 30.0, 1000.0}) {
      const double reach = 2.0 * std::abs(f) / B + 1e-9;
      CHECK_THAT(k::worst_outflow(f, B), WithinAbs(-worst_motion(f, B, -reach, reach), 1e-9));
    }
  }
}

TEST_CASE("strict_force_bound spends the ledger to rounding and nothing in debt (2.17, A6)",
          "[kernels]") {
  const double eps = std::numeric_limits<double>::epsilon();
  CHECK_THAT(k::strict_force_bound(0.01, 30.0), WithinRel(std::sqrt(1.2), 40 * eps));
  CHECK_THAT(k::worst_outflow(k::strict_force_bound(0.01, 30.0), 30.0), WithinRel(0.01, 80 * eps));
  CHECK(k::strict_force_bound(0.0, 30.0) == 0.0);
  CHECK(k::strict_force_bound(-1e-3, 30.0) == 0.0);
  static_assert(k::strict_force_bound(1.0, 1.0) < 2.0);  // towards zero, by 32 ε
  static_assert(k::strict_force_bound(1.0, 1.0) >
                2.0 - 80 * std::numeric_limits<double>::epsilon());
  static_assert(k::strict_force_bound(-1.0, 1.0) == 0.0);
}

TEST_CASE("rounding is paid for by the margins that the proof counts (docs/design/stability.md)",
          "[kernels]") {
  const double eps = std::numeric_limits<double>::epsilon();
  const double least = std::numeric_limits<double>::min() / eps;
  CHECK(k::rounding<double>() == 16 * eps);
  CHECK(k::spendable(1.0) == 1.0 - 64 * eps);
  CHECK(k::spendable(0.0) == -least);
  CHECK(k::spendable(-1.0) < -1.0 + 65 * eps);
  CHECK(k::sure_gain(1.0, 0.25, 0.5) == 0.75 - 24 * eps);
  CHECK(k::sum_rounded_down(1.0, 0.75 * eps) == 1.0);  // which rounds to 1 + ε
  CHECK(k::sum_rounded_down(1.0, -eps / 8) < 1.0);     // which rounds to 1
  CHECK(k::sum_rounded_down(1.0, 0.5) == 1.5);
  CHECK(k::outward_reach(0.0, 1.0, 1.0, 0.0, 0.5, 1.0, 1.0) == 2.0 + 32 * eps);
  CHECK(k::reachable_force_bound(1.0, 0.25, 1.0) <= 1.25 - 80 * eps);
  CHECK(k::reachable_force_bound(1.0, 0.25, 1.0) >= 1.25 - 90 * eps);
  CHECK(k::reachable_share(0.5, 1.0, 1.0) <= 0.75 - 42 * eps);
  CHECK(k::reachable_share(0.5, 1.0, 1.0) >= 0.75 - 48 * eps);
  CHECK(k::strict_scale(0.25, 1.0) <= 0.5 - 15 * eps);
  CHECK(k::strict_scale(0.25, 1.0) >= 0.5 - 18 * eps);
}

TEST_CASE("strict_scale never lets the rounded force spend more than the ledger", "[kernels]") {
  int reduced = 0;
  for (int i = 1; i < 20000; ++i) {
    const float E = 1e-7F * static_cast<float>(i * i);
    const float outflow = 3.7e-7F * static_cast<float>(i) * static_cast<float>(20000 - i);
    const auto s = static_cast<long double>(k::strict_scale(E, outflow));
    reduced += s < 1.0L ? 1 : 0;
    if (!(s * s * static_cast<long double>(outflow) <= static_cast<long double>(E))) {
      FAIL("E = " << E << ", outflow = " << outflow);
    }
  }
  CHECK(reduced > 10000);                          // the control: the factor was at work
  static_assert(k::strict_scale(1.0, 1.0) < 1.0);  // just covered, but for rounding
  static_assert(k::strict_scale(1.0, 0.99999) == 1.0);
  static_assert(k::strict_scale(-1.0, 1.0) == 0.0);
  static_assert(k::strict_scale(0.0, 0.0) == 0.0);
  static_assert(k::strict_scale(-1.0, 0.0) == 0.0);
}

TEST_CASE("reachable_force_bound is the largest force that no reachable motion overdraws (§ 2(a′))",
          "[kernels]") {
  for (const double B : {3.0, 30.0, 300.0}) {
    for (const double E : {1e-9, 1e-6, 1e-3, 0.1}) {
      for (const double reach : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        const double F = k::reachable_force_bound(E, B, reach);
        CHECK(worst_motion(F, B, 0.0, reach) >= -E * (1 + 1e-9));
        CHECK(worst_motion(1.001 * F, B, 0.0, reach) < -E);  // the control: no slack
      }
      const double meet = std::sqrt(E / B);
      CHECK_THAT(k::reachable_force_bound(E, B, meet * (1 - 1e-9)),
                 WithinRel(k::reachable_force_bound(E, B, meet * (1 + 1e-9)), 1e-8));
    }
  }
  CHECK(k::reachable_force_bound(0.0, 30.0, 0.0) == std::numeric_limits<double>::max());
  CHECK(k::reachable_force_bound(0.0, 30.0, -1.0) == std::numeric_limits<double>::max());
  CHECK(k::reachable_force_bound(0.0, 30.0, 1e-6) == 0.0);
  CHECK(k::reachable_force_bound(-1.0, 30.0, 1e-6) == 0.0);
}

TEST_CASE("reachable_outflow is the most that a force hands out within its reach", "[kernels]") {
  for (const double B : {3.0, 30.0, 300.0}) {
    for (const double f : {0.1, 3.0, 20.0}) {
      for (const double reach : {1e-5, 1e-3, 0.1}) {
        CHECK_THAT(k::reachable_outflow(f, B, reach),
                   WithinAbs(-worst_motion(f, B, 0.0, reach), 1e-9 * f * reach));
      }
    }
  }
  CHECK(k::reachable_outflow(5.0, 30.0, 0.0) == 0.0);
  CHECK(k::reachable_outflow(5.0, 30.0, -1.0) == 0.0);
  CHECK(k::reachable_outflow(0.0, 30.0, 1.0) == 0.0);
}

TEST_CASE("reachable_share and reachable_work say in joules what the others say in newtons",
          "[kernels]") {
  for (const double B : {3.0, 30.0, 300.0}) {
    for (const double f : {0.1, 3.0, 20.0}) {
      const double W = k::worst_outflow(f, B);
      for (const double reach : {-1e-3, 0.0, 1e-6, 1e-4, 1e-2}) {
        const double most_work = f * reach;  // η = f δ
        CHECK_THAT(k::reachable_work(W, most_work),
                   WithinRel(k::reachable_outflow(f, B, reach), 1e-12));
        for (const double E : {-1e-3, 0.0, 1e-6, 1e-3, 0.1}) {
          const double left = std::min(f, k::reachable_force_bound(E, B, reach));
          CHECK_THAT(f * k::reachable_share(E, W, most_work), WithinRel(left, 1e-12));
        }
      }
    }
  }
  CHECK(k::reachable_share(0.0, 1.0, std::numeric_limits<double>::max()) == 0.0);  // anything
  CHECK(k::reachable_work(0.0, 1.0) == 0.0);
  CHECK(k::reachable_work(-1.0, 1.0) == 0.0);
  CHECK(k::reachable_work(1.0, -1.0) == 0.0);
}

TEST_CASE("outward_reach bounds a mass under the worst admissible forces, and is met (L6)",
          "[kernels]") {
  const double m = 0.1;
  for (const double T0 : {0.5e-3, 1e-3, 2e-3}) {
    for (const double T : {0.5e-3, 1e-3, 2e-3}) {
      const double held = 3.0, next = 5.0, other = 2.0, v = -0.2;
      const auto travel = [m](double speed, double force, double time) {
        return speed * time + force / m * time * time / 2;
      };
      const double last = travel(v, held + other, T0);
      const double speed = v + (held + other) / m * T0;
      const double coming = travel(speed, next + other, T);
      // Δx = ∫v: with a constant push the travel of the next tick follows exactly.
      CHECK_THAT(k::outward_reach(last, held, next, other, m, T0, T), WithinAbs(coming, 1e-15));
      CHECK(k::outward_reach(0.0, held, next, other, m, T0, T, 1e-3) ==
            k::outward_reach(0.0, held, next, other, m, std::max(T0, 1e-3), T));
      CHECK(k::outward_reach(last, held, next, other, m, T0, T, 3e-3) > coming);
      // Any weaker push in the last tick that gives the same travel ends slower or goes less far.
      const double weaker = v + (last - travel(v, 0.0, T0)) / T0;
      CHECK(travel(weaker, next + other, T) <= coming + 1e-15);
    }
  }
}

TEST_CASE("half_angle_turn stays on the circle and never turns further than asked (A20)",
          "[kernels]") {
  constexpr double largest = std::numeric_limits<double>::max();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double angle :
       {0.0, 1e-9, 1e-4, 0.004, 0.1, 1.0, 3.0, 100.0, 1e9, 1e160, largest, infinite}) {
    const auto turn = k::half_angle_turn(angle);
    CHECK_THAT(turn.cosine * turn.cosine + turn.sine * turn.sine, WithinAbs(1.0, 4e-16));
    const double turned = std::atan2(turn.sine, turn.cosine);
    CHECK(turned <= angle);
    if (angle < 0.2) {
      CHECK_THAT(turned, WithinAbs(angle - angle * angle * angle / 12, std::pow(angle, 5) + 1e-16));
    }
    CHECK_THAT(turn.chord_squared, WithinAbs(2 - 2 * turn.cosine, 1e-15));
  }
}

TEST_CASE("square_root agrees with the library's, at compile time too", "[kernels]") {
  constexpr double root = k::square_root(2.0);
  CHECK_THAT(root, WithinRel(std::sqrt(2.0), 3e-16));
  constexpr double tiny = k::square_root(1e-300);
  CHECK_THAT(tiny, WithinRel(1e-150, 1e-15));
  static_assert(k::square_root(0.0) == 0.0);
  static_assert(k::square_root(1e300) > 0.99e150 && k::square_root(1e300) < 1.01e150);
}

TEST_CASE("is_finite tells numbers from NaN and infinities", "[kernels]") {
  using limits = std::numeric_limits<double>;
  CHECK(k::is_finite(0.0));
  CHECK(k::is_finite(limits::max()));
  CHECK(k::is_finite(limits::denorm_min()));
  CHECK_FALSE(k::is_finite(limits::infinity()));
  CHECK_FALSE(k::is_finite(-limits::infinity()));
  CHECK_FALSE(k::is_finite(limits::quiet_NaN()));
}

TEST_CASE("a held spring leaks K Δx²/2 a tick, and the wrong pairing hides it (L2)", "[kernels]") {
  const double K = 1e4;
  double held = 0, same_sample = 0, squares = 0, d = 0.004, f = K * d;
  for (int n = 1; n <= 1000; ++n) {
    const double next = 0.004 + 0.003 * std::sin(0.37 * n);
    held += f * (next - d);
    same_sample += K * next * (next - d);
    squares += K / 2 * (next - d) * (next - d);
    d = next;
    f = K * d;
  }
  const double stored = K / 2 * (d * d - 0.004 * 0.004);
  CHECK_THAT(held, WithinAbs(stored - squares, 1e-9));
  CHECK_THAT(same_sample, WithinAbs(stored + squares, 1e-9));
  CHECK(squares > 1.0);
}

TEST_CASE("what bounds a path or a turn is what its formula says, rounded up", "[kernels]") {
  using namespace passive_haptics::kernels;
  const auto just_above = [](double bound, double exact) {
    return bound > exact && bound < exact * (1.0 + 1e-14);
  };
  CHECK(just_above(later_reach(2.0, 3.0, 5.0, 4.0, 0.5), 4.0));
  CHECK(just_above(later_reach(0.5, 1.0, 0.0, 2.5, 2.0), 6.0));
  CHECK(just_above(coning(72.0, 0.5, 2.0), 8.0));
  CHECK(just_above(longest_path(1.0, 2.0, 0.25, 2.0, 1.0), 7.75));  // r (T₀/2 + t) is ½
  CHECK(longest_path(1.0, 2.0, 0.2500001, 2.0, 1.0) == largest<double>());
  CHECK(unseen_turn(2.0, 3.0, 2.0) == 14.0);
}

TEST_CASE("the short kernels are what their formulas say, in numbers that do not round",
          "[kernels]") {
  using limits = std::numeric_limits<double>;
  const double nan = limits::quiet_NaN();
  CHECK(k::smaller(1.0, 2.0) == 1.0);
  CHECK(k::smaller(2.0, 1.0) == 1.0);
  CHECK(k::larger(1.0, 2.0) == 2.0);
  CHECK(k::larger(2.0, 1.0) == 2.0);
  CHECK(k::smaller(1.0, nan) == 1.0);  // of NaN and a number the first is taken
  CHECK(k::larger(1.0, nan) == 1.0);
  for (const double zero :
       {0.0, -0.0}) {  // of two that are equal the first is taken, as std::max does
    CHECK(std::signbit(k::smaller(zero, -zero)) == std::signbit(zero));
    CHECK(std::signbit(k::larger(zero, -zero)) == std::signbit(zero));
  }
  CHECK(k::clamped(5.0, -1.0, 2.0) == 2.0);
  CHECK(k::clamped(-5.0, -1.0, 2.0) == -1.0);
  CHECK(k::clamped(0.5, -1.0, 2.0) == 0.5);
  CHECK(k::magnitude(-3.0) == 3.0);
  CHECK(k::magnitude(3.0F) == 3.0F);
  CHECK_FALSE(std::signbit(k::magnitude(-0.0)));
  for (const double x : {-3.0, -0.25, 0.5, 3.0}) {  // also of a number that has no fabs
    CHECK(k::magnitude(own_number(x)).value == std::abs(x));
    CHECK(k::is_finite(own_number(x)));
  }
  CHECK_FALSE(std::signbit(k::magnitude(own_number(0.0)).value));
  CHECK_FALSE(k::is_finite(own_number(-HUGE_VAL)));
  CHECK_FALSE(k::is_finite(own_number(nan)));
  CHECK(k::smallest<float>() == std::numeric_limits<float>::min());
  for (const double x : {0.0, 2.0, 1e-300, 1e300}) CHECK(k::square_root(x) == std::sqrt(x));
  CHECK(k::square_root(2.0F) == std::sqrt(2.0F));

  CHECK(k::damping_per_tick(6.0, 2.0) == 3.0);
  CHECK(k::bank_for_hold(6.0, 2.0, 4.0) == 18.0);
  CHECK(k::depth_bound(6.0, 2.0) == 3.0);
  CHECK(k::depth_bound(6.0, 0.0) == 0.0);
  CHECK(k::depth_bound(6.0, -2.0) == 0.0);
  CHECK(k::sampled_stiffness(10.0, 0.5, 8.0, 2.0) == 1.0);
  CHECK(k::sampled_stiffness(0.5, 0.5, 8.0, 2.0) == 0.5);
  CHECK(k::sampled_damping(4.0, 0.5, 4.0, 16.0, 2.0) == 8.0);
  CHECK(k::sampled_damping(4.0, 0.5, 0.25, 16.0, 2.0) == 2.0);
  const auto right = k::half_angle_turn(2.0);
  CHECK((right.cosine == 0.0 && right.sine == 1.0 && right.chord_squared == 2.0));

  CHECK(k::strict_scale(1e-290, 1e20) == 0.0);  // a share with no root that is a normal number
  CHECK(k::strict_force_bound(1e300, 1e300) == std::sqrt(limits::max()));
  CHECK(k::unseen_arc(2.0) == 4.0 * (0.25 + 2.0 / 29.0));
  CHECK(k::unseen_arc(3.125) == 3.125 * 3.125 * (0.25 + 3.125 / 29.0));
  CHECK(k::unseen_arc(4.0) == 7.1875);
  // Half of |τ| = 2 is 1, which is below 4b/T = 2, and twice as large as 4b/T = 1/2.
  CHECK(k::coning_share(0.5, 4.0, 1.0, 2.0) == 0.5);
  CHECK(k::coning_share(0.5, 4.0, 0.25, 2.0) < 0.25);
  CHECK_THAT(k::coning_share(0.5, 4.0, 0.25, 2.0), WithinRel(0.25, 40 * limits::epsilon()));
}
