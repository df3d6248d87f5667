// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// reported_work<P>: the port P of a device whose driver reports what its motors did.
//
// Motors hold torques in their joints, which is no constant force f at the handle: f·Δx is another work than the
// motors did. The work τ·Δq is exact for any mechanism and any path (lemma J, docs/design/six_dof.md). So the
// driver adds it up, and the ledger books
//     E1 += Δxᵀ(b/dt)Δx − work
//
//     using device = ph::reported_work<ph::space<double, 3>>;
//     port.tick({.position = x, .held = f, .dt = dt, .valid = true, .work = tau.dot(q - q_last)}, wanted);
//
// strict_bound keeps its promise. What reads the motion beside the ledger is refused: memoryless_bound and
// reachable_bound would take f·Δx for the work, and the reach along a curve is longer than along its tangent.

#include <passive_haptics/device/device_sample.hpp>
#include <passive_haptics/device/space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// P with a field `work` in its samples, and no other difference. Models port.
template <class P>
struct reported_work : P {
  static constexpr bool reports_work = true;
  static constexpr bool turns = false;  ///< the work of the path is known, whatever the path
};

/// The sample of such a device.
template <class P>
struct device_sample<reported_work<P>> {
  typename P::stored_pose position{};  ///< [m]
  typename P::stored_effort held{};    ///< [N], the effort that J⁻ᵀ makes of the torques held
  typename P::scalar dt{};             ///< [s]
  bool valid = false;                  ///< false: nothing was read, the rest says nothing
  typename P::scalar work{};           ///< Σ τ·Δq of the motors since the last sample [J]
};

}  // namespace v0
}  // namespace passive_haptics
