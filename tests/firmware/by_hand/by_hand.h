/* SPDX-License-Identifier: BSD-3-Clause */
/* The ticks of bench/by_hand as C compiles them for the target, a function of its own each, so that
   their bytes can be counted. */
#ifndef PASSIVE_HAPTICS_FIRMWARE_BY_HAND_H
#define PASSIVE_HAPTICS_FIRMWARE_BY_HAND_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#ifdef FIRMWARE_DOUBLE
#include "../../../bench/by_hand/in_double.h"
#else
#include "../../../bench/by_hand/in_float.h"
#endif

#ifdef __cplusplus
extern "C" {
#endif

struct answer1 by_hand_wall_trusted_tick(struct wall_trusted* w, real x, real dt);
struct answer1 by_hand_wall_strict_tick(struct wall_strict* w, real x, real dt);
struct answer1 by_hand_wall_reachable_tick(struct wall_reachable* w, real x, real dt);
struct answer2 by_hand_plane_strict_tick(struct plane_strict* w, const vec2* x, real dt);
struct answer3 by_hand_plane_reachable_tick(struct plane_reachable* w, const vec3* x, real dt);
struct answer3 by_hand_triangle_thesis_tick(struct triangle_thesis* w, const vec3* x, real dt);

#ifdef __cplusplus
}
#endif
#endif
