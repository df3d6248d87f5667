// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bounds that begin soft and grow stiff on what the ledger has to spare.
//
//   nonlinear_coupling    K_c grows all the time in contact        stiffens within one press
//   stiffness_increment   K grows once per press and release       stiffens from touch to touch
//   force_augmentation    an offset is added where motion turns    steady force, soft feel
//
// All three only reduce the desired force. The strict law, ¼ fᵀB⁻¹f ≤ E1, comes last and alone
// makes them passive; the guard decides what may grow. U(d) [J] is what the shaped spring gives
// back on a release from depth d, and growth at d may raise it by no more than
//     E_free = E1 − max(U(d), ¼ fᵀB⁻¹f)
// U is a reservation: pressing raises it as it fills the ledger, releasing empties both alike, and
// each increment is charged to it in full. So nothing is promised twice, and nothing has to be
// remembered through a lost sample or a late tick. What it buys: from E1 ≥ U, a spring up to 2b/T
// on a surface that stays put keeps E1 ≥ U in every motion, and the strict law never cuts it.
//
// Each is INSPIRED BY the work it names; the published control laws are not confirmed. Formulas and
// proofs: docs/design/mathematics.md § 2(f). With actuators that lag, put strict_bound<Space, k>
// behind.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// Is there anything to shape, and is it known how the device came here?
[[nodiscard]] constexpr bool shapes(const auto& asked, const auto& state) noexcept {
  using scalar = std::remove_cvref_t<decltype(asked)>;
  return asked > scalar(0) && state.target_depth > scalar(0) && state.motion_known;
}

/// `desired` with at most `most` [N] of the `asked` [N] that it has along the normal.
template <class Space>
[[nodiscard]] constexpr typename Space::vector at_most(const typename Space::vector& desired,
                                                       typename Space::scalar asked,
                                                       typename Space::scalar most) noexcept {
  return most < asked ? typename Space::vector(desired * (most / asked)) : desired;
}

/// The strict law (2.17): `force`, or as much of it as the ledger covers for the longest tick.
template <class Space>
[[nodiscard]] constexpr typename Space::vector covered(const typename Space::vector& force,
                                                       const auto& state) noexcept {
  return force * state.damping.affordable(force, state.credit(), state.longest_tick);
}

/// E_free [J], ≥ 0: what the ledger has beyond the release U and the worst next tick of `force`.
template <class Space>
[[nodiscard]] constexpr typename Space::scalar spare(const typename Space::vector& force,
                                                     typename Space::scalar release,
                                                     const auto& state) noexcept {
  using scalar = typename Space::scalar;
  const scalar outflow = state.damping.worst_outflow(force, state.longest_tick);
  return kernels::larger(state.credit() - kernels::larger(release, outflow), scalar(0));
}

/// `wanted`, or as much of it as `spare` [J] pays for at `price` [J] each.
template <class Scalar>
[[nodiscard]] constexpr Scalar paid_for(Scalar wanted, Scalar price, Scalar spare) noexcept {
  return wanted * price <= spare ? wanted : spare / price;
}

/// The stiffness may start anywhere above zero.
template <class Scalar>
[[nodiscard]] constexpr parameter_fault<Scalar> initial_fault(Scalar initial) noexcept {
  if (initial > Scalar(0) && kernels::is_finite(initial)) return {};
  return {"initial", initial, "finite and > 0 N/m"};
}
}  // namespace detail

/// f = min(f*, K_f d), 1/K_f = 1/K_c + 1/K, and K_c grows in contact, each tick of length dt by
///     ΔK_c = min(rate·dt, most − K_c, 2 E_free/d²)       charged: ΔK_f d²/2 ≤ ΔK_c d²/2 [J]
/// It is back at `initial` when contact, or a sample, is lost. U = K_f d²/2. Inspired by the
/// nonlinear virtual coupling of the thesis (Fig. 1.7), of which only the idea is known. The price:
/// strict_bound's, and a press starts soft.
template <class Space>
struct nonlinear_coupling {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.only_reduces = true, .needs_ledger = true};

  scalar initial{};                                       ///< K_c at first touch [N/m], ≤ 2b/T
  scalar rate{};                                          ///< [N/(m·s)]
  scalar most = std::numeric_limits<scalar>::infinity();  ///< largest K_c [N/m]; infinite: up to K
  scalar coupling{};                                      ///< K_c now [N/m]; 0 outside

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    const scalar asked = Space::dot(desired, state.normal);
    if (!detail::shapes(asked, state)) {
      coupling = scalar(0);
      return detail::covered<Space>(desired, state);
    }
    const scalar d = state.target_depth;
    const scalar half = d * d / scalar(2);
    coupling = kernels::larger(coupling, initial);
    const scalar K = felt(state.stiffness);
    const vector now = detail::at_most<Space>(desired, asked, K * d);
    const scalar wanted = kernels::smaller(rate * state.dt, most - coupling);
    coupling += detail::paid_for(wanted, half, detail::spare<Space>(now, K * half, state));
    return detail::covered<Space>(detail::at_most<Space>(desired, asked, felt(state.stiffness) * d),
                                  state);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (const auto fault = detail::initial_fault(initial)) return fault;
    if (!(rate >= scalar(0)) || !kernels::is_finite(rate)) {
      return {"rate", rate, "finite and ≥ 0 N/(m·s)"};
    }
    if (!(most >= initial)) return {"most", most, "≥ initial"};
    return {};
  }

 private:
  [[nodiscard]] constexpr scalar felt(scalar K) const noexcept {
    return K / (scalar(1) + K / coupling);
  }
};

/// f = min(f*, K_i d), and K_i grows when a press follows a release, after a bounce too, by
///     ΔK = min(step, K − K_i, 2 E_free/d²)               charged: ΔK d²/2 [J]
/// It is back at `initial` after `reset_after` out of contact, or a lost sample. U = K_i d²/2.
/// Inspired by the successive stiffness increment (SSI) of Singh, Jafari and Ryu. A tick that moves
/// the other way counts as a turn, so quantised or noisy positions make it grow sooner: the guard
/// holds all the same. The price: strict_bound's, and the first presses are soft.
template <class Space>
struct stiffness_increment {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.only_reduces = true, .needs_ledger = true};

  scalar initial{};                ///< K_0 [N/m], ≤ 2b/T
  scalar step{};                   ///< most ΔK per press and release [N/m]
  scalar reset_after = scalar(1);  ///< time out of contact that forgets [s]
  scalar stiffness{};              ///< K_i now [N/m]; 0 before the first touch
  scalar away{};                   ///< time out of contact so far [s]
  bool released = false;           ///< it has moved out, or left, since it last moved in

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    const scalar asked = Space::dot(desired, state.normal);
    if (!detail::shapes(asked, state)) {
      away += state.dt;
      released = stiffness > scalar(0);
      if (away > reset_after || !state.motion_known) forget();
      return detail::covered<Space>(desired, state);
    }
    away = scalar(0);
    const scalar d = state.target_depth;
    const scalar half = d * d / scalar(2);
    stiffness = kernels::smaller(kernels::larger(stiffness, initial), state.stiffness);
    const scalar outward = Space::dot(state.displacement, state.normal);
    if (outward > scalar(0)) released = true;
    if (outward < scalar(0) && released) {
      released = false;
      const vector now = detail::at_most<Space>(desired, asked, stiffness * d);
      const scalar wanted = kernels::smaller(step, state.stiffness - stiffness);
      stiffness +=
          detail::paid_for(wanted, half, detail::spare<Space>(now, stiffness * half, state));
    }
    return detail::covered<Space>(detail::at_most<Space>(desired, asked, stiffness * d), state);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (const auto fault = detail::initial_fault(initial)) return fault;
    if (!(step >= scalar(0)) || !kernels::is_finite(step)) {
      return {"step", step, "finite and ≥ 0 N/m"};
    }
    if (!(reset_after >= scalar(0))) return {"reset_after", reset_after, "≥ 0 s"};
    return {};
  }

 private:
  constexpr void forget() noexcept {
    stiffness = scalar(0);
    released = false;
  }
};

/// f = min(f*, K_L d + F), K_L = min(low, K), and where the motion turns, in or out, the offset F
/// goes towards what is missing there, (K − K_L) d, by
///     ΔF = min(step, (K − K_L) d − F, E_free/d)          charged: ΔF d [J]
/// or down by at most `step`. It is zero again when contact, or a sample, is lost.
/// U = K_L d²/2 + F d, which min(f*, ·) can only make smaller. Inspired by the successive force
/// augmentation (SFA) of Singh, Jafari and Ryu, of which the abstract is known and this update is
/// not. Turns as in stiffness_increment. The price: strict_bound's, and the force steps by up to
/// `step` at a turn.
template <class Space>
struct force_augmentation {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.only_reduces = true, .needs_ledger = true};

  scalar low{};          ///< K_L [N/m], ≤ 2b/T
  scalar step{};         ///< most |ΔF| per turn [N]
  scalar offset{};       ///< F now [N]
  bool leaving = false;  ///< the way of the last motion in contact

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    const scalar asked = Space::dot(desired, state.normal);
    if (!detail::shapes(asked, state)) {
      offset = scalar(0);
      leaving = false;
      return detail::covered<Space>(desired, state);
    }
    const scalar d = state.target_depth;
    const scalar K = kernels::smaller(low, state.stiffness);
    const scalar outward = Space::dot(state.displacement, state.normal);
    const bool turned = leaving ? outward < scalar(0) : outward > scalar(0);
    if (turned) {
      leaving = !leaving;
      const vector now = detail::at_most<Space>(desired, asked, K * d + offset);
      const scalar release = (K * d / scalar(2) + offset) * d;
      const scalar missing = (state.stiffness - K) * d - offset;
      const scalar wanted = kernels::larger(kernels::smaller(missing, step), -step);
      offset += detail::paid_for(wanted, d, detail::spare<Space>(now, release, state));
    }
    return detail::covered<Space>(detail::at_most<Space>(desired, asked, K * d + offset), state);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(low > scalar(0)) || !kernels::is_finite(low)) {
      return {"low", low, "finite and > 0 N/m"};
    }
    if (!(step >= scalar(0)) || !kernels::is_finite(step)) {
      return {"step", step, "finite and ≥ 0 N"};
    }
    return {};
  }
};

static_assert(force_bound_for<nonlinear_coupling<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<stiffness_increment<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<force_augmentation<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
