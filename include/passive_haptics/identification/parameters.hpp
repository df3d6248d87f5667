// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The limits of force [N] and motion [m] of a device while it is identified.

#include <passive_haptics/identification/trust.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// In metres and newtons; a joint is identified in radians and newton metres.
struct identification_parameters {
  double force = 3.0;  ///< largest force that is ever commanded, either way [N]
  double stroke =
      8e-3;  ///< how far it swings to either side of its start [m]; a longer one is more accurate
  double workspace =
      40e-3;  ///< distance from its start [m], beyond which the force is zero for good
  double sweep_time = 8.0;  ///< time of the swing for mass, damping, friction and latency [s]
  double shake_time = 6.0;  ///< time of the motion that shows what is wrong [s]
  double cross_time = 4.0;  ///< time of the slow motion that shows what is fine along the way [s]
  double friction_time = 37.0;    ///< time of the ramps and of the cycles below break-away [s]
  int places = 8;                 ///< most places where it is pushed until it slips
  int creep_cycles = 150;         ///< most cycles of a force below break-away, at each level tried
  identification::trust trust{};  ///< margins from the estimates to the bounds

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!passive_haptics::detail::positive(force)) return {"force", force, "finite and > 0 N"};
    if (!passive_haptics::detail::positive(stroke)) return {"stroke", stroke, "finite and > 0 m"};
    if (!(workspace >= 2.0 * stroke) || !kernels::is_finite(workspace)) {
      return {"workspace", workspace, "finite and ≥ 2 strokes"};
    }
    if (!(sweep_time >= 1.0 && sweep_time <= 600.0))
      return {"sweep_time", sweep_time, "1 to 600 s"};
    if (!(shake_time >= 1.0 && shake_time <= 600.0))
      return {"shake_time", shake_time, "1 to 600 s"};
    if (!(cross_time >= 0.0 && cross_time <= 600.0))
      return {"cross_time", cross_time, "0 to 600 s"};
    if (!(friction_time >= 10.0 && friction_time <= 600.0))
      return {"friction_time", friction_time, "10 to 600 s"};
    if (places < 2 || places > 16) return {"places", static_cast<double>(places), "2 to 16"};
    if (creep_cycles < 10 || creep_cycles > 10000) {
      return {"creep_cycles", static_cast<double>(creep_cycles), "10 to 10000"};
    }
    return trust.check();
  }
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
