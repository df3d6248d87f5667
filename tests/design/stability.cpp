// SPDX-License-Identifier: BSD-3-Clause
// What the static conditions call stable is so on the exact device, and where they draw the line.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/design.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace design = ph::design;
namespace passivity = ph::design::passivity;
namespace stability = ph::design::stability;
namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using design::frequency;
using design::loop;

namespace {

constexpr double T = 1e-3;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr loop thesis{.damping = 0.03, .period = T};

constexpr auto coupling_of(double Kc, double Bc) {
  return [Kc, Bc](frequency w) { return Bc + Kc * T / w.difference(); };
}

/// Does the exact device, alone with a linear spring and damper, swing more and more?
bool unstable(const loop& l, double mass, double K) {
  sim::device<d1> device(
      {.mass = mass, .damping = l.damping, .period = l.period, .start = 1e-3, .latency = l.delay});
  auto sample = device.exchange(0.0);
  double last = sample.position;
  double early = 0.0, late = 0.0;
  const double turn = 2 * design::pi * std::sqrt(mass / K);
  const int window = static_cast<int>(2 * turn / l.period) + 2;
  const int ticks = 200000 + 2 * window;
  for (int n = 0; n < ticks; ++n) {
    const double f = -K * sample.position - l.virtual_damping * (sample.position - last) / l.period;
    last = sample.position;
    sample = device.exchange(f);
    const double x = std::abs(device.position());
    if (n >= window && n < 2 * window) early = std::max(early, x);
    if (n >= ticks - window) late = std::max(late, x);
    if (x > 1e3) return true;
  }
  return late > early;
}

double critical_stiffness(const loop& l, double mass) {
  const double guess = stability::gil_hulin(l);
  double low = 0.5 * guess, high = 1.5 * guess;
  if (unstable(l, mass, low) || !unstable(l, mass, high)) return std::nan("");
  for (int i = 0; i < 10; ++i) {
    const double middle = (low + high) / 2;
    (unstable(l, mass, middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

/// m ẍ + b ẋ + k x = f over a tick, f held: exact, by the series of the matrix exponential.
struct oscillator {
  std::array<std::array<double, 3>, 2> step{};
  double x = 0.0, v = 0.0;

  oscillator(double m, double b, double k) {
    // exp(A T/2¹⁰) by Taylor, then squared ten times; A acts on (x, v, f)
    const double h = T / 1024;
    using matrix = std::array<std::array<double, 3>, 3>;
    const auto times = [](const matrix& p, const matrix& q) {
      matrix r{};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          for (std::size_t n = 0; n < 3; ++n) r[i][j] += p[i][n] * q[n][j];
        }
      }
      return r;
    };
    const matrix a{{{0, h, 0}, {-k / m * h, -b / m * h, h / m}, {0, 0, 0}}};
    matrix sum{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, term = sum;
    for (int n = 1; n < 12; ++n) {
      term = times(term, a);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          term[i][j] /= n;
          sum[i][j] += term[i][j];
        }
      }
    }
    for (int n = 0; n < 10; ++n) sum = times(sum, sum);
    step = {sum[0], sum[1]};
  }
  void hold(double f) {
    const double next = step[0][0] * x + step[0][1] * v + step[0][2] * f;
    v = step[1][0] * x + step[1][1] * v + step[1][2] * f;
    x = next;
  }
};

/// A world that is passive in discrete time: mass, damper and spring by backward differences.
struct world {
  double mass = 0.0, damping = 0.0, stiffness = 0.0;  ///< stiffness infinite: it never moves
};

/// The largest |x| late in a run over the largest early in it: device and hand (m, b, k), coupling,
/// world, each exact. Above 1 it grows.
double growth(oscillator device, double Kc, double Bc, const world& w, int delay) {
  std::array<double, 4> command{};
  device.x = 1e-3;
  double last = device.x, stretch = 0.0, world_at = 0.0, world_speed = 0.0;
  double early = 0.0, late = 0.0;
  const int ticks = 40000;
  for (int n = 0; n < ticks; ++n) {
    const double v = (device.x - last) / T;
    last = device.x;
    // (Bc + Kc T)(v − u) + Kc stretch = (M/T + Bv + Kv T) u + Kv at − (M/T) u_before
    double u = 0.0;
    if (ph::kernels::is_finite(w.stiffness)) {
      const double own = w.mass / T + w.damping + w.stiffness * T;
      const double coupled = Bc + Kc * T;
      u = (coupled * v + Kc * stretch - w.stiffness * world_at + w.mass / T * world_speed) /
          (own + coupled);
    }
    stretch += (v - u) * T;
    world_at += u * T;
    world_speed = u;
    for (std::size_t j = 3; j > 0; --j) command[j] = command[j - 1];
    command[0] = -(Kc * stretch + Bc * (v - u));
    device.hold(command[static_cast<std::size_t>(delay)]);
    const double size = std::abs(device.v);
    if (!(size < 1e6)) return infinity;
    if (n >= ticks / 4 && n < ticks / 2) early = std::max(early, size);
    if (n >= 3 * ticks / 4) late = std::max(late, size);
  }
  return late / early;
}

}  // namespace

TEST_CASE("Gil and Hulin's line is the exact device's within 1 % where it says so",
          "[design][stability]") {
  for (const double mass : {0.05, 0.5}) {
    for (const double b : {0.03, 0.3}) {
      for (const int D : {0, 1, 5}) {
        const loop l{.damping = b, .period = T, .delay = D};
        const double critical = critical_stiffness(l, mass);
        INFO("m " << mass << " b " << b << " D " << D << " K " << critical);
        CHECK_THAT(stability::gil_hulin(l), WithinRel(critical, 0.01));
        CHECK(stability::gil_hulin(l) <= 1.001 * critical);
        CHECK(critical >= 0.998 * passivity::colgate_schenkel(l));  // passive is stable
      }
    }
  }
}

TEST_CASE(
    "with strong virtual damping the device is unstable below Gil and Hulin's line, as it says",
    "[design][stability]") {
  const loop mild{.damping = 0.03, .period = T, .delay = 5, .virtual_damping = 1.0};
  const loop strong{.damping = 0.03, .period = T, .delay = 5, .virtual_damping = 5.0};
  CHECK_THAT(critical_stiffness(mild, 0.05) / stability::gil_hulin(mild), WithinAbs(0.95, 0.01));
  CHECK_THAT(critical_stiffness(strong, 0.05) / stability::gil_hulin(strong),
             WithinAbs(0.73, 0.01));
}

TEST_CASE("a coupling within the criterion is stable with every passive hand and world tried",
          "[design][stability]") {
  sim::random_source random(7);
  const auto any = [&random](double low, double high) {
    return low * std::pow(high / low, random.uniform());
  };
  double worst = 0.0;
  int tried = 0;
  double control = 0.0;
  while (tried < 300) {
    const int D = static_cast<int>(3 * random.uniform());
    const double Kc = any(0.5, 100.0);
    const double Bc = random.chance(0.5) ? 0.0 : any(1e-4, 0.03);
    const loop l{.damping = 0.03, .period = T, .delay = D};
    const double margin = passivity::adams_hannaford(l, coupling_of(Kc, Bc));
    // hand: mass, damper and spring up to beyond the Nyquist frequency
    const double mass = any(1e-5, 0.5);
    const double damper = random.chance(0.7) ? 0.0 : any(1e-3, 5.0);
    const double stiffness = random.chance(0.3) ? 0.0 : mass * std::pow(any(1.0, 6000.0), 2);
    const oscillator device(mass, 0.03 + damper, stiffness);
    const world rigid{.stiffness = infinity};
    const world moving{.mass = any(1e-7, 1.0),
                       .damping = random.chance(0.5) ? 0.0 : any(1e-3, 10.0),
                       .stiffness = random.chance(0.5) ? 0.0 : any(1.0, 1e5)};
    const double grown = growth(device, Kc, Bc, random.chance(0.3) ? rigid : moving, D);
    if (margin >= 0.0) {
      worst = std::max(worst, grown);
      ++tried;
    } else if (margin < -0.01) {
      control = std::max(control, grown);
    }
  }
  CHECK(worst <= 1.0 + 1e-6);
  CHECK(control > 2.0);  // what it refuses includes what does swing up
}

TEST_CASE("the criterion with ZOH = (1 + z⁻¹)/2 accepts a spring that no device can hold",
          "[design][stability]") {
  // |ZOH| (1 − cos arg ZOH) = cos(θ/2)(1 − cos(θ/2)) ≤ 2 b Re(1/Z_c) up to K_c = 8b/T
  const double Kc = 6 * 0.03 / T;
  for (int i = 1; i <= 1000; ++i) {
    const frequency w{design::pi * i / 1000};
    const double half = std::cos(w.angle / 2);
    CHECK(half * (1 - half) <= 2 * 0.03 * (1.0 / coupling_of(Kc, 0.0)(w)).re);
  }
  CHECK(unstable(thesis, 0.1, Kc));
  CHECK_FALSE(unstable(thesis, 0.1, 0.99 * passivity::coupling(thesis)));
  CHECK(passivity::adams_hannaford(thesis, coupling_of(Kc, 0.0)) < 0.0);
}
