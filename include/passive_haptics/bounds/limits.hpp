// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Limits that need no ledger.
//
//   no_bound          f = f*                          for comparison, and for worlds proved otherwise
//   actuator_limit    |f| ≤ what the motors give      always, with motors
//   force_rate_limit  f within f_LM ± rate·dt         no jumps at updates

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// f = f*. Loses energy at every tick in contact (lemma L2): K Δx²/2 against b Δx²/T.
template <class Space>
struct no_bound {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.only_reduces = true};

  [[nodiscard]] constexpr vector limit(const vector& desired,
                                       const auto& /*state*/) const noexcept {
    return desired;
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

/// |f| ≤ `most` [N], direction kept: what the motors can hold. Without it (or a device that reports
/// the force it held) the ledger would book a force that was never there (A28).
template <class Space>
struct actuator_limit {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.only_reduces = true};

  scalar most{};  ///< largest force [N]

  [[nodiscard]] constexpr vector limit(const vector& desired,
                                       const auto& /*state*/) const noexcept {
    const scalar force = Space::norm(desired);
    return force > most ? vector(desired * (most / force)) : desired;
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (most >= scalar(0) && kernels::is_finite(most)) return {};
    return {"most", most, "finite and ≥ 0 N"};
  }
};

/// f within f_LM ± `rate`·dt, along the normal: what the hand's own motion does to the force passes
/// at once, what the environment does (an update, a lost contact) passes at `rate` N/s. That is the
/// local surface moving at no more than rate/K m/s (A23). It may hold a force above the desired one
/// while the surface retreats, so put the energy bound BEHIND it in the chain.
template <class Space>
struct force_rate_limit {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.needs_local_model = true};

  scalar rate{};  ///< [N/s]

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    const scalar step = rate * state.dt;
    const scalar asked = Space::dot(desired, state.normal);
    const scalar least = kernels::larger(state.local_force - step, scalar(0));
    const scalar most = state.local_force + step;
    return state.normal * kernels::smaller(kernels::larger(asked, least), most);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (rate > scalar(0) && kernels::is_finite(rate)) return {};
    return {"rate", rate, "finite and > 0 N/s"};
  }
};

static_assert(force_bound_for<no_bound<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<actuator_limit<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<force_rate_limit<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
