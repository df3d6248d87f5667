/* SPDX-License-Identifier: BSD-3-Clause */
/* The five scenes by hand: state, start, news from the environment, one tick. */
#ifndef PASSIVE_HAPTICS_BY_HAND_SCENES_H
#define PASSIVE_HAPTICS_BY_HAND_SCENES_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  real x, y;
} vec2;
typedef struct {
  real x, y, z;
} vec3;

struct answer1 {
  real force, depth, energy;
  uint8_t what;
  bool limited;
};
struct answer2 {
  vec2 force;
  real depth, energy;
  uint8_t what;
  bool limited;
};
struct answer3 {
  vec3 force;
  real depth, energy;
  uint8_t what;
  bool limited;
};

/* What every scene remembers of the device. */
struct device1 {
  real held, position, blind; /* blind: time that bad samples took */
  bool seen, sound;
};
struct device2 {
  vec2 held, position;
  real blind;
  bool seen, sound;
};
struct device3 {
  vec3 held, position;
  real blind;
  bool seen, sound;
};

/* What a surface that the environment moves remembers of it. */
struct news {
  struct freshness rule;
  real age, last_weight;
  bool published, changed, refused, together;
};

struct plane1 {
  real point, normal, stiffness;
};
struct plane2 {
  vec2 point, normal;
  real stiffness;
};
struct plane3 {
  vec3 point, normal;
  real stiffness;
};
struct triangle3 {
  vec3 a, b, c;
  real stiffness, thickness;
  vec3 normal;
};

struct wall_strict {
  struct plane1 wall;
  struct ledger ledger;
  struct loop loop;
  struct device1 device;
};
void by_hand_wall_strict_start(struct wall_strict* w, struct plane1 wall, real damping,
                               struct loop loop);
struct answer1 by_hand_wall_strict_tick(struct wall_strict* w, real x, real dt);

struct wall_reachable {
  struct news news;
  struct plane1 newest, own;
  struct damped_spring spring;
  struct ledger ledger;
  struct reach reach;
  struct loop loop;
  struct device1 device;
};
void by_hand_wall_reachable_start(struct wall_reachable* w, struct freshness rule, real damping,
                                  struct reach reach, struct loop loop);
bool by_hand_wall_reachable_retarget(struct wall_reachable* w, struct plane1 next);
struct answer1 by_hand_wall_reachable_tick(struct wall_reachable* w, real x, real dt);

struct plane_strict {
  struct news news;
  struct plane2 newest, own;
  real rate;
  struct ledger ledger;
  struct loop loop;
  struct device2 device;
};
void by_hand_plane_strict_start(struct plane_strict* w, struct freshness rule, real rate,
                                real damping, struct loop loop);
bool by_hand_plane_strict_retarget(struct plane_strict* w, const struct plane2* next);
struct answer2 by_hand_plane_strict_tick(struct plane_strict* w, const vec2* x, real dt);

struct plane_reachable {
  struct news news;
  struct plane3 newest, own;
  real rate;
  struct damped_spring spring;
  struct ledger ledger;
  struct reach reach;
  struct loop loop;
  struct device3 device;
};
void by_hand_plane_reachable_start(struct plane_reachable* w, struct freshness rule, real rate,
                                   real damping, struct reach reach, struct loop loop);
bool by_hand_plane_reachable_retarget(struct plane_reachable* w, const struct plane3* next);
struct answer3 by_hand_plane_reachable_tick(struct plane_reachable* w, const vec3* x, real dt);

struct triangle_thesis {
  struct news news;
  struct triangle3 newest, own;
  real rate, stiffness;
  struct ledger ledger;
  struct loop loop;
  struct device3 device;
  bool beside; /* behind the surface, but outside its edges */
};
void by_hand_triangle_thesis_start(struct triangle_thesis* w, struct freshness rule, real rate,
                                   real damping, struct loop loop);
bool by_hand_triangle_thesis_retarget(struct triangle_thesis* w, const struct triangle3* next);
struct answer3 by_hand_triangle_thesis_tick(struct triangle_thesis* w, const vec3* x, real dt);

#ifdef __cplusplus
}
#endif
#endif
