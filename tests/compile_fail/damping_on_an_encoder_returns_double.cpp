// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the damping does not model damping_for
//
// worst_outflow() must return the scalar of the port, not something that converts to it.

#include <passive_haptics/energy_observer/quantised_energy.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using number = float;
#else
using number = double;
#endif

struct mine : ph::isotropic_damping {
  template <class P>
  struct on : ph::isotropic_damping::on<P> {
    using ph::isotropic_damping::on<P>::on;
    constexpr number worst_outflow(float f, float T) const noexcept { return T * f * f; }
  };
};
using ledger = ph::basic_quantised_energy<mine>;
ph::part_at<ledger, scene> at_port(ledger{});
