// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the observer does not model energy_observer_for
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
  static constexpr bool counts = true;
  ph::isotropic_damping<scene> damping{1};
  constexpr bool update(float /*dx*/, float /*held*/, float /*dt*/) noexcept {
    return true;
  }
  constexpr void forfeit(float /*held*/, float /*T*/) noexcept {}
  constexpr float value() const noexcept {
    return 0;
  }
  constexpr ph::parameter_fault<float> check() const noexcept {
    return {};
  }
};

ph::local_model model{scene{}, ph::following<wall>{}, ph::snap<scene>{}, ph::spring<scene>{},
                      mine{},  ph::no_bound<scene>{}};
