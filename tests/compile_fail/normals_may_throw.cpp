// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the normal interpolation does not model normal_interpolation_for
//
// step() runs in the haptic loop and must say that it never throws.

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
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif
struct mine : ph::snap<scene> {
  constexpr float step(float /*from*/, float to, float /*dt*/) const noexcept(quiet) { return to; }
};

ph::local_model model{scene{},
                      ph::following<wall>{},
                      mine{},
                      ph::spring<scene>{},
                      ph::reduced_energy<scene>{},
                      ph::strict_bound<scene>{}};
