// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the scenes of sizes.cmake with one degree of freedom share: a knob, as its facts state it, in float.

#include <passive_haptics/firmware.hpp>
#include <passive_haptics/knob/detents.hpp>

namespace ph = passive_haptics;

using line = ph::hardware_space<float, 1>;  // rad, N·m
inline constexpr ph::exact_device motor{
    .mass = 5e-5, .damping = 1e-3, .force_limit = 0.2, .longest_tick = 1e-4, .rotary = true};
inline constexpr ph::trusted_hand fingers{{.force = 0.15}};
