// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the inertia does not model inertia_for
//
// norm() must return the scalar of the port, not something that converts to it.

#include <passive_haptics/force_bound/reachable_bound.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using number = float;
#else
using number = double;
#endif

struct mine : ph::isotropic_inertia {
  template <class P>
  struct on : ph::isotropic_inertia::on<P> {
    using ph::isotropic_inertia::on<P>::on;
    constexpr number norm(float f) const noexcept { return f; }
  };
};
using bound = ph::basic_reachable_work_bound<mine>;
ph::part_at<bound, scene> at_port(bound{});
