// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The passive port: one guard, one ledger and one bound for all contacts and forces of one device.
//
//  sample ─▶ GUARD ─▶ LEDGER ─▶ SOURCE.ask ─▶  BOUND  ─▶ SOURCE.answered ─▶ hold ─▶ force
//           finite?   E1 += …   wanted effort  |f| ≤     local model to       pairs the next
//           dt > 0?             (N, N·m)       f(E1)     the depth f/K        motion
//
// ONE PER DEVICE. Two ports on one device have two ledgers that spend the same damping: both types would be
// `strict`, and the hand could draw energy. Several contacts are one source (contact/contacts.hpp).
//
// ONE THREAD calls a port, or several in turns, because its calls must not overlap; debug builds check that
// (one_at_a_time.hpp). Other threads use an `exchange` (base/exchange.hpp).
//
// The order is that of the thesis (Fig. 2.7, A27). Rare cases are not inlined, so that the compiler optimises
// the ordinary tick as a whole. In a tick: no exception, heap, lock, clock, virtual call, I/O, recursion.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/base/seconds.hpp>
#include <passive_haptics/port/composing.hpp>
#include <passive_haptics/port/guard.hpp>
#include <passive_haptics/port/last_difference.hpp>
#include <passive_haptics/port/loop_limits.hpp>
#include <passive_haptics/port/one_at_a_time.hpp>

#include <algorithm>

namespace passive_haptics {
inline namespace v0 {

/// Compose by value; class template argument deduction finds the type. Force in, force out:
///     ph::passive_port device{scene{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03},
///                             ph::strict_bound{}, ph::loop_limits{.longest_tick = 0.0011}};
///     motors.command(device.tick(position, ph::seconds{dt}, wanted).force);
/// A motion estimator may follow the limits; the default is last_difference. A default-constructed port ticks with
/// force zero until another is assigned to it.
template <port P, class Source, class Observer, class Bound, class Limits = loop_limits,
          class Motion = last_difference>
class passive_port {
 public:
  using port_type = P;
  using scalar = typename P::scalar;
  using pose = typename P::pose;
  using motion = typename P::motion;
  using effort = typename P::effort;
  using source_type = part_at<Source, P>;
  using observer_type = part_at<Observer, P>;
  using bound_type = part_at<Bound, P>;

  static_assert(source_for<Source, P>,
                "passive_haptics: the source does not model source_for: see port/concepts.hpp");
  static_assert(!std::same_as<Limits, detail::left_out>,
                "passive_haptics: the limits of the loop are left out: after the bound comes "
                "loop_limits{.longest_tick = ...}");
  static_assert(std::same_as<Limits, detail::left_out> || limits_for<Limits, P>,
                "passive_haptics: the limits do not model limits_for: see port/concepts.hpp");
  static_assert(energy_observer_for<Observer, P>,
                "passive_haptics: the observer does not model energy_observer_for: "
                "see port/concepts.hpp");
  static_assert(detail::are_bounds<Bound>());

  using result_type = typename source_type::result_type;
  static constexpr int latency = Limits::latency;

 private:
  using damping_type =
      std::remove_cvref_t<decltype(std::declval<const observer_type&>().damping())>;

 public:
  using state_type =
      port_state<P, damping_type, latency, Observer::exact, Bound::traits.needs_ledger>;

  static_assert(force_bound_for<Bound, P, state_type>,
                "passive_haptics: the bound does not model force_bound_for: see port/concepts.hpp");
  static_assert(motion_estimator_for<Motion, P>,
                "passive_haptics: the motion estimator does not model motion_estimator_for: "
                "see port/concepts.hpp");
  static_assert(Observer::counts || !Bound::traits.needs_ledger,
                "passive_haptics: this bound spends energy that no_observer does not count: "
                "use reduced_energy");
  static_assert(Observer::counts || !detail::spends_ledger<source_type>(),
                "passive_haptics: this shaper spends energy that no_observer does not count: "
                "use reduced_energy");
  static_assert(
      Observer::exact || !assumptions_of<Bound>().exact_travel,
      "passive_haptics: this bound reads the motion itself and takes it as exact, and this "
      "observer is for encoders with steps: use strict_bound or reachable_bound");
  static_assert(latency <= assumptions_of<Bound>().latency,
                "passive_haptics: this bound is not proved for a loop that is so late: "
                "use strict_bound or reachable_bound");
  static_assert(
      !detail::turns<P>() || detail::books_turns<Observer>(),
      "passive_haptics: this port turns, and this observer takes every turn for a straight one: "
      "use reduced_energy with rigid_damping");
  static_assert(!detail::turns<P>() || assumptions_of<Bound>().turns,
                "passive_haptics: this bound is not proved for a port that turns: "
                "use strict_bound or rigid_reachable_bound");
  static_assert(
      !detail::reports_work<P>() || detail::books_work<observer_type, P>,
      "passive_haptics: this port reports the work of its motors, and this observer does not "
      "book it: use reduced_energy");
  static_assert(
      !detail::reports_work<P>() || assumptions_of<Bound>().reported_work,
      "passive_haptics: this port reports the work of its motors, and this bound takes it from "
      "the motion: use strict_bound");

  /// The weakest guarantee of ledger, bound and loop limits.
  static constexpr guarantee passivity =
      (std::min)({Observer::passivity, promise_of<Bound, P>(), Limits::passivity});

  constexpr passive_port() noexcept
      : passive_port(P{}, Source{}, Observer{}, Bound{}, Limits{}, Motion{}) {}
  constexpr passive_port(P /*port*/, const Source& source, const Observer& observer,
                         const Bound& bound, const Limits& limits,
                         const Motion& estimator = {}) noexcept
      : source_(source), observer_(observer), bound_(bound), limits_(limits), motion_(estimator) {
    begin();
  }

  /// The first parameter that is out of its range, if any. A port with such a fault ticks with force zero.
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = detail::fault_in(limits_)) return fault;
    if (const auto fault = detail::fault_in(observer_)) return fault;
    if (const auto fault = detail::fault_in(bound_)) return fault;
    if (const auto fault = detail::fault_in(motion_)) return fault;
    return detail::fault_in(source_);
  }

  /// Sets new parameters of one part; the ledger and all other state is kept. If they have a fault, nothing changes:
  ///     if (const auto fault = touch.set(ph::actuator_limit{.most = 6.0})) …
  template <class Parameters>
  constexpr parameter_fault set(const Parameters& p) noexcept {
    [[maybe_unused]] const auto alone = one_call();
    constexpr int found =
        std::same_as<Parameters, Limits> + detail::takers<Parameters, Observer, P> +
        detail::takers<Parameters, Bound, P> + detail::takers<Parameters, Motion, P> +
        detail::takers<Parameters, Source, P>;
    static_assert(found > 0, "passive_haptics: set(): no part of this port has such parameters");
    static_assert(found < 2, "passive_haptics: set(): more than one part has such parameters");
    if (const auto fault = detail::fault_in(p)) return fault;
    if constexpr (std::same_as<Parameters, Limits>) limits_ = limits_type(p);
    if constexpr (detail::takers<Parameters, Observer, P> == 1) {
      detail::take<Observer, P>(observer_, p);
    }
    if constexpr (detail::takers<Parameters, Bound, P> == 1) detail::take<Bound, P>(bound_, p);
    if constexpr (detail::takers<Parameters, Motion, P> == 1) detail::take<Motion, P>(motion_, p);
    if constexpr (detail::takers<Parameters, Source, P> == 1) detail::take<Source, P>(source_, p);
    begin();
    return {};
  }

  /// Resets everything but the parameters, with the loan, for a device that has stopped. There is no surface then: a
  /// first target that was given to `followed` has to be passed again.
  constexpr void reset() noexcept {
    [[maybe_unused]] const auto alone = one_call();
    detail::restart(source_);
    detail::restart(observer_);
    detail::restart(bound_);
    detail::restart(motion_);
    guard_.reset();
    watch_.reset();
    is_cut_ = false;
    if (stopped_ != event::forces_off) stopped_ = event::nominal;
    begin();
  }

  /// States that the driver drops all forces, as with motors off. Until they are stated to be on, ticks return force
  /// zero and event::forces_off, and the ledger books no motion; the outflow of the last effort is written off as with a
  /// lost sample. After that surfaces are treated as new; an effort of your own returns at once (docs/events.md).
  constexpr void enable_forces(bool on) noexcept {
    if (!on && stopped_ <= event::rejected_parameters) stopped_ = event::forces_off;
    if (!on || stopped_ != event::forces_off) return;
    stopped_ = event::nominal;
    static_cast<void>(source_.refused({P::zero(), energy(), event::forces_off, false}, scalar(0)));
    if constexpr (looks) bound_.watching().look_on(false);  // no window goes on over the gap
    begin();
  }

  /// One tick, with the device at `position`, `dt` after the last one (a std::chrono::duration or ph::seconds{…}). It
  /// assumes that the device held the commanded effort exactly.
  [[nodiscard, gnu::flatten]] constexpr result_type tick(const pose& position,
                                                         seconds<scalar> dt) noexcept {
    static_assert(!detail::reports_work<P>(),
                  "passive_haptics: this port reports the work of its motors: tick with a "
                  "device_sample, which says it");
    [[maybe_unused]] const auto alone = one_call();
    return advance(position, dt.count(), guard_.commanded().back());
  }
  /// The same for a device that reports the effort it really held.
  [[nodiscard, gnu::flatten]] constexpr result_type tick(const device_sample<P>& sample) noexcept {
    [[maybe_unused]] const auto alone = one_call();
    if constexpr (!trusting) {
      if (!sample.valid || !can_hold(sample.held)) {
        return refuse(event::rejected_sample, sample.dt);
      }
    }
    if constexpr (detail::reports_work<P>()) {
      return advance(sample.position, sample.dt, {sample.held, sample.work});
    } else {
      return advance(sample.position, sample.dt, sample.held);
    }
  }
  /// The same two with a desired effort for this tick, for a source that takes one.
  template <class Own = source_type>
  requires detail::takes_efforts<Own, P>
  [[nodiscard, gnu::flatten]] constexpr result_type tick(const pose& position, seconds<scalar> dt,
                                                         const effort& wanted) noexcept {
    source_.update(wanted);
    return tick(position, dt);
  }
  template <class Own = source_type>
  requires detail::takes_efforts<Own, P>
  [[nodiscard, gnu::flatten]] constexpr result_type tick(const device_sample<P>& sample,
                                                         const effort& wanted) noexcept {
    source_.update(wanted);
    return tick(sample);
  }
  /// Does not compile: a bare number as dt could as well be a position or a force.
  template <std::convertible_to<scalar> Number, class Last = effort>
  constexpr result_type tick(const pose& /*position*/, const Number& /*dt*/,
                             const Last& /*wanted*/ = {}) noexcept {
    detail::refuse_bare_time<Number>();
    return tick(device_sample<P>{});
  }

  /// Do not compile: a mesh is for the source, and its nodes are for its surface.
  template <class Mesh, class Own = source_type>
  requires(Own::touches_meshes) constexpr void touch(const Mesh& /*mesh*/) noexcept {
    detail::refuse_mesh<Mesh>();
  }
  template <class Nodes, class Own = source_type>
  requires(Own::touches_meshes) constexpr void update(const Nodes& /*nodes*/) noexcept {
    detail::refuse_mesh<Nodes>();
  }
  /// Does not compile: the slots of several surfaces are those of the source.
  template <class... Surface, class Own = source_type>
  requires requires(Own s, const Surface&... told) {
    typename Own::first_kind;
    s.update(0, told...);
  }
  constexpr void update(int /*slot*/, const Surface&... /*told*/) noexcept {
    detail::refuse_slot<Own>();
  }

  /// The displayed stiffness of the surface, its reason, and the reason for a smaller last force.
  template <class Own = source_type>
  requires requires(const Own s, explanation e, pose x, scalar T) { s.explain(e, x, T, 0); }
  [[nodiscard]] constexpr explanation explain() const noexcept {
    explanation e;
    if (stopped_ != event::nominal) {
      e.stiffness = stopped_ == event::rejected_parameters ? softened_by::parameters
                    : stopped_ == event::forces_off        ? softened_by::forces_off
                                                           : softened_by::refuted;
      return e;
    }
    if constexpr (!trusting) {
      if (guard_.blind() > scalar(0)) {
        e.stiffness = softened_by::sample;
        return e;
      }
    }
    e.force = static_cast<double>(detail::force_in<P>(guard_.commanded().front()));
    source_.explain(e, where(), limits_.longest_tick, latency);
    e.torque = static_cast<double>(detail::torque_in<P>(guard_.commanded().front()));
    detail::explain(bound_, e, observer_.damping(), limits_.longest_tick, latency);
    // A tick that asks for nothing where nothing stays nothing is not bounded, so is_cut_ is that of the tick before.
    const bool cut = is_cut_ && !(zero_stays_zero && e.depth == 0.0 && e.force == 0.0);
    // A surface that follows news waits at 0.1 mm of what the ledger pays for (port_state::paid_way).
    bool waits = cut;
    if constexpr (Bound::traits.needs_ledger) {
      waits = waits || (e.force > 0.0 && !(static_cast<double>(energy()) > 1.1e-4 * e.force));
    }
    if (e.now == softened_by::news ? waits : cut && e.now == softened_by::nothing) {
      e.now = softened_by::ledger;
    }
    if (!cut && e.depth > 0.0 && e.force > 0.95 * e.shown * e.depth) e.now = softened_by::nothing;
    const bool asks = cut || e.depth > 0.0;
    if (asks && !(e.force > 0.0) && !(energy() > scalar(0))) {
      const bool owes = energy() < scalar(0) && overdrawn();
      e.now = owes ? softened_by::ledger : softened_by::started_inside;
    }
    if constexpr (!Observer::exact) {
      const double q = static_cast<double>(travel_error()), E1 = static_cast<double>(energy());
      e.floor = e.shown * q;
      if (e.now == softened_by::ledger && E1 > 0.0) {  // f q/δ ≤ f, where f δ = E1
        e.floor = kernels::larger(e.floor, e.force * kernels::smaller(e.force * q / E1, 1.0));
      }
    }
    return e;
  }

  [[nodiscard]] constexpr scalar energy() const noexcept { return observer_.value(); }  ///< E1 [J]
  /// T [s], as stated, or the longest tick so far of a loop that learns.
  [[nodiscard]] constexpr scalar longest_tick() const noexcept { return limits_.longest_tick; }
  /// The position of the last good sample, if there has been one.
  [[nodiscard]] constexpr pose position() const noexcept { return guard_.last(); }
  [[nodiscard]] constexpr bool has_position() const noexcept { return guard_.has_seen(); }
  [[nodiscard]] constexpr source_type& source() noexcept { return source_; }
  [[nodiscard]] constexpr const source_type& source() const noexcept { return source_; }
  [[nodiscard]] constexpr observer_type& observer() noexcept { return observer_; }
  [[nodiscard]] constexpr const observer_type& observer() const noexcept { return observer_; }
  [[nodiscard]] constexpr const bound_type& bound() const noexcept { return bound_; }

 protected:
  /// A lock for the time of a call that changes the port, in debug builds only.
  [[nodiscard]] constexpr detail::one_at_a_time one_call() noexcept {
    return detail::one_at_a_time(busy_);
  }

 private:
  using limits_type = part_at<Limits, P>;
  using guard_type = typename Limits::template guard_type<P>;
  using held_type = detail::held_at<P>;

  /// True for trusted_loop_limits: samples are not checked, and a bad one is not written off.
  static constexpr bool trusting = guard_type::trusting;
  /// True if the bound only reduces, so zero effort stays zero, and if it has no state, so it need not be called then.
  static constexpr bool reduces = detail::reduces<Bound, P, state_type>();
  static constexpr bool zero_stays_zero = reduces && detail::keeps_nothing<Bound, P, state_type>();
  /// True if the bound limits the motion between samples, and the ledger uses that.
  static constexpr bool reaches = !trusting && detail::knows_reach<bound_type, P> &&
                                  detail::knows_most_held<bound_type> &&
                                  requires(observer_type o, const effort f, scalar s) {
    o.forfeit(f, s, s);
  };
  static constexpr bool knows_hidden =
      reaches && detail::turns<P>() &&
      requires(observer_type o, const motion m, const held_type f, scalar s) {
    o.update(m, f, s, s);
  };
  struct unasked {};
  /// True if the desired effort is finite and the bound only reduces it, so that the result need not be checked.
  static constexpr bool always_numbers = source_type::asks_for_numbers && reduces;
  static constexpr bool looks = detail::looks_at_motion<bound_type>;
  /// True if the bound reckons with what a mass can do in a tick, and so with its length.
  static constexpr bool reckons = promise_of<Bound, P>() == guarantee::conditional;
  struct no_ticks {};
  /// True if the bound also limits the distance of a sample from the last motion.
  static constexpr bool doubts = looks && reaches && detail::has_geometry<P>;
  struct last_seen {
    scalar square = kernels::largest<scalar>(), dt{1};
    [[nodiscard]] constexpr last_seen last() const noexcept { return *this; }
  };
  /// The last tick with a known motion; its square is the largest number before the first.
  using what_was_seen =
      std::conditional_t<doubts, motion_check<P>, std::conditional_t<reaches, last_seen, unasked>>;
  /// True if the observer recovers from faults and reports wall_lost and wall_back (forgiving.hpp).
  static constexpr bool mends = requires(observer_type o) { o.tells(event::nominal, false); };
  /// True if the source itself states that there is no desired effort.
  static constexpr bool says_nothing = zero_stays_zero && !detail::takes_efforts<source_type, P>;

  [[nodiscard, gnu::always_inline, gnu::flatten]] constexpr result_type advance(
      const pose position, scalar dt, const held_type& held) noexcept {
    const typename P::stored_effort& force = detail::force_of<P>(held);
    if constexpr (looks) {
      if (bound_.watching().looks()) [[unlikely]]
        look(position, dt, force);
    }
    if (stopped_ != event::nominal) [[unlikely]]
      return refuse_all(dt);
    motion travel = P::between(guard_.last(), position);
    [[maybe_unused]] scalar square{};
    if constexpr (reaches) square = P::squared(travel);
    bool known = true;
    if constexpr (doubts) {
      if (!(seen_.is_calm(square, dt) && !is_late(dt, limits_.longest_tick) &&
            guard_.within(position, limits_.workspace))) [[unlikely]] {
        if (!guard_.believes(position, travel, dt, limits_)) return refuse_sample(position, dt);
        if (!seen_.is_easy(travel) && !thought_about(travel, dt)) {
          return refuse(event::rejected_sample, dt);
        }
        known = guard_.knows_motion();
      }
    } else {
      if constexpr (!trusting) {
        if (!guard_.believes(position, travel, dt, limits_)) [[unlikely]] {
          return refuse_sample(position, dt);
        }
      }
      known = guard_.knows_motion();
    }
    if (!known) [[unlikely]] {
      travel = resume(travel, force, dt);
      square = kernels::largest<scalar>();
    } else if (!book(travel, held, dt)) [[unlikely]] {
      return refuse(event::rejected_sample, dt);
    }
    guard_.move_to(position);
    if constexpr (doubts) {
      if (known) seen_.see(travel, dt);
    } else if constexpr (reaches) {
      seen_ = {square, dt};
    }
    const bool late = is_late(dt, limits_.longest_tick);
    event what = booked_as(travel, dt, late);
    if constexpr (Limits::traits.learns) {
      const scalar T =
          kernels::smaller(limits_.taught.after(dt, limits_.longest_tick), limits_.watchdog);
      if (!(T == limits_.longest_tick)) learn(T);
    }
    const state_type state{.damping = observer_.damping(),
                           .commanded = guard_.commanded(),
                           .energy = observer_.value(),
                           .dt = dt,
                           .longest_tick = limits_.longest_tick,
                           .recent = recent(),
                           .held = force,
                           .travel = travel,
                           .travel_error = travel_error(),
                           .motion_known = known,
                           .late = late};
    const auto request = source_.template ask<reduces>(
        motion_.estimate(position, travel, force, dt, known), state, what);
    if constexpr (reduces) {
      if (request.nothing) {
        if constexpr (!zero_stays_zero) {
          detail::idle<Bound, P>(bound_, state);
          is_cut_ = false;
          if constexpr (reckons) recent_ = {};
          if constexpr (looks) what = worse(what, bound_.watching().seen());
        }
        if constexpr (looks) bound_.watching().look_on(false);
        guard_.command(P::zero());
        amend(what, false);
        return source_.answered(request, {P::zero(), observer_.value(), what, false});
      }
    }
    auto allowed = bounded(request.wanted, state, what);
    if constexpr (looks) {
      bound_.watching().look_on(says_nothing || !(request.wanted == P::zero()));
      if (bound_.watching().seen() != event::nominal) [[unlikely]] {
        what = worse(what, bound_.watching().seen());
        if (bound_.watching().lets_go()) allowed = {P::zero(), true};
      }
    }
    amend(what, allowed.limited);
    guard_.command(allowed.force);
    is_cut_ = allowed.limited;
    if constexpr (reckons) {
      if (is_cut_) [[unlikely]]
        recent_.see(dt, limits_.longest_tick);
      else
        recent_ = {};
    }
    return source_.answered(request, {allowed.force, observer_.value(), what, allowed.limited});
  }

  /// Passes the last tick to a bound that tests its assumptions, before anything else of this tick.
  [[gnu::noinline]] constexpr void look(typename P::stored_pose position, scalar dt,
                                        typename P::stored_effort held) noexcept {
    if constexpr (looks) {
      const motion travel = P::between(guard_.last(), position);
      bool known = guard_.knows_motion() && !is_late(dt, limits_.longest_tick);
      if constexpr (!trusting) known = known && guard_.believes(position, travel, dt, limits_);
      if constexpr (doubts) {
        known = known && seen_.is_possible(travel, dt, far_off());
        if (known) seen_.ease(far_off(), limits_.longest_tick, limits_.top_speed);
      }
      const bool doubted = bound_.watching().seen() != event::nominal;
      bound_.watching().template look<Observer::exact>(known, travel, guard_.commanded().back(),
                                                       held, dt, observer_);
      if (bound_.watching().seen() > event::outside_force) stopped_ = bound_.watching().seen();
      if (doubted && bound_.watching().forgives())
        disturbed();  // the hand has sunk in without paying energy in
    }
  }
  /// True if this sample is possible after those before it.
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr bool thought_about(
      typename P::stored_effort travel, scalar dt) noexcept {
    if constexpr (doubts) {
      if (!seen_.judge(travel, guard_.blind() + dt, far_off())) return false;
      seen_.ease(far_off(), limits_.longest_tick, limits_.top_speed);
    }
    return true;
  }
  [[nodiscard]] constexpr auto far_off() noexcept {
    return [this](scalar T0, scalar t, scalar speeds) {
      if constexpr (doubts) {
        const scalar most = P::norm(bound_.most_held()) / scalar(2);
        return bound_.watching().template far_off<Observer::exact>(T0, t, speeds, most, observer_);
      } else {
        return scalar(0);
      }
    };
  }
  /// Writes off the unknown motion since the last good sample as the worst one; returns no motion.
  [[nodiscard, gnu::always_inline]] constexpr motion resume([[maybe_unused]] const motion& travel,
                                                            const typename P::stored_effort& held,
                                                            scalar dt) noexcept {
    write_off(held, dt);
    if constexpr (doubts) {
      if (guard_.has_seen()) seen_.see(travel, guard_.blind() + dt);
    }
    guard_.see_again();
    return P::zero();
  }
  /// The event of a tick that was booked.
  [[nodiscard, gnu::always_inline]] constexpr event booked_as(const motion& travel, scalar dt,
                                                              [[maybe_unused]] bool late) noexcept {
    if constexpr (!trusting) {
      if (watch_.repeats(travel, dt, limits_.top_speed)) return event::repeated_sample;
      if (late) {
        disturbed();
        return event::late_tick;
      }
    }
    if constexpr (mends && Observer::exact) return event::nominal;  // amend() sets the event
    return observer_.value() < scalar(0) && overdrawn() ? event::debt : event::nominal;
  }
  /// The event of an observer that recovers from faults, a debt included.
  [[gnu::always_inline]] constexpr void amend([[maybe_unused]] event& what,
                                              [[maybe_unused]] bool cut) noexcept {
    if constexpr (mends) {
      if (observer_.remembers()) [[unlikely]]
        what = observer_.tells(what, cut);
    }
  }
  /// True if the ledger is in debt. A ledger that begins below zero, for elastic friction, has overdrawn() for it.
  [[nodiscard]] constexpr bool overdrawn() const noexcept {
    if constexpr (requires { observer_.overdrawn(); }) return observer_.overdrawn();
    return true;
  }
  /// The bounded effort; zero, and an event, if it is not finite.
  [[nodiscard, gnu::always_inline]] constexpr detail::bounded<P> bounded(const effort& wanted,
                                                                         const state_type& state,
                                                                         event& what) noexcept {
    auto allowed = detail::applied<P>(bound_, wanted, state);
    if constexpr (!always_numbers) {
      if (!P::is_finite(allowed.force)) [[unlikely]] {
        what = detail::worse_yet(what, event::rejected_sample);
        return {P::zero(), true};
      }
    }
    return allowed;
  }

  /// Books one tick; returns false if its energy is not finite.
  [[nodiscard, gnu::always_inline]] constexpr bool book(const motion& travel, const held_type& held,
                                                        scalar dt) noexcept {
    if constexpr (!trusting) {
      if (dt > limits_.watchdog) return book_cut_short(travel, held, dt);
    }
    if constexpr (knows_hidden) {
      if (is_late(dt, limits_.longest_tick)) return book_late(travel, held, dt);
    }
    return observer_.update(travel, held, dt);
  }
  /// The work that a long turn may hide, which the inertia may limit more than lemma C.
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr bool book_late(typename P::stored_effort travel,
                                                                   held_type held,
                                                                   scalar dt) noexcept {
    if constexpr (knows_hidden) return observer_.update(travel, held, dt, unseen(held, dt).beside);
    return observer_.update(travel, held, dt);
  }
  /// The most work that an effort can have done in a time `dt` [s] without samples, after the last known tick.
  [[nodiscard]] constexpr detail::unseen_work<scalar> unseen(const effort& held,
                                                             scalar dt) const noexcept {
    if constexpr (reaches) {
      const auto [square, T0] = seen_.last();
      return bound_.unseen(detail::seen_tick<P>{square, T0, travel_error(), bound_.most_held()},
                           observer_.damping(), held, dt);
    } else {
      return {kernels::largest<scalar>(), kernels::largest<scalar>()};
    }
  }
  /// Writes off the largest outflow of `held` in a tick of unknown motion, not inlined if the bound limits it.
  [[gnu::always_inline]] constexpr void write_off(const typename P::stored_effort& held,
                                                  scalar dt) noexcept {
    if constexpr (reaches) return write_off_reach(held, dt);
    if constexpr (!trusting) observer_.forfeit(held, limits_.held_for(dt));
  }
  [[gnu::cold, gnu::noinline]] constexpr void write_off_reach(typename P::stored_effort held,
                                                              scalar dt) noexcept {
    if constexpr (reaches) {
      const scalar blind = guard_.blind() + kernels::larger(dt, limits_.longest_tick);
      observer_.forfeit(held, limits_.held_for(dt), unseen(held, blind).done);
    }
  }
  /// Books a tick in which the watchdog may or may not have dropped the force, as the worse of both cases; a ledger
  /// with more state than a number drops the state that only one of them covers (§ 3). Vectors are passed by value as
  /// stored types, so that the ordinary tick keeps its own in registers.
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr bool book_cut_short(
      typename P::stored_effort travel, held_type held, scalar dt) noexcept {
    observer_type dropped = observer_;
    if constexpr (reaches) {
      dropped.forfeit(detail::force_of<P>(held), limits_.watchdog,
                      unseen(detail::force_of<P>(held), limits_.watchdog).done);
    } else {
      dropped.forfeit(detail::force_of<P>(held), limits_.watchdog);
    }
    if (!observer_.update(travel, held, dt)) return false;
    if constexpr (!Observer::exact) observer_.forfeit(P::zero(), limits_.watchdog);
    if (dropped.value() < observer_.value()) observer_ = dropped;
    return true;
  }

  /// The estimated position of the device, which within an encoder step is better than the measured one.
  [[nodiscard]] constexpr pose where() const noexcept {
    if constexpr (requires { motion_.position(); }) {
      return motion_.position();
    } else {
      return guard_.last();
    }
  }
  [[nodiscard]] constexpr recent_ticks<scalar, Observer::exact> recent() const noexcept {
    if constexpr (reckons) return recent_;
    return {};
  }
  [[nodiscard]] constexpr scalar travel_error() const noexcept {
    if constexpr (Observer::exact) {
      return scalar(0);
    } else {
      return observer_.travel_error();
    }
  }

  [[gnu::cold, gnu::noinline]] constexpr result_type refuse_all(scalar dt) noexcept {
    return refuse(stopped_, dt);
  }
  [[gnu::cold, gnu::noinline]] constexpr result_type refuse_sample(typename P::stored_pose position,
                                                                   scalar dt) noexcept {
    const motion travel = P::between(guard_.last(), position);
    const bool possible = guard_.is_possible(position, travel, dt, limits_.top_speed);
    return refuse(possible ? event::outside_workspace : event::rejected_sample, dt);
  }
  /// Returns no effort, and writes off the unknown motion since the last good sample.
  [[gnu::cold, gnu::noinline]] constexpr result_type refuse(event why, scalar dt) noexcept {
    const bool lasted = dt > scalar(0) && kernels::is_finite(dt);
    const scalar passed = lasted ? dt : limits_.longest_tick;
    if constexpr (!trusting) {
      if (stopped_ != event::rejected_parameters) write_off(guard_.commanded().back(), passed);
      if (stopped_ == event::nominal) disturbed();
    }
    if constexpr (doubts) seen_.think();
    guard_.lose_sight(passed);
    guard_.command(P::zero());
    return source_.refused({P::zero(), observer_.value(), why, false}, passed);
  }

  /// Reports a fault to an observer that recovers from faults.
  constexpr void disturbed() noexcept {
    if constexpr (requires { observer_.disturbed(); }) observer_.disturbed();
  }
  /// True if the device can have held a force: it is finite and within the motors' limit, if the bound knows one.
  [[nodiscard]] constexpr bool can_hold(const effort& held) const noexcept {
    if constexpr (requires { bound_.can_hold(held); }) {
      // A commanded effort was possible, even if set() has lowered the limit since.
      return bound_.can_hold(held) || held == effort(guard_.commanded().back());
    } else {
      return P::is_finite(held);
    }
  }
  /// Sets another T, of which the source is told.
  [[gnu::cold, gnu::noinline]] constexpr void learn(scalar T) noexcept {
    limits_.longest_tick = T;
    detail::tell(source_, limits_.longest_tick, latency);
  }
  /// Recomputes everything that depends on parameters.
  constexpr void begin() noexcept {
    if (stopped_ <= event::rejected_parameters) {
      stopped_ = check() ? event::rejected_parameters : event::nominal;
    }
    recent_ = {};
    if constexpr (reaches) seen_ = {};  // the former limit of the motors may have been larger
    detail::tell(source_, limits_.longest_tick, latency);
  }

  source_type source_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS observer_type observer_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS bound_type bound_;
  limits_type limits_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS part_at<Motion, P> motion_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS guard_type guard_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS sensor_watch<P, Limits::traits.watched> watch_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS
  std::conditional_t<reckons, recent_ticks<scalar, Observer::exact>, no_ticks> recent_;
  bool is_cut_ = false;             ///< the bound has reduced the last desired effort
  event stopped_ = event::nominal;  ///< the reason for force zero until set() or reset()
  std::uint8_t busy_ = 0;           ///< true during a call; debug builds only
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS
  what_was_seen seen_;
};

/// The deduction guide for a port without limits, so that the compiler names what is missing.
template <class P, class Source, class Observer, class Bound>
passive_port(P, Source, Observer, Bound)
    -> passive_port<P, Source, Observer, Bound, detail::left_out>;

}  // namespace v0
}  // namespace passive_haptics
