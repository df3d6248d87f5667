// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the constraint does not model constraint_for
//
// A constraint crosses threads, so it is trivially copyable: no heap, no Eigen member.

#include <passive_haptics/bounds.hpp>
#include <passive_haptics/contact.hpp>
#include <passive_haptics/geometry.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normals.hpp>
#include <passive_haptics/observers.hpp>
#include <passive_haptics/supply.hpp>

#include <vector>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;
using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
using names = int;
#else
using names = std::vector<int>;
#endif
struct mine : wall {
  names touched_by{};
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
