// SPDX-License-Identifier: BSD-3-Clause
// What windows.h leaves behind. Every header of the library is read with its macros in force, and two
// controllers are composed. The standard library, Eigen and libusb come first: they look after
// themselves. every_header.cmake writes the two lists.
#include "others.hpp"

#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define near
#define far
#define NEAR
#define FAR
#define small char
#define hyper long long
#define interface struct
#define pascal
#define cdecl
#define IN
#define OUT
#define OPTIONAL
#define CONST const
#define VOID void
#define TRUE 1
#define FALSE 0
#define STRICT 1
#define ERROR 0
#define NO_ERROR 0L
#define DELETE (0x00010000L)
#define ABSOLUTE 1
#define RELATIVE 2

#ifdef BARE  // the control: what no header may do
inline double farther(double near, double far) {
  return std::max(near, far);
}
#else
#include "ours.hpp"

namespace ph = passive_haptics;
using scene = ph::space<float, 3>;

float touched(const scene::vector& position) {
  static auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.03, .force_limit = 9.0, .longest_tick = 0.0011}, {.force = 5.0});
  touch.update({.point = {0, 0, 0}, .normal = {0, 0, 1}, .stiffness = 500});
  return touch.tick(position, ph::seconds{1e-3}).force.norm();
}

float guarded(float position, float wanted) {
  static auto port =
      ph::make_strict_guard<ph::space<float, 1>>({0.03}, ph::actuator_limit{9.0}, 0.0011);
  return port.tick(position, ph::seconds{1e-3}, wanted).force;
}
#endif

#if !defined(near) || !defined(far) || !defined(small) || !defined(interface) || !defined(IN)
#error a header has put an end to the macros
#endif
static_assert(min(1, 2) + max(1, 2) == 3);
