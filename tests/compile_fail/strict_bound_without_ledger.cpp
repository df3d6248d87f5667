// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this bound spends energy that no_observer does not count
//
// A bound that spends energy needs an observer that counts it.

#include <passive_haptics/bounds.hpp>
#include <passive_haptics/contact.hpp>
#include <passive_haptics/geometry.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normals.hpp>
#include <passive_haptics/observers.hpp>
#include <passive_haptics/supply.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;
using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
using observer = ph::reduced_energy<scene>;
#else
using observer = ph::no_observer<scene>;
#endif
ph::local_model model{scene{},    ph::following<wall>{},    ph::snap<scene>{}, ph::spring<scene>{},
                      observer{}, ph::strict_bound<scene>{}};
