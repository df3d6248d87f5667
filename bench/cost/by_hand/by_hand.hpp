// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Three ticks written by hand, the yardstick for what composing costs: plain functions on plain
// scalars, no template, nothing of the library but the names of its events. Each does what the scene
// of the same name in ../scenes.hpp does: the same parameters, to be set at run time, the same checks
// of every sample, the same bits out (tests/cost.cpp). What its scene has no use for is not in it.
//
//   wall.inc         1 DOF, rigid half-space, spring, strict bound
//   half_space.inc   3 DOF, rigid half-space, damped spring, reachable bound
//   triangle.inc     3 DOF, the tick of the thesis: a triangle that follows the environment, normals
//                    that turn at a limited rate, spring, thesis_bound
//
// The same text twice, for float and for double.

#include <passive_haptics/event.hpp>

#include <cmath>
#include <limits>

namespace by_hand {

using passive_haptics::event;
using passive_haptics::worse;

namespace in_float {
using real = float;
#include "numbers.inc"
//
#include "half_space.inc"
#include "triangle.inc"
#include "wall.inc"
}  // namespace in_float

namespace in_double {
using real = double;
#include "numbers.inc"
//
#include "half_space.inc"
#include "triangle.inc"
#include "wall.inc"
}  // namespace in_double

}  // namespace by_hand
