// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The sample that a device returns in every tick.

#include <passive_haptics/base/language.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The state of a device at the end of a tick: its position, the length of the tick, and the effort that it
/// really held during it (saturated, rounded, without gravity compensation).
template <class Port>
struct device_sample {
  typename Port::stored_pose position{};  ///< x at the end of the tick [m]; joints: [rad]
  typename Port::stored_effort held{};    ///< the effort held during the tick [N]; joints: [N·m]
  typename Port::scalar dt{};             ///< the length of the tick [s]
  bool valid = false;                     ///< false if nothing was read; the rest is then undefined
};

}  // namespace v0
}  // namespace passive_haptics
