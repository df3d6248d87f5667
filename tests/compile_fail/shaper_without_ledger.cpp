// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this shaper spends energy that no_observer does not count
//
// A shaper that spends what the ledger has needs an observer that counts it.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>
#include <passive_haptics/published/stiffness_augmentation.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
using observer = ph::reduced_energy;
#else
using observer = ph::no_observer;
#endif

ph::local_model model{scene{},
                      ph::followed<wall>{},
                      ph::turn_at_once{},
                      ph::shaped{ph::spring{}, ph::stiffness_increment{}},
                      observer{},
                      ph::no_bound{},
                      ph::loop_limits{}};
