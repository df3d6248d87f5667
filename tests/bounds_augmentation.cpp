// SPDX-License-Identifier: BSD-3-Clause
// Bounds that grow stiff: growth, caps, resets, what an increment costs, and the promise against
// adversaries, judged by the true port energy.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/bounds/augmentation.hpp>
#include <passive_haptics/laws.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const ph::isotropic_damping<d1> b1{0.03};  // B = 30 N/m

/// A wall of 10 kN/m that pushes along −1; the device is `depth` inside and moved by `moved`.
ph::tick_state<d1> inside(double depth, double moved, double energy) {
  return {.damping = b1,
          .energy = energy,
          .in_flight = 0,
          .dt = 1e-3,
          .longest_tick = 1e-3,
          .held = 0,
          .displacement = moved,
          .motion_known = true,
          .normal = -1,
          .stiffness = 1e4,
          .depth = depth,
          .target_depth = depth,
          .local_force = 0,
          .target_changed = false};
}

/// What the spring of that wall asks for.
double asked(const ph::tick_state<d1>& state) {
  return -state.stiffness * std::max(state.target_depth, 0.0);
}

template <class Space>
auto coupling() {
  using scalar = typename Space::scalar;
  return ph::nonlinear_coupling<Space>{.initial = scalar(50), .rate = scalar(2e5)};
}
template <class Space>
auto increments() {
  using scalar = typename Space::scalar;
  return ph::stiffness_increment<Space>{.initial = scalar(50), .step = scalar(500)};
}
template <class Space>
auto offsets() {
  using scalar = typename Space::scalar;
  return ph::force_augmentation<Space>{.low = scalar(50), .step = scalar(0.5)};
}

/// The same growth with nothing that pays for it.
struct unpaid_growth : ph::no_bound<d1> {
  double initial = 50.0, step = 200.0, most = 1e4;  ///< [N/m], step per tick
  double stiffness = 0.0;
  double limit(double desired, const auto& state) noexcept {
    const double d = state.target_depth;
    stiffness = d > 0.0 ? std::clamp(stiffness + step, initial, most) : 0.0;
    return d > 0.0 ? state.normal * stiffness * d : desired;
  }
};

/// Growth that the ledger pays for, without the strict law behind it.
struct guard_alone : ph::no_bound<d1> {
  double initial = 50.0, step = 200.0, most = 1e4;
  double stiffness = 0.0;
  double limit(double desired, const auto& state) noexcept {
    const double d = state.target_depth;
    if (!(d > 0.0)) {
      stiffness = 0.0;
      return desired;
    }
    stiffness = std::max(stiffness, initial);
    const double f = stiffness * d;
    const double spare = state.credit() - std::max(f * d / 2, state.damping.worst_outflow(f, 1e-3));
    stiffness += std::max(std::min({step, most - stiffness, 2.0 * spare / (d * d)}), 0.0);
    return state.normal * stiffness * d;
  }
};

/// `Growing` with the strict law behind it; says whether that law ever took any of K d.
template <class Growing>
struct watched : Growing {
  static constexpr ph::bound_traits traits{.needs_ledger = true};
  bool* cut = nullptr;
  double limit(double desired, const auto& state) noexcept {
    const double f = ph::strict_bound<d1>{}.limit(Growing::limit(desired, state), state);
    if (std::abs(f) < this->stiffness * state.target_depth * (1.0 - 1e-9)) *cut = true;
    return f;
  }
};

struct conditions {
  bool jumping = true;  ///< the surface jumps by up to ±2 mm, its normal and stiffness change
  bool jitter = false;  ///< periods of 0.5 to 1.5 ms
  double lost = 0.0;    ///< probability that a sample is lost
  int ticks = 500;
};

/// A model with this bound against one prescribed motion; the least true port energy [J].
template <class Space, class Bound, class Motion>
double attack(const Bound& bound, Motion motion, const conditions& when, std::uint64_t seed) {
  using scalar = typename Space::scalar;
  using state = typename sim::physical<Space>::vector;
  auto model = following_half_space<Space>(
      ph::spring<Space>{}, thesis_ledger<Space>(), bound,
      ph::loop_limits<Space>{.longest_tick = scalar(when.jitter ? 1.5e-3 : 1e-3)});
  REQUIRE_FALSE(model.check());
  sim::random_source random(seed);
  sim::prescribed_motion<Space> device({.damping = 0.03});
  sim::jumping_surface jumps(2e-3, seed);
  sim::switching_stiffness stiffness(2e3, 22e3, seed + 1);
  state normal = random.direction<Space>();
  double offset = 0.0, K = 1e4;
  const auto place = [&] {
    model.retarget({sim::to_port<Space>(state(normal * offset)), sim::to_port<Space>(normal),
                    static_cast<scalar>(K)});
  };
  place();
  auto sample = device.exchange(Space::zero());
  for (int n = 0; n < when.ticks; ++n) {
    if (when.jitter) device.set_period(random.uniform(0.5e-3, 1.5e-3));
    if (when.jumping) {
      const double moved = jumps.offset(device.time());
      const double switched = stiffness.stiffness(device.time());
      if (moved != offset || switched != K) {
        offset = moved;
        K = switched;
        normal = random.direction<Space>();
        place();
      }
    }
    const bool lost = when.lost > 0.0 && random.chance(when.lost);
    if (lost) sample.valid = false;
    const auto out = model.tick(sample);
    const double depth =
        sim::physical<Space>::dot(state(normal * offset - device.position()), normal);
    device.move_to(motion.next({.position = device.position(),
                                .normal = normal,
                                .depth = depth,
                                .force = sim::to_physical<Space>(out.force),
                                .dt = static_cast<double>(sample.dt)},
                               random));
    sample = device.exchange(out.force);
  }
  return device.meter().minimum();
}

/// The worst of the four adversaries.
template <class Space, class Bound>
double worst_of(const Bound& bound, conditions when, int seeds) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(seeds); ++seed) {
    conditions still = when;
    still.jumping = when.jumping && seed % 2 == 0;
    const sim::random_walk<Space> slow{.speed = 0.02};  // what is lost, the surface gave
    worst = std::min({worst, attack<Space>(bound, sim::nyquist_motion<Space>{}, still, seed),
                      attack<Space>(bound, sim::random_walk<Space>{}, when, seed),
                      attack<Space>(bound, sim::greedy_motion<Space>{}, when, seed),
                      attack<Space>(bound, slow, when, seed)});
  }
  return worst;
}

/// Presses `deep` at `speed`, rests, and comes back out a little farther than the surface.
struct press_rest_release {
  double deep = 0.01, speed = 0.01, rest = 0.1;
  double phase = 0.0;
  double next(const sim::adversary_view<d1>& view, sim::random_source& /*random*/) noexcept {
    phase += view.dt;
    const double pressing = deep / speed;
    const double way = phase < pressing          ? -1.0
                       : phase < pressing + rest ? 0.0
                       : view.depth > -1e-3      ? 1.0
                                                 : 0.0;
    return view.position + view.normal * (way * speed * view.dt);
  }
};

template <class S>
constexpr bool obeys(auto bound, int ticks) {
  return ph::laws::scales_down<S>(bound, ticks) &&
         ph::laws::adds_nothing_to_zero<S>(bound, ticks) &&
         ph::laws::spends_at_most_the_ledger<S>(bound, ticks);
}

static_assert(obeys<d1>(ph::nonlinear_coupling<d1>{.initial = 50, .rate = 2e5}, 60));
static_assert(obeys<d1>(ph::stiffness_increment<d1>{.initial = 50, .step = 500}, 60));
static_assert(obeys<d1>(ph::force_augmentation<d1>{.low = 50, .step = 0.5}, 60));
static_assert(ph::nonlinear_coupling<d3>::passivity == ph::guarantee::strict);
static_assert(ph::stiffness_increment<d3>::passivity == ph::guarantee::strict);
static_assert(ph::force_augmentation<d3>::passivity == ph::guarantee::strict);

}  // namespace

TEMPLATE_TEST_CASE("bounds that grow stiff obey the laws of strict bounds that only reduce",
                   "[bound][law]", d1, f1, d2, f2, d3, f3) {
  CHECK(obeys<TestType>(coupling<TestType>(), 1000));
  CHECK(obeys<TestType>(increments<TestType>(), 1000));
  CHECK(obeys<TestType>(offsets<TestType>(), 1000));
}

TEST_CASE("nonlinear_coupling grows by rate·dt in series with the wall, up to its cap",
          "[bound][augmentation]") {
  ph::nonlinear_coupling<d1> bound{.initial = 50, .rate = 2e5, .most = 600};
  const auto felt = [](double Kc) { return Kc * 1e4 / (Kc + 1e4); };
  const auto state = inside(1e-3, 0.0, 1.0);
  for (const double Kc : {250.0, 450.0, 600.0, 600.0}) {
    CHECK_THAT(bound.limit(asked(state), state), WithinRel(-felt(Kc) * 1e-3, 1e-12));
    CHECK_THAT(bound.coupling, WithinRel(Kc, 1e-12));
  }
  SECTION("a longer tick grows more") {
    ph::nonlinear_coupling<d1> other{.initial = 50, .rate = 2e5};
    auto longer = state;
    longer.dt = 2e-3;
    (void)other.limit(asked(longer), longer);
    CHECK_THAT(other.coupling, WithinRel(450.0, 1e-12));
  }
  SECTION("without a cap it comes as near to the wall as one likes") {
    ph::nonlinear_coupling<d1> other{.initial = 50, .rate = 1e12};
    const auto rich = inside(1e-3, 0.0, 1e6);
    CHECK_THAT(other.limit(asked(rich), rich), WithinRel(asked(rich), 1e-4));
  }
  SECTION("it starts again when contact is lost") {
    const auto outside = inside(-1e-3, -1e-4, 1.0);
    CHECK(bound.limit(asked(outside), outside) == 0.0);
    CHECK_THAT(bound.limit(asked(state), state), WithinRel(-felt(250) * 1e-3, 1e-12));
  }
  SECTION("it starts again when a sample is lost") {
    auto unknown = state;
    unknown.motion_known = false;
    (void)bound.limit(asked(unknown), unknown);
    CHECK(bound.coupling == 0.0);
  }
}

TEST_CASE("stiffness_increment grows once when a press follows a release",
          "[bound][augmentation]") {
  ph::stiffness_increment<d1> bound{.initial = 50, .step = 500, .reset_after = 0.1};
  const auto in = inside(1e-3, 1e-5, 1.0);
  const auto out = inside(1e-3, -1e-5, 1.0);
  const auto tick = [&bound](const auto& state) {
    return -bound.limit(asked(state), state) / 1e-3;
  };
  CHECK_THAT(tick(in), WithinRel(50.0, 1e-12));
  CHECK_THAT(tick(in), WithinRel(50.0, 1e-12));
  CHECK_THAT(tick(out), WithinRel(50.0, 1e-12));
  CHECK_THAT(tick(inside(1e-3, 0.0, 1.0)), WithinRel(50.0, 1e-12));  // at rest: neither
  CHECK_THAT(tick(in), WithinRel(550.0, 1e-12));
  CHECK_THAT(tick(in), WithinRel(550.0, 1e-12));  // once
  SECTION("up to the stiffness of the wall") {
    for (int n = 0; n < 30; ++n) {
      (void)tick(out);
      (void)tick(in);
    }
    CHECK(bound.stiffness == 1e4);
    CHECK(bound.limit(asked(in), in) == asked(in));
  }
  SECTION("no stiffer than a wall that turns soft") {
    auto soft = in;
    soft.stiffness = 300;
    CHECK_THAT(tick(soft), WithinRel(300.0, 1e-12));
  }
  SECTION("a bounce is a release") {
    const auto outside = inside(-1e-3, -1e-4, 1.0);
    for (int n = 0; n < 50; ++n) (void)bound.limit(0.0, outside);  // 0.05 s
    CHECK_THAT(tick(in), WithinRel(1050.0, 1e-12));
  }
  SECTION("long enough away, it starts again") {
    const auto outside = inside(-1e-3, -1e-4, 1.0);
    for (int n = 0; n < 102; ++n) (void)bound.limit(0.0, outside);
    CHECK_THAT(tick(in), WithinRel(50.0, 1e-12));
  }
  SECTION("it starts again when a sample is lost") {
    auto unknown = in;
    unknown.motion_known = false;
    (void)bound.limit(asked(unknown), unknown);
    CHECK_THAT(tick(in), WithinRel(50.0, 1e-12));
  }
}

TEST_CASE("force_augmentation adds what is missing, a step at a turn", "[bound][augmentation]") {
  ph::force_augmentation<d1> bound{.low = 50, .step = 0.5};
  const auto in = inside(1e-4, 1e-5, 1.0);
  const auto out = inside(1e-4, -1e-5, 1.0);  // missing: (10000 − 50)·1e-4 = 0.995 N
  const auto tick = [&bound](const auto& state) { return -bound.limit(asked(state), state); };
  CHECK_THAT(tick(in), WithinRel(0.005, 1e-12));
  CHECK_THAT(tick(in), WithinRel(0.005, 1e-12));  // no turn yet
  CHECK_THAT(tick(out), WithinRel(0.505, 1e-12));
  CHECK_THAT(tick(out), WithinRel(0.505, 1e-12));
  CHECK_THAT(tick(in), WithinRel(1.0, 1e-12));  // 0.495 N was left
  CHECK_THAT(bound.offset, WithinRel(0.995, 1e-12));
  SECTION("deeper, the offset stays and K_L presses on") {
    CHECK_THAT(tick(inside(2e-4, 1e-4, 1.0)), WithinRel(0.01 + 0.995, 1e-12));
  }
  SECTION("shallower, never more than the wall asks") {
    CHECK_THAT(tick(inside(5e-5, -5e-5, 1.0)), WithinRel(0.5, 1e-12));
    CHECK_THAT(bound.offset, WithinRel(0.4975, 1e-12));  // what is missing there
  }
  SECTION("down by a step at most") {
    bound.step = 0.1;
    (void)tick(inside(5e-5, -5e-5, 1.0));
    CHECK_THAT(bound.offset, WithinRel(0.895, 1e-12));
  }
  SECTION("it is gone with the contact") {
    (void)bound.limit(0.0, inside(-1e-4, -2e-4, 1.0));
    CHECK_THAT(tick(in), WithinRel(0.005, 1e-12));
  }
  SECTION("it is gone with a lost sample") {
    auto unknown = in;
    unknown.motion_known = false;
    (void)bound.limit(asked(unknown), unknown);
    CHECK_THAT(tick(in), WithinRel(0.005, 1e-12));
  }
}

TEST_CASE("growth takes what the ledger has beyond release and worst tick, and no more",
          "[bound][augmentation]") {
  // at d = 20 mm, K = 50: release U = K d²/2 = 10 mJ, worst tick (K d)²/4B = 8.33 mJ
  const double d = 0.02, U = 0.01;
  SECTION("stiffness_increment: ΔK = 2 E_free/d²") {
    for (const double spare : {-1e-3, 0.0, 1e-3, 0.02}) {
      ph::stiffness_increment<d1> bound{.initial = 50, .step = 500};
      (void)bound.limit(asked(inside(d, 1e-5, U)), inside(d, 1e-5, U));
      (void)bound.limit(asked(inside(d, -1e-5, U)), inside(d, -1e-5, U));
      (void)bound.limit(asked(inside(d, 1e-5, U + spare)), inside(d, 1e-5, U + spare));
      CHECK_THAT((bound.stiffness - 50.0) * d * d / 2.0,
                 WithinAbs(std::max(spare, 0.0), 1e-15));  // charged in full
    }
  }
  SECTION("nonlinear_coupling: ΔK_c = 2 E_free/d²") {
    ph::nonlinear_coupling<d1> bound{.initial = 50, .rate = 1e7};
    auto state = inside(d, 0.0, 0.015);
    state.stiffness = 1e12;  // K_f = K_c
    (void)bound.limit(asked(state), state);
    CHECK_THAT((bound.coupling - 50.0) * d * d / 2.0, WithinRel(0.005, 1e-6));
  }
  SECTION("force_augmentation: ΔF = E_free/d") {
    ph::force_augmentation<d1> bound{.low = 50, .step = 1e3};
    (void)bound.limit(asked(inside(d, 1e-5, U)), inside(d, 1e-5, U));
    (void)bound.limit(asked(inside(d, -1e-5, U + 3e-3)), inside(d, -1e-5, U + 3e-3));
    CHECK_THAT(bound.offset * d, WithinRel(3e-3, 1e-9));
    const double kept = bound.offset;  // the next turn finds it promised
    (void)bound.limit(asked(inside(d, 1e-5, U + 3e-3)), inside(d, 1e-5, U + 3e-3));
    CHECK_THAT(bound.offset, WithinRel(kept, 1e-9));
  }
  SECTION("the same credit is not promised twice") {
    ph::nonlinear_coupling<d1> bound{.initial = 50, .rate = 1e3};
    const auto state = inside(d, 0.0, U + 1e-3);
    for (int n = 0; n < 1000; ++n) (void)bound.limit(asked(state), state);
    const double K = bound.coupling * 1e4 / (bound.coupling + 1e4);
    CHECK(K * d * d / 2.0 <= U + 1e-3);
    CHECK(bound.coupling > 50.0);
  }
  SECTION("above 2B the worst tick is the larger claim") {
    ph::stiffness_increment<d1> bound{.initial = 600, .step = 500};
    const double outflow = 600 * d * 600 * d / 120.0, release = 300 * d * d;
    REQUIRE(outflow > release);
    const double E = outflow + 0.01;
    (void)bound.limit(asked(inside(d, 1e-5, E)), inside(d, 1e-5, E));
    (void)bound.limit(asked(inside(d, -1e-5, E)), inside(d, -1e-5, E));
    (void)bound.limit(asked(inside(d, 1e-5, E)), inside(d, 1e-5, E));
    CHECK_THAT((bound.stiffness - 600.0) * d * d / 2.0, WithinRel(0.01, 1e-9));
  }
  SECTION("what is in flight is not spare") {
    ph::nonlinear_coupling<d1> bound{.initial = 50, .rate = 1e7};
    auto state = inside(d, 0.0, U + 1e-3);
    state.in_flight = 2e-3;
    (void)bound.limit(asked(state), state);
    CHECK(bound.coupling == 50.0);
    state.in_flight = 0.0;
    (void)bound.limit(asked(state), state);
    CHECK(bound.coupling > 50.0);
  }
}

TEST_CASE("a release gives back what its increments were charged, ΔK d²/2, at the true port",
          "[bound][augmentation]") {
  // pressed to d with K_0, grown at rest to K_1, released: −(K_1 − K_0) d²/2, but for the damper's
  // b v per metre and the hold's leak, both of the order of the step
  const double d = 0.01;
  sim::prescribed_motion<d1> device({.damping = 1e-6});
  const ph::isotropic_damping<d1> damping{1e-6};
  ph::nonlinear_coupling<d1> bound{.initial = 50, .rate = 1e4, .most = 400};
  double charged = 0.0, x = 0.0;
  const auto go = [&](double next) {
    const ph::tick_state<d1> plenty{.damping = damping,
                                    .energy = 1e9,  // covers everything
                                    .in_flight = 0,
                                    .dt = 1e-3,
                                    .longest_tick = 1e-3,
                                    .held = 0,
                                    .displacement = 0,
                                    .motion_known = true,
                                    .normal = -1,
                                    .stiffness = 1e12,
                                    .depth = x,
                                    .target_depth = x,
                                    .local_force = 0,
                                    .target_changed = false};
    const double before = std::max(bound.coupling, 50.0);
    const double f = bound.limit(-1e12 * std::max(x, 0.0), plenty);
    if (x > 0.0) charged += (bound.coupling - before) * x * x / 2.0;
    device.move_to(next);
    (void)device.exchange(f);
    x = next;
  };
  bound.rate = 0.0;
  for (int n = 1; n <= 10000; ++n) go(d * n / 10000);
  bound.rate = 1e4;
  for (int n = 0; n < 100; ++n) go(d);
  REQUIRE_THAT(bound.coupling, WithinRel(400.0, 1e-12));
  bound.rate = 0.0;
  for (int n = 9999; n >= 0; --n) go(d * n / 10000);
  CHECK_THAT(charged, WithinRel(350 * d * d / 2, 1e-9));
  CHECK_THAT(device.meter().value(), WithinRel(-charged, 2e-4));
}

TEST_CASE("bounds that grow stiff never lose energy to any adversary in 1, 2 and 3 dimensions",
          "[passivity][augmentation]") {
  for (const conditions& when : {conditions{}, conditions{.jitter = true}, conditions{.lost = 0.05},
                                 conditions{.jumping = false}}) {
    const auto all = [&](const auto& one, const auto& two, const auto& three) {
      CHECK(worst_of<d1>(one, when, 60) >= -1e-12);
      CHECK(worst_of<d2>(two, when, 30) >= -1e-12);
      CHECK(worst_of<d3>(three, when, 30) >= -1e-12);
    };
    all(coupling<d1>(), coupling<d2>(), coupling<d3>());
    all(increments<d1>(), increments<d2>(), increments<d3>());
    all(offsets<d1>(), offsets<d2>(), offsets<d3>());
  }
  for (const conditions& when : {conditions{}, conditions{.jumping = false}}) {
    CHECK(worst_of<d1>(unpaid_growth{}, when, 12) < -1e-3);  // the control
    // and the guard without the strict law: the hold's leak is not its business
    CHECK(worst_of<d1>(guard_alone{}, when, 12) < -1e-6);
  }
}

TEST_CASE("parameters of bounds that grow stiff are refused with their name",
          "[bound][augmentation]") {
  const auto name = [](const auto& bound) {
    const auto fault = bound.check();
    return std::string(fault ? fault.parameter : "");
  };
  const double nan = std::nan("");
  CHECK(name(coupling<d1>()).empty());
  CHECK(name(ph::nonlinear_coupling<d1>{}) == "initial");
  CHECK(name(ph::nonlinear_coupling<d1>{.initial = 50, .rate = -1}) == "rate");
  CHECK(name(ph::nonlinear_coupling<d1>{.initial = 50, .rate = 1, .most = 40}) == "most");
  CHECK(name(increments<d1>()).empty());
  CHECK(name(ph::stiffness_increment<d1>{.initial = nan}) == "initial");
  CHECK(name(ph::stiffness_increment<d1>{.initial = 50, .step = nan}) == "step");
  CHECK(name(ph::stiffness_increment<d1>{.initial = 50, .reset_after = nan}) == "reset_after");
  CHECK(name(offsets<d1>()).empty());
  CHECK(name(ph::force_augmentation<d1>{.low = 0}) == "low");
  CHECK(name(ph::force_augmentation<d1>{.low = 50, .step = -1}) == "step");
}

TEST_CASE("growth that nobody pays for loses energy even where the spring itself is passive",
          "[passivity][augmentation]") {
  // K ≤ 2b/T = 60 N/m and a wall that stays put: only the growth can lose
  const press_rest_release motion{.rest = 1.0};
  const conditions still{.jumping = false, .ticks = 3500};
  unpaid_growth unpaid;
  guard_alone paid;
  unpaid.initial = paid.initial = 20.0;
  unpaid.step = paid.step = 0.02;
  unpaid.most = paid.most = 60.0;
  CHECK(attack<d1>(unpaid, motion, still, 1) < -1e-3);
  CHECK(attack<d1>(paid, motion, still, 1) >= -1e-12);
  CHECK(worst_of<d1>(paid, {.jumping = false}, 20) >= -1e-12);
  CHECK(worst_of<d1>(paid, {.jumping = false, .jitter = true}, 20) >= -1e-12);
  unpaid.initial = 60.0;  // no growth
  CHECK(attack<d1>(unpaid, motion, still, 1) >= -1e-12);
}

TEST_CASE("up to 2b/T the strict law never cuts what the ledger paid for, and cuts what it did not",
          "[bound][augmentation]") {
  bool cut = false;
  const auto watch = [&cut](auto growing) {
    growing.initial = 20.0;
    growing.step = 0.02;
    growing.most = 60.0;
    growing.cut = &cut;
    return growing;
  };
  const conditions still{.jumping = false, .ticks = 3500};
  const press_rest_release motion{.rest = 1.0};
  const auto paid = watch(watched<guard_alone>{});
  CHECK(attack<d1>(paid, motion, still, 1) >= -1e-12);
  CHECK(worst_of<d1>(paid, still, 5) >= -1e-12);
  CHECK_FALSE(cut);
  CHECK(attack<d1>(watch(watched<unpaid_growth>{}), motion, still, 1) >= -1e-12);
  CHECK(cut);
}
