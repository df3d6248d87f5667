// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The passive local model: its parts, one tick.
//
//  x, dt ─▶ guard ─▶ observer ─▶ motion ─▶ probe ─▶ normal ─▶ contact ─▶ bound ─▶ follow ─▶ force
//           finite?   E1 += …    x, v     depth in  n_LM →   f* = K d…   |f| ≤    own plane
//           dt > 0?                       both      n_VE                 f(E1)    at depth f/K
//
// The order is the thesis's (Fig. 2.7, A27). Only this class holds the last position and the forces
// held, so the ledger always pairs a displacement with the force that was there while it happened.
// What is rare is kept out of line, so that the compiler sees the ordinary tick as one piece.
// In a tick: no exception, heap, lock, clock, virtual call, I/O or recursion.

#include <passive_haptics/concepts.hpp>
#include <passive_haptics/loop.hpp>
#include <passive_haptics/motion.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {

/// Compose by value; class template argument deduction finds the type:
///     ph::local_model wall{scene{},
///                          ph::rigid{ph::half_space<scene>{0.0, -1.0, 1e4}},
///                          ph::snap<scene>{},
///                          ph::spring<scene>{},
///                          ph::reduced_energy<scene>{.damping = 0.03},
///                          ph::strict_bound<scene>{}};
///     device.command(wall.tick(position, dt).force);
/// After the bound come, where the defaults do not fit, loop_limits and a motion estimator.
template <class Space, class Supply, class Normals, class Contact, class Observer, class Bound,
          class Motion = last_difference<Space>>
class local_model {
 public:
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using constraint_type = typename Supply::constraint_type;

  static_assert(constraint_for<constraint_type, Space>,
                "passive_haptics: the constraint does not model constraint_for: see concepts.hpp");
  static_assert(normal_interpolation_for<Normals, Space>,
                "passive_haptics: the normal interpolation does not model "
                "normal_interpolation_for: see concepts.hpp");
  static_assert(
      contact_law_for<Contact, Space>,
      "passive_haptics: the contact law does not model contact_law_for: see concepts.hpp");
  static_assert(energy_observer_for<Observer, Space>,
                "passive_haptics: the observer does not model energy_observer_for: "
                "see concepts.hpp");
  static_assert(force_bound_for<Bound, Space>,
                "passive_haptics: the bound does not model force_bound_for: see concepts.hpp");
  static_assert(motion_estimator_for<Motion, Space>,
                "passive_haptics: the motion estimator does not model motion_estimator_for: "
                "see concepts.hpp");
  static_assert(Observer::counts || !Bound::traits.needs_ledger,
                "passive_haptics: this bound spends energy that no_observer does not count: "
                "use reduced_energy");
  static_assert(Supply::moves || !Bound::traits.needs_local_model,
                "passive_haptics: this bound compares with a local model that can move: "
                "use following instead of rigid");

  /// The weakest promise among the parts.
  static constexpr guarantee passivity =
      std::min({Normals::passivity, Contact::passivity, Observer::passivity, Bound::passivity,
                Motion::passivity});

  constexpr local_model(Space /*scene*/, const Supply& supply, const Normals& normals,
                        const Contact& contact, const Observer& observer, const Bound& bound,
                        const loop_limits<Space>& limits = {}, const Motion& motion = {}) noexcept
      : supply_(supply),
        normals_(normals),
        contact_(contact),
        observer_(observer),
        bound_(bound),
        limits_(limits),
        motion_(motion) {
    held_.fill(Space::zero());
    sound_ = !check();
    if constexpr (!Supply::moves) contact_.adopt(supply_.target().stiffness, limits_.longest_tick);
  }

  /// The first parameter that is out of its range, if any. Such a model ticks with force zero.
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (const auto fault = limits_.check()) return fault;
    if (const auto fault = normals_.check()) return fault;
    if (const auto fault = contact_.check()) return fault;
    if (const auto fault = observer_.check()) return fault;
    if (const auto fault = bound_.check()) return fault;
    if (const auto fault = motion_.check()) return fault;
    return supply_.check();
  }

  /// Hands over the environment's newest constraint, from the haptic thread. False: it is unusable
  /// and the last good one stays; the next tick says so too.
  template <class Owner = Supply>
  requires(Owner::moves) constexpr bool retarget(const constraint_type& next) noexcept {
    return supply_.retarget(next);
  }

  /// One tick: the device is at `position` [m], `dt` [s] after the last one. The force of the last
  /// tick is taken to have been held exactly.
  [[nodiscard, gnu::flatten]] constexpr tick_result<Space> tick(const vector& position,
                                                                scalar dt) noexcept {
    return tick(position, dt, held_.back());
  }
  /// The same for a device that reports the force it really held.
  [[nodiscard, gnu::flatten]] constexpr tick_result<Space> tick(
      const device_sample<Space>& sample) noexcept {
    if (!sample.valid || !Space::is_finite(sample.held)) {
      return refuse(event::rejected_sample, sample.dt);
    }
    return tick(sample.position, sample.dt, sample.held);
  }

  [[nodiscard]] constexpr const constraint_type& local() const noexcept { return supply_.local(); }
  [[nodiscard]] constexpr const constraint_type& target() const noexcept {
    return supply_.target();
  }
  [[nodiscard]] constexpr scalar energy() const noexcept { return observer_.value(); }
  [[nodiscard]] constexpr const Contact& contact() const noexcept { return contact_; }

 private:
  static constexpr std::size_t latency = static_cast<std::size_t>(Bound::traits.latency);

  using state_type = tick_state<Space, decltype(Observer::damping)>;
  /// A bound that only reduces, and remembers nothing, has no say where nothing is asked.
  static constexpr bool zero_stays_zero = requires(const Bound& b, vector v, state_type s) {
    requires Bound::traits.only_reduces;
    b.limit(v, s);
  };

  [[nodiscard, gnu::always_inline, gnu::flatten]] constexpr tick_result<Space> tick(
      const vector& position, scalar dt, const vector& held) noexcept {
    if (!sound_) [[unlikely]] {
      return refuse(event::rejected_parameters, dt);
    }
    vector displacement = position - vector(position_);
    if (!trusted(position, displacement, dt)) [[unlikely]] {
      return refuse(event::rejected_sample, dt);
    }

    const bool known = seen_ && !(blind_ > scalar(0));
    if (known) [[likely]] {
      if (!book(displacement, held, dt)) [[unlikely]] {
        return refuse(event::rejected_sample, dt);
      }
    } else {
      displacement = Space::zero();
      observer_.forfeit(held, limits_.longest_tick);
      seen_ = true;
      blind_ = scalar(0);
    }
    position_ = position;
    event what = observer_.value() < scalar(0) ? event::debt : event::nominal;
    if (dt > limits_.longest_tick) what = event::late_tick;

    // Where are we, in the newest target and in our own constraint?
    const auto motion = motion_.estimate(position, displacement, held, dt, known);
    const vector& here = motion.position;
    const constraint_type& target = supply_.target();
    const scalar weight = presence(dt, what);
    const scalar target_depth = target.depth(here);
    const bool behind = weight > scalar(0) && target_depth > scalar(0);
    const bool in_target = behind && target.covers(here);
    scalar depth = target_depth;
    bool in_local = in_target && !beside_;  // coming in sideways is an update, not a contact (A18)
    if constexpr (Supply::moves) {
      if (!supply_.together()) {
        depth = supply_.local().depth(here);
        in_local = depth > scalar(0) && supply_.local().covers(here);
      }
      if (!(supply_.last_weight() > scalar(0))) in_local = false;  // so is a surface that appears
      beside_ = behind && !in_target;
    }

    // Which way, and how hard, if nothing held us back?
    [[maybe_unused]] const Contact before = contact_;  // with the stiffness up to now
    if (fresh()) contact_.adopt(target.stiffness, limits_.longest_tick);
    if constexpr (zero_stays_zero) {
      if (!in_target) return let_go(what, weight);
    }
    const vector goal = target.outward();
    vector normal = goal;
    if constexpr (Supply::moves) {
      if (in_local && !supply_.together()) {
        normal = normals_.step(supply_.local().outward(), goal, dt);
      }
    }
    const scalar outward_speed = motion.along(normal);
    scalar felt = in_target ? target_depth : scalar(0);
    scalar asked = in_target ? weight * contact_.force(target_depth, outward_speed) : scalar(0);
    const scalar twice = scalar(2) * asked;  // a unit normal may be an ulp too long
    if (!kernels::is_finite(twice) || !kernels::is_finite(felt)) [[unlikely]] {
      asked = felt = scalar(0);
      what = worse(what, event::rejected_target);
    }
    const vector desired = normal * asked;

    // How much of it does the ledger cover?
    scalar local_force(0);
    if constexpr (Bound::traits.needs_local_model) {
      if (in_local) local_force = supply_.last_weight() * before.force(depth, outward_speed);
    }
    const state_type state{.damping = observer_.damping,
                           .energy = observer_.value(),
                           .in_flight = in_flight(),
                           .dt = dt,
                           .longest_tick = limits_.longest_tick,
                           .held = held,
                           .displacement = displacement,
                           .displacement_error = displacement_error(),
                           .motion_known = known,
                           .normal = normal,
                           .stiffness = target.stiffness,
                           .depth = depth,
                           .target_depth = target_depth,
                           .local_force = local_force,
                           .target_changed = fresh()};
    vector force = bound_.limit(desired, state);
    const bool limited = !(force == desired);
    if (limited && !Space::is_finite(force)) [[unlikely]] {
      force = Space::zero();
      what = worse(what, event::rejected_sample);
    }

    // Put our own constraint where that force says it is.
    if constexpr (Supply::moves) {
      if (limited) {
        felt = contact_.depth(Space::dot(force, normal), outward_speed);
        if constexpr (!Bound::traits.only_reduces) {  // more than K d over a K next to nothing
          if (!kernels::is_finite(felt)) felt = scalar(0);
        }
      }
      if (limited || (in_target && !(normal == goal))) {
        supply_.approach(in_local, here, normal, felt);
      } else {
        supply_.sync();
      }
      supply_.seen(weight);
    }
    hold(force);
    return {force, felt, observer_.value(), what, limited};
  }

  /// Nothing is asked, so there is nothing to bound.
  constexpr tick_result<Space> let_go(event what, [[maybe_unused]] scalar weight) noexcept {
    if constexpr (Supply::moves) {
      supply_.sync();
      supply_.seen(weight);
    }
    hold(Space::zero());
    return {Space::zero(), scalar(0), observer_.value(), what, false};
  }

  /// One tick into the ledger; false if its energy is no number.
  [[nodiscard, gnu::always_inline]] constexpr bool book(const vector& displacement,
                                                        const vector& held, scalar dt) noexcept {
    if (dt > limits_.longest_tick) return book_late(displacement, held, dt);
    return observer_.update(displacement, held, dt);
  }
  /// A late tick may have let a watchdog drop the force part of the way, or not: it counts as the
  /// worse of the two. Vectors by value, so that the ordinary tick keeps its own in registers.
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr bool book_late(vector displacement, vector held,
                                                                   scalar dt) noexcept {
    Observer dropped = observer_;
    dropped.forfeit(held, limits_.longest_tick);
    if (!observer_.update(displacement, held, dt)) return false;
    if (dropped.value() < observer_.value()) observer_ = dropped;
    return true;
  }

  /// A finite sample, no farther from the last good one than the device can have gone since.
  [[nodiscard]] constexpr bool trusted(const vector& position, const vector& travel,
                                       scalar dt) const noexcept {
    const scalar largest = std::numeric_limits<scalar>::max();  // below infinity, and NaN
    if (!(dt > scalar(0))) return false;
    if (!seen_) return dt <= largest && Space::is_finite(position);  // there is no travel yet
    const scalar farthest = limits_.top_speed * (blind_ + dt);
    const scalar square = Space::dot(travel, travel);
    return square + dt <= largest && square <= farthest * farthest;
  }

  /// How far the contact counts at all: 1, less as a silent environment fades, 0 before
  /// its first word.
  [[nodiscard]] constexpr scalar presence(scalar dt, event& what) noexcept {
    if constexpr (Supply::moves) {
      if (supply_.refused()) what = worse(what, event::rejected_target);
      if (!supply_.published()) what = worse(what, event::no_target);
      if (!supply_.changed()) supply_.grow_older(dt);
      if (supply_.stale()) what = worse(what, event::stale_target);
      return supply_.weight();
    } else {
      return scalar(1);
    }
  }

  [[nodiscard]] constexpr bool fresh() const noexcept {
    if constexpr (Supply::moves) return supply_.changed();
    return false;
  }

  [[nodiscard]] constexpr scalar displacement_error() const noexcept {
    if constexpr (requires { observer_.displacement_error(); }) {
      return observer_.displacement_error();
    } else {
      return scalar(0);
    }
  }

  /// ¼ Σ fᵀB⁻¹f over the commands that are still on their way to the motors, rounded up (§ 3).
  [[nodiscard]] constexpr scalar in_flight() const noexcept {
    scalar promised(0);
    for (std::size_t j = 0; j < latency; ++j) {
      promised += observer_.damping.worst_outflow(held_[j], limits_.longest_tick);
    }
    return promised * (scalar(1) + kernels::rounding<scalar>());
  }

  constexpr void hold(const vector& force) noexcept {
    for (std::size_t j = latency; j > 0; --j) held_[j] = held_[j - 1];
    held_[0] = force;
  }

  /// Force zero; the motion since the last good sample is unknown and written off.
  [[gnu::cold, gnu::noinline]] constexpr tick_result<Space> refuse(event why, scalar dt) noexcept {
    if (sound_) observer_.forfeit(held_.back(), limits_.longest_tick);
    const bool lasted = dt > scalar(0) && dt <= std::numeric_limits<scalar>::max();
    const scalar passed = lasted ? dt : limits_.longest_tick;
    blind_ += passed;
    if constexpr (Supply::moves) supply_.grow_older(passed);
    hold(Space::zero());
    return {Space::zero(), scalar(0), observer_.value(), why, false};
  }

  Supply supply_;
  [[no_unique_address]] Normals normals_;
  Contact contact_;
  [[no_unique_address]] Observer observer_;
  [[no_unique_address]] Bound bound_;
  loop_limits<Space> limits_;
  [[no_unique_address]] Motion motion_;
  std::array<typename Space::coordinates, latency + 1> held_{};  ///< newest first; the last is held
  typename Space::coordinates position_{};                       ///< of the last good sample
  scalar blind_{};       ///< time since then that bad samples took [s]
  bool seen_ = false;    ///< has there been a good sample?
  bool beside_ = false;  ///< behind the surface, but outside its edges
  bool sound_ = true;    ///< are the parameters good?
};

}  // namespace v0
}  // namespace passive_haptics
