// SPDX-License-Identifier: BSD-3-Clause
// A core with an FPU, and a build that forgot to use it.
// EXPECT: this build uses no FPU
// FLAGS: -mcpu=cortex-m4 -mfloat-abi=soft
// CONTROL: -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=softfp
#include <passive_haptics/firmware.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
ph::space<float, 1>::vector x{};
#else
ph::hardware_space<float, 1>::vector x{};
#endif
