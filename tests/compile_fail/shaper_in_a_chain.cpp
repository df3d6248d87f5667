// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this is a shaper, not a bound
//
// Shapers come first: behind a bound, a rate limit would hold a force that the ledger no longer covers.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/shaped.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>
#include <passive_haptics/shaper/force_rate_limit.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
ph::local_model model{scene{},
                      ph::followed<wall>{},
                      ph::turn_at_once{},
                      ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 100}},
                      ph::reduced_energy{},
                      ph::bound_chain{ph::strict_bound{}},
                      ph::loop_limits{}};
#else
ph::local_model model{scene{},
                      ph::followed<wall>{},
                      ph::turn_at_once{},
                      ph::spring{},
                      ph::reduced_energy{},
                      ph::bound_chain{ph::strict_bound{}, ph::force_rate_limit{.rate = 100}},
                      ph::loop_limits{}};
#endif
