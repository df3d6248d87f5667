// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr ph::virtual_coupling coupling_of(double stiffness, double damping) {
  return {.stiffness = stiffness, .damping = damping};
}

/// The least true port energy [J] of one motion on a fixed wall without ledger or bound, b = 0.03,
/// T = 1 ms, starting `start` m deep. What is pressed in at the start is lent.
template <class Space, class Motion>
double unbounded_on_fixed_wall(const ph::virtual_coupling& law, double K, Motion motion,
                               std::uint64_t seed, double start = 0.0, int ticks = 2000) {
  sim::random_source random(seed);
  const typename sim::physical<Space>::vector normal = random.direction<Space>();
  sim::prescribed_motion<Space> device(
      {.damping = 0.03, .start = typename sim::physical<Space>::vector(-normal * start)});
  ph::local_model model{Space{},
                        ph::fixed{ph::half_space<Space>{Space::zero(), normal, K}},
                        ph::turn_at_once{},
                        law,
                        ph::no_observer{},
                        ph::no_bound{},
                        thesis_loop};
  REQUIRE_FALSE(model.check());
  auto sample = device.exchange(Space::zero());
  for (int n = 0; n < ticks; ++n) {
    const auto out = model.tick(sample);
    device.move_to(motion.next({.position = device.position(),
                                .normal = normal,
                                .depth = -sim::physical<Space>::dot(device.position(), normal),
                                .force = out.force},
                               random));
    sample = device.exchange(out.force);
  }
  return device.meter().minimum();
}

/// Presses 2 mm deep by 2 µm a tick, where the damper never lets go, then shakes by ±0.1 mm.
struct press_and_shake {
  int tick = 0;
  [[nodiscard]] double next(const sim::adversary_view<d1>& view,
                            sim::random_source& /*random*/) noexcept {
    const double inwards = ++tick <= 1000 ? 2e-6 : tick % 2 == 0 ? 1e-4 : -1e-4;
    return view.position - view.normal * inwards;
  }
};

double shaken_on_fixed_wall(double stiffness, double damping, double K) {
  return unbounded_on_fixed_wall<d1>(coupling_of(stiffness, damping), K, press_and_shake{}, 1, 0.0,
                                     21000);
}

/// The worst of three motions, from the surface and from two places outside.
template <class Space>
double worst_on_fixed_wall(double stiffness, double damping, double K) {
  const auto law = coupling_of(stiffness, damping);
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const double start : {0.0, -0.0003, -0.0007}) {
      worst = std::min(
          {worst, unbounded_on_fixed_wall<Space>(law, K, sim::nyquist_motion<Space>{}, seed, start),
           unbounded_on_fixed_wall<Space>(law, K, sim::random_walk<Space>{}, seed, start),
           unbounded_on_fixed_wall<Space>(law, K, sim::greedy_motion<Space>{}, seed, start)});
    }
  }
  return worst;
}

static_assert(ph::laws::presses_outwards<d1>(coupling_of(2000.0, 0.02)));
static_assert(ph::laws::presses_outwards<f1>(coupling_of(2000.0, 0.02)));

}  // namespace

TEST_CASE("virtual_coupling is two springs in series, felt through a damper (§ 2(g))",
          "[contact]") {
  ph::virtual_coupling::on<d1> law({.stiffness = 3000.0, .damping = 0.5});
  law.adopt(6000.0, 1e-3);
  CHECK_THAT(law.stiffness(), WithinRel(2000.0, 1e-14));
  CHECK_THAT(law.force(1e-3, 0.0), WithinRel(2.0, 1e-14));
  CHECK_THAT(law.force(1e-3, -2.0), WithinRel(3.0, 1e-14));  // moving in: more
  CHECK_THAT(law.force(1e-3, 2.0), WithinRel(1.0, 1e-14));   // moving out: less
  CHECK(law.force(1e-3, 5.0) == 0.0);                        // it never pulls
  CHECK(law.force(0.0, -2.0) == 0.0);
  CHECK(law.force(-1e-3, -2.0) == 0.0);
  CHECK_THAT(law.depth(3.0, -2.0), WithinRel(1e-3, 1e-14));
  CHECK(law.depth(0.5, -2.0) == 0.0);  // the damper alone gives more than that
  CHECK(law.depth(0.0, 2.0) == 0.0);   // no force is no contact, however fast it is left
  CHECK(law.depth(-1.0, 4.0) == 0.0);
}

TEST_CASE("virtual_coupling with K_c infinite, or as large as a number gets, is the wall itself",
          "[contact]") {
  for (const double Kc :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max()}) {
    ph::virtual_coupling::on<d1> law({.stiffness = Kc});
    law.adopt(1e4, 1e-3);
    CHECK(law.stiffness() == 1e4);
    CHECK(law.force(1e-3, 7.0) == 10.0);
  }
  CHECK(ph::virtual_coupling{}.stiffness == std::numeric_limits<double>::infinity());
}

TEMPLATE_TEST_CASE("virtual_coupling obeys the law of contacts", "[contact][law]", d1, f1, d2, f2,
                   d3, f3) {
  CHECK(ph::laws::presses_outwards<TestType>(coupling_of(2000.0, 0.02)));
  CHECK(ph::laws::presses_outwards<TestType>(
      coupling_of(std::numeric_limits<double>::infinity(), 0.0)));
}

TEST_CASE("the massless proxy has the felt stiffness, and the damper whole on a rigid wall only",
          "[contact]") {
  // D_c p' + (K + K_c) p = K_c d + D_c d', f = K p, by small steps, against the law
  const double Kc = 1000.0, Dc = 1.0, speed = 0.1, h = 1e-7;
  const auto damper_of = [&](double K) {
    double p = 0.0, d = 0.0;
    for (int n = 0; n < 400000; ++n) {
      d += speed * h;
      p += h * (Kc * d + Dc * speed - (K + Kc) * p) / Dc;
    }
    ph::virtual_coupling::on<d1> law({.stiffness = Kc});
    law.adopt(K, 1e-3);
    return (K * p - law.force(d, 0.0)) / speed;
  };
  CHECK_THAT(damper_of(1000.0), WithinRel(Dc / 4.0, 1e-3));  // D_c (K/(K + K_c))²
  CHECK_THAT(damper_of(1e6), WithinRel(Dc, 5e-3));
}

TEST_CASE("virtual_coupling needs no ledger on a fixed wall while K_c ≤ 2(b − D_c)/T (§ 2(g))",
          "[contact][passivity][long]") {
  for (const double Dc : {0.0, 0.01, 0.02, 0.029}) {
    const double Kc = 2.0 * (0.03 - Dc) / 1e-3;
    for (const double K : {30.0, 1e4}) {
      CHECK(worst_on_fixed_wall<d1>(Kc, Dc, K) >= -1e-12);
      CHECK(worst_on_fixed_wall<d2>(Kc, Dc, K) >= -1e-12);
      CHECK(worst_on_fixed_wall<d3>(Kc, Dc, K) >= -1e-12);
    }
    CHECK(shaken_on_fixed_wall(Kc, Dc, 1e9) >= -1e-12);
    CHECK(shaken_on_fixed_wall(1.05 * Kc, Dc, 1e9) < -1e-6);  // the control: just above
  }
  CHECK(worst_on_fixed_wall<d1>(1e9, 0.01, 39.0) >=
        -1e-12);  // it is the felt stiffness that counts
  CHECK(shaken_on_fixed_wall(1e9, 0.01, 39.0) >= -1e-12);
  CHECK(shaken_on_fixed_wall(1e9, 0.01, 42.0) < -1e-6);
}

TEST_CASE("Nyquist motion takes (K_f/2 + D_c/T − b/T)Δ² a tick from a virtual_coupling",
          "[contact][passivity]") {
  const double delta = 1e-5;
  const sim::nyquist_motion<d1> motion{.amplitude = delta};
  for (const double Kc : {50.0, 400.0}) {
    for (const double Dc : {0.0, 0.02}) {
      const double gain = (Kc / 2.0 + (Dc - 0.03) / 1e-3) * delta * delta;
      // 20 mm deep, so that the damper never lets go; the first move has no move before it
      const double least =
          unbounded_on_fixed_wall<d1>(coupling_of(Kc, Dc), 1e12, motion, 1, 0.02, 20001);
      const double expected = gain > 0.0 ? -20000.0 * gain : 0.0;
      CHECK_THAT(least, WithinAbs(expected, 2e-3 * std::abs(expected) + 1e-12));
    }
  }
}

TEST_CASE("virtual_coupling is strict on a surface that moves with strict_bound, and not without",
          "[contact][passivity]") {
  const auto worst = [](auto observer, auto bound) {
    double least = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      auto model = following_half_space<d1>(coupling_of(40.0, 0.01), observer, bound);
      sim::random_source random(seed);
      sim::prescribed_motion<d1> device({.damping = 0.03});
      sim::jumping_surface jumps(2e-3, seed);
      sim::greedy_motion<d1> motion{.speed = 0.05};
      double surface = 0.0;
      model.update({surface, -1.0, 1e4});
      auto sample = device.exchange(0.0);
      for (int n = 0; n < 2000; ++n) {
        if (const double moved = jumps.offset(device.time()); moved != surface) {
          surface = moved;
          model.update({surface, -1.0, 1e4});
        }
        const auto out = model.tick(sample);
        device.move_to(motion.next({.position = device.position(),
                                    .normal = -1.0,
                                    .depth = device.position() - surface,
                                    .force = out.force},
                                   random));
        sample = device.exchange(out.force);
      }
      least = std::min(least, device.meter().minimum());
    }
    return least;
  };
  CHECK(worst(thesis_ledger(), ph::strict_bound{}) >= -1e-12);
  CHECK(worst(ph::no_observer{}, ph::no_bound{}) < -1e-6);
}

TEST_CASE("parameters of virtual_coupling are refused with their name", "[contact]") {
  const auto refused = [](const ph::virtual_coupling& law) {
    const auto fault = law.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({}).empty());
  CHECK(refused({.stiffness = 1e3, .damping = 0.1}).empty());
  CHECK(refused({.stiffness = 0.0}) == "stiffness");
  CHECK(refused({.stiffness = std::nan("")}) == "stiffness");
  CHECK(refused({.damping = -0.1}) == "damping");
  CHECK(refused({.damping = std::numeric_limits<double>::infinity()}) == "damping");
}
