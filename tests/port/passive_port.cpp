// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/eased.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/energy_observer/forgiving.hpp>
#include <passive_haptics/force_bound/watched.hpp>
#include <passive_haptics/port/reported_work.hpp>

#include <array>
#include <cmath>
#include <set>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using ph::event;

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

/// A ledger that says something of its own in every tick.
struct talks : ph::reduced_energy {
  template <class P>
  struct on : ph::part_at<ph::reduced_energy, P> {
    constexpr explicit on(const talks& p) noexcept : ph::part_at<ph::reduced_energy, P>(p) {}
    [[nodiscard]] constexpr bool remembers() const noexcept { return true; }
    [[nodiscard]] constexpr event tells(event so_far, bool cut) const noexcept {
      return ph::worse(so_far, cut ? event::wall_lost : event::wall_back);
    }
  };
};
/// A motion estimator that counts from its last reset on: so many millimetres.
struct counts {
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class P>
  struct on {
    struct seen {
      double position;
      [[nodiscard]] constexpr double along(double /*n*/) const noexcept { return 0.0; }
    };
    int ticks = 0;
    constexpr explicit on(const counts& /*p*/) noexcept {}
    constexpr void reset() noexcept { ticks = 0; }
    [[nodiscard]] constexpr seen estimate(double /*x*/, double /*dx*/, double /*held*/,
                                          double /*dt*/, bool /*known*/) noexcept {
      return {-1e-3 * ++ticks};
    }
  };
};

}  // namespace

TEST_CASE("a port resets its motion estimator, and its ledger speaks in the air as well",
          "[port]") {
  ph::passive_port port{d1{},
                        ph::local_contact{ph::fixed{ph::half_space<d1>{0.0, 1.0, 1000.0}},
                                          ph::turn_at_once{}, ph::spring{}},
                        ph::no_observer{},
                        ph::no_bound{},
                        thesis_loop,
                        counts{}};
  for (int n = 0; n < 2; ++n) {
    port.reset();
    for (const double force : {1.0, 2.0, 3.0}) CHECK(port.tick(0.0, 1ms).force == force);
  }
  ph::local_model wall{d1{},
                       ph::followed{ph::half_space<d1>{0.0, 1.0, 1000.0}},
                       ph::turn_at_once{},
                       ph::spring{},
                       talks{{.damping = 0.03}},
                       ph::strict_bound{},
                       thesis_loop};
  CHECK(wall.tick(1e-3, 1ms).what == event::wall_back);
  CHECK(wall.tick(-1e-2, 1ms).what == event::wall_lost);
}

TEST_CASE("motors that are off and on again between two ticks make news of a surface", "[port]") {
  const auto felt = [](bool off) {
    ph::local_model wall{d1{},
                         ph::followed{ph::half_space<d1>{0.0, 1.0, 1000.0}},
                         ph::turn_at_once{},
                         ph::eased{ph::spring{}},
                         ph::no_observer{},
                         ph::no_bound{},
                         thesis_loop};
    (void)wall.tick(1e-3, 1ms);
    (void)wall.tick(-1e-3, 1ms);
    if (off) {
      wall.enable_forces(false);
      wall.enable_forces(true);
    }
    const auto out = wall.tick(-1e-3, 1ms);
    CHECK(out.what == event::nominal);
    return out.force;
  };
  CHECK(felt(false) == 1.0);
  CHECK(felt(true) < 0.1);
}

TEST_CASE("a port books the work that its device reports, and a debt that is more than elastic",
          "[port]") {
  ph::passive_port arm{ph::reported_work<d1>{}, ph::given_force{},
                       ph::reduced_energy{.damping = 0.03, .loan = 1.0}, ph::strict_bound{},
                       thesis_loop};
  (void)arm.tick({.position = 0.0, .held = 0.0, .dt = 1e-3, .valid = true, .work = 0.0}, 0.5);
  const auto out =
      arm.tick({.position = 1e-3, .held = 0.5, .dt = 1e-3, .valid = true, .work = 0.25}, 0.5);
  CHECK(out.what == event::nominal);
  CHECK_THAT(out.energy,
             WithinRel(1.0 + 0.03 * 1e-6 / 1e-3 - 0.25, 1e-12));  // and not 0.5 N · 1 mm

  ph::passive_port rubs{
      d1{}, ph::given_force{},
      ph::dual_ledger{.damping = {.coefficient = 0.05, .coulomb = 0.1, .presliding = 2e-5},
                      .quantum = 1e-4,
                      .window = 0.03},
      ph::no_bound{}, thesis_loop};
  const auto tick = [&](double x, double wanted) {
    return rubs.tick({.position = x, .held = wanted, .dt = 1e-3, .valid = true}, wanted).what;
  };
  CHECK(tick(0.0, 0.0) == event::nominal);
  CHECK(tick(0.0, 0.0) == event::nominal);
  CHECK(tick(1e-2, 9.0) == event::debt);
}

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

namespace {

/// A port for forces that a renderer gives a second time: its parts are the library's, and what happens between them in
/// a tick is written down anew, each case by itself (architecture.md; mathematics.md § 3, § 11 to § 13).
template <class P, class Observer, class Bound, class Limits>
struct plainly {
  using vector = typename P::vector;
  using observer_type = ph::part_at<Observer, P>;
  using bound_type = ph::part_at<Bound, P>;
  using damping_type = std::remove_cvref_t<decltype(std::declval<observer_type&>().damping())>;
  using state_type = ph::port_state<P, damping_type, Limits::latency, true>;
  struct said {
    vector force;
    double energy;
    event what;
    bool limited;
  };

  observer_type ledger;
  bound_type bound;
  ph::part_at<Limits, P> limits;
  typename state_type::commands commands{};  // newest first, the last is held
  ph::motion_check<P> check{};
  ph::recent_ticks<double> recent{};
  vector last = P::zero();
  double blind = 0.0;  // since the last good sample [s]
  bool seen = false;
  event stopped = event::nominal;

  plainly(const Observer& o, const Bound& b, const Limits& l) : ledger(o), bound(b), limits(l) {
    commands.fill(P::zero());
  }
  [[nodiscard]] bool doubted() const {
    return const_cast<plainly&>(*this).bound.watching().seen() != event::nominal;
  }
  void shaken() {
    if constexpr (requires { ledger.disturbed(); }) ledger.disturbed();
  }
  auto far_off() {
    return [this](double T0, double t, double speeds) {
      return bound.watching().template far_off<true>(T0, t, speeds, P::norm(bound.most_held()) / 2,
                                                     ledger);
    };
  }
  void command(const vector& f) {
    for (std::size_t j = commands.size() - 1; j > 0; --j) commands[j] = commands[j - 1];
    commands[0] = f;
  }
  void write_off(const vector& held, double dt) {
    const auto [square, T0] = check.last();
    const ph::detail::seen_tick<P> tick{square, T0, 0.0, bound.most_held()};
    const double longer = dt > limits.longest_tick ? dt : limits.longest_tick;
    const double done = bound.unseen(tick, ledger.damping(), held, blind + longer).done;
    ledger.forfeit(held, limits.held_for(dt), done);
  }
  [[nodiscard]] bool possible(const vector& x, const vector& travel, double dt) const {
    if (!(dt > 0.0 && std::isfinite(dt) && P::is_finite(x))) return false;
    return !seen || P::norm(travel) <= limits.top_speed * (blind + dt);
  }
  [[nodiscard]] bool within(const vector& x) const { return P::norm(x) <= limits.workspace; }
  said refuse(event why, double dt) {
    const double passed = dt > 0.0 && std::isfinite(dt) ? dt : limits.longest_tick;
    write_off(commands.back(), passed);
    if (stopped == event::nominal) shaken();
    check.think();
    blind += passed;
    command(P::zero());
    return {P::zero(), ledger.value(), why, false};
  }
  void look(const vector& travel, const vector& x, double dt, const vector& held) {
    const double T = limits.longest_tick;
    bool known = seen && blind == 0.0 && dt <= T && possible(x, travel, dt) && within(x);
    known = known && check.is_possible(travel, dt, far_off());
    if (known) check.ease(far_off(), T, limits.top_speed);
    const bool doubts = doubted();
    bound.watching().template look<true>(known, travel, commands.back(), held, dt, ledger);
    if (bound.watching().seen() > event::outside_force) stopped = bound.watching().seen();
    if (doubts && bound.watching().forgives()) shaken();
  }
  said tick(const ph::device_sample<P>& s, const vector& wanted) {
    const vector x = s.position, held = s.held, travel = x - last;
    const double dt = s.dt, T = limits.longest_tick;
    const bool was_commanded = held == vector(commands.back());
    if (!s.valid || !(bound.can_hold(s.held) || was_commanded)) {
      return refuse(event::rejected_sample, dt);
    }
    if (bound.watching().looks()) look(travel, x, dt, held);
    if (stopped != event::nominal) return refuse(stopped, dt);

    const bool calm = check.is_calm(P::squared(travel), dt) && dt <= T;
    if (!possible(x, travel, dt)) return refuse(event::rejected_sample, dt);
    if (!within(x)) return refuse(event::outside_workspace, dt);
    if (!calm && !check.is_easy(travel)) {
      if (!check.judge(travel, blind + dt, far_off())) return refuse(event::rejected_sample, dt);
      check.ease(far_off(), T, limits.top_speed);
    }
    const bool known = seen && blind == 0.0;
    vector moved = travel;
    if (!known) {
      write_off(held, dt);
      if (seen) check.see(travel, blind + dt);
      seen = true;
      blind = 0.0;
      moved = P::zero();
    } else {
      observer_type dropped = ledger;
      if (!ledger.update(travel, s.held, dt)) return refuse(event::rejected_sample, dt);
      if (dt > limits.watchdog) {  // which may have dropped the force: what is worse counts
        const auto [square, T0] = check.last();
        const ph::detail::seen_tick<P> tick{square, T0, 0.0, bound.most_held()};
        const double most = limits.watchdog;
        dropped.forfeit(held, most, bound.unseen(tick, ledger.damping(), held, most).done);
        if (dropped.value() < ledger.value()) ledger = dropped;
      }
      check.see(travel, dt);
    }
    last = x;
    const bool late = dt > T;
    event what = late ? event::late_tick : event::nominal;
    if (late) shaken();
    if constexpr (!requires { ledger.tells(what, true); }) {
      if (!late && ledger.value() < 0.0) what = event::debt;
    }
    const state_type state{.damping = ledger.damping(),
                           .commanded = commands,
                           .energy = ledger.value(),
                           .dt = dt,
                           .longest_tick = T,
                           .recent = recent,
                           .held = s.held,
                           .travel = moved,
                           .travel_error = 0.0,
                           .motion_known = known,
                           .late = late};
    auto allowed = ph::detail::applied<P>(bound, wanted, state);
    bound.watching().look_on(P::norm(wanted) > 0.0);
    if (doubted()) {
      what = ph::worse(what, bound.watching().seen());
      if (bound.watching().lets_go()) allowed = {P::zero(), true};
    }
    if constexpr (requires { ledger.tells(what, true); }) {
      if (ledger.remembers()) what = ledger.tells(what, allowed.limited);
    }
    command(allowed.force);
    if (allowed.limited) {
      recent.see(dt, T);
    } else {
      recent = {};
    }
    return {allowed.force, ledger.value(), what, allowed.limited};
  }
};

/// A ledger that counts what it is told of faults.
struct counted : ph::reduced_energy {
  template <ph::port P>
  class on : public ph::part_at<ph::reduced_energy, P> {
   public:
    int told = 0;
    constexpr explicit on(const counted& p) noexcept : ph::part_at<ph::reduced_energy, P>(p) {}
    constexpr void disturbed() noexcept { ++told; }
  };
};

/// A device in a hand that is as strong as it is `strong` [N], whose samples get lost, come late, are off or lie.
/// Returns which events there were.
template <class P, class Observer, class Bound, class Limits>
std::set<event> lives(unsigned seed, double strong, int lies, const Observer& observer,
                      const Bound& bound, const Limits& limits) {
  using vector = typename P::vector;
  ph::laws::samples random(seed);
  const auto some = [&] { return random.number<double>(); };
  ph::passive_port port{P{}, ph::given_force{}, observer, bound, limits};
  plainly<P, Observer, Bound, Limits> twin(observer, bound, limits);
  std::set<event> events;
  std::array<vector, Limits::latency + 1> flying{};
  flying.fill(P::zero());
  vector x = P::zero(), v = P::zero();
  for (int n = 0; n < 1500; ++n) {
    const double t = 1e-3 * n;
    const double dt = n % 97 == 96 ? 1.6e-3 : n % 41 == 40 ? 0.5e-3 : n % 307 == 306 ? 12e-3 : 1e-3;
    vector aim = P::zero();
    P::component(aim, P::dof - 1) = -5e-3 + 7e-3 * std::cos(9.0 * t);
    vector hand = 600.0 * (aim - x) - 1.0 * v;
    if (P::norm(hand) > strong) hand *= strong / P::norm(hand);
    vector held = flying.back();
    if (lies == 1 && n > 700 && n % 250 < 20) held = -held;
    v += dt / 0.1 * (hand + held - 0.05 * v);
    x += dt * v;
    vector shown = x, told = held;
    double stamp = dt;
    if (lies == 2 && n % 173 > 160) told = flying.back() * (1.0 + 0.5 * some());
    if (lies == 3 && n % 211 == 200) told = told * 1e3;
    if (n % 89 == 88) shown += random.vector<P>() * (n % 2 == 0 ? 2e-3 : 0.03);
    if (n % 263 > 260) shown *= n % 2 == 0 ? std::nan("") : 1e3;
    if (n % 409 == 408) stamp = n % 2 == 0 ? 0.0 : std::nan("");
    const ph::device_sample<P> s{
        .position = shown, .held = told, .dt = stamp, .valid = n % 131 < 129};
    const double deep = std::max(0.0, -P::component(x, P::dof - 1));
    vector wanted = P::zero();
    P::component(wanted, P::dof - 1) = 2500.0 * deep;
    P::component(wanted, 0) += 20.0 * deep;
    if (n % 500 > 480) wanted = P::zero();
    const auto expected = twin.tick(s, wanted);
    const auto out = port.tick(s, wanted);
    CAPTURE(seed, n, int(out.what), int(expected.what), out.energy, expected.energy);
    REQUIRE(out.what == expected.what);
    REQUIRE_THAT(out.energy, WithinAbs(expected.energy, 1e-12));
    REQUIRE(P::norm(vector(out.force) - expected.force) <= 1e-9);
    REQUIRE(out.limited == expected.limited);
    if constexpr (requires { twin.ledger.told; }) {
      REQUIRE(port.observer().told == twin.ledger.told);
    }
    events.insert(out.what);
    for (std::size_t j = flying.size() - 1; j > 0; --j) flying[j] = flying[j - 1];
    flying[0] = out.force;
  }
  return events;
}

}  // namespace

TEST_CASE("a port does what its parts do one after the other, whatever its samples are like",
          "[port][law]") {
  const ph::bound_chain bound{ph::watched{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0}},
                              ph::actuator_limit{.most = 8.0}};
  const ph::reduced_energy ledger{.damping = 0.05, .loan = 1e-3};
  const ph::forgiving mild{ledger, 0.02};
  const ph::loop_limits prompt{
      .longest_tick = 1e-3, .top_speed = 5.0, .workspace = 0.01, .watchdog = 5e-3};
  const ph::late_loop_limits<1> late{
      .longest_tick = 1e-3, .top_speed = 5.0, .workspace = 0.01, .watchdog = 1.2e-3};
  std::set<event> all;
  for (unsigned seed = 1; seed < 4; ++seed) {
    for (const int lies : {0, 1, 2, 3}) {
      for (const double strong : {4.5, 25.0}) {
        all.merge(lives<d1>(seed, strong, lies, mild, bound, prompt));
        all.merge(lives<d2>(seed, strong, lies, ledger, bound, prompt));
        all.merge(lives<d3>(seed, strong, lies, mild, bound, late));
        all.merge(lives<d1>(seed, strong, lies, counted{ledger}, bound, prompt));
      }
    }
  }
  for (const event e :
       {event::nominal, event::late_tick, event::outside_workspace, event::rejected_sample,
        event::outside_force, event::wrong_sign, event::wall_lost, event::wall_back}) {
    CAPTURE(to_string(e));
    CHECK(all.contains(e));
  }
}
