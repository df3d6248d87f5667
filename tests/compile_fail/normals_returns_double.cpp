// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the normal interpolation does not model normal_interpolation_for
//
// step() must return the vector of the space, not something that converts to it.

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
using result = float;
#else
using result = double;
#endif
struct mine : ph::snap<scene> {
  constexpr result step(float /*from*/, float to, float /*dt*/) const noexcept { return to; }
};

ph::local_model model{scene{},
                      ph::following<wall>{},
                      mine{},
                      ph::spring<scene>{},
                      ph::reduced_energy<scene>{},
                      ph::strict_bound<scene>{}};
