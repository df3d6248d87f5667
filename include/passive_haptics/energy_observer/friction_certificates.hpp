// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The credit of dry friction in a ledger of positions that are known to a step only; a part of dual_ledger.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// The functions that a ledger needs of an elastic friction; device/dry_friction.hpp has them.
template <class D, class P>
concept friction_for = requires(const D d, const typename P::motion m, const typename P::effort f,
                                typename P::scalar s) {
  { d.viscous(m, s) } -> std::same_as<typename P::scalar>;
  { d.friction_near(f) } -> std::convertible_to<typename P::effort>;
  { d.friction_along(m) } -> std::convertible_to<typename P::effort>;
  { d.most_friction() } -> std::same_as<typename P::scalar>;
  { d.hysteresis(f) } -> std::same_as<typename P::scalar>;
  { d.stored(f) } -> std::same_as<typename P::scalar>;
  { d.most_stored() } -> std::same_as<typename P::scalar>;
};

/// Every sequence u(1), u(2), … [N] of assumed friction forces gives a lower bound of the energy, a certificate
/// (A, u) of § 6. Which one is best is known only later, so three are kept beside the ledger's own, u = 0:
///
///   following    u follows the force within |u| ≤ c (a play operator): it loses least while the force hunts at rest
///   slipped[2]   u opposes a recent motion: it earns most while that motion continues
///
/// A change of u by d costs ½ Σ qᵢ|dᵢ| + p|d| [J] at any time, so a certificate that is behind another by more than
/// that is replaced by it. Each one is valid by itself, so any may be dropped. A `lead` is A − |u|²p/(2c) less the
/// ledger's own A [J]; sums are rounded down, costs up.
template <class P, class Owed>
class friction_certificates : Owed {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;

  /// Starts again with u = 0 in every certificate.
  constexpr void reset() noexcept {
    following_ = slipped_[0] = slipped_[1] = {P::zero(), scalar(0), scalar(0)};
    own() = {};
    directions_ = 0;
    missed_ = scalar(0);
  }

  /// Takes new parameters, and brings every u within the new friction.
  constexpr void set(const auto& damping, const auto& steps) noexcept {
    const scalar up = scalar(1) + kernels::rounding<scalar>();
    const scalar doubt = damping.most_friction() * steps.travel_error() / scalar(2);
    leaving_ = (doubt + damping.most_stored()) * up;
    dearest_ = (doubt + scalar(3) * damping.most_stored()) * up;
    for (certificate* one : {&following_, &slipped_[0], &slipped_[1]}) {
      *one = moved(*one, damping.friction_near(effort(one->friction)), damping, steps);
    }
  }

  /// Books a change of the held force by `change` [N], for which the ledger has charged `doubt` [J] to every
  /// certificate. The following one owes less and gets the difference back.
  constexpr void follow(const effort& change, scalar doubt, const auto& damping,
                        const auto& steps) noexcept {
    if (!(doubt > scalar(0))) return;
    const effort before = effort(following_.friction);
    const effort now = damping.friction_near(effort(before + change));
    const effort way = now - before;
    const scalar cost = steps.doubt(effort(way - change)) + damping.hysteresis(way);
    const scalar stored = damping.stored(now);
    own() = own().charged(steps, -change);
    for (certificate& one : slipped_) one.owed = one.owed.charged(steps, -change);
    following_.owed = following_.owed.charged(steps, way - change);
    following_.lead += doubt - cost + (following_.stored - stored) -
                       kernels::rounding<scalar>() * (doubt + cost + dearest_);
    following_.friction = now;
    following_.stored = stored;
  }

  /// Books a measured motion. Returns the energy by which the best lead exceeds what it may cost to drop friction,
  /// which the ledger books as its own [J].
  [[nodiscard]] constexpr scalar slip(const motion& shown, const auto& damping,
                                      const auto& steps) noexcept {
    const effort along = damping.friction_along(shown);
    const scalar most = P::work(along, shown).joules;
    if (!(most > scalar(0) && most < kernels::largest<scalar>() / scalar(8))) return scalar(0);
    std::array<scalar, 2> gain{earned(slipped_[0], shown), earned(slipped_[1], shown)};

    const std::size_t i = gain[1] > gain[0] ? 1 : 0;
    if (gain[i] > most * scalar(0.99)) {  // one certificate opposes this motion already
      missed_ = scalar(0);
      if (following_.lead > slipped_[i].lead) {
        const certificate there = moved(following_, effort(slipped_[i].friction), damping, steps);
        if (there.lead > slipped_[i].lead) slipped_[i] = there;
      }
    } else {
      certificate fresh = moved(following_, along, damping, steps);
      if (fresh.lead < -dearest_) fresh.owed = {};
      fresh.lead = kernels::larger(fresh.lead, -dearest_);
      const bool room = directions_ < slipped_.size();
      const std::size_t j = room                                                      ? directions_
                            : slipped_[1].lead + gain[1] < slipped_[0].lead + gain[0] ? 1
                                                                                      : 0;
      missed_ += most - gain[j];
      if (room || fresh.lead + missed_ > slipped_[j].lead) {
        missed_ = scalar(0);
        slipped_[j] = fresh;
        gain[j] = most;
        if (room) ++directions_;
      }
    }

    const scalar lost = kernels::rounding<scalar>() * (most + dearest_);  // by rounding, at most
    earn(following_, earned(following_, shown) - lost);
    earn(slipped_[0], gain[0] - lost);
    earn(slipped_[1], gain[1] - lost);
    const certificate& best = slipped_[slipped_[1].lead > slipped_[0].lead ? 1 : 0];
    if (following_.lead < best.lead) {
      const certificate there = moved(best, effort(following_.friction), damping, steps);
      if (!(there.lead < following_.lead)) following_ = best;
    }
    const scalar spare = kernels::larger(following_.lead, best.lead) - leaving_;
    if (!(spare > scalar(0))) return scalar(0);
    own() = (following_.lead < best.lead ? best : following_).owed;
    fall_behind(spare);
    return spare;
  }

  /// Gives back what `steps` knows to be owed of the charges; returns what the ledger is to book of it [J].
  [[nodiscard]] constexpr scalar give_back(auto& steps) noexcept {
    const scalar back = steps.given_back(own());
    for (certificate* one : {&following_, &slipped_[0], &slipped_[1]}) {
      one->lead = kernels::sum_rounded_down(one->lead, steps.given_back(one->owed) - back);
    }
    return back;
  }

  /// Lowers every lead by `booked` [J], which the ledger has booked from another source.
  constexpr void fall_behind(scalar booked) noexcept {
    for (certificate* one : {&following_, &slipped_[0], &slipped_[1]}) one->lead -= booked;
  }

  /// The value of the best certificate less the ledger's own A, under the force `held` of that `doubt` [J].
  [[nodiscard]] constexpr scalar lead(const effort& held, scalar doubt,
                                      const auto& steps) const noexcept {
    const scalar slipped =
        worth(slipped_[slipped_[1].lead > slipped_[0].lead ? 1 : 0], held, steps);
    return kernels::larger(-doubt, kernels::larger(worth(following_, held, steps), slipped));
  }

  /// The friction's part of the loss of the best certificate [J] over a tick of unknown motion, in which `next` is
  /// held after `held`: its u changes to the friction force nearest to `next`, then to zero.
  [[nodiscard]] constexpr scalar given_up(const effort& next, const effort& held,
                                          const auto& damping, const auto& steps) const noexcept {
    const certificate own{P::zero(), scalar(0), scalar(0)};
    const certificate* best = &own;
    scalar most = -steps.doubt(held);
    for (const certificate* one : {&following_, &slipped_[0], &slipped_[1]}) {
      const scalar value = worth(*one, held, steps);
      if (value > most) best = one;
      most = kernels::larger(most, value);
    }
    const effort rubbing = damping.friction_near(next);
    return damping.hysteresis(effort(rubbing - effort(best->friction))) +
           damping.hysteresis(rubbing) -
           best->stored * (scalar(1) - scalar(2) * kernels::rounding<scalar>());
  }

 private:
  struct certificate {
    typename P::stored_effort friction;  ///< u [N]
    scalar lead;                         ///< A − stored less the ledger's own A [J]
    scalar stored;                       ///< |u|²p/(2c) [J]
    PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS Owed owed{};
  };

  /// Adds energy to a lead. A new certificate costs dearest_ [J] at most, starting from the ledger's own u = 0, so a
  /// lead below −dearest_ is raised to that first.
  constexpr void earn(certificate& one, scalar energy) const noexcept {
    if (one.lead < -dearest_) one.owed = {};
    one.lead = kernels::larger(one.lead, -dearest_) + energy;
  }
  [[nodiscard]] static constexpr scalar earned(const certificate& one,
                                               const motion& shown) noexcept {
    return P::work(effort(one.friction), shown).joules;
  }
  [[nodiscard]] static constexpr scalar worth(const certificate& one, const effort& held,
                                              const auto& steps) noexcept {
    return one.lead - steps.doubt(effort(effort(one.friction) - held));
  }
  /// The certificate after a change of u to `to`, with the change paid.
  [[nodiscard]] static constexpr certificate moved(const certificate& from, const effort& to,
                                                   const auto& damping,
                                                   const auto& steps) noexcept {
    const effort way = to - effort(from.friction);
    const scalar cost =
        (steps.doubt(way) + damping.hysteresis(way)) * (scalar(1) + kernels::rounding<scalar>());
    const scalar stored = damping.stored(to);
    return {to, kernels::sum_rounded_down(from.lead, from.stored - stored - cost), stored,
            from.owed.charged(steps, way)};
  }

  [[nodiscard]] constexpr Owed& own() noexcept { return *this; }  ///< owed to the ledger's own

  std::size_t directions_ =
      0;  ///< how many of slipped_ are in use; first, so that an empty Owed takes no bytes
  certificate following_{P::zero(), scalar(0), scalar(0)};
  std::array<certificate, 2> slipped_{following_, following_};
  scalar missed_{};   ///< what a new certificate would have earned more, in this direction [J]
  scalar leaving_{};  ///< most that a change to u = 0 can cost [J]
  scalar dearest_{};  ///< most that a change from u = 0 can cost [J]
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
