// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motion estimators: position [m] and velocity [m/s] of the device from encoder positions.
//
//   last_difference   x̂ and Δx̂/dt                       the default; for fine encoders
//   mass_observer     a mass under the held force,       for coarse encoders; needs the mass;
//                     clamped to the measured step       settles without friction
//   edge_observer     exact at the edges of a step,      for coarse encoders with dry friction;
//                     extrapolated in between            costs the ledger least
//
// Geometry and contact law use the estimate. Ledger and bound never do: they use the measured
// motion, so no error of an estimate affects the guarantee.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The measured position x̂, and the velocity Δx̂/dt between the last two.
struct last_difference {
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <port P>
  class on {
   public:
    using scalar = typename P::scalar;
    using pose = typename P::pose;
    using motion = typename P::motion;

    struct seen {
      const pose& position;  ///< x̂ [m]
      const motion& travel;  ///< Δx̂ [m]
      scalar dt;             ///< length of the tick [s]
      /// Speed along a unit vector [m/s].
      [[nodiscard]] constexpr scalar along(const motion& n) const noexcept {
        return P::dot(travel, n) / dt;
      }
    };

    constexpr explicit on(const last_difference& /*p*/) noexcept {}
    [[nodiscard]] constexpr seen estimate(const pose& shown, const motion& travel,
                                          const typename P::effort& /*held*/, scalar dt,
                                          bool /*known*/) const noexcept {
      return {shown, travel, dt};
    }
  };
};

static_assert(motion_estimator_for<last_difference, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
