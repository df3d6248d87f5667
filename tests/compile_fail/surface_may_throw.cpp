// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the surface does not model surface_for
//
// at() of a surface runs in the haptic loop and must say that it never throws.

#include <passive_haptics/contact/contact_set.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif

struct mine {
  float stiffness = 100.0F;
  struct probe {
    float depth;
    constexpr float outward() const noexcept { return 1; }
    constexpr bool covered() const noexcept { return true; }
  };
  constexpr bool prepare() noexcept { return true; }
  constexpr probe at(const float& x) const noexcept(quiet) { return {-x}; }
};

ph::contact_set set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<mine, 1>{}};
ph::part_at<decltype(set), scene> one(set);
