// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The loop around a local model: what it has to keep to, and what it gets back from a tick.

#include <passive_haptics/event.hpp>
#include <passive_haptics/kernels.hpp>

namespace passive_haptics {
inline namespace v0 {

/// What the loop around the model keeps to. A guarantee holds while it does; a tick that does not
/// is reported.
template <class Space>
struct loop_limits {
  using scalar = typename Space::scalar;
  scalar longest_tick = scalar(0.001);  ///< T_max [s]: set it to the worst tick of YOUR loop
  scalar top_speed = scalar(100);       ///< faster than this is a sensor fault [m/s]

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(longest_tick > scalar(0)) || !kernels::is_finite(longest_tick)) {
      return {"longest_tick", longest_tick, "finite and > 0 s"};
    }
    if (!(top_speed > scalar(0)) || !kernels::is_finite(top_speed)) {
      return {"top_speed", top_speed, "finite and > 0 m/s"};
    }
    return {};
  }
};

/// All that a tick knows. Trivial to log.
template <class Space>
struct tick_result {
  typename Space::vector force;   ///< on the device [N]
  typename Space::scalar depth;   ///< penetration in the local model [m], 0 outside
  typename Space::scalar energy;  ///< E1 [J]
  event what = event::nominal;    ///< the worst that happened
  bool limited = false;           ///< the bound changed the desired force
};

}  // namespace v0
}  // namespace passive_haptics
