// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: constraints not satisfied.*P::work
//
// A port says what work an effort does over a motion: joules are what all promises are made of.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

struct mine : scene {
#ifndef POSITIVE_CONTROL
  static constexpr float work(float f, float dx) noexcept {
    return f * dx;
  }
#endif
};

template <class P>
using guard = ph::passive_port<P, ph::given_force, ph::reduced_energy, ph::strict_bound>;
guard<mine> device;
