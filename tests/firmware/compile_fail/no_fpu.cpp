// SPDX-License-Identifier: BSD-3-Clause
// A core without an FPU. The header itself compiles there, and space computes in software.
// EXPECT: this build uses no FPU
// FLAGS: -mcpu=cortex-m3
// CONTROL: -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
#include <passive_haptics/firmware.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
ph::space<float, 1>::vector x{};
#else
ph::hardware_space<float, 1>::vector x{};
#endif
