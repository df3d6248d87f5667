// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the shaper does not model shaper_for
//
// shape() runs in the haptic loop and must say that it never throws.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/shaped.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif

struct mine {
  static constexpr bool needs_local_model = false;
  static constexpr bool needs_ledger = false;
  template <class Space>
  struct on {
    constexpr explicit on(const mine& /*p*/) noexcept {}
    constexpr ph::share<float> shape(float /*desired*/, const auto& /*contact*/,
                                     const auto& /*port*/) const noexcept(quiet) {
      return {1};
    }
  };
};

ph::local_model model{scene{},
                      ph::followed<wall>{},
                      ph::turn_at_once{},
                      ph::shaped{ph::spring{}, mine{}},
                      ph::reduced_energy{},
                      ph::strict_bound{},
                      ph::loop_limits{}};
