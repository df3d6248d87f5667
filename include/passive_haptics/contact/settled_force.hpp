// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force in, force out, and at rest when the hand is: given_force with the damping that somebody else's
// renderer does not have.
//
//     ph::make_force_guard<scene>({.mass = 0.1, .damping = 0.03, .hand_force = 5, .force_limit = 9}, 0.0011)
//
// Source: ours; docs/design/mathematics.md § 10, measured in docs/design/settling.md.

#include <passive_haptics/contact/given_force.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The force w given, and dampers that only brake, with v the velocity and n the direction of w, smoothed:
///     f = w − n clip(B n·v, −2 n·w, n·w) + clip(σ (I − nnᵀ)(w − w_last)) − clip(B_s (I − nnᵀ) v)
///     B = β m/T          along n [N·s/m]; at most 2|w| inwards, |w| outwards
///     σ                  ticks by which the part of w across n is led; at most B times the speed that it brakes
///     B_s = β_s m/T      across n [N·s/m]: it stops what swings along a trough; 0.02 N at 0.1 kg and 0.1 m/s
///     n ← n + (w/|w| − n) dt/(τ + dt), of length 1: facets and detents turn it smoothly
/// Both parts across n are at most |w| together. At rest f = w, in the air f = 0.
///
/// Of a force that the motors cannot hold F is left, and B √(F/|w|), critical for the secant: a device comes out
/// at a speed that it can be stopped from. In a loop that is k ticks late B is 1/(1 + k) of itself. T is the port's
/// longest tick. v is what the motion estimator says: on encoders whose steps are felt take a mass_observer.
/// It promises nothing of energy; the bound behind it does.
struct settled_force {
  double mass{};  ///< m, smallest apparent mass, over all directions and poses [kg]
  double damping_fraction = 0.25;                                ///< β, of m/T
  double lead = 5.0;                                             ///< σ [ticks]
  double slide_fraction = 0.002;                                 ///< β_s, of m/T
  double turn_time = 0.02;                                       ///< τ, with which n follows w [s]
  double force_limit = std::numeric_limits<double>::infinity();  ///< F, what the motors hold [N]
  double stale_after = 0.1;  ///< age up to which a force counts in full [s]
  double fade = 0.05;        ///< how long it then takes to end [s]

  /// The ranges are those in which most_stiffness was found, and, of lead and slide, what was not seen to ring
  /// and is not felt as mud.
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(mass)) return {"mass", mass, "finite and > 0 kg"};
    if (!(damping_fraction > 0.0 && damping_fraction <= 0.5)) {
      return {"damping_fraction", damping_fraction, "in (0, 0.5]"};
    }
    if (!(lead >= 0.0 && lead <= 10.0)) return {"lead", lead, "in [0, 10] ticks"};
    if (!(slide_fraction >= 0.0 && slide_fraction <= 0.1)) {
      return {"slide_fraction", slide_fraction, "in [0, 0.1]"};
    }
    if (!detail::not_negative(turn_time)) return {"turn_time", turn_time, "finite and ≥ 0 s"};
    if (!(force_limit > 0.0)) return {"force_limit", force_limit, "> 0 N"};
    return given_force{stale_after, fade}.check();
  }
  /// The stiffest renderer [N/m] that settles along n, K (k + l + 3/2) T ≤ B: its force is k = `renderer_late` ticks
  /// old, a tick T [s], the loop l = `loop_late` ≤ 2 ticks late. Linear, without clip or bound, on a grid of k, l and β
  /// (§ 10); a device that falls on it may bounce above ¾ of that. What is stiffer is as passive, and may ring.
  /// Across n, σ > k + l + 1/2 is needed as well.
  [[nodiscard]] constexpr double most_stiffness(double T, int renderer_late = 0,
                                                int loop_late = 0) const noexcept {
    const double late = static_cast<double>(renderer_late) + static_cast<double>(loop_late);
    return damping_fraction * mass / ((1.0 + loop_late) * (late + 1.5) * T * T);
  }
  template <port P>
  class on;
};

template <port P>
class settled_force::on : private part_at<given_force, P> {
  using given = part_at<given_force, P>;
  static_assert(detail::has_geometry<P>,
                "passive_haptics: settled_force damps along the directions of a space: joints need "
                "given_force");

 public:
  using given::asks_for_numbers;
  using given::update, given::release, given::answered, given::refused;
  using typename given::scalar, typename given::effort, typename given::result_type,
      typename given::request;

  constexpr explicit on(const settled_force& p) noexcept : given({p.stale_after, p.fade}) {
    set(p);
    reset();
  }
  /// What depends on T counts from the next adopt() on.
  constexpr void set(const settled_force& p) noexcept {
    given::set({p.stale_after, p.fade});
    mass_ = detail::number<scalar>(p.mass);
    fraction_ = detail::number<scalar>(p.damping_fraction);
    slide_ = detail::number<scalar>(p.slide_fraction);
    lead_ = detail::number<scalar>(p.lead);
    turn_time_ = detail::number<scalar>(p.turn_time);
    most_ = detail::number<scalar>(p.force_limit);
  }
  [[nodiscard]] constexpr settled_force parameters() const noexcept {
    const given_force rule = given::parameters();
    return {.mass = static_cast<double>(mass_),
            .damping_fraction = static_cast<double>(fraction_),
            .lead = static_cast<double>(lead_),
            .slide_fraction = static_cast<double>(slide_),
            .turn_time = static_cast<double>(turn_time_),
            .force_limit = static_cast<double>(most_),
            .stale_after = rule.stale_after,
            .fade = rule.fade};
  }
  constexpr void adopt(scalar T, int late) noexcept { per_tick_ = mass_ / (T * scalar(1 + late)); }
  constexpr void reset() noexcept {
    given::reset();
    last_ = n_ = P::zero();
  }

  template <bool Shortcut>
  [[nodiscard, gnu::always_inline]] constexpr request ask(const auto& motion, const auto& port,
                                                          event& what) noexcept {
    const request asked = given::template ask<Shortcut>(motion, port, what);
    const scalar share = within(asked.wanted, most_);
    const scalar secant = share < scalar(1) ? kernels::square_root(share) : scalar(1);
    const effort w = P::scaled(asked.wanted, share);
    const effort f = settled(w, velocity(motion), per_tick_ * secant, port.dt);
    return {P::is_finite(f) ? f : w};  // f of an absurd force, or of next to none, is no number
  }

 private:
  /// f of w at the velocity v; m/T is `per_tick` [N·s/m].
  [[nodiscard, gnu::always_inline]] constexpr effort settled(const effort& w, const effort& v,
                                                             scalar per_tick, scalar dt) noexcept {
    const effort change = P::difference(w, last_);
    last_ = w;
    const scalar squared = P::dot(w, w);
    if (!(squared > scalar(0))) {
      n_ = P::zero();
      return w;
    }
    const scalar B = fraction_ * per_tick;
    if constexpr (P::dof == 1) {
      const scalar most = scalar(-2) * w;
      return w - clipped(B * v, kernels::smaller(w, most), kernels::larger(w, most));
    } else {
      const scalar size = kernels::square_root(squared);
      const effort n = turned(w, size, dt);
      const scalar along = P::dot(n, w), speed = P::dot(n, v);
      const scalar brake = clipped(B * speed, scalar(-2) * along, along);
      const effort sideways = less(v, n, speed);
      const effort ahead = P::scaled(less(change, n, P::dot(n, change)), lead_);
      const effort across =
          less(P::scaled(ahead, braking(ahead, sideways, B)), sideways, slide_ * per_tick);
      return less(less(w, n, brake), across, -within(across, size));
    }
  }
  /// n on its way to w/|w|; a force that has turned round is met anew.
  [[nodiscard, gnu::always_inline]] constexpr effort turned(const effort& w, scalar size,
                                                            scalar dt) noexcept {
    const effort last = n_;
    effort n = w;
    if (P::dot(last, w) > scalar(0)) {
      const scalar a = dt / (turn_time_ + dt);
      n = less(P::scaled(w, a), last, (a - scalar(1)) * size);
      size = P::norm(n);
    }
    n = P::scaled(n, scalar(1) / size);
    n_ = n;
    return n;
  }
  /// How much of what leads w brakes, at most B times the speed along it.
  [[nodiscard, gnu::always_inline]] static constexpr scalar braking(const effort& ahead,
                                                                    const effort& v,
                                                                    scalar B) noexcept {
    const scalar squared = P::dot(ahead, ahead), against = -P::dot(ahead, v);
    if (!(against > scalar(0))) return scalar(0);
    return B * against < squared ? B * against / squared : scalar(1);
  }
  /// What is to be multiplied so that it is no longer than `most`.
  [[nodiscard, gnu::always_inline]] static constexpr scalar within(const effort& a,
                                                                   scalar most) noexcept {
    const scalar squared = P::dot(a, a);
    return squared > most * most ? most / kernels::square_root(squared) : scalar(1);
  }
  [[nodiscard]] static constexpr scalar clipped(scalar x, scalar least, scalar most) noexcept {
    return kernels::smaller(kernels::larger(x, least), most);
  }
  /// a − b s.
  [[nodiscard, gnu::always_inline]] static constexpr effort less(const effort& a, const effort& b,
                                                                 scalar s) noexcept {
    return P::difference(a, P::scaled(b, s));
  }
  /// What the motion estimator says, axis by axis where it has more to say than travel and time [m/s].
  [[nodiscard, gnu::always_inline]] static constexpr effort velocity(const auto& motion) noexcept {
    if constexpr (requires { motion.travel / motion.dt; }) {
      return P::scaled(motion.travel, scalar(1) / motion.dt);
    } else {
      effort v = P::zero();
      for (int i = 0; i < P::dof; ++i) {
        effort axis = P::zero();
        P::component(axis, i) = scalar(1);
        P::component(v, i) = motion.along(axis);
      }
      return v;
    }
  }

  scalar mass_{}, fraction_{}, slide_{}, lead_{}, turn_time_{}, most_{};
  scalar per_tick_{};                 ///< m/T [N·s/m]
  typename P::stored_effort last_{};  ///< w of the last tick [N]
  typename P::stored_effort n_{};     ///< n; zero in the air
};

static_assert(source_for<settled_force, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
