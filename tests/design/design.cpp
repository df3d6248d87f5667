// SPDX-License-Identifier: BSD-3-Clause
// Static conditions: their known values at compile time, and their forms against each other. What they
// promise against the exact simulation: design_passivity.cpp, design_stability.cpp.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/design.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace design = ph::design;
namespace passivity = ph::design::passivity;
namespace stability = ph::design::stability;
using Catch::Matchers::WithinAbs;
using design::frequency;
using design::loop;

namespace {

constexpr double T = 1e-3;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr loop thesis{.damping = 0.03, .period = T};

constexpr auto spring_damper(double K, double D) {
  return [K, D](frequency w) { return K + D * w.difference() / T; };
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
    for (const double D : {0.0, 0.01, -0.01, 0.5, -0.5}) {
      const double closed = 0.03 - (K * T / 2 + std::abs(D));
      CHECK_THAT(passivity::colgate_schenkel(thesis, spring_damper(K, D)), WithinAbs(closed, 1e-9));
      CHECK_THAT(passivity::delayed_wall({.damping = 0.03, .virtual_damping = D}, K),
                 WithinAbs(closed, 1e-9));
    }
  }
}

TEST_CASE("Dirichlet's kernel is the general form with delay, frequency by frequency", "[design]") {
  for (int k = 0; k <= 5; ++k) {
    for (const double D : {0.0, 0.02, -0.02}) {
      for (int i = 1; i <= 40; ++i) {
        const frequency w{design::pi * i / 40};
        const auto H = w.delay(k) * spring_damper(500, D)(w);
        const auto ahead = (1.0 - w.delay(1)) * H;
        const double general = T / 2 / (1 - std::cos(w.angle)) * ahead.re;
        const loop l{.damping = 0.03, .delay = k, .virtual_damping = D};
        CHECK_THAT(passivity::needed_damping(l, 500, w), WithinAbs(general, 1e-12));
      }
      // and over all of them
      const loop bare{.damping = 0.03, .delay = k};
      const loop damped{.damping = 0.03, .delay = k, .virtual_damping = D};
      CHECK_THAT(passivity::colgate_schenkel(bare, spring_damper(500, D)),
                 WithinAbs(passivity::delayed_wall(damped, 500), 1e-9));
    }
  }
}

TEST_CASE("b ≥ K (T/2 + t_d) + |D| is enough with delay, and exact without virtual damping",
          "[design]") {
  bool less_conservative = false;
  for (int k = 0; k <= 6; ++k) {
    for (const double D : {0.0, 0.004, -0.004, 0.02}) {
      const loop l{.damping = 0.03, .delay = k, .virtual_damping = D};
      const double K = passivity::colgate_schenkel(l);
      REQUIRE(K > 0.0);
      const double margin = passivity::delayed_wall(l, K);
      CHECK(margin >= -1e-12);
      if (D == 0.0) CHECK_THAT(margin, WithinAbs(0.0, 1e-9));
      less_conservative = less_conservative || margin > 1e-3;
    }
  }
  CHECK(less_conservative);
}

TEST_CASE("what is passive without virtual damping is stable, and virtual damping tells them apart",
          "[design]") {
  for (const double b : {0.01, 0.03, 1.0, 10.0}) {
    for (int k = 0; k <= 8; ++k) {
      const loop l{.damping = b, .period = T, .delay = k};
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
  // with delay: (k + 1)² (K_c T/2)²/(B_c + K_c T/2) at low frequencies, so damping helps there
  const loop late{.damping = 0.03, .period = T, .delay = 1};
  CHECK_THAT(passivity::adams_hannaford(late, coupling_of(10, 0.0)),
             WithinAbs(0.03 - 4 * 10 * T / 2, 1e-9));
  CHECK(passivity::adams_hannaford(late, coupling_of(20, 0.0)) < 0.0);
  CHECK(passivity::adams_hannaford(late, coupling_of(20, 0.01)) > 0.0);
  // an active coupling is refused at once
  CHECK(passivity::adams_hannaford(thesis, coupling_of(10, -0.02)) == -infinity);
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
