// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// reported_work<P>: the port P of a device whose driver reports the work of its motors.
//
// Motors hold torques τ [N·m] in their joints, which is no constant force f at the handle, so f·Δx is not the motors'
// work. τ·Δq [J] is that work for any mechanism and any path (lemma J, docs/design/six_dof.md). So the driver sums
// it, and the ledger books
//     E1 += Δxᵀ(b/dt)Δx − work
//
//     using device = ph::reported_work<ph::space<double, 3>>;
//     port.tick({.position = x, .held = f, .dt = dt, .valid = true, .work = tau.dot(q - q_last)}, wanted);
//
// strict_bound keeps its guarantee. Bounds that read the motion do not compile here: memoryless_bound and
// reachable_bound would use f·Δx as the work, and the reach along a curve is longer than along its tangent.

#include <passive_haptics/device/device_sample.hpp>
#include <passive_haptics/device/space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The port P, with a field `work` in its samples. Models port.
template <class P>
struct reported_work : P {
  static constexpr bool reports_work = true;
  static constexpr bool turns = false;  ///< the work is known for any path
};

/// The sample of such a device.
template <class P>
struct device_sample<reported_work<P>> {
  typename P::stored_pose position{};  ///< x at the end of the tick [m]
  typename P::stored_effort held{};    ///< J⁻ᵀτ of the torques held during the tick [N]
  typename P::scalar dt{};             ///< the length of the tick [s]
  bool valid = false;                  ///< false if nothing was read; the rest is then undefined
  typename P::scalar work{};           ///< Σ τ·Δq of the motors since the last sample [J]
};

}  // namespace v0
}  // namespace passive_haptics
