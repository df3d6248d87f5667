// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the bound does not model force_bound_for
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
  static constexpr ph::bound_traits traits{.only_reduces = true};
  constexpr float limit(float desired, const auto& /*state*/) const noexcept {
    return desired;
  }
  constexpr ph::parameter_fault<float> check() const noexcept {
    return {};
  }
};

ph::local_model model{scene{},
                      ph::following<wall>{},
                      ph::snap<scene>{},
                      ph::spring<scene>{},
                      ph::reduced_energy<scene>{},
                      mine{}};
