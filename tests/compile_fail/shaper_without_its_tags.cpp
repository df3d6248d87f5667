// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the shaper does not model shaper_for
//
// A shaper says whether it spends what an observer must have counted, either way.

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

struct half {
  static constexpr bool needs_local_model = false;
#ifdef POSITIVE_CONTROL
  static constexpr bool needs_ledger = false;
#endif
  constexpr ph::share<float> shape(float /*desired*/, const auto& /*contact*/,
                                   const auto& /*port*/) const noexcept {
    return {0.5F};
  }
};

ph::local_model model{scene{},
                      ph::followed<ph::half_space<scene>>{},
                      ph::turn_at_once{},
                      ph::shaped{ph::spring{}, half{}},
                      ph::reduced_energy{},
                      ph::strict_bound{},
                      ph::loop_limits{}};
