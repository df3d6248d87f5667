// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <array>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A bound of somebody else's, gone wrong: what it returns is no number where more than 1 N is asked.
struct lost_bound {
  static constexpr ph::guarantee passivity = ph::guarantee::none;
  static constexpr ph::bound_traits traits{};
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class Port>
  struct on {
    using effort = typename Port::effort;
    constexpr explicit on(const lost_bound& /*p*/) noexcept {}
    [[nodiscard]] effort limit(const effort& desired, const auto& /*state*/) const noexcept {
      return std::abs(desired) > 1.0 ? std::nan("") : desired;
    }
  };
};

}  // namespace

TEST_CASE("what a bound returns is looked at: no number is no force", "[port][fault]") {
  ph::passive_port guard{d1{}, ph::given_force{}, thesis_ledger(), lost_bound{}, thesis_loop};
  CHECK(guard.tick(0.0, 1ms, 0.5).force == 0.5);  // the control
  for (int n = 0; n < 3; ++n) {
    const auto out = guard.tick(0.0, 1ms, 2.0);
    CHECK(out.force == 0.0);
    CHECK(out.what == ph::event::rejected_sample);
    CHECK(out.limited);
  }
  CHECK(guard.tick(-1e-4, 1ms, 0.5).force == 0.5);  // and the ledger has kept its head
  CHECK_THAT(guard.energy(), WithinRel(0.03 * 1e-8 / 1e-3, 1e-9));
}

TEST_CASE("the ledger pairs a displacement with the force held while it happened (A27)",
          "[local_model]") {
  ph::reduced_energy ledger{.damping = 0.03, .loan = 0.1};
  ph::local_model model{d1{},
                        ph::fixed{wall<d1>(1000)},
                        ph::turn_at_once{},
                        ph::spring{},
                        ledger,
                        ph::strict_bound{},
                        ph::loop_limits{.longest_tick = 2e-3}};
  const double x0 = 1e-3, x1 = 1.5e-3, x2 = 1.2e-3;
  const auto first = model.tick(x0, 1ms);
  CHECK_THAT(first.force, WithinRel(-1.0, 1e-12));
  CHECK(first.energy == 0.1);  // no displacement is known yet
  const auto second = model.tick(x1, 1ms);
  CHECK_THAT(second.energy, WithinRel(0.1 + 30 * 0.25e-6 + 1.0 * 0.5e-3, 1e-12));
  const auto third = model.tick(x2, 2ms);
  CHECK_THAT(third.energy, WithinRel(second.energy + 15 * 0.09e-6 - 1.5 * 0.3e-3, 1e-12));
}

TEST_CASE("a device that reports what it held is believed, not the command (A28)",
          "[local_model]") {
  const auto make = [] {
    return following_half_space<d1>(ph::shaped{ph::spring{}, ph::thesis_rule{}}, thesis_ledger(),
                                    ph::no_bound{});
  };
  auto told = make(), untold = make();
  told.update(wall<d1>(1e4));
  untold.update(wall<d1>(1e4));
  double x = -1e-3;
  for (int n = 0; n < 20; ++n, x += 5e-4) {
    const double commanded = n == 0 ? 0.0 : told.law().force(x - 5e-4, 0);
    const double held = -std::min(commanded, 9.0);
    (void)told.tick({.position = x, .held = held, .dt = 1e-3, .valid = true});
    (void)untold.tick(x, 1ms);
  }
  CHECK(told.energy() < untold.energy());  // the motors never gave the force the other one booked
  CHECK_THAT(told.tick({.position = x, .held = 0, .dt = 1e-3, .valid = false}).force,
             WithinAbs(0, 0));
}

TEST_CASE("forces in flight are paired with the tick that will hold them (latency)",
          "[local_model]") {
  ph::reduced_energy ledger{.damping = 0.03, .loan = 1.0};
  ph::local_model model{d1{},
                        ph::fixed{wall<d1>(1000)},
                        ph::turn_at_once{},
                        ph::spring{},
                        ledger,
                        ph::strict_bound{},
                        ph::late_loop_limits<2>{.longest_tick = 1e-3}};
  double x = 0, expected = 1.0;
  std::array<double, 40> forces{};
  for (std::size_t n = 0; n < forces.size(); ++n) {
    const double dx = 1e-4 * std::sin(0.5 * static_cast<double>(n));
    x += dx;
    const auto out = model.tick(x, 1ms);
    forces[n] = out.force;
    if (n >= 1) expected += 30 * dx * dx - (n >= 3 ? forces[n - 3] : 0.0) * dx;
    CHECK_THAT(out.energy, WithinRel(expected, 1e-12));
  }
}

TEST_CASE("a composition promises no more than its weakest part", "[local_model]") {
  const auto promise = [](const auto& observer, const auto& bound, const auto& law) {
    using model = decltype(following_half_space<d1>(law, observer, bound));
    return model::passivity;
  };
  const auto ledger = thesis_ledger();
  const ph::spring spring;
  const ph::shaped thesis{spring, ph::thesis_rule{}};
  CHECK(promise(ledger, ph::strict_bound{}, spring) == ph::guarantee::strict);
  CHECK(promise(ledger, ph::reachable_bound{}, spring) == ph::guarantee::conditional);
  CHECK(promise(ledger, ph::strict_bound{}, thesis) == ph::guarantee::strict);  // a law asks
  CHECK(promise(ledger, ph::no_bound{}, thesis) == ph::guarantee::none);
  CHECK(promise(ledger, ph::no_bound{}, spring) == ph::guarantee::none);
  CHECK(promise(ph::no_observer{}, ph::no_bound{}, spring) == ph::guarantee::none);
}

TEST_CASE("a fault in any part of a port is told, and such a port ticks with force zero",
          "[port]") {
  const auto fault_of = [](const ph::given_force& rule, const ph::reduced_energy& ledger,
                           const ph::actuator_limit& bound, const ph::loop_limits& limits,
                           const ph::mass_observer& estimator) {
    ph::passive_port guard{d1{}, rule, ledger, bound, limits, estimator};
    const auto out = guard.tick(0.0, 1ms, 1.0);
    const auto fault = guard.check();
    CHECK((out.what == ph::event::rejected_parameters) == bool(fault));
    CHECK(out.force == (fault ? 0.0 : 1.0));
    return std::string(fault ? fault.parameter : "");
  };
  const ph::actuator_limit motors{.most = 2.0};
  const ph::mass_observer known{.mass = 0.1};
  CHECK(fault_of({}, thesis_ledger(), motors, thesis_loop, known).empty());
  CHECK(fault_of({.fade = 0.0}, thesis_ledger(), motors, thesis_loop, known) == "fade");
  CHECK(fault_of({}, {.damping = 0.0}, motors, thesis_loop, known) == "damping");
  CHECK(fault_of({}, thesis_ledger(), {.most = -1.0}, thesis_loop, known) == "most");
  CHECK(fault_of({}, thesis_ledger(), motors, {}, known) == "longest_tick");
  CHECK(fault_of({}, thesis_ledger(), motors, thesis_loop, {}) == "mass");
}

TEST_CASE("a port knows where its device is, once it has been told", "[port]") {
  ph::passive_port guard{d1{}, ph::given_force{}, thesis_ledger(), ph::strict_bound{}, thesis_loop};
  CHECK_FALSE(guard.has_position());
  (void)guard.tick(std::nan(""), 1ms, 1.0);
  CHECK_FALSE(guard.has_position());
  (void)guard.tick(0.125, 1ms, 1.0);
  CHECK(guard.has_position());
  (void)guard.tick(std::nan(""), 1ms, 1.0);
  CHECK(guard.position() == 0.125);
}

TEST_CASE("reset puts everything back but the parameters", "[port]") {
  const ph::reduced_energy ledger{.damping = 0.03, .loan = 0.25};
  auto used = following_half_space<d1>(ph::spring{}, ledger, ph::strict_bound{});
  const auto fresh = used;
  REQUIRE_FALSE(used.set(ph::freshness{.stale_after = 0.5}));
  used.update(wall<d1>(1000));
  for (int n = 0; n < 50; ++n) (void)used.tick(1e-4 * n, 1ms);
  REQUIRE(used.energy() != 0.25);
  used.reset();
  CHECK(used.energy() == 0.25);
  CHECK_FALSE(used.has_position());
  CHECK(used.source().check().parameter == nullptr);
  auto as_new = fresh;
  REQUIRE_FALSE(as_new.set(ph::freshness{.stale_after = 0.5}));
  for (int n = 0; n < 700; ++n) {
    if (n == 5) {
      used.update(wall<d1>(500));
      as_new.update(wall<d1>(500));
    }
    const double x = 1e-3 * std::sin(0.1 * n);
    const auto one = used.tick(x, 1ms), other = as_new.tick(x, 1ms);
    REQUIRE(one.force == other.force);
    REQUIRE(one.energy == other.energy);
    REQUIRE(one.what == other.what);
  }
}
