// SPDX-License-Identifier: BSD-3-Clause
// dual_ledger alone, against the true energy of devices with steps and elastic friction. Bounds on it
// against adversaries: attacks/adversary_encoders.cpp, full/bounds_dual.cpp.
#include "force_bound/upkeep.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/identification/crossed_step.hpp>
#include <passive_haptics/identification/sliders.hpp>
#include <passive_haptics/simulation/adversary_motions.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace {

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using kind = sim::friction_kind;

struct device {
  double b = 0.03;   ///< [N·s/m]
  double c = 0.2;    ///< [N]
  double p = 15e-6;  ///< [m]
  double q = 50e-6;  ///< [m]
  kind rubs_like = kind::one_spring;

  [[nodiscard]] constexpr ph::dual_ledger ledger() const {
    return {.damping = {b, c, p}, .quantum = q, .loan = 10.0};  // never empty: no bound keeps it
  }
};
/// What a run has besides.
struct troubles {
  double lost = 0.0;      ///< share of samples lost
  double late = 0.0;      ///< share of ticks of 1 to 4 ms
  bool watchdog = false;  ///< which drops the force after 1 ms
  double noise = 0.0;     ///< off by half of that either way, instead of steps [m]
};

constexpr double tick = 1e-3;

/// The most by which the ledger exceeds the energy that has flowed in [J], reserve and loan aside, while
/// forces hunt, hold and jump, and a hand moves to where that pays it most.
template <class Space>
double overstated(const auto& parameters, const device& truth, std::uint64_t seed,
                  const troubles& when = {}) {
  using vector = typename Space::vector;
  auto ledger = at<Space>(parameters);
  const double given = ledger.value();
  sim::device_parameters<Space> built;
  built.damping = truth.b;
  built.period = tick;
  if (when.watchdog) built.watchdog = tick;
  sim::prescribed_motion<Space, sim::friction_like> moved(built,
                                                          {truth.rubs_like, truth.c, truth.p});
  sim::random_source random(seed);
  const double pace = std::pow(10.0, random.uniform(-6.0, -3.5));
  const double hunt = truth.c * std::pow(10.0, random.uniform(-1.0, 1.0));
  const auto shown = [&](vector x) {
    for (int i = 0; i < Space::dof; ++i) {
      double& along = Space::component(x, i);
      if (when.noise > 0.0) {
        along += when.noise * random.uniform(-0.5, 0.5);
      } else if (truth.q > 0.0) {
        along = truth.q * (std::floor(along / truth.q) + 0.5);
      }
    }
    return x;
  };
  vector force = Space::zero(), last = shown(moved.position());
  double worst = -1.0;
  bool seen = true;
  for (int n = 0; n < 1500; ++n) {
    const vector before = force;
    if (random.chance(0.3)) force = force + random.direction<Space>() * (hunt * random.uniform());
    if (random.chance(0.03)) force = random.direction<Space>() * (4.0 * random.uniform());
    const bool late = random.chance(when.late);
    const double dt = late ? tick * random.uniform(1.01, 4.0) : tick;
    (void)moved.set_period(dt);
    // Where to: anywhere near, with the change of the force within a step or p; the cheapest of a few.
    vector to = moved.position();
    double least = moved.price(to, force);
    const vector change = force - before;
    const double size = Space::norm(change);
    for (int i = 0; i < 6; ++i) {
      const double reach = i < 2 ? truth.q : i < 4 ? 2.0 * truth.p : pace;
      vector way = random.direction<Space>() * (reach * random.uniform());
      if (i % 2 == 0 && size > 0.0) way = change * (reach * random.uniform() / size);
      const double price =
          moved.price(moved.position() + way, force) + 1e-7 * random.uniform(-1.0, 1.0);
      if (n % 100 < 90 ? price < least : i == 5) {
        least = price;
        to = moved.position() + way;
      }
    }
    moved.move_to(to);
    (void)moved.exchange(force);

    if (random.chance(when.lost)) {
      ledger.forfeit(force, dt);
      seen = false;
    } else if (!seen) {  // nobody knows what moved since the last good sample
      ledger.forfeit(force, dt);
      last = shown(moved.position());
      seen = true;
    } else {
      const vector now = shown(moved.position());
      if (late && when.watchdog) {  // as passive_port does
        auto dropped = ledger;
        dropped.forfeit(force, tick);
        REQUIRE(ledger.update(now - last, force, dt));
        ledger.forfeit(Space::zero(), tick);
        if (dropped.value() < ledger.value()) ledger = dropped;
      } else {
        REQUIRE(ledger.update(now - last, force, dt));
      }
      last = now;
    }
    worst = std::max(worst, ledger.value() - given - moved.meter().with_friction());
  }
  return worst;
}
template <class Space>
double most_overstated(const auto& parameters, const device& truth, std::uint64_t seeds,
                       const troubles& when = {}) {
  double worst = -1.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    worst = std::max(worst, overstated<Space>(parameters, truth, seed, when));
  }
  return worst;
}

static_assert(ph::laws::forfeit_never_credits<f1>(device{}.ledger()));

}  // namespace

TEMPLATE_TEST_CASE("dual_ledger never exceeds the true energy of a device with elastic friction",
                   "[dual]", d1, d2, d3) {
  for (const kind like : {kind::one_spring, kind::three_springs, kind::dupont, kind::stribeck}) {
    for (const device& d : {device{}, device{.b = 0.5, .p = 0.0}, device{.c = 0.05, .p = 50e-6},
                            device{.c = 0.5, .p = 5e-6, .q = 10e-6}, device{.q = 0.0}}) {
      if (!(d.p > 0.0) && like != kind::one_spring) continue;
      device truth = d;
      truth.rubs_like = like;
      CAPTURE(to_string(like), d.b, d.c, d.p, d.q);
      ph::dual_ledger stated = d.ledger();
      // Springs on every axis give way by p each; Stribeck's and Dupont's by what their claim says.
      const auto claim = sim::friction_like{like, d.c, d.p}.claim();
      stated.damping.presliding = std::max(claim.presliding, d.p) * std::sqrt(TestType::dof);
      stated.damping.coulomb = std::min(claim.level, d.c);
      CHECK(most_overstated<TestType>(stated, truth, 3) <= 1e-11);
    }
  }
}

TEST_CASE("a device with less than was stated is overstated: each number is needed", "[dual]") {
  const device truth{.p = 30e-6, .q = 60e-6};
  const auto told = [](double c, double p, double q) {
    return device{.c = c, .p = p, .q = q}.ledger();
  };
  CHECK(most_overstated<d1>(told(0.2, 30e-6, 60e-6), truth, 10) <= 1e-11);
  CHECK(most_overstated<d1>(told(0.3, 30e-6, 60e-6), truth, 10) > 1e-6);
  CHECK(most_overstated<d1>(told(0.2, 3e-6, 60e-6), truth, 10) > 1e-6);
  CHECK(most_overstated<d1>(told(0.2, 30e-6, 20e-6), truth, 10) > 1e-6);
}

TEMPLATE_TEST_CASE("noise, lost samples and late ticks do not fool dual_ledger", "[dual]", d1, d3) {
  const device truth{.p = 30e-6};
  device stated = truth;
  stated.p *= std::sqrt(TestType::dof);
  for (const troubles& when :
       {troubles{.noise = 50e-6}, troubles{.lost = 0.1}, troubles{.late = 0.1},
        troubles{.late = 0.1, .watchdog = true},
        troubles{.lost = 0.02, .late = 0.05, .watchdog = true, .noise = 50e-6}}) {
    CAPTURE(when.noise, when.lost, when.late, when.watchdog);
    CHECK(most_overstated<TestType>(stated.ledger(), truth, 6, when) <= 1e-11);
  }
  device noisier = stated;
  noisier.q = 10e-6;
  CHECK(most_overstated<TestType>(noisier.ledger(), truth, 6, {.noise = 50e-6}) > 1e-6);
}

TEST_CASE("friction, presliding and steps may differ from axis to axis", "[dual]") {
  using axes = ph::basic_dual_ledger<ph::diagonal_damping_and_friction<3>, ph::encoder_steps<3>>;
  const device truth{};
  const auto stated = [](double c, double q) {
    return axes{.damping = {{0.03, 0.02, 0.03}, {0.2, c, 0.1}, {15e-6, 15e-6, 20e-6}},
                .quantum = {{50e-6, q, 60e-6}},
                .loan = 10.0};
  };
  CHECK(most_overstated<d3>(stated(0.2, 50e-6), truth, 6) <= 1e-11);
  CHECK(most_overstated<d3>(stated(0.2, 5e-6), truth, 20) > 1e-6);  // finer than they are
  // what each axis is told counts on that axis: 5 mm along it
  for (const double c : {0.2, 1.0}) {
    auto ledger = at<d3>(stated(c, 50e-6));
    const double given = ledger.value();
    for (int n = 0; n < 100; ++n) (void)ledger.update(d3::vector(0, 50e-6, 0), d3::zero(), 1.0);
    CHECK_THAT(ledger.value() - given, WithinRel(c * 5e-3, 0.02));
  }
}

TEST_CASE("dry friction pays for a force that hunts, and a slip earns c a metre", "[dual]") {
  const ph::dual_ledger parameters{.damping = {0.03, 0.2, 0.0}, .quantum = 50e-6};
  auto ledger = at<d1>(parameters);
  auto without = at<d1>(ph::quantised_energy{.damping = 0.03, .quantum = 50e-6});
  // within 2c at a position that does not change, for nothing
  for (int n = 0; n < 1000; ++n) {
    (void)ledger.update(0.0, n % 2 == 0 ? 0.2 : -0.2, 1e-3);
    (void)without.update(0.0, n % 2 == 0 ? 0.2 : -0.2, 1e-3);
  }
  CHECK(ledger.value() >= -1e-12);
  CHECK_THAT(without.value(), WithinRel(-0.5 * 50e-6 * (0.4 * 999 + 0.4), 1e-9));
  // beyond it half a step for each newton more
  auto wide = at<d1>(parameters);
  for (int n = 0; n < 100; ++n) (void)wide.update(0.0, n % 2 == 0 ? 0.3 : -0.3, 1e-3);
  CHECK_THAT(wide.value(), WithinAbs(-0.5 * 50e-6 * 0.2 * 100, 0.5 * 50e-6 * 0.4));
  // a slip: the friction of all of it but of the doubt at its ends
  auto slips = at<d1>(parameters);
  for (int n = 0; n < 100; ++n) (void)slips.update(50e-6, 0.0, 1.0);
  CHECK_THAT(slips.value(), WithinAbs(0.2 * 5e-3, 1.01 * 0.2 * 50e-6));
  CHECK(slips.value() <= 0.2 * 5e-3);
}

TEST_CASE("where friction is elastic the ledger begins at −5/2 c p and earns it back", "[dual]") {
  const ph::dual_ledger parameters{.damping = {0.03, 0.2, 10e-6}, .quantum = 20e-6, .loan = 1e-3};
  auto ledger = at<d1>(parameters);
  CHECK_THAT(ledger.value(), WithinRel(1e-3 - 2.5 * 0.2 * 10e-6, 1e-9));
  for (int n = 0; n < 100; ++n) (void)ledger.update(20e-6, 0.0, 1.0);
  CHECK_THAT(ledger.value() - 1e-3, WithinAbs(0.2 * 2e-3, 4 * 0.2 * 20e-6));
  ledger.reset();
  CHECK_THAT(ledger.value(), WithinRel(1e-3 - 2.5 * 0.2 * 10e-6, 1e-9));
  ledger.set({.damping = {0.03, 0.2, 30e-6}, .quantum = 20e-6, .loan = 1e-3});  // holds back more
  CHECK_THAT(ledger.value(), WithinRel(1e-3 - 2.5 * 0.2 * 30e-6, 1e-9));
  ledger.set(parameters);  // what has been taken for it is not given again
  CHECK_THAT(ledger.value(), WithinRel(1e-3 - 2.5 * 0.2 * 30e-6, 1e-9));
}

TEST_CASE("dual_ledger keeps the laws of an observer, and its parameters", "[dual]") {
  const auto stated = ph::dual_ledger{.damping = {0.03, 0.2, 1e-5}, .quantum = 1e-5};
  CHECK(broken_laws<d1, f3>(stated).empty());
  using joints = ph::basic_dual_ledger<ph::diagonal_damping_and_friction<2>, ph::encoder_steps<2>>;
  const joints arm{.damping = {{0.03, 0.1}, {0.2, 0.0}, {1e-5, 0.0}}, .quantum = {{1e-5, 1e-4}}};
  CHECK(broken_laws<ph::joint_space<double, 2>>(arm).empty());
  using ledger = ph::dual_ledger;
  CHECK(refused(ledger{.damping = {0.03, 0.2, 0.0}}).empty());  // exact positions, rigid friction
  CHECK(refused(ledger{.damping = {0.03, 0.2}, .quantum = 1e-5}) == "presliding");
  CHECK(refused(ledger{.damping = {0.03, 0.2, -1.0}, .quantum = 1e-5}) == "presliding");
  CHECK(refused(ledger{.damping = {0.03, -0.2, 1e-5}, .quantum = 1e-5}) == "friction");
  CHECK(refused(ledger{.damping = {0.0, 0.2, 1e-5}, .quantum = 1e-5}) == "damping");
  CHECK(refused(ledger{.damping = {0.03, 0.2, 1e-5}, .quantum = -1e-5}) == "quantum");
  CHECK(refused(ledger{.damping = {0.03, 0.2, 1e-5}, .window = 0.0}) == "window");
  const auto model = following_half_space<d1>(ph::spring{}, stated, ph::strict_bound{});
  check_upkeep(model, stated, ph::dual_ledger{.damping = {0.02, 0.2, 1e-5}, .quantum = 1e-5},
               ph::dual_ledger{.damping = {0.02, 0.1}, .quantum = 1e-5});
}

TEST_CASE("a reset forgets which edges were crossed, and that a motion refuted the mass",
          "[dual]") {
  const double q = 64e-6, T = 1e-3;
  const ph::crossed_ledger still{
      .damping = {0.05, 0.0, 0.0},
      .quantum = {.quantum = q, .mass = 1e6, .hand_force = 1.0}};  // it hardly accelerates
  const auto pressed = [&](auto& ledger, double way) {  // what 1 N costs after such a motion
    REQUIRE(ledger.value() == 0.0);
    if (way > 0.0) REQUIRE(ledger.update(way, 0.0, T));
    const double start = ledger.value();
    for (int n = 0; n < 12; ++n) REQUIRE(ledger.update(0.0, -1.0, T));
    return ledger.value() - start;
  };
  auto fresh = at<d1>(still);
  auto another = fresh, crossed = fresh, refuted = fresh;
  const double at_rest = pressed(fresh, 0.0), beyond = pressed(another, q);
  CHECK_THAT(at_rest, Catch::Matchers::WithinAbs(-q, 1e-9));
  CHECK_THAT(beyond, Catch::Matchers::WithinAbs(-q / 13, 2e-9));
  REQUIRE(crossed.update(q, 0.0, T));
  crossed.reset();
  CHECK(pressed(crossed, 0.0) == at_rest);
  for (const double way : {q, -3 * q, q, -3 * q}) REQUIRE(refuted.update(way, -0.5, T));
  REQUIRE(refuted.steps().refuted());
  refuted.reset();
  CHECK(pressed(refuted, q) == beyond);
}

TEST_CASE("a reset forgets what the sliders opposed", "[dual]") {
  const ph::basic_dual_ledger<ph::damping_and_sliders<2>> told{
      .damping = {.coefficient = 0.05, .sliders = {{{0.1, 4e-6}, {0.2, 15e-6}}}}, .quantum = 1e-6};
  const auto wound = [](auto& ledger) {  // what 30 µm of slow motion bring
    const double start = ledger.value();
    for (int n = 0; n < 30; ++n) REQUIRE(ledger.update(1e-6, 0.0, 1.0));
    return ledger.value() - start;
  };
  auto fresh = at<d1>(told), worn = fresh;
  const double once = wound(fresh);
  CHECK(once > 0.0);
  CHECK(wound(fresh) > 1.1 * once);  // what is wound already brings more
  (void)wound(worn);
  worn.reset();
  CHECK(wound(worn) == once);
}

TEST_CASE(
    "of a crossing comes back what holds the device at the edge, and nothing of what does not",
    "[dual]") {
  const double q = 64e-6, T = 1e-3;
  const ph::crossed_ledger still{
      .damping = {0.05, 0.0, 0.0},
      .quantum = {.quantum = q, .mass = 1e6, .hand_force = 1.0}};  // it hardly accelerates
  for (const double way : {q, -q}) {
    auto back = at<d1>(still), on = at<d1>(still);
    for (auto* ledger : {&back, &on}) REQUIRE(ledger->update(way, 0.0, T));
    const double start = back.value();
    REQUIRE(on.value() == start);
    for (int n = 1; n <= 12; ++n) {  // it is q/(n + 1) beyond the edge at most
      REQUIRE(back.update(0.0, -way / q, T));
      REQUIRE(on.update(0.0, way / q, T));
      CAPTURE(way, n);
      CHECK_THAT(back.value() - start, Catch::Matchers::WithinAbs(-q / (n + 1), 2e-9));
      CHECK(on.value() - start <= -q);  // and may have been there
    }
  }
}

TEST_CASE("a ledger that is full goes on booking", "[dual]") {
  auto ledger = at<f1>(ph::dual_ledger{.damping = {1e-3, 0.2, 0.0}, .quantum = 1e-5});
  for (int n = 0; n < 20; ++n) {
    REQUIRE(ledger.update(1e19F, -1e19F, 1.0F));  // 1e38 J, a third of the largest number
    REQUIRE(ledger.value() > 4e37F);
  }
  for (int n = 0; n < 20; ++n) REQUIRE(ledger.update(-1e18F, -1e19F, 1.0F));
  CHECK(ledger.value() < -1e38F);
}

TEMPLATE_TEST_CASE("numbers at the ends of their range leave dual_ledger a number", "[dual]", d1,
                   f1, f3) {
  using scalar = typename TestType::scalar;
  using limits = std::numeric_limits<scalar>;
  const std::array<double, 9> odd{0.0,
                                  double(limits::denorm_min()),
                                  1e-30,
                                  1e-3,
                                  0.2,
                                  1.0,
                                  1e18,
                                  double(limits::max()) / 4,
                                  double(limits::max())};
  sim::random_source random(5);
  const auto any = [&] { return odd[static_cast<std::size_t>(random.uniform(0.0, 8.999))]; };
  int booked = 0, refused_ticks = 0;
  for (int run = 0; run < 3000; ++run) {
    ph::dual_ledger p{.damping = {std::max(any(), 1e-30), any(), any()}, .quantum = any()};
    if (random.chance(0.5)) p.damping = {0.03, 0.2, 1e-5};
    if (random.chance(0.5)) p.quantum = 1e-5;
    REQUIRE_FALSE(p.check());
    auto ledger = at<TestType>(p);
    auto plain = at<TestType>(ph::quantised_energy{.damping = 0.03, .quantum = p.quantum});
    for (int n = 0; n < 20; ++n) {
      typename TestType::vector dx = TestType::zero(), held = TestType::zero();
      for (int i = 0; i < TestType::dof; ++i) {
        TestType::component(dx, i) = static_cast<scalar>(random.chance(0.5) ? any() : -any());
        TestType::component(held, i) = static_cast<scalar>(random.chance(0.5) ? any() : -any());
      }
      const auto dt = static_cast<scalar>(std::max(any(), 1e-30));
      (ledger.update(dx, held, dt) ? booked : refused_ticks) += 1;
      (void)plain.update(dx, held, dt);
      REQUIRE(ph::kernels::is_finite(ledger.value()));
      REQUIRE(ph::kernels::is_finite(plain.value()));
      if (random.chance(0.1)) {
        ledger.forfeit(held, dt);
        plain.forfeit(held, dt);
        REQUIRE(ph::kernels::is_finite(ledger.value()));
        REQUIRE(ph::kernels::is_finite(plain.value()));
      }
    }
  }
  CHECK(booked > 1000);
  CHECK(refused_ticks > 1000);
}

TEST_CASE("a device with elastic friction that rests in free space owes nothing", "[encoders]") {
  auto touch = ph::make_touch<d1>(ph::encoder_device{.mass = 0.1,
                                                     .damping = 0.2,
                                                     .friction = 0.15,
                                                     .presliding = 1e-5,
                                                     .quantum = 1e-4,
                                                     .force_limit = 8.0},
                                  ph::trusted_hand{{.force = 5.0}});  // who is believed
  REQUIRE(touch.update({0.0, 1.0, 800.0}));
  CHECK(touch.tick(2e-3, 1ms).energy < 0.0);  // 5/2 c p, that the friction's springs may hold
  for (int n = 0; n < 100; ++n) CHECK(touch.tick(2e-3, 1ms).what == ph::event::nominal);
  for (int n = 0; n < 40; ++n) (void)touch.tick(2e-3 - 1e-4 * n, 1ms);
  int owed = 0;  // it is thrown out faster than any mass goes: a debt, and said to be one
  for (int n = 0; n < 40; ++n) owed += touch.tick(-2e-3 + 4e-3 * n, 1ms).what == ph::event::debt;
  CHECK(owed > 0);
}
