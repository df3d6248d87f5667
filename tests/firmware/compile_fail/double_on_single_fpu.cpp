// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: the FPU of this core does not compute this scalar
// FLAGS: -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
// CONTROL: -mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard
#include <passive_haptics/firmware.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
ph::hardware_space<float, 1>::vector x{};
#else
ph::hardware_space<double, 1>::vector x{};
#endif
