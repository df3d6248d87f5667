// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Passive set-position modulation (PSPM): gates the energy that an update of the surface puts into
// the contact spring, and nothing else.
//
//   set_position_modulation   ½ K d_new² ≤ ½ K d_old² + E      excellent against jumps of the
//                                                              environment; does not see the hold
//
// For walls stiffer than 2b/T put a strict bound behind it: bound_chain{pspm, strict_bound}.

#include <passive_haptics/concepts.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// Who pays for the leak of the zero-order hold, K Δx²/2 per tick (lemma L2).
enum class hold_leak : std::uint8_t {
  paid,     ///< it is taken out of the damping first: passive for K ≤ 2b/T
  ignored,  ///< the spring counts as one of continuous time, as published
};

/// The contact spring is moved away from the device no farther than a tank covers. Between updates
/// the spring is left alone. At an update:
///     E ← min(E + D_min + ½ K d_old² − ½ K d_new², cap),     d_new the deepest ≤ d* with E ≥ 0
///     D_min = (b − K T/2) (max x − min x)²/(t_k − t_{k−1})      b alone where the leak is ignored
/// x is the travel along the normal since the last update. The gap between d* and d_new stays until
/// the next update, or until the device leaves: then the surface follows it out, which costs
/// nothing. What the spring asked for and the motors did not hold is booked too.
///
/// Source: Lee and Huang 2010, form from memory; proofs: docs/design/mathematics.md § 2(e) for
/// continuous time. With the leak paid, for a hold of T, with S = ½ K d²:
///     K ≤ 2b/T  ⇒  ΔE1 ≥ ΔS + (b/T − K/2) Δx² within an update, so  E1 ≥ S + E ≥ 0 throughout,
/// and a tick cannot take more than it leaves, (K d)²/(4B) ≤ S.
///
/// Assumes, where the leak is paid: every K the environment sends is ≤ 2b/T; b is a lower bound;
/// every tick ≤ longest_tick; positions exact; no latency; the contact law asks at most K d; the
/// force held is known and at most the one asked for. Stiffer, or with the leak ignored, it promises
/// nothing: with a static wall it is the same as no bound at all. E at the start is a loan.
template <class Space, hold_leak Leak = hold_leak::paid>
struct set_position_modulation {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity =
      Leak == hold_leak::paid ? guarantee::conditional : guarantee::none;
  static constexpr bound_traits traits{
      .only_reduces = true, .needs_ledger = true, .needs_local_model = true};

  /// The spring that is there now, K [N/m], d [m] (< 0 outside), and its unit normal.
  struct contact_spring {
    scalar stiffness{};
    scalar depth{};
    typename Space::coordinates normal{};
    scalar gap{};  ///< d* − d [m], ≥ 0
  };
  /// What has happened since the last update.
  struct interval {
    scalar inward{}, least{}, most{};  ///< travel along the normal, and its range [m]
    scalar time{};                     ///< [s]
    scalar damping = std::numeric_limits<scalar>::max();  ///< least that is free to spend [N·s/m]
  };

  scalar energy{};                                  ///< E [J]; its first value is a loan
  scalar cap = std::numeric_limits<scalar>::max();  ///< most that E may hold [J]
  scalar ask_again = scalar(0.02);  ///< a target not reached is asked for again after this [s]
  contact_spring spring{};          ///< begin with none
  interval since{};                 ///< begin with none

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    const scalar there = book(state);
    const bool update = state.target_changed || (spring.gap > scalar(0) && since.time >= ask_again);
    if (update) collect();
    const scalar asked = state.target_depth;
    const scalar gap = update ? scalar(0) : spring.gap;
    scalar depth = kernels::smaller(asked, kernels::larger(asked - gap, scalar(0)));
    const scalar budget = kernels::larger(energy + there, scalar(0));
    if (stored(state.stiffness, depth) > budget) {
      depth = kernels::smaller(depth, kernels::square_root(scalar(2) * budget / state.stiffness));
    }
    energy = kernels::smaller(energy + there - stored(state.stiffness, depth), cap);
    spring = {state.stiffness, depth, state.normal, asked - depth};
    return depth < asked ? vector(desired * (depth / asked)) : desired;
  }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(energy >= scalar(0)) || !kernels::is_finite(energy)) {
      return {"energy", energy, "finite and ≥ 0 J at the start"};
    }
    if (!(cap >= scalar(0))) return {"cap", cap, "≥ 0 J"};
    if (!(ask_again > scalar(0))) return {"ask_again", ask_again, "> 0 s"};
    if (spring.stiffness > scalar(0)) {
      return {"spring.stiffness", spring.stiffness, "0 N/m at the start"};
    }
    return {};
  }

 private:
  [[nodiscard]] static constexpr scalar stored(scalar stiffness, scalar depth) noexcept {
    return depth > scalar(0) ? stiffness * depth * depth / scalar(2) : scalar(0);
  }

  /// One tick of the spring as it was; what it stores at the end of it [J]. A tick that was not
  /// seen, or was too long, leaves neither spring nor credit.
  constexpr scalar book(const auto& state) noexcept {
    if (!(spring.stiffness > scalar(0))) return scalar(0);  // never a target, never a force
    if (!state.motion_known || state.dt > state.longest_tick) {
      energy = kernels::smaller(energy, scalar(0));
      since = {};
      return scalar(0);
    }
    const scalar T = state.longest_tick;
    const vector normal = spring.normal;
    const vector asked = normal * (spring.stiffness * kernels::larger(spring.depth, scalar(0)));
    energy += Space::dot(vector(asked - state.held), state.displacement);

    const scalar inward = -Space::dot(state.displacement, normal);
    const scalar leak = Leak == hold_leak::paid ? spring.stiffness * T / scalar(2) : scalar(0);
    since.inward += inward;
    since.least = kernels::smaller(since.least, since.inward);
    since.most = kernels::larger(since.most, since.inward);
    since.time += state.dt;
    since.damping = kernels::smaller(since.damping, state.damping.per_tick(normal, T) * T - leak);
    return stored(spring.stiffness, spring.depth + inward);
  }

  /// D_min into the tank. (lemma L1)
  constexpr void collect() noexcept {
    const scalar range = since.most - since.least;
    if (since.time > scalar(0) && since.damping > scalar(0)) {
      energy += since.damping * range * range / since.time;
    }
    since = {};
  }
};

static_assert(force_bound_for<set_position_modulation<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
