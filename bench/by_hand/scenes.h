/* SPDX-License-Identifier: BSD-3-Clause */
/* Seven ticks written by hand, the yardstick for what composing costs: plain functions on plain
   numbers, in what C11 and C++20 have in common, and nothing of the library. Each does what the scene
   of the same name does that is composed from it: the same parameters, set at run time, the same
   checks of every sample, the same order of operations, so the same bits (tests/experiments/cost.cpp,
   tests/firmware). What a scene has no use for is not in it.

     wall_trusted          1   a fixed wall          spring          strict_bound      every sample trusted
     wall_strict           1   a fixed wall          spring          strict_bound
     wall_reachable        1   a moving wall         damped spring   reachable_bound
     plane_strict          2   a moving half-space   spring          strict_bound      normals turn slowly
     plane_reachable       3   a moving half-space   damped spring   reachable_bound   normals turn slowly
     half_space_reachable  3   a fixed half-space    damped spring   reachable_bound
     triangle_thesis       3   a moving triangle     spring          thesis_rule       normals turn slowly

   It is one text for both scalars: in_float.h and in_double.h say what a `real` is. Units: m, N, J,
   s, kg. */

#include "numbers.h"
/* numbers first */
#include "vectors.h"
/* then what is made of them */
#include "half_space_reachable.h"
#include "plane_reachable.h"
#include "plane_strict.h"
#include "triangle_thesis.h"
#include "wall_reachable.h"
#include "wall_strict.h"
#include "wall_trusted.h"
