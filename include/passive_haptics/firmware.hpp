// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// For firmware: the core without Eigen in one include, make_touch and make_guard among it, and a space that
// insists on its FPU. Detents: knob.hpp beside it.
//
//   hardware_space<float, 1>   space<float, 1>, if the FPU computes floats
//   space<float, 1>            the same without that question: for cores that compute in software
//
// Two and three degrees of freedom need vectors: include device/eigen_space.hpp, too. The flags to use,
// how to tick from an interrupt, PlatformIO, Arduino, Zephyr and FreeRTOS: docs/firmware.md.

#include <passive_haptics/base/exchange.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/contact/contacts.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/contact/virtual_coupling.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/energy_observer/quantised_energy.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>
#include <passive_haptics/shaper/force_rate_limit.hpp>
#include <passive_haptics/shaper/thesis_rule.hpp>
#include <passive_haptics/version.hpp>

namespace passive_haptics {
inline namespace v0 {

/// What the compiler tells of the FPU of its target: bit 2 is set for single and bit 3 for double
/// precision, so the mask of a scalar is its size in bytes. 32-bit ARM tells it (ACLE, __ARM_FP), and so
/// does RISC-V (__riscv_flen); every other target is taken to have an FPU for every scalar.
namespace target {

#if defined(__ARM_FP)
inline constexpr unsigned fpu = __ARM_FP;
#elif defined(__riscv_flen)
inline constexpr unsigned fpu = __riscv_flen >= 64 ? 4 + 8 : 4;
#elif defined(__arm__) || defined(__riscv)
inline constexpr unsigned fpu = 0;
#else
inline constexpr unsigned fpu = ~0U;
#endif

/// Its sentences are asserted only where `type` is asked for, so other builds may be without an FPU.
template <real Scalar, int Dof, unsigned Fpu = fpu>
struct checked {
  static_assert(Fpu != 0,
                "passive_haptics: firmware: this build uses no FPU: set -mfpu and "
                "-mfloat-abi=hard, or write space instead of hardware_space for soft float");
  static_assert(Fpu == 0 || (Fpu & sizeof(Scalar)) != 0,
                "passive_haptics: firmware: the FPU of this core does not compute this scalar: use "
                "float, or write space instead of hardware_space for soft float");
  using type = space<Scalar, Dof>;
};

}  // namespace target

/// space<Scalar, Dof>, computed in hardware or not at all.
template <real Scalar, int Dof>
using hardware_space = typename target::checked<Scalar, Dof>::type;

}  // namespace v0
}  // namespace passive_haptics
