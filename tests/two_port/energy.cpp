// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "two_port/sides.hpp"
#include <passive_haptics/laws.hpp>

#include <limits>

using namespace two_ends;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using energy1 = ph::two_port_energy;
static_assert(ph::energy_observer_for<ph::two_port_energy, d3>);
static_assert(ph::energy_observer_for<ph::two_port_energy, f2>);
static_assert(ph::laws::never_overstates<d1>(energy1{.damping = 0.03}));
static_assert(ph::laws::never_overstates<d1>(energy1{.damping = 0.03, .share = 0.0}));
static_assert(ph::laws::forfeit_never_credits<d1>(energy1{.damping = 0.03}));

constexpr double after(const energy1& told, double dx, double held) {
  auto observer = at<d1>(told);
  observer.update(dx, held, 1e-3);
  return observer.value();
}
constexpr bool is_rounded_down(double value, double exact) {
  return value <= exact && value > exact - 1e-14;
}
// b dx²/dt = 0.03 J for dx = 1 m; the hand puts in 2 J, or takes out 2 J.
static_assert(is_rounded_down(after({.damping = 3e-5}, -1.0, 2.0), 0.03));
static_assert(is_rounded_down(after({.damping = 3e-5, .share = 0.25}, -1.0, 2.0), 1.53));
static_assert(is_rounded_down(after({.damping = 3e-5}, 1.0, 2.0), -1.97));

}  // namespace

TEST_CASE("two_port_energy is D + E_in_rx − E_out: what the hand puts in is promised, not kept",
          "[two_port]") {
  sim::random_source random(5);
  auto observer = at<d3>(energy1{.damping = 0.5});
  double damped = 0.0, in = 0.0, out = 0.0, other = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double length = random.uniform(0.0, 1e-3), strength = random.uniform(0.0, 5.0);
    const d3::vector dx = random.direction<d3>() * length;
    const d3::vector held = random.direction<d3>() * strength;
    observer.update(dx, held, 1e-3);
    damped += 0.5 * dx.squaredNorm() / 1e-3;
    in += std::max(-held.dot(dx), 0.0);
    out += std::max(held.dot(dx), 0.0);
    other += random.uniform(0.0, 1e-3);
    observer.receive(other);
  }
  CHECK_THAT(observer.outgoing(), WithinRel(in, 1e-12));
  CHECK_THAT(observer.value(), WithinAbs(damped + other - out, 1e-12));
}

TEST_CASE("a promise counts once, in whatever order and number its packets come", "[two_port]") {
  auto observer = at<d1>(energy1{.damping = 0.03, .loan = 1.0});
  for (const double promised : {0.2, 0.5, 0.3, 0.5, 0.2, std::nan(""), -1.0,
                                std::numeric_limits<double>::infinity(), 0.4}) {
    observer.receive(promised);
  }
  CHECK_THAT(observer.value(), WithinAbs(1.5, 1e-15));
  observer.receive(0.75);
  CHECK_THAT(observer.value(), WithinAbs(1.75, 1e-15));
  CHECK(observer.outgoing() == 0.0);

  auto capped = at<d1>(energy1{.damping = 0.03, .cap = 0.1});
  capped.receive(5.0);
  CHECK(capped.value() == 0.1);
}

TEST_CASE("pressed slowly, strict_bound over two_port_energy shows 2B(1 − share) (L4)",
          "[two_port]") {
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    const double b = 0.03, T = 1e-3, step = 1e-7;
    auto master = side_of({.damping = b, .share = share});
    master.receive({0.0, 1, 100.0});
    double x = 0.0, force = 0.0;
    for (int n = 0; n < 100000; ++n) {
      force = master.tick(x, ph::seconds{T}).force;
      x -= step;
    }
    CHECK_THAT(force / -x, WithinAbs(2 * b / T * (1 - share), 0.7));
  }
}
