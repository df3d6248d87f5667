// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The laws of each role: what a policy must obey and a concept cannot say. Each is a predicate over
// a policy of YOURS, fed with repeatable random samples; constexpr, so in one dimension
//     static_assert(ph::laws::spends_at_most_the_ledger<scene>(my_bound{}));
// and in any dimension CHECK(...) it at run time.
//
//   observer   never_overstates       it counts at most what the device really took
//              forfeit_never_credits  a tick nobody saw only costs
//   bound      adds_nothing_to_zero   nothing desired, nothing returned (only_reduces)
//              scales_down            the result is s·f*, 0 ≤ s ≤ 1 (only_reduces)
//              spends_at_most_the_ledger    ¼ fᵀB⁻¹f ≤ E1 (tag strict)
//   normal     turns_at_most          unit length, no faster than the rate, and it arrives
//   contact    presses_outwards       f* ≥ 0, zero outside, monotone in depth, depth() inverts it
//   constraint measures_depth         (p − x)·n, unit normal; toward() puts x at the depth asked

#include <passive_haptics/concepts.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {
namespace laws {

/// A repeatable source of numbers in [−1, 1), also at compile time (SplitMix64 of Steele,
/// Lea and Flood, 2014; not for cryptography).
class samples {
 public:
  constexpr explicit samples(std::uint64_t seed) noexcept : state_(seed) {}

  [[nodiscard]] constexpr std::uint64_t bits() noexcept {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  template <class Scalar>
  [[nodiscard]] constexpr Scalar number() noexcept {
    return Scalar(static_cast<std::int32_t>(bits() >> 32U)) / Scalar(2147483648.0);
  }
  /// Components in [−1, 1).
  template <class Space>
  [[nodiscard]] constexpr typename Space::vector vector() noexcept {
    using scalar = typename Space::scalar;
    if constexpr (Space::dof == 1) {
      return number<scalar>();
    } else {
      typename Space::vector v = Space::zero();
      for (int i = 0; i < Space::dof; ++i) v(i) = number<scalar>();
      return v;
    }
  }
  /// Length one, any direction.
  template <class Space>
  [[nodiscard]] constexpr typename Space::vector direction() noexcept {
    using scalar = typename Space::scalar;
    while (true) {
      const typename Space::vector v = vector<Space>();
      const scalar length = Space::norm(v);
      if (length > scalar(0.1) && length <= scalar(1)) return v / length;
    }
  }

 private:
  std::uint64_t state_;
};

/// In a run of random motions and forces, E1 never exceeds its first value plus the sum of
/// b|Δx|²/dt − f·Δx, and follows it down at once: a cap, a reset or a dead band may only take away.
template <class Space, class Observer>
[[nodiscard]] constexpr bool never_overstates(Observer observer, int ticks = 200) noexcept {
  using scalar = typename Space::scalar;
  samples random(1);
  const scalar tolerance = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < ticks; ++i) {
    const scalar dt = scalar(0.001) * (scalar(1.5) + random.number<scalar>());
    const typename Space::vector step = random.vector<Space>() * scalar(0.001);
    const bool touching = random.number<scalar>() > scalar(0);
    const typename Space::vector held =
        touching ? typename Space::vector(random.vector<Space>()) : Space::zero();
    const scalar before = observer.value();
    const scalar took = observer.damping.dissipated(step, dt);
    const scalar gave = Space::dot(held, step);
    observer.update(step, held, dt);
    const scalar size = kernels::magnitude(before) + took + kernels::magnitude(gave);
    if (observer.value() > before + took - gave + tolerance * size) return false;
  }
  return true;
}

/// forfeit() never raises the ledger, never deepens a debt, and covers the worst outflow if it can.
template <class Space, class Observer>
[[nodiscard]] constexpr bool forfeit_never_credits(Observer observer, int ticks = 200) noexcept {
  using scalar = typename Space::scalar;
  samples random(2);
  const scalar T = scalar(0.001);
  for (int i = 0; i < ticks; ++i) {
    observer.update(random.vector<Space>() * scalar(0.001), Space::zero(), T);
    const typename Space::vector held = random.vector<Space>();
    const scalar before = observer.value();
    const scalar worst = observer.damping.worst_outflow(held, T);
    observer.forfeit(held, T);
    const scalar after = observer.value();
    if (after > before || (before > scalar(0) && after < scalar(0))) return false;
    if (after > scalar(0) && after > before - worst + scalar(1e-6) * before) return false;
  }
  return true;
}

/// A random situation for a bound: everything finite, the ledger anywhere from debt to plenty.
template <class Space>
[[nodiscard]] constexpr auto random_state(samples& random,
                                          const isotropic_damping<Space>& damping) noexcept {
  using scalar = typename Space::scalar;
  const typename Space::vector normal = random.direction<Space>();
  const scalar exponent = random.number<scalar>();
  return tick_state<Space>{damping,
                           exponent * exponent * exponent * scalar(0.1),
                           scalar(0),
                           scalar(0.001),
                           scalar(0.001),
                           random.vector<Space>() * scalar(5),
                           random.vector<Space>() * scalar(0.002),
                           scalar(0),
                           true,
                           normal,
                           scalar(1000),
                           random.number<scalar>() * scalar(0.005),
                           random.number<scalar>() * scalar(0.005),
                           kernels::magnitude(random.number<scalar>()) * scalar(5),
                           false};
}

/// Visits `ticks` random states; true if test(desired, limited, state) holds in all of them.
template <class Space, class Bound>
[[nodiscard]] constexpr bool holds_in_random_states(Bound bound, auto test, int ticks) noexcept {
  using scalar = typename Space::scalar;
  samples random(3);
  const isotropic_damping<Space> damping{scalar(0.03)};
  for (int i = 0; i < ticks; ++i) {
    const auto state = random_state<Space>(random, damping);
    const scalar asked = random.number<scalar>();
    const typename Space::vector desired = state.normal * (asked * asked * scalar(20));
    const typename Space::vector result = bound.limit(desired, state);
    if (!Space::is_finite(result) || !test(desired, result, state)) return false;
  }
  return true;
}

/// Nothing desired, nothing returned.
template <class Space, class Bound>
[[nodiscard]] constexpr bool adds_nothing_to_zero(Bound bound, int ticks = 200) noexcept {
  static_assert(Bound::traits.only_reduces, "passive_haptics: a law for bounds that only reduce");
  return holds_in_random_states<Space>(
      bound,
      [&bound](const auto&, const auto&, const auto& state) {
        Bound copy = bound;
        const typename Space::vector none = Space::zero();
        return typename Space::vector(copy.limit(none, state)) == none;
      },
      ticks);
}

/// The result is s·f* with 0 ≤ s ≤ 1: same direction, no longer.
template <class Space, class Bound>
[[nodiscard]] constexpr bool scales_down(Bound bound, int ticks = 200) noexcept {
  static_assert(Bound::traits.only_reduces, "passive_haptics: a law for bounds that only reduce");
  using scalar = typename Space::scalar;
  return holds_in_random_states<Space>(
      bound,
      [](const typename Space::vector& desired, const typename Space::vector& result,
         const auto& state) {
        const scalar slack = scalar(16) * std::numeric_limits<scalar>::epsilon();
        const scalar along = Space::dot(result, state.normal);
        const scalar asked = Space::dot(desired, state.normal);
        const typename Space::vector rest = result - state.normal * along;
        return along >= scalar(0) && along <= asked * (scalar(1) + slack) &&
               Space::norm(rest) <= slack * asked;
      },
      ticks);
}

/// ¼ fᵀB⁻¹f ≤ E1, and f = 0 in debt: the whole of the proof of a strict bound.
template <class Space, class Bound>
[[nodiscard]] constexpr bool spends_at_most_the_ledger(Bound bound, int ticks = 1000) noexcept {
  using scalar = typename Space::scalar;
  return holds_in_random_states<Space>(
      bound,
      [](const auto&, const typename Space::vector& result, const auto& state) {
        const scalar outflow = state.damping.worst_outflow(result, state.longest_tick);
        return outflow <= kernels::larger(state.credit(), scalar(0));
      },
      ticks);
}

/// From any unit normal to any other: unit length, at most `rate`·dt a step, there in the end.
template <class Space, class Normals>
[[nodiscard]] constexpr bool turns_at_most(Normals normals, typename Space::scalar rate,
                                           int pairs = 20) noexcept {
  using scalar = typename Space::scalar;
  samples random(4);
  const scalar dt = scalar(0.001);
  const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < pairs; ++i) {
    const typename Space::vector target = random.direction<Space>();
    typename Space::vector now = i == 0   ? typename Space::vector(-target)
                                 : i == 1 ? target
                                          : typename Space::vector(random.direction<Space>());
    const int enough = static_cast<int>(scalar(4) / (rate * dt)) + 2;
    for (int k = 0; k < enough; ++k) {
      const typename Space::vector next = normals.step(now, target, dt);
      if (!(Space::norm(typename Space::vector(next)) <= scalar(1) + slack)) return false;
      if (!(Space::norm(typename Space::vector(next)) >= scalar(1) - slack)) return false;
      const typename Space::vector chord = next - now;  // |chord| ≤ angle
      if (Space::dof > 1 && !(Space::norm(chord) <= rate * dt + slack)) return false;
      now = next;
    }
    if (!(now == target)) return false;
  }
  return true;
}

/// f* ≥ 0, zero outside, never falling with depth or rising with outward speed; depth() gives back
/// the depth of any force that is not zero.
template <class Space, class Contact>
[[nodiscard]] constexpr bool presses_outwards(Contact contact, int ticks = 200) noexcept {
  using scalar = typename Space::scalar;
  samples random(5);
  for (int i = 0; i < ticks; ++i) {
    contact.adopt(scalar(5000) * (scalar(1.1) + random.number<scalar>()), scalar(0.001));
    const scalar d = random.number<scalar>() * scalar(0.01);
    const scalar v = random.number<scalar>();
    const scalar f = contact.force(d, v);
    if (!(f >= scalar(0)) || (d <= scalar(0) && f > scalar(0))) return false;
    if (contact.force(d + scalar(0.001), v) < f) return false;
    if (contact.force(d, v + scalar(0.1)) > f) return false;
    const scalar miss = contact.depth(f, v) - d;
    if (f > scalar(0) && kernels::magnitude(miss) > scalar(1e-4) * d) return false;
  }
  return true;
}

/// After prepare(): unit normal, depth d − s after moving x by s along it, and toward(..., x, n, d)
/// gives a constraint with normal n in which x lies d deep.
template <class Space, class Constraint>
[[nodiscard]] constexpr bool measures_depth(Constraint constraint, int ticks = 100) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  if (!constraint.prepare()) return false;
  samples random(6);
  const scalar slack = scalar(256) * std::numeric_limits<scalar>::epsilon();
  const vector n = constraint.outward();
  for (int i = 0; i < ticks; ++i) {
    const vector x = random.vector<Space>();
    const scalar s = random.number<scalar>();
    const scalar change = constraint.depth(vector(x + n * s)) - (constraint.depth(x) - s);
    const vector m = random.direction<Space>();
    const scalar d = s * s;
    const auto moved = constraint.toward(constraint, x, m, d);
    const scalar miss = moved.depth(x) - d;
    if (!(change * change <= slack * slack) || !(miss * miss <= slack * slack)) return false;
    if (!(vector(moved.outward()) == m)) return false;
  }
  const scalar unit = Space::dot(n, n) - scalar(1);
  return unit * unit <= slack * slack;
}

}  // namespace laws
}  // namespace v0
}  // namespace passive_haptics
