// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What dry friction is worth to a ledger of positions that are known to a step only: dual_ledger's own.

#include <passive_haptics/port/concepts.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// What a ledger asks of a friction that is elastic: device/dry_friction.hpp.
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

/// Every choice u(1), u(2), … of the friction counted on gives a lower bound of the energy, a certificate
/// (A, u). Which is best shows afterwards only, so three are kept beside the ledger's own, u = 0:
///
///   following    u follows the force, as far as friction reaches: costs least while the device
///                holds still and the force hunts                               (a play operator)
///   slipped[2]   u opposes a recent motion: earns most while it goes on
///
/// A change of u by d costs ½ Σ qᵢ|dᵢ| and p|d| at any time, so one that has fallen behind another by more
/// than that is replaced by it. Whatever is dropped, the rest stays true. A `lead` is how far A − |u|²p/(2c)
/// is ahead of the ledger's own A [J]; sums are rounded down, costs up.
template <class P>
class friction_certificates {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;

  /// Starts anew: no certificate counts on any friction.
  constexpr void reset() noexcept {
    following_ = slipped_[0] = slipped_[1] = {P::zero(), scalar(0), scalar(0)};
    directions_ = 0;
    missed_ = scalar(0);
  }

  /// After new parameters: no certificate counts on more friction than there is.
  constexpr void set(const auto& damping, const auto& steps) noexcept {
    const scalar up = scalar(1) + kernels::rounding<scalar>();
    const scalar doubt = damping.most_friction() * steps.travel_error() / scalar(2);
    leaving_ = (doubt + damping.most_stored()) * up;
    dearest_ = (doubt + scalar(3) * damping.most_stored()) * up;
    for (certificate* one : {&following_, &slipped_[0], &slipped_[1]}) {
      *one = moved(*one, damping.friction_near(effort(one->friction)), damping, steps);
    }
  }

  /// The held force changed by `change`, and the ledger has charged `doubt` [J] for it to all alike. The certificate
  /// that follows owes less and gets the difference back.
  constexpr void follow(const effort& change, scalar doubt, const auto& damping,
                        const auto& steps) noexcept {
    if (!(doubt > scalar(0))) return;
    const effort before = effort(following_.friction);
    const effort now = damping.friction_near(effort(before + change));
    const effort way = now - before;
    const scalar cost = steps.doubt(effort(way - change)) + damping.hysteresis(way);
    const scalar stored = damping.stored(now);
    following_.lead += doubt - cost + (following_.stored - stored) -
                       kernels::rounding<scalar>() * (doubt + cost + dearest_);
    following_.friction = now;
    following_.stored = stored;
  }

  /// The device is seen to have moved. Returns what the ledger itself may book [J].
  [[nodiscard]] constexpr scalar slip(const motion& shown, const auto& damping,
                                      const auto& steps) noexcept {
    const effort along = damping.friction_along(shown);
    const scalar most = P::work(along, shown).joules;
    if (!(most > scalar(0) && most < kernels::largest<scalar>() / scalar(8))) return scalar(0);
    std::array<scalar, 2> gain{earned(slipped_[0], shown), earned(slipped_[1], shown)};

    const std::size_t i = gain[1] > gain[0] ? 1 : 0;
    if (gain[i] > most * scalar(0.99)) {  // one of them points that way
      missed_ = scalar(0);
      if (following_.lead > slipped_[i].lead) {
        const certificate there = moved(following_, effort(slipped_[i].friction), damping, steps);
        if (there.lead > slipped_[i].lead) slipped_[i] = there;
      }
    } else {
      certificate fresh = moved(following_, along, damping, steps);
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
    for (certificate* one : {&following_, &slipped_[0], &slipped_[1]}) one->lead -= spare;
    return spare;
  }

  /// The ledger itself has booked that from elsewhere [J].
  constexpr void fall_behind(scalar booked) noexcept {
    for (certificate* one : {&following_, &slipped_[0], &slipped_[1]}) one->lead -= booked;
  }

  /// By how much the best certificate is worth more than the ledger's own A while `held` is held [J].
  [[nodiscard]] constexpr scalar lead(const effort& held, const auto& steps) const noexcept {
    const scalar own = -steps.doubt(held);
    const scalar slipped =
        worth(slipped_[slipped_[1].lead > slipped_[0].lead ? 1 : 0], held, steps);
    return kernels::larger(own, kernels::larger(worth(following_, held, steps), slipped));
  }

  /// What the best certificate loses by friction [J] over a tick that nobody sees, in which `next` is held after
  /// `held`: its u goes to where friction would be under `next`, then to zero.
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
    scalar lead;                         ///< of A − stored [J]
    scalar stored;                       ///< |u|²p/(2c) [J]
  };

  /// Adds energy to a lead. A certificate could start again from u = 0 at a cost of at most dearest_, so no
  /// lead is kept below −dearest_.
  constexpr void earn(certificate& one, scalar energy) const noexcept {
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
  /// The certificate after u has changed to `to`, with the cost of the change.
  [[nodiscard]] static constexpr certificate moved(const certificate& from, const effort& to,
                                                   const auto& damping,
                                                   const auto& steps) noexcept {
    const effort way = to - effort(from.friction);
    const scalar cost =
        (steps.doubt(way) + damping.hysteresis(way)) * (scalar(1) + kernels::rounding<scalar>());
    const scalar stored = damping.stored(to);
    return {to, kernels::sum_rounded_down(from.lead, from.stored - stored - cost), stored};
  }

  certificate following_{P::zero(), scalar(0), scalar(0)};
  std::array<certificate, 2> slipped_{following_, following_};
  std::size_t directions_ = 0;  ///< how many of slipped_ count on friction
  scalar missed_{};  ///< what a certificate against the present motion would have earned by now [J]
  scalar leaving_{};  ///< most that a lead falls by when a certificate drops all its friction [J]
  scalar dearest_{};  ///< most that a lead falls by when a certificate takes up some friction [J]
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
