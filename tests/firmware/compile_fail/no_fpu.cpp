// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: this build uses no FPU
// FLAGS: -mcpu=cortex-m3
// CONTROL: -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
#include <passive_haptics/firmware.hpp>

using scene = passive_haptics::hardware_space<float, 1>;
scene::vector x = scene::zero();
