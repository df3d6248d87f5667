// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this damping credits dry friction, but does not say what of it is elastic
//
// A damping of one's own that counts on friction must answer what a ledger asks of it.

#include <passive_haptics/energy_observer/dual_ledger.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

struct mine : ph::isotropic_damping {
  template <class P>
  struct on : ph::isotropic_damping::on<P> {
    using ph::isotropic_damping::on<P>::on;
#ifndef POSITIVE_CONTROL
    static constexpr bool rubs = true;
#endif
  };
};
using ledger = ph::basic_dual_ledger<mine>;
ph::part_at<ledger, scene> at_port(ledger{});
