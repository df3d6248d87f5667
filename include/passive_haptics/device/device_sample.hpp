// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a device tells its loop.

#include <passive_haptics/base/language.hpp>

namespace passive_haptics {
inline namespace v0 {

/// What a device reports after holding an effort: where it is, how long the tick was, and the effort
/// it really held (saturated, rounded, gravity compensation taken out).
template <class Port>
struct device_sample {
  typename Port::stored_pose position{};  ///< [m]; joints: [rad]
  typename Port::stored_effort held{};    ///< [N]; joints: [N·m]
  typename Port::scalar dt{};             ///< [s]
  bool valid = false;                     ///< false: nothing was read, the rest says nothing
};

}  // namespace v0
}  // namespace passive_haptics
