// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: detents have one degree of freedom
//
// A knob or a slider has one place along its way; what has more is made of surfaces.

#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/knob/detents.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr int dof = 1;
#else
constexpr int dof = 2;
#endif
auto knob = ph::make_detents<ph::space<float, dof>>(
    ph::exact_device{.mass = 0.1, .damping = 0.03, .force_limit = 9.0}, ph::known_hand{5.0},
    {.pitch = 0.01, .stiffness = 100.0});
