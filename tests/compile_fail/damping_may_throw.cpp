// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the damping does not model damping_for
//
// dissipated() runs in the haptic loop and must say that it never throws.

#include <passive_haptics/energy_observer/reduced_energy.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif

struct mine : ph::isotropic_damping {
  template <class P>
  struct on : ph::isotropic_damping::on<P> {
    using ph::isotropic_damping::on<P>::on;
    constexpr float dissipated(float dx, float dt) const noexcept(quiet) { return dx * dx / dt; }
  };
};
using ledger = ph::basic_reduced_energy<mine>;
ph::part_at<ledger, scene> at_port(ledger{});
