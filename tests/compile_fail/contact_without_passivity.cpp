// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the contact law does not model contact_law_for
//
// Every policy states what it promises; a model promises the least of its parts.

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

struct mine {
#ifdef POSITIVE_CONTROL
  static constexpr ph::guarantee passivity = ph::guarantee::none;
#endif
  constexpr void adopt(float /*K*/, float /*T*/) noexcept {}
  constexpr float force(float depth, float /*speed*/) const noexcept {
    return depth;
  }
  constexpr float depth(float force, float /*speed*/) const noexcept {
    return force;
  }
  constexpr ph::parameter_fault<float> check() const noexcept {
    return {};
  }
};

ph::local_model model{scene{}, ph::following<wall>{},       ph::snap<scene>{},
                      mine{},  ph::reduced_energy<scene>{}, ph::strict_bound<scene>{}};
