// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Normal interpolation: how fast the contact direction may turn from the local model's to the environment's.
//
//   turn_at_once     n ← n_VE                     flat walls, one degree of freedom, comparison
//   turn_limited     by at most `rate` [rad/s]    surfaces that deform or have edges
//
// A blend over one update period is not offered, because it has to know when the next update comes.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// n ← n_VE: the contact normal is the environment's at once.
struct turn_at_once {
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <class Space>
  struct on {
    using vector = typename Space::vector;
    constexpr explicit on(const turn_at_once& /*p*/) noexcept {}
    [[nodiscard]] constexpr vector step(const vector& /*from*/, const vector& to,
                                        typename Space::scalar /*dt*/) const noexcept {
      return to;
    }
  };
};

static_assert(normal_interpolation_for<turn_at_once, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
