// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the constraint does not model constraint_for
//
// depth() must return the scalar of the space, not something that converts to it.

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
struct mine : wall {
  constexpr result depth(float x) const noexcept { return x; }
  constexpr mine toward(const mine& target, float /*x*/, float /*n*/, float /*d*/) const noexcept {
    return target;
  }
};

ph::local_model model{scene{},
                      ph::following<mine>{},
                      ph::snap<scene>{},
                      ph::spring<scene>{},
                      ph::reduced_energy<scene>{},
                      ph::strict_bound<scene>{}};
