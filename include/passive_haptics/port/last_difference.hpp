// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motion estimators: where the device is and how fast it moves, from what the encoders show.
//
//   last_difference   x̂ and Δx̂/dt                       the default; for fine encoders
//   mass_observer     a mass under the force held,       for encoders whose steps are felt; needs
//                     kept within the step shown         the mass; settles on ideal devices
//   edge_observer     surely known at the edges of a     for the same with dry friction, which it
//                     step, going on in between          spends least of
//
// Geometry and contact law look at the estimate. Ledger and bound never do: they count what was
// measured, so no estimate, however wrong, costs the guarantee.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The position shown, and the speed between the last two.
struct last_difference {
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <port P>
  class on {
   public:
    using scalar = typename P::scalar;
    using pose = typename P::pose;
    using motion = typename P::motion;

    struct seen {
      const pose& position;  ///< [m]
      const motion& travel;  ///< [m]
      scalar dt;             ///< [s]
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
