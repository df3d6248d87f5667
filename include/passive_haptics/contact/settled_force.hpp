// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force in, force out, and at rest when the hand is: given_force with the damping that somebody else's
// renderer does not have.
//
//     ph::make_guard<scene>({.mass = 0.1, .damping = 0.03, .force_limit = 9, .longest_tick = 0.0011}, {.force = 5})
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
/// What is steeper than K_m = most_stiffness(T, 0, l) would ring, so of such a renderer w is s times what is given: K,
/// its slope −Δw·Δx/|Δx|² along w and across it, is learned over 30 ms of motion, and s = ¾ K_m/K from then on, until
/// it is less than half as steep. shown() is s. A world that moves pushes Δw with Δx, not against it, and changes no s.
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
  double most = std::numeric_limits<double>::infinity();  ///< what encoder steps are paid for [N/m]
  double stale_after = 0.1;  ///< age up to which a force counts in full [s]
  double fade = 0.05;        ///< how long it then takes to end [s]
  bool softens = true;       ///< what is too steep; without, it goes out as it is, and rings

  /// The ranges are those in which most_stiffness was found, and what is not felt as mud.
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
    if (!(most > 0.0)) {
      return {"most", most, "> 0 N/m; a budget of 0 says that nothing is paid for"};
    }
    return given_force{stale_after, fade}.check();
  }
  /// The stiffest renderer [N/m] that settles along n, K (k + l + 3/2) T ≤ B: its force is k = `renderer_late` ticks
  /// old, a tick T [s], the loop l = `loop_late` ≤ 2 ticks late (§ 10). A device that falls on it may bounce above ¾ of
  /// that; what is stiffer is as passive, and may ring. Across n, σ > k + l + 1/2 is needed as well.
  [[nodiscard]] constexpr double most_stiffness(double T, int renderer_late = 0,
                                                int loop_late = 0) const noexcept {
    const double late = static_cast<double>(renderer_late) + static_cast<double>(loop_late);
    return damping_fraction * mass / ((1.0 + loop_late) * (late + 1.5) * T * T);
  }
  /// Does a renderer of K [N/m] settle along n and across it? One that is stiffer is shown softer, if `softens`.
  [[nodiscard]] constexpr bool settles(double K, double T, int renderer_late = 0,
                                       int loop_late = 0) const noexcept {
    return K > 0.0 && K <= most_stiffness(T, renderer_late, loop_late) && loop_late <= 2 &&
           lead > static_cast<double>(renderer_late) + static_cast<double>(loop_late) + 0.5;
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
    softens_ = p.softens;
    if (!softens_) forget();
    most_ = detail::number<scalar>(p.force_limit);
    stiffest_ = detail::number<scalar>(p.most);
  }
  [[nodiscard]] constexpr settled_force parameters() const noexcept {
    const given_force rule = given::parameters();
    return {.mass = static_cast<double>(mass_),
            .damping_fraction = static_cast<double>(fraction_),
            .lead = static_cast<double>(lead_),
            .slide_fraction = static_cast<double>(slide_),
            .turn_time = static_cast<double>(turn_time_),
            .force_limit = static_cast<double>(most_),
            .most = static_cast<double>(stiffest_),
            .stale_after = rule.stale_after,
            .fade = rule.fade,
            .softens = softens_};
  }
  /// The same in the loop of the port.
  [[nodiscard]] constexpr bool settles(scalar K, int renderer_late = 0) const noexcept {
    return parameters().settles(static_cast<double>(K), static_cast<double>(longest_tick_),
                                renderer_late, late_);
  }
  constexpr void adopt(scalar T, int late) noexcept {
    longest_tick_ = T;
    late_ = late;
    per_tick_ = mass_ / (T * scalar(1 + late));
    const scalar settles = fraction_ * per_tick_ / ((scalar(late) + scalar(1.5)) * T);
    steepest_ = softens_ ? kernels::smaller(settles, stiffest_) : kernels::largest<scalar>();
  }
  /// most_stiffness, as long as nobody knows how stiff the renderer is; of one that was found too steep what it is, and ¾
  /// of that.
  constexpr void explain(explanation& e, const auto& /*x*/, scalar T, int late) const noexcept {
    e.asked = e.shown = std::numeric_limits<double>::infinity();
    const double part = shown_ < scalar(1) ? 0.75 : 1.0;
    e.soften(part * parameters().most_stiffness(static_cast<double>(T), 0, late),
             softened_by::mass_and_tick);
    e.soften(part * static_cast<double>(stiffest_), softened_by::encoder_steps);
    if (shown_ < scalar(1)) e.asked = e.shown / static_cast<double>(shown_);
  }
  constexpr void reset() noexcept {
    given::reset();
    last_ = n_ = given_ = P::zero();
    forget();
  }
  /// s: 1, or less of a renderer that is steeper than it settles with.
  [[nodiscard]] constexpr scalar shown() const noexcept { return shown_; }

  template <bool Shortcut>
  [[nodiscard, gnu::always_inline]] constexpr request ask(const auto& motion, const auto& port,
                                                          event& what) noexcept {
    if (watched_ > 0) [[unlikely]]
      look(port.travel, port.dt);
    const request asked = given::template ask<Shortcut>(motion, port, what);
    const effort softly = P::scaled(asked.wanted, shown_);
    const scalar share = within(softly, most_);
    const scalar secant = share < scalar(1) ? kernels::square_root(share) : scalar(1);
    const effort w = P::scaled(softly, share);
    if constexpr (!requires {
                    motion.travel / motion.dt;
                  }) {  // what creeps over steps has no speed
      const effort change = P::difference(w, last_), way = port.travel;
      if (-P::dot(change, way) > steepest_ * P::dot(way, way)) watched_ = long_enough;
    }
    const effort f = settled(w, detail::velocity_of<P>(motion), per_tick_ * secant, port.dt);
    return {P::is_finite(f) ? f : w};  // f of an absurd force, or of next to none, is no number
  }

 private:
  /// Σ −Δw Δx, Σ Δx² and Σ Δw² of the last 30 ms of motion.
  struct slope {
    scalar stiff{}, moved{}, changed{};
    constexpr void see(scalar work, scalar way, scalar change, scalar keep) noexcept {
      stiff = keep * stiff - work;
      moved = keep * moved + way;
      changed = keep * changed + change;
    }
    /// Of a force so steep, how much is as steep as `enough`; 100 where it is hardly steep, or where that is not sure: less
    /// than a quarter of what changes goes with the motion, or the rest may make all the difference. That is noise, or
    /// an effect that was added.
    [[nodiscard]] constexpr scalar share(scalar enough) const noexcept {
      const scalar allowed = enough * moved, both = moved * changed, steep = stiff * stiff;
      const scalar beyond = stiff - allowed, rest = both - steep;
      const bool sure = scalar(4) * steep > both && !(rest > scalar(8) * beyond * beyond);
      return sure && stiff * scalar(100) > allowed ? allowed / stiff : scalar(100);
    }
  };
  static constexpr int long_enough = 30;  ///< [ticks] of motion that are looked at

  constexpr void forget() noexcept {
    along_ = across_ = {};
    shown_ = scalar(1);
    watched_ = 0;
    ticks_ = scalar(0);
    knows_given_ = learns_ = false;
  }
  /// Along n the last tick was too steep: it is to be looked at.
  [[gnu::always_inline]] constexpr void notice(scalar rise, scalar speed, scalar dt) noexcept {
    if (-rise * speed > steepest_ * dt * speed * speed) [[unlikely]]
      watched_ = long_enough;
  }
  /// How steep is the renderer? What moves slower than 1 mm/s says nothing of it.
  [[gnu::cold, gnu::noinline]] constexpr void look(const typename P::stored_effort& travel,
                                                   scalar dt) noexcept {
    const effort w = given::newest(), way = travel, change = P::difference(w, given_);
    given_ = w;
    const scalar size = P::dot(w, w), moved = P::dot(way, way), slow = scalar(1e-3) * dt;
    if (!knows_given_) {
      knows_given_ = true;
      return;
    }
    if (!(size > scalar(0) && moved > slow * slow)) return;
    const scalar keep = scalar(0.03) / (scalar(0.03) + dt), little = moved * scalar(1e-4);
    const scalar out = P::dot(w, way), work = P::dot(change, way);
    const scalar rise = P::dot(w, change), risen = rise * rise / size;
    const scalar along = out * rise / size, outwards = out * out / size;
    along_.see(along, outwards + little, risen, keep);
    across_.see(work - along, moved - outwards + little, P::dot(change, change) - risen, keep);
    learns_ = learns_ || -work > steepest_ * moved;
    ticks_ = keep * ticks_ + scalar(1);
    const scalar s = learns_ && ticks_ > scalar(3)
                         ? kernels::smaller(along_.share(steepest_), across_.share(steepest_))
                         : scalar(1);
    if (!kernels::is_finite(s)) {
      along_ = across_ = {};
      ticks_ = scalar(0);
    } else if (s < shown_) {
      shown_ = scalar(0.75) * s;
    } else if (s > scalar(8) / scalar(3) * shown_) {
      shown_ = kernels::smaller(shown_ * (scalar(1) + dt), scalar(1));
    }
    if (shown_ == scalar(1) && --watched_ == 0) forget();
  }
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
      notice(change, v, dt);
      const scalar inwards = scalar(-2) * w;
      return w - kernels::clamped(B * v, kernels::smaller(w, inwards), kernels::larger(w, inwards));
    } else {
      const scalar size = kernels::square_root(squared);
      const effort n = turned(w, size, dt);
      const scalar along = P::dot(n, w), speed = P::dot(n, v);
      const scalar brake = kernels::clamped(B * speed, scalar(-2) * along, along);
      const effort sideways = less(v, n, speed);
      const scalar rise = P::dot(n, change);
      notice(rise, speed, dt);
      const effort ahead = P::scaled(less(change, n, rise), lead_);
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
  /// a − b s.
  [[nodiscard, gnu::always_inline]] static constexpr effort less(const effort& a, const effort& b,
                                                                 scalar s) noexcept {
    return P::difference(a, P::scaled(b, s));
  }
  scalar mass_{}, fraction_{}, slide_{}, lead_{}, turn_time_{}, most_{}, stiffest_{};
  scalar per_tick_{};                 ///< m/T [N·s/m]
  scalar longest_tick_{};             ///< T [s]
  int late_ = 0;                      ///< [ticks]
  typename P::stored_effort last_{};  ///< w of the last tick [N]
  typename P::stored_effort n_{};     ///< n; zero in the air
  scalar steepest_{};                 ///< K_m [N/m]
  bool softens_ = true, knows_given_ = false, learns_ = false;
  scalar ticks_{};            ///< of motion that it has looked at, of the last 30 ms
  int watched_ = 0;           ///< ticks of motion for which it is still looked at how steep w is
  scalar shown_ = scalar(1);  ///< s
  slope along_{}, across_{};  ///< of what was given, along w and across
  typename P::stored_effort given_{};  ///< in the last tick that was looked at [N]
};

static_assert(source_for<settled_force, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
