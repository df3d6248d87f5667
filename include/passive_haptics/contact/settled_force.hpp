// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force in, force out, and at rest when the hand is: a damper for a renderer, or as a shaper for a law, that has none.
//
//     ph::shaped{your_law{}, ph::settled_force{.mass = 0.1}}
//     ph::make_guard<scene>({.mass = 0.1, .damping = 0.03, .force_limit = 9, .longest_tick = 0.0011}, {.force = 5})
//
// Source: ours; docs/design/mathematics.md § 10, measured in docs/design/settling.md.

#include <passive_haptics/contact/given_force.hpp>

#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// The given force w [N] with dampers that only brake, v [m/s] the velocity and n the smoothed direction of w:
///     f = w − n clip(D n·v, −2 n·w, n·w) + clip(σ (I − nnᵀ)(w − w_last)) − clip(D_s (I − nnᵀ) v)
///     D = min(B, t K)    B = β m/T, t = max(50 T, 50 ms, 4m/B), along n [N·s/m]; at most 2|w| inwards, |w| outwards
///     σ                  lead of the part of w across n [ticks]; at most B times the speed that it brakes
///     D_s = max(min(B_s, 0.02 N/|v⊥|), min(4 t K_s, max(B_s, min(10 B_s, 0.04 N/|v⊥|))))   B_s = β_s m/T, across n
///                        [N·s/m], |v⊥| ≥ 1 mm/s in it: dry friction, and more in a trough, where it stops a swing
///     K, K_s             slopes −Δw·Δx/|Δx|² of w along n and across it, felt in the last 0.1 s of motion [N/m]
///     n ← n + (w/|w| − n) dt/(τ + dt), of length 1, so that it turns smoothly at facets and detents
/// The sum of both parts across n is at most |w|. At rest f = w; for w = 0 f = 0. A force that is the same everywhere
/// (a weight, wind) is not braked, and a stroke along a flat or convex wall by 0.02 N at most; at a touch D is B.
///
/// A renderer stiffer than K_m = most_stiffness(T, P/T, l) [N/m] would ring, so its w is multiplied by s = ¾ K_m/K. Its
/// stiffness K, the slope −Δw·Δx/|Δx|² along w and across it, is estimated over 30 ms of motion, or 30 changes of w;
/// s rises again when K falls below half. shown() is s. Along w, on exact positions, K is the lesser of that slope and
/// of the one about the means of Δw and Δx, which a wall that moves at a steady speed does not raise; so a press that
/// does not swing is shown as given. A wall whose speed swings with the device's may lower s. P is `renderer_period`:
/// one that is slower than told may ring.
///
/// A force above the motors' limit F is shortened to F, and B to B √(F/|w|), critical for the secant, so that the
/// device comes out at a speed from which F can stop it. In a loop that is k ticks late B is divided by 1 + k. T is the
/// port's longest tick, and v is that of the motion estimator: with coarse encoders use a mass_observer. It gives no
/// passivity guarantee; the bound behind it does. As a shaper w is a law's force; stale_after and fade do nothing.
struct settled_force {
  double mass{};  ///< m, smallest apparent mass, over all directions and poses [kg]
  double damping_fraction = 0.25;                                ///< β, in units of m/T
  double lead = 5.0;                                             ///< σ, lead across n [ticks]
  double slide_fraction = 0.002;                                 ///< β_s, in units of m/T
  double turn_time = 0.02;                                       ///< τ, time constant of n [s]
  double force_limit = std::numeric_limits<double>::infinity();  ///< F, limit of the motors [N]
  double most = std::numeric_limits<double>::infinity();         ///< budget for encoder steps [N/m]
  double stale_after = 0.1;      ///< age up to which a force is not reduced [s]
  double fade = 0.05;            ///< time in which it then fades to zero [s]
  bool softens = true;           ///< if false, s = 1, and too stiff a renderer rings
  double renderer_period = 0.0;  ///< P, longest time from one given force to the next [s]; 0: T

  /// The ranges are those for which most_stiffness was measured and damping does not feel viscous.
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
      return {"most", most, "> 0 N/m; on encoders dry friction pays, stated as .friction"};
    }
    if (!detail::not_negative(renderer_period)) {
      return {"renderer_period", renderer_period, "finite and ≥ 0 s"};
    }
    return given_force{stale_after, fade}.check();
  }
  /// The largest stiffness of a renderer [N/m] that settles along n, K (k + l + 3/2) T ≤ B, with a force that is
  /// k = `renderer_late` ticks of T [s] old, in a loop l = `loop_late` ≤ 2 ticks late (ours, § 10). Above ¾ of it a
  /// device that falls on it may bounce; a stiffer one is as passive, but may ring. Across n, σ > k + l + 1/2 is needed.
  [[nodiscard]] constexpr double most_stiffness(double T, double renderer_late = 0.0,
                                                int loop_late = 0) const noexcept {
    const double late = renderer_late + static_cast<double>(loop_late);
    return damping_fraction * mass / ((1.0 + loop_late) * (late + 1.5) * T * T);
  }
  /// True if a renderer of K [N/m] settles along n and across it. A stiffer one is displayed softer, if `softens`.
  [[nodiscard]] constexpr bool settles(double K, double T, int renderer_late = 0,
                                       int loop_late = 0) const noexcept {
    return K > 0.0 && K <= most_stiffness(T, renderer_late, loop_late) && loop_late <= 2 &&
           lead > static_cast<double>(renderer_late) + static_cast<double>(loop_late) + 0.5;
  }
  static constexpr bool needs_local_model = false, needs_ledger = false, needs_velocity = true;
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
  }
  /// Parameters that depend on T take effect at the next adopt().
  constexpr void set(const settled_force& p) noexcept {
    given::set({p.stale_after, p.fade});
    mass_ = detail::number<scalar>(p.mass);
    fraction_ = detail::number<scalar>(p.damping_fraction);
    slide_ = detail::number<scalar>(p.slide_fraction);
    lead_ = detail::number<scalar>(p.lead);
    turn_time_ = detail::number<scalar>(p.turn_time);
    softens_ = p.softens;
    period_ = detail::number<scalar>(p.renderer_period);
    if (!softens_) seen_ = {};
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
            .softens = softens_,
            .renderer_period = static_cast<double>(period_)};
  }
  /// The same for the port's T and latency.
  [[nodiscard]] constexpr bool settles(scalar K, int renderer_late = 0) const noexcept {
    return parameters().settles(static_cast<double>(K), static_cast<double>(longest_tick_),
                                renderer_late, late_);
  }
  constexpr void adopt(scalar T, int late) noexcept {
    longest_tick_ = T;
    late_ = late;
    age_ = period_ > T ? period_ : scalar(0);
    per_tick_ = mass_ / (T * scalar(1 + late));
    most_damping_ = fraction_ * per_tick_;
    slope_time_ = kernels::larger(scalar(4) * mass_ / most_damping_,
                                  kernels::larger(scalar(0.05), scalar(50) * T));
    const scalar settles = most_damping_ / ((scalar(late) + scalar(1.5)) * T + age_);
    steepest_ = softens_ ? kernels::smaller(settles, stiffest_) : kernels::largest<scalar>();
  }
  /// Explains most_stiffness; for a renderer that was found too stiff, its estimated stiffness and ¾ of most_stiffness,
  /// or all of it as long as it does not swing. As a shaper it explains the surface: its share s, or most_stiffness if
  /// no force was too stiff yet.
  constexpr void explain(explanation& e, const auto& /*x*/, scalar T, int late) const noexcept {
    const double settles =
        parameters().most_stiffness(static_cast<double>(T), static_cast<double>(age_ / T), late);
    const double steps = static_cast<double>(stiffest_), s = static_cast<double>(seen_.shown);
    const double least = kernels::smaller(settles, steps);
    const auto why = settles <= steps ? softened_by::mass_and_tick : softened_by::encoder_steps;
    const bool shapes = e.asked > 0.0;  // the force of a surface
    if (shapes && !softens_) return;
    if (!shapes) e.asked = e.shown = std::numeric_limits<double>::infinity();
    if (!(s < 1.0) && seen_.felt > steepest_ && seen_.along.share(steepest_) < scalar(1)) {
      if (!shapes) e.asked = e.shown = static_cast<double>(seen_.felt);
      return;
    }
    e.soften(s < 1.0 ? (shapes ? s * e.shown : 0.75 * least) : least, why);
    if (!shapes && s < 1.0) e.asked = e.shown / s;
  }
  constexpr void reset() noexcept {
    given::reset();
    last_ = n_ = P::zero();
    braked_ = kernels::largest<scalar>();
    slid_ = scalar(0);
    seen_ = {};
  }
  /// s: 1, or less for a renderer that is too stiff to settle.
  [[nodiscard]] constexpr scalar shown() const noexcept { return seen_.shown; }

  template <bool Shortcut>
  [[nodiscard, gnu::always_inline]] constexpr request ask(const auto& motion, const auto& port,
                                                          event& what) noexcept {
    const request asked = given::template ask<Shortcut>(motion, port, what);
    return {rested(given::newest(), asked.wanted, detail::velocity_of<P>(motion), port)};
  }
  /// The same, of the force of a contact law.
  [[nodiscard, gnu::always_inline]] constexpr effort shape(const effort& w, const auto& contact,
                                                           const auto& port) noexcept {
    return rested(w, w, contact.velocity, port);
  }

 private:
  /// f [N] for `wanted`, of `raw` as far as it has not faded, at the velocity v [m/s].
  [[nodiscard, gnu::always_inline]] constexpr effort rested(const effort& raw, const effort& wanted,
                                                            const effort& v,
                                                            const auto& port) noexcept {
    if (seen_.left > 0) [[unlikely]]
      look(raw, port.travel, port.dt);
    const effort softly = P::scaled(wanted, seen_.shown);
    const scalar share = within(softly, most_);
    const scalar secant = share < scalar(1) ? kernels::square_root(share) : scalar(1);
    const effort w = P::scaled(softly, share);
    const effort change = P::difference(w, last_), way = port.travel;
    if (-P::dot(change, way) > steepest_ * P::dot(way, way)) seen_.left = 30;
    const effort f = settled(w, change, v, secant, port.dt);
    return P::is_finite(f) ? f : w;  // f is not finite if w overflows or underflows
  }
  /// Σ −Δw·Δx, Σ Δx² and Σ Δw² of the last 30 ms of motion.
  struct slope {
    scalar stiff{}, moved{}, changed{};
    constexpr void see(scalar work, scalar way, scalar change, scalar keep) noexcept {
      stiff = keep * stiff - work;
      moved = keep * moved + way;
      changed = keep * changed + change;
    }
    /// The same about the means of Δx and Δw, whose sums over so many ticks are given.
    [[nodiscard]] constexpr slope about(scalar way, scalar rise, scalar ticks) const noexcept {
      const scalar varies = moved * scalar(0.9999) - way * way / ticks;
      return {stiff + way * rise / ticks, kernels::larger(varies, moved * scalar(1e-5)),
              changed - rise * rise / ticks};
    }
    /// `enough` over the stiffness, the share s of the force that has the stiffness `enough` [N/m]. It is 100 for a soft
    /// force and for an uncertain estimate: if less than a quarter of Σ Δw² correlates with the motion, or if the rest
    /// may explain the excess, as with noise or an added effect.
    [[nodiscard]] constexpr scalar share(scalar enough) const noexcept {
      const scalar allowed = enough * moved, both = moved * changed, steep = stiff * stiff;
      const scalar beyond = stiff - allowed, rest = both - steep;
      const bool sure = scalar(4) * steep > both && !(rest > scalar(8) * beyond * beyond);
      return sure && stiff * scalar(100) > allowed ? allowed / stiff : scalar(100);
    }
  };
  struct evaluation {
    slope along{}, across{};  ///< of the given force, along w and across it
    scalar way{}, rise{};     ///< Σ Δx [m] and Σ Δw [N] along w
    scalar felt{};            ///< slope of the last evaluated tick [N/m]
    scalar ticks{};           ///< evaluated ticks of motion, of the last 30 ms
    int left = 0;             ///< ticks of motion still to be evaluated; 30 after a stiff one
    bool begun = false, steep = false;   ///< `given` is known; a tick was too stiff
    typename P::stored_effort passed{};  ///< way since the force of a slow renderer changed [m]
    scalar shown = scalar(1);            ///< s
    typename P::stored_effort given{};   ///< given force of the last evaluated tick [N]
  };
  /// Estimates the renderer's stiffness from one tick, unless the device moves at less than 1 mm/s.
  [[gnu::cold, gnu::noinline]] constexpr void look(const effort& w,
                                                   const typename P::stored_effort& travel,
                                                   scalar dt) noexcept {
    const effort change = P::difference(w, seen_.given);
    const effort way = less(effort(travel), effort(seen_.passed), scalar(-1));
    const bool old =
        age_ > scalar(0) && !(P::dot(change, change) > scalar(0)) && P::dot(w, w) > scalar(0);
    seen_.passed = old ? way : P::zero();
    if (old) return;
    seen_.given = w;
    const scalar size = P::dot(w, w), moved = P::dot(way, way), slow = scalar(1e-3) * dt;
    if (!std::exchange(seen_.begun, true) || !(size > scalar(0) && moved > slow * slow)) return;
    slope &along = seen_.along, &across = seen_.across;
    const scalar keep = scalar(0.03) / (scalar(0.03) + dt), little = moved * scalar(1e-4);
    const effort n = P::scaled(w, scalar(1) / kernels::square_root(size));
    const scalar out = P::dot(n, way), rise = P::dot(n, change), risen = rise * rise;
    const scalar work = P::dot(change, way), outwards = kernels::smaller(out * out, moved);
    along.see(out * rise, outwards + little, risen, keep);
    across.see(work - out * rise, moved - outwards + little, P::dot(change, change) - risen, keep);
    seen_.felt = -work / moved;
    seen_.steep = seen_.steep || seen_.felt > steepest_;
    seen_.ticks = keep * seen_.ticks + scalar(1);
    seen_.way = keep * seen_.way + out;
    seen_.rise = keep * seen_.rise + rise;
    scalar s(1);
    if (seen_.steep && seen_.ticks > scalar(3)) {
      s = along.share(steepest_);
      if (!(stiffest_ < kernels::largest<scalar>())) {  // there are no encoder steps
        const slope swing = along.about(seen_.way, seen_.rise, seen_.ticks);
        s = kernels::larger(s, swing.share(steepest_));
      }
      s = kernels::smaller(s, across.share(steepest_));
    }
    if (!kernels::is_finite(along.stiff + along.changed + across.stiff + across.moved +
                            across.changed)) {  // a force was absurd
      along = across = {};
      seen_.ticks = seen_.way = seen_.rise = scalar(0);
    } else if (s < seen_.shown) {
      seen_.shown = scalar(0.75) * s;
    } else if (s > scalar(8) / scalar(3) * seen_.shown) {
      seen_.shown = kernels::smaller(seen_.shown * (scalar(1) + dt), scalar(1));
    }
    if (seen_.shown == scalar(1) && --seen_.left == 0) seen_ = {};
  }
  /// f [N] for w, which has changed by `change`, at the velocity v; `secant` is the factor of B.
  [[nodiscard, gnu::always_inline]] constexpr effort settled(const effort& w, const effort& change,
                                                             const effort& v, scalar secant,
                                                             scalar dt) noexcept {
    last_ = w;
    const scalar squared = P::dot(w, w);
    if (!(squared > scalar(0))) {
      n_ = P::zero();
      braked_ = kernels::largest<scalar>();
      slid_ = scalar(0);
      return w;
    }
    const scalar full = most_damping_ * secant;
    if constexpr (P::dof == 1) {
      const scalar B = damper(braked_, -change * v, v * v, dt, full);
      const scalar inwards = scalar(-2) * w;
      return w - kernels::clamped(B * v, kernels::smaller(w, inwards), kernels::larger(w, inwards));
    } else {
      const scalar size = kernels::square_root(squared);
      const effort n = turned(w, size, dt);
      const scalar along = P::dot(n, w), speed = P::dot(n, v), rise = P::dot(n, change);
      const scalar B = damper(braked_, -rise * speed, speed * speed, dt, full);
      const scalar brake = kernels::clamped(B * speed, scalar(-2) * along, along);
      const effort sideways = less(v, n, speed), aside = less(change, n, rise);
      const scalar square = P::dot(sideways, sideways), unit = slide_ * per_tick_ * secant;
      const scalar felt = damper(slid_, scalar(-4) * P::dot(aside, sideways), square, dt, full);
      const scalar per_newton =
          scalar(1) / kernels::larger(kernels::square_root(square), scalar(1e-3));
      const scalar stops =
          kernels::larger(unit, kernels::smaller(scalar(10) * unit, scalar(0.04) * per_newton));
      const scalar slide = kernels::larger(kernels::smaller(unit, scalar(0.02) * per_newton),
                                           kernels::smaller(felt, stops));
      const effort ahead = P::scaled(aside, lead_);
      const effort across = less(P::scaled(ahead, braking(ahead, sideways, full)), sideways, slide);
      return less(less(w, n, brake), across, -within(across, size));
    }
  }
  /// B [N·s/m] up to a limit. B grows to t K within a few ticks and, if `limit` is the whole damper, fades while it is
  /// above 2 t K at more than 1 mm/s. K is the slope of w along v, `fall` = −Δw·v and `square` = |v|².
  [[nodiscard]] constexpr scalar damper(scalar& B, scalar fall, scalar square, scalar dt,
                                        scalar limit) const noexcept {
    const scalar asked = slope_time_ * fall, way = square * dt;
    scalar now = B = kernels::smaller(B, most_damping_);
    if (asked > now * way) {
      now = B += (kernels::smaller(asked / way, most_damping_) - now) / scalar(5);
    } else if (asked + asked < now * way && square > scalar(1e-6) && !(limit < most_damping_)) {
      B -= now * kernels::smaller(scalar(10) * dt, scalar(1));
    }
    return kernels::smaller(now, limit);
  }
  /// Updates n towards w/|w|; if w has turned by more than 90°, n = w/|w| at once.
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
  /// The share of the lead of w that brakes, at most B times the speed along it.
  [[nodiscard, gnu::always_inline]] static constexpr scalar braking(const effort& ahead,
                                                                    const effort& v,
                                                                    scalar B) noexcept {
    const scalar squared = P::dot(ahead, ahead), against = -P::dot(ahead, v);
    if (!(against > scalar(0))) return scalar(0);
    return B * against < squared ? B * against / squared : scalar(1);
  }
  /// The factor ≤ 1 that shortens `a` to the length `most`.
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
  scalar braked_ = kernels::largest<scalar>();         ///< t K along n, large at a touch [N·s/m]
  scalar slid_{};                                      ///< 4 t K_s across n [N·s/m]
  scalar per_tick_{}, most_damping_{}, slope_time_{};  ///< m/T and B [N·s/m], t [s]
  scalar longest_tick_{}, period_{}, age_{};           ///< T, P, P of a slow renderer or 0 [s]
  int late_ = 0;                                       ///< [ticks]
  typename P::stored_effort last_{};                   ///< w of the last tick [N]
  typename P::stored_effort n_{};                      ///< n; zero for w = 0
  scalar steepest_{};                                  ///< K_m [N/m]
  bool softens_ = true;
  evaluation seen_{};
};

static_assert(source_for<settled_force, space<float, 1>> &&
              shaper_for<settled_force, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
