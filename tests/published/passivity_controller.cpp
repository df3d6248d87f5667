// SPDX-License-Identifier: BSD-3-Clause
// The series passivity controller: its formula and its books, the rows of S0, what it keeps and loses.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/published/energy_tank.hpp>
#include <passive_haptics/published/parallel_passivity_controller.hpp>
#include <passive_haptics/published/passivity_controller.hpp>
#include <passive_haptics/published/reference_energy.hpp>
#include <passive_haptics/published/set_position_modulation.hpp>

using attacks::drop, attacks::fall, attacks::inf, attacks::model_of, attacks::tapped;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3;

using series = ph::series_passivity_controller;
using crediting = ph::series_controller_with_damping;

/// E [J] of a copy: asked for nothing while it moves by 1 m, it answers with E − E_thr over it, if
/// that is negative. The damper of that tick takes nothing.
template <class Part>
double ledger_of(const Part& controller) {
  for (const double threshold : {0.0, 1e-2, 1.0, 100.0}) {
    auto parameters = controller.parameters();
    parameters.threshold = threshold;
    parameters.max_damping = ph::kernels::largest<double>();
    parameters.least_speed = parameters.least_travel = 0.0;
    parameters.reset_after = inf;
    Part copy = controller;
    copy.set(parameters);
    const double f = allowed(
        copy, 0.0, situation<d1>{.damping = at<d1>(ph::isotropic_damping{1e-300}), .travel = 1.0});
    if (f < 0.0) return threshold + f;
  }
  return inf;
}

/// A wall without an observer.
template <class Bound>
auto unobserved(const Bound& bound) {
  return following_half_space<d1>(ph::spring{}, ph::no_observer{}, bound);
}

/// The books of 2002: the NEW force with the LAST displacement. For comparison only.
struct same_sample_controller {
  static constexpr ph::guarantee passivity = ph::guarantee::none;
  static constexpr ph::bound_traits traits{};
  double max_damping = 50.0;

  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <ph::port P>
  class on {
   public:
    constexpr explicit on(const same_sample_controller& p) noexcept : most_(p.max_damping) {}
    constexpr void reset() noexcept { energy_ = 0.0; }
    [[nodiscard]] constexpr double limit(double desired, const auto& state) noexcept {
      const double dx = state.travel;
      const double would_be = energy_ - desired * dx;
      const double damping =
          would_be < 0.0 && dx != 0.0 ? std::min(-would_be * state.dt / (dx * dx), most_) : 0.0;
      const double force = desired - damping * dx / state.dt;
      energy_ -= force * dx;
      return force;
    }

   private:
    double most_, energy_ = 0.0;
  };
};

static_assert(ph::promise_of<same_sample_controller, d1>() == ph::guarantee::none);
static_assert([] {
  auto damper = at<f1>(crediting{.max_damping = 5});
  return allowed(damper, -1.0F, situation<f1>{.held = -2.0F, .travel = -0.001F}) > -1.0F;
}());

}  // namespace

TEST_CASE("the series controller repays a deficit with a damper and carries what it may not take",
          "[time domain]") {
  auto controller = at<d1>(series{.max_damping = 10.0});
  situation<d1> now{.held = -2.0};
  const auto force = [&](double desired) { return allowed(controller, desired, now); };
  SECTION("pressing in is income: nothing to do") {
    now.travel = 1e-4;
    CHECK(force(-3.0) == -3.0);
    CHECK_THAT(ledger_of(controller), WithinRel(2e-4, 1e-12));
  }
  SECTION("leaving: α = −E T/Δx², f = f* − α v, which pushes inwards") {
    now.travel = -1e-3;  // pushed out with 2 N: E = −2 mJ, α would be 2 N·s/m
    CHECK_THAT(force(-1.0), WithinRel(-1.0 + 2.0, 1e-12));
  }
  SECTION("capped; the rest is still owed in the next tick") {
    now.travel = -1e-4;  // E = −0.2 mJ, α would be 20
    CHECK_THAT(force(-1.0), WithinAbs(-1.0 + 10.0 * 0.1, 1e-12));
    now.held = 0.0;
    now.travel = -1e-3;
    CHECK_THAT(force(0.0), WithinRel(0.2, 1e-12));  // −E/|Δx|
  }
  SECTION("no action below a speed or below a quantum") {
    controller.set({.max_damping = 10.0, .least_speed = 0.02, .least_travel = 60e-6});
    now.travel = -59e-6;
    CHECK(force(-1.0) == -1.0);
    now.travel = -61e-6;
    CHECK(force(-1.0) > -1.0);
    now.dt = now.longest_tick = 4e-3;  // 61 µm in 4 ms is 15 mm/s
    CHECK(force(-1.0) == -1.0);
    now.travel = 0.0;
    CHECK(force(-1.0) == -1.0);
  }
  SECTION("it acts at just those, and at rest it does nothing however strong it may be") {
    controller.set({.max_damping = 10.0, .least_travel = 0x1p-14});
    now.travel = -0x1p-14;
    CHECK(force(-1.0) > -1.0);
    controller.set({.max_damping = ph::kernels::largest<double>()});
    now.travel = 0.0;
    CHECK(force(-1.0) == -1.0);
  }
  SECTION("a threshold below zero is a loan") {
    controller.set({.max_damping = 10.0, .threshold = -1e-3});
    now.travel = -4e-4;
    CHECK(force(-1.0) == -1.0);
    CHECK(force(-1.0) > -1.0);
  }
  SECTION("positive energy is voided after a force-free time, a debt is not") {
    controller = at<d1>(series{.max_damping = 10.0, .reset_after = 2e-3, .loan = 1e-3});
    now.held = 0.0;
    static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinRel(1e-3, 1e-12));
    controller.reset();  // and the time begins anew
    static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinRel(1e-3, 1e-12));
    now.held = -1.0;
    static_cast<void>(force(0.0));  // as it does with a force
    now.held = 0.0;
    static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinRel(1e-3, 1e-12));
    static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinAbs(0.0, 1e-17));
    now.held = -2.0;
    now.travel = -0.5e-3;  // 1 mJ goes out
    static_cast<void>(force(0.0));
    now.held = now.travel = 0.0;
    for (int n = 0; n < 4; ++n) static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinRel(-1e-3, 1e-12));
  }
  SECTION("a lost motion voids credit once it has started, and never a debt") {
    controller = at<d1>(series{.max_damping = 10.0, .loan = 1e-3});
    now.motion_known = false;
    static_cast<void>(force(0.0));  // the very first tick: nothing was held yet
    CHECK_THAT(ledger_of(controller), WithinRel(1e-3, 1e-12));
    static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinAbs(0.0, 1e-17));
    now.motion_known = true;
    now.travel = -0.5e-3;
    static_cast<void>(force(0.0));
    now.motion_known = false;
    static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinRel(-1e-3, 1e-12));
  }
  SECTION("a late tick is the worse of held and dropped") {
    controller = at<d1>(series{.max_damping = 10.0, .loan = 1e-3});
    now.dt = 2e-3;
    now.travel = 1e-3;
    static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinAbs(0.0, 1e-17));
    now.travel = -1e-3;
    static_cast<void>(force(0.0));
    CHECK_THAT(ledger_of(controller), WithinRel(-2e-3, 1e-12));
  }
}

TEST_CASE("the series controller damps along the motion in three dimensions, without an observer",
          "[time domain]") {
  auto model =
      following_half_space<d3>(ph::spring{}, ph::no_observer{}, series{.max_damping = 5.0});
  (void)model.update({{0, 0, 0}, {0, 0, 1}, 1000.0});
  const d3::vector inside(0, 0, -1e-3), outside(1e-4, 0, 1e-3);
  static_cast<void>(model.tick(inside, ph::seconds{T}));
  static_cast<void>(model.tick(outside, ph::seconds{T}));  // pressed out by K d over 2 mm
  const d3::vector step(2e-4, 3e-4, 0);
  const d3::vector force = model.tick(outside + step, ph::seconds{T}).force;
  CHECK((force + 5.0 * step / T).norm() < 1e-12);
}

TEST_CASE("the damping credit makes the books of the series controller the true port energy",
          "[time domain]") {
  auto controller = at<d1>(crediting{.max_damping = 50.0});
  sim::prescribed_motion<d1> device;
  sim::random_source random(3);
  auto sample = device.exchange(0.0);
  double x = 0.0, last = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const situation<d1> now{.held = sample.held, .travel = x - last};
    last = x;
    const double force = allowed(controller, -1000.0 * std::max(x, 0.0), now);
    x = random.uniform(-1e-3, 1e-3);
    device.move_to(x);
    sample = device.exchange(force);
  }
  const situation<d1> now{.held = sample.held, .travel = x - last};
  static_cast<void>(allowed(controller, 0.0, now));
  CHECK_THAT(ledger_of(controller), WithinRel(device.meter().value(), 1e-10));
}

TEST_CASE("with the pairing of 2002 the controller never acts while the wall feeds the device",
          "[time domain]") {
  const fall bare = drop(unobserved(ph::no_bound{}));
  const fall blind = drop(unobserved(same_sample_controller{}));
  CHECK((blind.forces == bare.forces));
  CHECK(blind.energy < -1.0);
  const fall held = drop(unobserved(series{.max_damping = 50.0}));  // the control
  CHECK(held.energy > -0.02);
}

TEST_CASE("the series controller reproduces its rows of S0 (docs/design/mathematics.md § 5)",
          "[time domain]") {
  const fall plain = drop(unobserved(series{.max_damping = 50.0}));
  CHECK_THAT(plain.swing, WithinRel(42.6e-3, 0.01));
  CHECK_THAT(plain.energy, WithinRel(-18e-3, 0.02));
}

TEST_CASE("a deficit is repaid if the motion goes on and doubles if it turns round",
          "[time domain]") {
  const auto after = [](double next) {
    auto controller = at<d1>(series{.max_damping = 1e9});
    situation<d1> now{.held = -2.0, .travel = -1e-3};
    const double force = allowed(controller, 0.0, now);
    REQUIRE_THAT(ledger_of(controller), WithinRel(-2e-3, 1e-12));
    now.held = force;
    now.travel = next;
    static_cast<void>(allowed(controller, 0.0, now));
    return ledger_of(controller);
  };
  CHECK_THAT(after(-1e-3), WithinAbs(0.0, 1e-15));
  CHECK_THAT(after(1e-3), WithinRel(-4e-3, 1e-12));
}

TEST_CASE("the series controller is not passive: a hand turns round and is fed", "[time domain]") {
  CHECK(attacks::least_of<d1>(series{.max_damping = 50.0}, {}, 40) < -0.1);
  CHECK(tapped(model_of<d1>(series{.max_damping = 50.0})) < -1e-3);
  CHECK(tapped(model_of<d1>(ph::strict_bound{})) >= -1e-12);  // the control
}

TEST_CASE("an α of half m/T stops a free mass and one of 2.1 m/T throws it", "[time domain]") {
  const auto speed_after_a_second = [](double share) {
    const double m = 0.1;
    auto model =
        model_of<d1>(series{.max_damping = share * m / T, .threshold = 1e12});  // α at its cap
    sim::device<d1> device({.mass = m, .damping = 0.0, .start_velocity = 0.1});
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 1000; ++n) sample = device.exchange(model.tick(sample).force);
    return std::abs(device.velocity());
  };
  CHECK(speed_after_a_second(0.35) < 1e-6);
  CHECK(speed_after_a_second(0.5) < 1e-6);
  CHECK(speed_after_a_second(2.1) > 1.0);
}

TEST_CASE("the series controller takes new parameters, refuses bad ones and starts anew",
          "[time domain]") {
  const series first{.max_damping = 50.0, .loan = 1e-5}, weaker{.max_damping = 10.0}, none{};
  check_upkeep(unobserved(first), first, weaker, none);
}

TEST_CASE("parameters of the time-domain controllers are refused with their name",
          "[time domain]") {
  const double nan = std::nan("");
  CHECK_FALSE(series{.max_damping = 50}.check());
  CHECK_FALSE(series{.max_damping = 50, .reset_after = 0}.check());
  CHECK(refused(series{}) == "max_damping");
  CHECK(refused(series{.max_damping = 50, .threshold = nan}) == "threshold");
  using reference = ph::reference_energy;
  CHECK(refused(reference{.controller = {.max_damping = 50}, .part = 1.1}) == "part");
  CHECK(refused(reference{.controller = {}, .part = 1.0}) == "max_damping");
  CHECK_FALSE(reference{.controller = {.max_damping = 50}, .part = 0.0}.check());
  CHECK_FALSE(reference{.controller = {.max_damping = 50}, .part = 1.0}.check());
  CHECK(refused(series{.max_damping = 50, .least_speed = -1}) == "least_speed");
  CHECK(refused(series{.max_damping = 50, .least_travel = nan}) == "least_travel");
  CHECK(refused(series{.max_damping = 50, .reset_after = nan}) == "reset_after");
  CHECK(refused(series{.max_damping = 50, .loan = -1}) == "loan");
  using parallel = ph::parallel_controller_parameters;
  CHECK_FALSE(parallel{.max_mobility = 1}.check());
  CHECK(refused(parallel{}) == "max_mobility");
  CHECK(refused(parallel{.max_mobility = 1, .threshold = nan}) == "threshold");
  CHECK(refused(parallel{.max_mobility = 1, .least_force = -1}) == "least_force");
  CHECK(refused(parallel{.max_mobility = 1, .loan = -1}) == "loan");
  CHECK_FALSE(ph::energy_tank{}.check());
  CHECK(refused(ph::energy_tank{.reserve = -1}) == "reserve");
  using layers = ph::two_layer_tank;
  CHECK_FALSE(layers{.wanted = 0.015, .refill = 3000.0, .max_damping = 50.0}.check());
  CHECK(refused(layers{.wanted = nan}) == "wanted");
  CHECK(refused(layers{.refill = -1}) == "refill");
  CHECK(refused(layers{.max_damping = -1}) == "max_damping");
  CHECK(refused(layers{.force_per_joule = 0}) == "force_per_joule");
  CHECK(refused(layers{.wanted = 1, .cap = 0.5}) == "cap");
  CHECK(refused(layers{.loan = nan}) == "loan");
  using gate = ph::set_position_modulation;
  CHECK_FALSE(gate{}.check());
  CHECK(refused(gate{.loan = -1}) == "loan");
  CHECK(refused(gate{.cap = -1}) == "cap");
  CHECK(refused(gate{.ask_again = 0}) == "ask_again");
}
