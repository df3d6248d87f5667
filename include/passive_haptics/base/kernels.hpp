// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The equations, one function each: plain scalars in, a plain scalar out, no state, no branch that
// is not in the formula. Whoever writes a loop of their own needs this header only.
//
//   damping_per_tick, worst_outflow, strict_force_bound, strict_scale, depth_bound    the strict law (2.5 to 2.27)
//   outward_reach, reachable_force_bound, reachable_outflow     what the next tick can reach (L6, § 2(a′));
//   reachable_share, reachable_work, later_reach                the same in joules, for any port
//   longest_path, unseen_arc                                    what can have gone on unseen (§ 2(a″))
//   coning, coning_share, unseen_turn                           what the end poses of a turn do not show (lemma C)
//   sampled_stiffness, sampled_damping                          what a sampled mass can take (§ 9)
//   spendable, sure_gain, sum_rounded_down                      rounding lowers the force, never breaks the promise
//   half_angle_turn                                             a small turn without cos and sin (2.30)
//
// Numbers with a dot are equations of McWilliam's 2017 thesis "Local Model Interpolation for Stable
// Haptic Interaction" with the signs put right (docs/design/audit.md); L and § refer to
// docs/design/mathematics.md.

#include <passive_haptics/base/language.hpp>

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0
#error passive_haptics: -ffast-math takes out the checks for NaN and infinity that every promise \
rests on: compile without it
#endif
#if defined(_M_FP_FAST)
#error passive_haptics: /fp:fast takes out the checks for NaN and infinity that every promise rests on: \
compile with /fp:precise
#endif
#if defined(__ASSOCIATIVE_MATH__)  // g++ defines it, clang++ does not
#error passive_haptics: -fassociative-math, a part of -ffast-math, sums in any order, so bounds are no \
longer rounded towards zero force: compile without it
#endif

namespace passive_haptics {
inline namespace v0 {

/// A real number type: float, double, long double, or anything that does arithmetic, compares, and
/// has numeric_limits and a sqrt found by argument-dependent look-up (Boost.Multiprecision).
template <class S>
concept real = std::regular<S> && std::totally_ordered<S> &&
               std::numeric_limits<S>::is_specialized && !std::numeric_limits<S>::is_integer &&
               requires(S a, S b) {
  {S(a + b)};
  {S(a - b)};
  {S(a * b)};
  {S(a / b)};
  {S(-a)};
  {S(1)};
};

namespace kernels {

template <real S>
[[nodiscard]] constexpr S smaller(S a, S b) noexcept {
  return b < a ? b : a;
}
template <real S>
[[nodiscard]] constexpr S larger(S a, S b) noexcept {
  return a < b ? b : a;
}

/// x, kept within [least, most].
template <real S>
[[nodiscard]] constexpr S clamped(S x, S least, S most) noexcept {
  return smaller(larger(x, least), most);
}

template <real S>
[[nodiscard]] constexpr S magnitude(S a) noexcept {
  if constexpr (std::floating_point<S>) {
    if (!std::is_constant_evaluated()) return std::fabs(a);
  }
  return a < S(0) ? S(-a) : a;
}

/// The largest finite number, and the smallest normal one. The brackets are there because headers of some
/// systems make macros of min and max.
template <class S>
[[nodiscard]] constexpr S largest() noexcept {
  return (std::numeric_limits<S>::max)();
}
template <real S>
[[nodiscard]] constexpr S smallest() noexcept {
  return (std::numeric_limits<S>::min)();
}

/// Neither NaN nor an infinity.
template <real S>
[[nodiscard]] constexpr bool is_finite(S x) noexcept {
  return magnitude(x) <= largest<S>();
}

/// √x for x ≥ 0. In a constant expression Newton's iteration descends until it stalls.
template <real S>
[[nodiscard]] constexpr S square_root(S x) noexcept {
  if (std::is_constant_evaluated()) {
    if (!(x > S(0)) || !is_finite(x)) return x;
    S root = x < S(1) ? S(1) : x;
    S next = (root + x / root) / S(2);
    while (next < root) {
      root = next;
      next = (root + x / root) / S(2);
    }
    return root;
  }
#if defined(__SSE2__) && defined(__GNUC__) && !defined(__clang__)
  // g++ would call sqrt() for errno where x < 0, and keep every number of the tick in memory for that.
  if constexpr (std::same_as<S, double>) {
    using two [[gnu::vector_size(16)]] = S;
    return __builtin_ia32_sqrtsd(two{x})[0];
  }
#endif
  using std::sqrt;
  return sqrt(x);
}

/// B = b/T [N/m]: damping b [N·s/m] seen over one tick of length T [s]. (2.5)
template <real S>
[[nodiscard]] constexpr S damping_per_tick(S b, S T) noexcept {
  return b / T;
}

/// f²/(4B) [J]: the most energy that force f [N], held for the next tick, can hand to the user
/// whatever the motion: min over Δx of BΔx² − fΔx, reached at Δx = f/(2B). (2.14, lemma L3)
template <real S>
[[nodiscard]] constexpr S worst_outflow(S f, S B) noexcept {
  return f * f / (S(4) * B);
}

/// 16ε, a relative margin that covers a dozen roundings in any direction.
template <real S>
[[nodiscard]] constexpr S rounding() noexcept {
  return S(16) * std::numeric_limits<S>::epsilon();
}

/// The part of a credit E1 [J] that may be spent although every step rounds, whichever way:
///     E1 (1 − 64ε) − min/ε,   ε and min the machine epsilon and the smallest normal number
/// The proof counts roundings and holds for b ≥ 1e-13 N·s/m (docs/design/stability.md).
template <real S>
[[nodiscard]] constexpr S spendable(S E1) noexcept {
  using limits = std::numeric_limits<S>;
  return E1 * (S(1) - S(4) * rounding<S>()) - smallest<S>() / limits::epsilon();
}

/// f_max = √(4 B E1) [N], rounded towards zero; zero for a ledger in debt, because E1 is clamped inside the
/// root (A6). (2.17)
template <real S>
[[nodiscard]] constexpr S strict_force_bound(S E1, S B) noexcept {
  const S credit = spendable(E1);
  if (!(credit > S(0))) return S(0);
  return square_root(smaller(S(4) * B * credit, largest<S>()));
}

/// The factor that brings a force whose worst outflow is `outflow` [J] down to what E1 [J] covers:
/// √(E1/outflow), rounded towards zero; 1 when it is covered already. (2.17 for any direction)
template <real S>
[[nodiscard]] constexpr S strict_scale(S E1, S outflow) noexcept {
  const S credit = spendable(E1);
  if (outflow <= credit) return S(1);
  if (!(credit > S(0))) return S(0);
  const S share = credit / outflow;
  if (!(share >= smallest<S>())) return S(0);
  const S scale = square_root(share);
  if (!(scale > S(0))) __builtin_unreachable();  // the root of a positive number is positive
  return scale;
}

/// dissipated − work [J], less the largest rounding error of both, so it is never more than in exact
/// arithmetic. `passed` is Σ |fᵢ Δxᵢ| [J], which is at least |work|.
template <real S>
[[nodiscard]] constexpr S sure_gain(S dissipated, S work, S passed) noexcept {
  return dissipated - work - rounding<S>() * (dissipated + passed);
}

/// E + gain [J], rounded down by an ulp at most, so that a ledger never grows by rounding: a float of 1 J would not
/// notice 1e-8 J going out, tick after tick.
template <real S>
[[nodiscard]] constexpr S sum_rounded_down(S E, S gain) noexcept {
  const S sum = E + gain;
  const S ulp = magnitude(sum) * std::numeric_limits<S>::epsilon();
  return sum - (sum - E > gain ? ulp : S(0));
}

/// d_max = f/K [m], the depth at which K displays f; 0 without stiffness. (2.27, A10)
template <real S>
[[nodiscard]] constexpr S depth_bound(S f, S K) noexcept {
  return K > S(0) ? f / K : S(0);
}

/// δ [m]: the farthest that a mass m [kg] can travel outwards in the next tick, of length ≤ T [s].
///     x(n+1) − x(n) = Δx·T/T₀ + double integral of a(t),   |a| ≤ (|f| + F_other)/m
/// `outward` is the travel along the force in the last tick [m], which lasted T₀ [s]; `held` and `next`
/// are the sizes of the force over the last and the next tick [N]; `other` bounds all else that pushes [N].
/// Exact for the double integrator; the terms beside `outward` are rounded up. (L6)
template <real S>
[[nodiscard]] constexpr S outward_reach(S outward, S held, S next, S other, S m, S T0,
                                        S T) noexcept {
  const S last = (held + other) * T0 * T / (S(2) * m);
  const S coming = (next + other) * T * T / (S(2) * m);
  return outward * T / T0 + (last + coming) * (S(1) + rounding<S>());
}

/// The largest force F [N] with F s − B s² ≤ E1 for every 0 ≤ s ≤ δ:
///     δ ≤ 0: any force      δ < √(E1/B): E1/δ + B δ      else: √(4 B E1)
/// rounded towards zero. (§ 2(a′))
template <real S>
[[nodiscard]] constexpr S reachable_force_bound(S E1, S B, S reach) noexcept {
  if (!(reach > S(0))) return largest<S>();
  const S credit = spendable(E1);
  if (B * reach * reach < credit) {
    return (credit / reach + B * reach) * (S(1) - rounding<S>());
  }
  return strict_force_bound(E1, B);
}

/// max of f s − B s² over 0 ≤ s ≤ δ [J]: the most that f [N] can hand to the user over δ [m]. (L3 with a reach)
template <real S>
[[nodiscard]] constexpr S reachable_outflow(S f, S B, S reach) noexcept {
  if (!(reach > S(0)) || !(f > S(0))) return S(0);
  if (S(2) * B * reach >= f) return worst_outflow(f, B);
  return f * reach - B * reach * reach;
}

/// max of η' − η'²/(4W) over 0 ≤ η' ≤ η [J], of an effort of worst outflow W [J]. (reachable_outflow in joules)
template <real S>
[[nodiscard]] constexpr S reachable_work(S W, S reach) noexcept {
  if (!(reach > S(0)) || !(W > S(0))) return S(0);
  if (reach >= S(2) * W) return W;
  return reach - reach * reach / (S(4) * W);
}

/// The largest share s of an effort with s η' − η'²/(4W) ≤ E1 for every 0 ≤ η' ≤ η:
///     η ≤ 0: all of it      η² < 4 W E1: E1/η + η/(4W)      else: √(E1/W)
/// rounded towards zero, at most 1. (reachable_force_bound in joules)
template <real S>
[[nodiscard]] constexpr S reachable_share(S E1, S W, S reach) noexcept {
  if (!(reach > S(0))) return S(1);
  const S credit = spendable(E1);
  if (credit > S(0) && reach * reach < S(4) * credit * W) {
    return smaller(S(1), (credit / reach + reach / (S(4) * W)) * (S(1) - rounding<S>()));
  }
  return strict_scale(E1, W);
}

/// dt|θ × τ|²/(36 b_ω) [J], rounded up: the most by which the gain of a turn can fall short of
/// b_ω|θ|²/dt − τ·θ, which its end poses show, if |θ| ≤ 1 rad and |τ| ≤ 4b_ω/dt. `across` is |θ × τ|².
/// (lemma C, docs/design/six_dof.md)
template <real S>
[[nodiscard]] constexpr S coning(S across, S b, S dt) noexcept {
  return dt * across / (S(36) * b) * (S(1) + rounding<S>());
}
/// The share of an effort, lowered so far that its torque is at most 4b_ω/T, rounded towards zero.
/// `squared` is |τ|². (lemma C)
template <real S>
[[nodiscard]] constexpr S coning_share(S share, S squared, S b, S T) noexcept {
  const S most = S(4) * b / T * (S(1) - rounding<S>());
  if (!(share * share * squared > most * most)) return share;
  return most / square_root(squared) * (S(1) - rounding<S>());
}

/// |Ω − θ| [rad], at most, of a tick of length dt whose rate of turn changes by at most α [rad/s²]: θ is the
/// turn that its end poses show and Ω the integral of the rate. To first order it is |Ω| α dt²/12, and |Ω| is
/// at most θ + α dt². (docs/design/six_dof.md)
template <real S>
[[nodiscard]] constexpr S unseen_turn(S theta, S alpha, S dt) noexcept {
  const S gained = alpha * dt * dt;
  return (theta + gained) * gained / S(12);
}
/// The longest path [m] of a time t [s] that nobody saw, after a tick of T₀ whose mean speed was v [m/s]:
///     t (v + A (T₀ + t)/2),   A = a + r V,   V = (v + a (T₀/2 + t))/(1 − r (T₀/2 + t))
/// a [m/s²] is the most that all but the damper accelerate, r = b/m [1/s] of the damper at most; any path where
/// that would brake within it. (§ 2(a″))
template <real S>
[[nodiscard]] constexpr S longest_path(S v, S a, S r, S T0, S t) noexcept {
  const S since = T0 / S(2) + t;
  if (!(r * since <= S(0.5))) return largest<S>();
  const S fastest = (v + a * since) / (S(1) - r * since);
  return t * (v + (a + r * fastest) * (T0 + t) / S(2)) * (S(1) + rounding<S>());
}
/// |Ω − θ| [rad], at most, of a path of length L [rad] from one orientation to another: L²/4 + L³/29, and L + π
/// where L > π. (§ 2(a″))
template <real S>
[[nodiscard]] constexpr S unseen_arc(S L) noexcept {
  return L <= S(3.125) ? L * L * (S(0.25) + L / S(29)) : L + S(3.1875);
}
/// η(j + 1) − η(j) of § 2(a′) [J]: `before` and `last` are the norms of what is held in the two ticks, `pushed` that of
/// all else that pushes.
template <real S>
[[nodiscard]] constexpr S later_reach(S norm, S before, S last, S pushed, S T) noexcept {
  return norm * (before + last + S(2) * pushed) * T * T / S(2) * (S(1) + rounding<S>());
}

/// K_s = min(K, κ m/T²) [N/m]: the stiffness that a mass sampled every T can be held with. (§ 9)
template <real S>
[[nodiscard]] constexpr S sampled_stiffness(S K, S fraction, S m, S T) noexcept {
  return smaller(K, fraction * m / (T * T));
}

/// D_s = min(2 ζ √(K_s m), β m/T) [N·s/m]: damping ratio ζ, kept below what sampling allows. (§ 9)
template <real S>
[[nodiscard]] constexpr S sampled_damping(S K, S ratio, S fraction, S m, S T) noexcept {
  return smaller(S(2) * ratio * square_root(K * m), fraction * m / T);
}

/// F²/(4B) [J]: the least cap on the ledger with which a wall can still push back with F [N]. (A9)
template <real S>
[[nodiscard]] constexpr S bank_for_hold(S F, S b, S T) noexcept {
  return worst_outflow(F, damping_per_tick(b, T));
}

/// Of a turn, and of the chord that it spans on the unit circle.
template <real S>
struct turn {
  S cosine, sine, chord_squared;
};

/// The turn by 2 atan(φ/2), from tan(turn/2) = φ/2: never more than φ [rad], short of it by φ³/12.
/// cos² + sin² = 1 to rounding, for any φ ≥ 0; beyond 2²¹ it is half a turn to within 2 µrad, so that no
/// square is beyond all numbers. (2.30-2.31 without cos and sin, A20)
template <real S>
[[nodiscard]] constexpr turn<S> half_angle_turn(S angle) noexcept {
  const S t = smaller(angle / S(2), S(1 << 20));
  const S d = S(1) + t * t;
  return {(S(1) - t * t) / d, S(2) * t / d, S(4) * t * t / d};
}

}  // namespace kernels
}  // namespace v0
}  // namespace passive_haptics
