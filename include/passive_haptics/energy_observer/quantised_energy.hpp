// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ledger for encoders with coarse steps, on a device whose dry friction is not stated.
//
//   quantised_energy   the least E1 that positions known to a step of q allow

#include <passive_haptics/energy_observer/dual_ledger.hpp>

namespace passive_haptics {
inline namespace v0 {

/// dual_ledger without friction, u = 0, which is summation by parts of Σ f·(e(k+1) − e(k)):
///     E1 ≥ Σ credit − Σ f_held·Δx̂ − q/2 (Σ ‖f(k) − f(k−1)‖₁ + ‖f_held‖₁)
/// A change of the force by 1 N costs 1 N · q/2 [J], so a hunting force empties this ledger, and it is empty at the
/// first touch. A loan helps there (A8), or dual_ledger if there is dry friction.
template <class Damping = isotropic_damping, ledger_sum Sum = ledger_sum::plain>
using basic_quantised_energy = basic_dual_ledger<Damping, encoder_step, Sum>;
using quantised_energy = basic_quantised_energy<>;

static_assert(energy_observer_for<quantised_energy, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
