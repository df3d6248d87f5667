// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this bound compares with a local model that can move
//
// A rigid wall keeps no second copy to compare with.

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
using supply = ph::following<wall>;
#else
using supply = ph::rigid<wall>;
#endif
ph::local_model model{scene{},
                      supply{},
                      ph::snap<scene>{},
                      ph::spring<scene>{},
                      ph::reduced_energy<scene>{},
                      ph::thesis_bound<scene>{}};
