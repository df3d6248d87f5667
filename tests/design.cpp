// SPDX-License-Identifier: BSD-3-Clause
// Static conditions: their known values at compile time, their forms against each other, and what
// they promise against the exact simulation.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/design.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

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

constexpr auto spring_damper(double K, double B) {
  return [K, B](frequency w) { return K + B * w.difference() / T; };
}
constexpr auto coupling_of(double Kc, double Bc) {
  return [Kc, Bc](frequency w) { return Bc + Kc * T / w.difference(); };
}
constexpr bool near(double a, double b, double tolerance) {
  return a - b <= tolerance && b - a <= tolerance;
}

// 60 N/m for the thesis's device, less what virtual damping and delay take, none in debt
static_assert(near(passivity::colgate_schenkel(thesis), 60.0, 1e-12));
static_assert(near(passivity::colgate_schenkel({.damping = 0.03, .virtual_damping = 0.01}), 40.0,
                   1e-12));
static_assert(near(passivity::colgate_schenkel({.damping = 0.03, .virtual_damping = -0.01}), 40.0,
                   1e-12));
static_assert(near(passivity::colgate_schenkel({.damping = 0.03, .delay = 1}), 20.0, 1e-12));
static_assert(passivity::colgate_schenkel({.damping = 0.03, .virtual_damping = 0.04}) == 0.0);
static_assert(near(passivity::coupling({.damping = 0.03, .virtual_damping = 0.02}), 20.0, 1e-12));
static_assert(near(stability::gil_hulin({.damping = 0.03, .virtual_damping = 0.01}), 80.0, 1e-12));
static_assert(near(stability::gil_hulin({.damping = 0.03, .delay = 1}), 20.0, 1e-12));
// the friction that 10 kN/m and 60 µm ask for is 0.3 N, and the damping 5 N·s/m
static_assert(near(passivity::abbott_okamura({.damping = 5, .friction = 0.3, .quantum = 60e-6}),
                   1e4, 1e-8));
static_assert(near(passivity::abbott_okamura({.damping = 5, .friction = 0.2, .quantum = 60e-6}),
                   2e4 / 3, 1e-8));
static_assert(near(passivity::abbott_okamura({.damping = 4, .friction = 0.3, .quantum = 60e-6}),
                   8e3, 1e-8));
static_assert(near(
    passivity::diolaiti({.damping = 5, .delay = 2, .friction = 0.3, .quantum = 1e-6}), 2e3, 1e-8));
// the forms over the frequencies are constant expressions too
static_assert(near(passivity::colgate_schenkel(thesis, spring_damper(40, 0.005)), 0.005, 1e-9));
static_assert(near(passivity::delayed_wall({.damping = 0.03, .virtual_damping = 0.005}, 40), 0.005,
                   1e-9));
static_assert(near(passivity::adams_hannaford(thesis, coupling_of(40, 0.005)), 0.005, 1e-9));

/// The least true port energy [J], friction included, of a linear spring and damper under a
/// prescribed motion: a wall that holds on both sides, or one that only pushes.
template <class Motion>
double prescribed(const loop& l, double K, Motion motion, std::uint64_t seed, bool pulls,
                  int ticks = 3000) {
  sim::random_source random(seed);
  sim::prescribed_motion<d1> device(
      {.damping = l.damping, .quantum = l.quantum, .period = l.period, .latency = l.delay});
  auto sample = device.exchange(0.0);
  double last = sample.position, friction = 0.0, worst = 0.0;
  for (int n = 0; n < ticks; ++n) {
    const double d = sample.position;  // the surface at 0, inside > 0
    const double wanted = K * d + l.virtual_damping * (d - last) / l.period;
    const double f = pulls || (d > 0.0 && wanted > 0.0) ? -wanted : 0.0;
    last = d;
    const double before = device.position();
    device.move_to(motion.next({.position = before,
                                .normal = -1.0,
                                .depth = before,
                                .force = f,
                                .dt = l.period,
                                .damping = l.damping},
                               random));
    sample = device.exchange(f);
    friction += l.friction * std::abs(device.position() - before);
    worst = std::min(worst, device.meter().value() + friction);
  }
  return worst;
}

/// A slow sine, where delay takes most.
struct slow_sine {
  double period = 0.2, amplitude = 1e-3, time = 0.0;
  double next(const sim::adversary_view<d1>& view, sim::random_source& /*random*/) noexcept {
    time += view.dt;
    return amplitude * std::sin(2 * design::pi * time / period);
  }
};

/// Goes to the first step of the sensor and hovers there, by less than damping can pay for.
struct edge_shaker {
  double step = 1e-4, swing = 1e-5;
  bool below = false;
  double next(const sim::adversary_view<d1>& /*view*/, sim::random_source& /*random*/) noexcept {
    below = !below;
    return step + (below ? -swing : swing) / 2;
  }
};

double worst_prescribed(const loop& l, double K, bool pulls) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    worst = std::min({worst, prescribed(l, K, sim::nyquist_motion<d1>{}, seed, pulls),
                      prescribed(l, K, sim::random_walk<d1>{}, seed, pulls),
                      prescribed(l, K, sim::greedy_motion<d1>{}, seed, pulls),
                      prescribed(l, K, sim::greedy_motion<d1>{.speed = 0.05}, seed, pulls),
                      prescribed(l, K, slow_sine{}, seed, pulls)});
  }
  return worst;
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

TEST_CASE("cos_sin is cosine and sine, at compile time too", "[design]") {
  static_assert(near(design::cos_sin(design::pi / 3).re, 0.5, 1e-15));
  double worst = 0.0;
  for (int i = -20000; i <= 20000; ++i) {
    const double a = 0.05 * i;
    const auto e = design::cos_sin(a);
    worst = std::max({worst, std::abs(e.re - std::cos(a)), std::abs(e.im - std::sin(a))});
  }
  CHECK(worst < 1e-15);
}

TEST_CASE("the general form of Colgate's condition is the closed form for spring and damper",
          "[design]") {
  for (const double K : {0.0, 10.0, 59.0, 1e3}) {
    for (const double B : {0.0, 0.01, -0.01, 0.5, -0.5}) {
      const double closed = 0.03 - (K * T / 2 + std::abs(B));
      CHECK_THAT(passivity::colgate_schenkel(thesis, spring_damper(K, B)), WithinAbs(closed, 1e-9));
      CHECK_THAT(passivity::delayed_wall({.damping = 0.03, .virtual_damping = B}, K),
                 WithinAbs(closed, 1e-9));
    }
  }
}

TEST_CASE("Dirichlet's kernel is the general form with delay, frequency by frequency", "[design]") {
  for (int D = 0; D <= 5; ++D) {
    for (const double B : {0.0, 0.02, -0.02}) {
      for (int i = 1; i <= 40; ++i) {
        const frequency w{design::pi * i / 40};
        const auto H = w.delay(D) * spring_damper(500, B)(w);
        const auto ahead = (1.0 - w.delay(1)) * H;
        const double general = T / 2 / (1 - std::cos(w.angle)) * ahead.re;
        const loop l{.damping = 0.03, .delay = D, .virtual_damping = B};
        CHECK_THAT(passivity::needed_damping(l, 500, w), WithinAbs(general, 1e-12));
      }
      // and over all of them
      const loop bare{.damping = 0.03, .delay = D};
      const loop damped{.damping = 0.03, .delay = D, .virtual_damping = B};
      CHECK_THAT(passivity::colgate_schenkel(bare, spring_damper(500, B)),
                 WithinAbs(passivity::delayed_wall(damped, 500), 1e-9));
    }
  }
}

TEST_CASE("b ≥ K (T/2 + t_d) + |B| is enough with delay, and exact without virtual damping",
          "[design]") {
  bool less_conservative = false;
  for (int D = 0; D <= 6; ++D) {
    for (const double B : {0.0, 0.004, -0.004, 0.02}) {
      const loop l{.damping = 0.03, .delay = D, .virtual_damping = B};
      const double K = passivity::colgate_schenkel(l);
      REQUIRE(K > 0.0);
      const double margin = passivity::delayed_wall(l, K);
      CHECK(margin >= -1e-12);
      if (B == 0.0) CHECK_THAT(margin, WithinAbs(0.0, 1e-9));
      less_conservative = less_conservative || margin > 1e-3;
    }
  }
  CHECK(less_conservative);
}

TEST_CASE("a wall that is passive by Colgate never loses energy, one just above does",
          "[design][passivity]") {
  for (const double B : {0.0, 0.01, 0.025}) {
    const loop l{.damping = 0.03, .period = T, .virtual_damping = B};
    const double K = passivity::colgate_schenkel(l);
    for (const bool pulls : {true, false}) CHECK(worst_prescribed(l, K, pulls) >= -1e-12);
    CHECK(prescribed(l, 1.02 * K, sim::nyquist_motion<d1>{}, 1, true) < -1e-6);
  }
  const loop hindering{.damping = 0.03, .period = T, .virtual_damping = -0.01};
  CHECK(worst_prescribed(hindering, passivity::colgate_schenkel(hindering), true) >= -1e-12);
}

TEST_CASE("with delay the same holds, and a slow sine draws energy just above",
          "[design][passivity]") {
  for (const int D : {1, 3}) {
    const loop l{.damping = 0.03, .period = T, .delay = D};
    const double K = passivity::colgate_schenkel(l);
    for (const bool pulls : {true, false}) CHECK(worst_prescribed(l, K, pulls) >= -1e-12);
    CHECK(prescribed(l, 1.02 * K, slow_sine{}, 1, true) < -1e-7);
    // stability and passivity forget about the delay at their peril
    CHECK(worst_prescribed(l, passivity::colgate_schenkel(thesis), true) < -1e-6);
  }
}

TEST_CASE("a wall that is passive by Colgate never loses energy on the exact device",
          "[design][passivity]") {
  const auto tapped = [](double K, double push, double mass) {
    sim::device<d1, sim::tapping_hand<d1>> device({.mass = mass, .start = -1e-4},
                                                  {.surface = 0.0, .normal = -1.0, .limit = push});
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 5000; ++n) {
      sample = device.exchange(-K * std::max(sample.position, 0.0));
    }
    return device.meter().minimum();
  };
  double control = 0.0;
  for (const double push : {0.01, 1.0, 20.0}) {
    for (const double mass : {0.002, 0.05, 0.5}) {
      CHECK(tapped(passivity::colgate_schenkel(thesis), push, mass) >= -1e-12);
      control = std::min(control, tapped(1e4, push, mass));
    }
  }
  CHECK(control < -1e-3);
}

TEST_CASE("sensor steps within Abbott and Okamura's bound cost no energy, larger ones do",
          "[design][passivity]") {
  const double K = 60.0;
  for (const int D : {0, 2}) {
    loop l{.damping = 0.03 * (1 + 2 * D), .period = T, .delay = D, .quantum = 1e-4};
    l.friction = K * l.quantum / 2;
    CHECK_THAT(passivity::diolaiti(l), WithinRel(K, 1e-12));
    CHECK_THAT(passivity::abbott_okamura(l), WithinAbs(D == 0 ? K : 0.0, 1e-12));
    CHECK(worst_prescribed(l, K, false) >= -1e-12);
    CHECK(prescribed(l, K, edge_shaker{}, 1, false) >= -1e-12);
    loop smooth = l;
    smooth.friction = 0.0;
    CHECK(passivity::diolaiti(smooth) == 0.0);
    CHECK(prescribed(smooth, K, edge_shaker{}, 1, false) < -1e-6);  // the control: no friction
  }
}

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

TEST_CASE("what is passive without virtual damping is stable, and virtual damping tells them apart",
          "[design]") {
  for (const double b : {0.01, 0.03, 1.0, 10.0}) {
    for (int D = 0; D <= 8; ++D) {
      const loop l{.damping = b, .period = T, .delay = D};
      CHECK(passivity::colgate_schenkel(l) <= stability::gil_hulin(l));
      CHECK(passivity::diolaiti(l) <= stability::gil_hulin(l));
      CHECK(passivity::coupling(l) <= stability::gil_hulin(l));
      loop damped = l;
      damped.virtual_damping = b / 2;
      CHECK(passivity::colgate_schenkel(damped) < passivity::colgate_schenkel(l));
      CHECK(stability::gil_hulin(damped) > stability::gil_hulin(l));
    }
  }
}

TEST_CASE("Adams and Hannaford's criterion with an exact hold is K_c < 2(b − B_c)/T for a spring",
          "[design]") {
  for (const double Bc : {0.0, 0.005, 0.02, 0.029}) {
    for (const double Kc : {1.0, 10.0, 60.0, 500.0}) {
      CHECK_THAT(passivity::adams_hannaford(thesis, coupling_of(Kc, Bc)),
                 WithinAbs(0.03 - Bc - Kc * T / 2, 1e-9));
    }
  }
  // with delay: (D + 1)² (K_c T/2)²/(B_c + K_c T/2) at low frequencies, so damping helps there
  const loop late{.damping = 0.03, .period = T, .delay = 1};
  CHECK_THAT(passivity::adams_hannaford(late, coupling_of(10, 0.0)),
             WithinAbs(0.03 - 4 * 10 * T / 2, 1e-9));
  CHECK(passivity::adams_hannaford(late, coupling_of(20, 0.0)) < 0.0);
  CHECK(passivity::adams_hannaford(late, coupling_of(20, 0.01)) > 0.0);
  // an active coupling is refused at once
  CHECK(passivity::adams_hannaford(thesis, coupling_of(10, -0.02)) == -infinity);
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

TEST_CASE("a constant out of range, or unknown to a condition, makes nothing safe", "[design]") {
  const auto name = [](const loop& l) {
    const auto fault = l.check();
    return std::string(fault ? fault.parameter : "");
  };
  const double nan = std::nan("");
  CHECK(name(thesis).empty());
  const std::array<std::pair<loop, const char*>, 6> bad{{
      {{.damping = -1}, "damping"},
      {{.damping = 1, .period = 0}, "period"},
      {{.damping = 1, .delay = -1}, "delay"},
      {{.damping = 1, .virtual_damping = nan}, "virtual_damping"},
      {{.damping = 1, .friction = nan}, "friction"},
      {{.damping = 1, .quantum = -1}, "quantum"},
  }};
  for (const auto& [l, parameter] : bad) {
    CHECK(name(l) == parameter);
    CHECK(passivity::colgate_schenkel(l) == 0.0);
    CHECK(passivity::coupling(l) == 0.0);
    CHECK(passivity::diolaiti(l) == 0.0);
    CHECK(passivity::abbott_okamura(l) == 0.0);
    CHECK(stability::gil_hulin(l) == 0.0);
    CHECK(passivity::colgate_schenkel(l, spring_damper(1, 0)) == -infinity);
    CHECK(passivity::delayed_wall(l, 1) == -infinity);
    CHECK(passivity::adams_hannaford(l, coupling_of(1, 0)) == -infinity);
  }
  const loop stepped{.damping = 1, .friction = 1, .quantum = 1e-5};
  CHECK(passivity::colgate_schenkel(stepped) == 0.0);
  CHECK(passivity::delayed_wall(stepped, 1) == -infinity);
  CHECK(stability::gil_hulin(stepped) == 0.0);
  CHECK(passivity::diolaiti(stepped) > 0.0);
  const loop damped{.damping = 1, .virtual_damping = 0.1};
  CHECK(passivity::diolaiti(damped) == 0.0);
  CHECK(passivity::adams_hannaford(damped, coupling_of(1, 0)) == -infinity);
  CHECK(passivity::colgate_schenkel(thesis, [nan](frequency) { return design::complex{nan}; }) ==
        -infinity);
  CHECK(passivity::delayed_wall(thesis, nan) == -infinity);
  CHECK(passivity::delayed_wall(thesis, 1, {.points = 0}) == -infinity);
}
