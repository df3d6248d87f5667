// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: delete the guard against NaN
// FLAGS: -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard -ffast-math
// CONTROL: -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
#include <passive_haptics/firmware.hpp>

using scene = passive_haptics::hardware_space<float, 1>;
scene::vector x = scene::zero();
