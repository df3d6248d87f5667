// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The equations, one function each. A kernel takes plain scalars and returns one, has no state, and no branch
// that is not in its formula. If you write a loop of your own, this header is all you need.
//
//   damping_per_tick, worst_outflow, strict_force_bound, strict_scale, depth_bound    the strict force bound (2.5 to 2.27)
//   outward_reach, reachable_force_bound, reachable_outflow     the travel that a mass admits (L6, § 2(a′))
//   reachable_share, reachable_work, later_reach                the same bound in joules, for any port
//   longest_path, unseen_arc                                    the longest motion between two samples (§ 2(a″))
//   coning, coning_share, unseen_turn                           the error of a turn known by its end poses (lemma C)
//   sampled_stiffness, sampled_damping                          the largest that a sampled mass admits (§ 9)
//   spendable, sure_gain, sum_rounded_down                      rounding that can only lower the force
//   half_angle_turn                                             a small turn without cos and sin (2.30)
//
// Numbers with a dot are equations of McWilliam's 2017 thesis "Local Model Interpolation for Stable Haptic Interaction",
// signs corrected; A and a number is a finding of docs/design/audit.md; L and § refer to docs/design/mathematics.md.

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

/// True unless x is NaN or an infinity.
template <real S>
[[nodiscard]] constexpr bool is_finite(S x) noexcept {
  return magnitude(x) <= largest<S>();
}

/// √x for x ≥ 0. In a constant expression it is computed by Newton's iteration, until that descends no more.
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

/// B = b/T [N/m], which makes BΔx² the least energy that damping b [N·s/m] takes in a tick of length T [s]. (2.5)
template <real S>
[[nodiscard]] constexpr S damping_per_tick(S b, S T) noexcept {
  return b / T;
}

/// f²/(4B) [J], the worst outflow: the most energy that a force f [N] held for one tick can give to the hand,
/// beyond what the damper takes. It is max over Δx of fΔx − BΔx², reached at Δx = f/(2B). (2.14, lemma L3)
template <real S>
[[nodiscard]] constexpr S worst_outflow(S f, S B) noexcept {
  return f * f / (S(4) * B);
}

/// 16ε with the machine epsilon ε: a relative margin that covers a dozen roundings in any direction.
template <real S>
[[nodiscard]] constexpr S rounding() noexcept {
  return S(16) * std::numeric_limits<S>::epsilon();
}

/// The part of a credit E1 [J] that may be spent even if every following step rounds in the wrong direction:
///     E1 (1 − 64ε) − min/ε,   ε and min the machine epsilon and the smallest normal number
/// The proof counts roundings and holds for b ≥ 1e-13 N·s/m (docs/design/stability.md).
template <real S>
[[nodiscard]] constexpr S spendable(S E1) noexcept {
  using limits = std::numeric_limits<S>;
  return E1 * (S(1) - S(4) * rounding<S>()) - smallest<S>() / limits::epsilon();
}

/// f_max = √(4 B E1) [N], rounded towards zero. (2.17) It is 0 for E1 < 0, because E1 is clamped in the root (A6).
template <real S>
[[nodiscard]] constexpr S strict_force_bound(S E1, S B) noexcept {
  const S credit = spendable(E1);
  if (!(credit > S(0))) return S(0);
  return square_root(smaller(S(4) * B * credit, largest<S>()));
}

/// √(E1/outflow), rounded towards zero: the factor by which a force of worst outflow `outflow` [J] has to shrink
/// until E1 [J] covers it. It is 1 if E1 covers the force already. (2.17 for any direction)
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

/// dissipated − work [J], less the largest rounding error of both, so the result never exceeds that of exact
/// arithmetic. `passed` is Σ |fᵢ Δxᵢ| [J], which bounds the rounding error of `work`.
template <real S>
[[nodiscard]] constexpr S sure_gain(S dissipated, S work, S passed) noexcept {
  return dissipated - work - rounding<S>() * (dissipated + passed);
}

/// E + gain [J], rounded down by one ulp at most. Otherwise a ledger could gain by rounding: in float, 1 J − 1e-8 J
/// is 1 J again, in every tick.
template <real S>
[[nodiscard]] constexpr S sum_rounded_down(S E, S gain) noexcept {
  const S sum = E + gain;
  const S ulp = magnitude(sum) * std::numeric_limits<S>::epsilon();
#if defined(__SSE2__)
  return sum - (sum - E > gain ? ulp : S(0));  // by a mask: a jump would be guessed wrong too often
#else
  return sum - E > gain ? S(sum - ulp) : sum;
#endif
}

/// d_max = f/K [m], the depth at which a spring K [N/m] has the force f [N]; 0 for K ≤ 0. (2.27, A10)
template <real S>
[[nodiscard]] constexpr S depth_bound(S f, S K) noexcept {
  return K > S(0) ? f / K : S(0);
}

/// δ [m]: the farthest that a mass m [kg] can travel along the force in the next tick, which lasts T [s] at most:
///     δ = outward T/T₀ + (held + other) T₀T/(2m) + (next + other) T²/(2m)
/// `outward` is the travel along the force in the last tick [m], which lasted T₀ [s]; `held` and `next`
/// are the sizes of the force over the last and the next tick [N]; `other` bounds all other forces [N].
/// A free mass reaches it; the terms beside `outward` are rounded up. (L6) In the second one T₀ is at least `recent`.
template <real S>
[[nodiscard]] constexpr S outward_reach(S outward, S held, S next, S other, S m, S T0, S T,
                                        S recent = S(0)) noexcept {
  const S last = (held + other) * larger(T0, recent) * T / (S(2) * m);
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

/// max of f s − B s² over 0 ≤ s ≤ δ [J], the most energy that f [N] gives to the hand within δ [m]. (L3 with a reach)
template <real S>
[[nodiscard]] constexpr S reachable_outflow(S f, S B, S reach) noexcept {
  if (!(reach > S(0)) || !(f > S(0))) return S(0);
  if (S(2) * B * reach >= f) return worst_outflow(f, B);
  return f * reach - B * reach * reach;
}

/// max of η' − η'²/(4W) over 0 ≤ η' ≤ η [J]: the most energy that an effort of worst outflow W [J] can give to the
/// hand if its work is at most η = `reach` [J]. (§ 2(a′), in joules)
template <real S>
[[nodiscard]] constexpr S reachable_work(S W, S reach) noexcept {
  if (!(reach > S(0)) || !(W > S(0))) return S(0);
  if (reach >= S(2) * W) return W;
  return reach - reach * reach / (S(4) * W);
}

/// The largest share s of such an effort with s η' − η'²/(4W) ≤ E1 for every 0 ≤ η' ≤ η:
///     η ≤ 0: s = 1      η² < 4 W E1: E1/η + η/(4W)      else: √(E1/W)
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

/// dt|θ × τ|²/(36 b_ω) [J], rounded up: the most by which the true gain of a turn can fall short of the
/// b_ω|θ|²/dt − τ·θ that its end poses show, if |θ| ≤ 1 rad and |τ| ≤ 4b_ω/dt. `across` is |θ × τ|² [N²·m²],
/// `b` is b_ω [N·m·s/rad]. (lemma C, docs/design/six_dof.md)
template <real S>
[[nodiscard]] constexpr S coning(S across, S b, S dt) noexcept {
  return dt * across / (S(36) * b) * (S(1) + rounding<S>());
}
/// `share`, lowered until share |τ| ≤ 4b_ω/T, and rounded towards zero. `squared` is |τ|² [N²·m²]. (lemma C)
template <real S>
[[nodiscard]] constexpr S coning_share(S share, S squared, S b, S T) noexcept {
  const S most = S(4) * b / T * (S(1) - rounding<S>());
  if (!(share * share * squared > most * most)) return share;
  return most / square_root(squared) * (S(1) - rounding<S>());
}

/// (θ + α dt²) α dt²/12 [rad], an upper bound of |Ω − θ| in a tick of length dt [s] whose angular velocity changes
/// by at most α [rad/s²]. θ is the turn between the end poses and Ω the integral of the angular velocity; to first
/// order |Ω − θ| is |Ω| α dt²/12, and |Ω| ≤ θ + α dt². (docs/design/six_dof.md)
template <real S>
[[nodiscard]] constexpr S unseen_turn(S theta, S alpha, S dt) noexcept {
  const S gained = alpha * dt * dt;
  return (theta + gained) * gained / S(12);
}
/// The longest path [m] in a time t [s] without samples, after a tick of T₀ [s] whose mean speed was v [m/s]:
///     t (v + A (T₀ + t)/2),   A = a + r V,   V = (v + a (T₀/2 + t))/(1 − r (T₀/2 + t))
/// a [m/s²] is the largest acceleration by all forces but the damper's, and r = b/m [1/s] of the largest b. The
/// bound holds for r (T₀/2 + t) ≤ ½; beyond, the result is the largest number. (§ 2(a″))
template <real S>
[[nodiscard]] constexpr S longest_path(S v, S a, S r, S T0, S t) noexcept {
  const S since = T0 / S(2) + t;
  if (!(r * since <= S(0.5))) return largest<S>();
  const S fastest = (v + a * since) / (S(1) - r * since);
  return t * (v + (a + r * fastest) * (T0 + t) / S(2)) * (S(1) + rounding<S>());
}
/// An upper bound of |Ω − θ| [rad], as in unseen_turn, of a turn along any path of length L [rad]: L²/4 + L³/29 for
/// L ≤ π, and L + π beyond. (§ 2(a″))
template <real S>
[[nodiscard]] constexpr S unseen_arc(S L) noexcept {
  return L <= S(3.125) ? L * L * (S(0.25) + L / S(29)) : L + S(3.1875);
}
/// η(j+1) − η(j) = ‖f‖ (‖h(j)‖ + ‖h(j+1)‖ + 2F) T²/2 [J]. `norm` is ‖f‖, `before` and `last` are the norms of the
/// efforts held in ticks j and j + 1, and `pushed` is the norm F of all others [√J/s]. (§ 2(a′))
template <real S>
[[nodiscard]] constexpr S later_reach(S norm, S before, S last, S pushed, S T) noexcept {
  return norm * (before + last + S(2) * pushed) * T * T / S(2) * (S(1) + rounding<S>());
}

/// K_s = min(K, κ m/T²) [N/m]: a stiffness at which a mass m [kg] sampled every T [s] settles; κ is `fraction`. (§ 9)
template <real S>
[[nodiscard]] constexpr S sampled_stiffness(S K, S fraction, S m, S T) noexcept {
  return smaller(K, fraction * m / (T * T));
}

/// D_s = min(2ζ√(K_s m), β m/T) [N·s/m]: damping of ratio ζ, kept below the limit of sampling; β is `fraction`. (§ 9)
template <real S>
[[nodiscard]] constexpr S sampled_damping(S K, S ratio, S fraction, S m, S T) noexcept {
  return smaller(S(2) * ratio * square_root(K * m), fraction * m / T);
}

/// F²/(4B) [J]: the smallest cap on the ledger under which the strict bound still grants a force F [N]. (A9)
template <real S>
[[nodiscard]] constexpr S bank_for_hold(S F, S b, S T) noexcept {
  return worst_outflow(F, damping_per_tick(b, T));
}

/// Cosine and sine of a turn, and the square of the chord that it spans on the unit circle, 2 − 2cos.
template <real S>
struct turn {
  S cosine, sine, chord_squared;
};

/// The turn by 2 atan(φ/2) [rad], from tan(turn/2) = φ/2. It is smaller than φ [rad], by about φ³/12.
/// cos² + sin² = 1 to rounding, for any φ ≥ 0. φ is clamped at 2²¹, where the turn is π to within 2 µrad, so
/// that t² does not overflow. (2.30-2.31 without cos and sin, A20)
template <real S>
[[nodiscard]] constexpr turn<S> half_angle_turn(S angle) noexcept {
  const S t = smaller(angle / S(2), S(1 << 20));
  const S d = S(1) + t * t;
  return {(S(1) - t * t) / d, S(2) * t / d, S(4) * t * t / d};
}

}  // namespace kernels
}  // namespace v0
}  // namespace passive_haptics
