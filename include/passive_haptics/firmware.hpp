// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// For firmware: the core without Eigen in one include, with make_touch and make_guard, and a space that compiles
// only if the FPU computes its scalar. knob/detents.hpp adds detents.
//
//   hardware_space<float, 1>   space<float, 1>; an error if the FPU does not compute floats
//   space<float, 1>            the same without that check, for cores that compute in software
//
// Two and three degrees of freedom need vectors: include device/eigen_space.hpp, too. docs/firmware.md has the
// flags, how to tick from an interrupt, and PlatformIO, Arduino, Zephyr and FreeRTOS.

#include <passive_haptics/base/exchange.hpp>
#include <passive_haptics/base/version.hpp>
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

namespace passive_haptics {
inline namespace v0 {

/// The FPU of the compiler's target: bit 2 is set for single and bit 3 for double precision, so the mask of a
/// scalar is its size in bytes. Compilers define it for 32-bit ARM (ACLE, __ARM_FP) and RISC-V (__riscv_flen);
/// every other target is assumed to have an FPU for every scalar.
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

/// The assertions apply only where `type` is used, so other builds need no FPU.
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

/// space<Scalar, Dof>, which compiles only if the FPU computes Scalar.
template <real Scalar, int Dof>
using hardware_space = typename target::checked<Scalar, Dof>::type;

}  // namespace v0
}  // namespace passive_haptics
