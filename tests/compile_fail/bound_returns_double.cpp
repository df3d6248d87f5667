// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the bound does not model force_bound_for
//
// limit() must return the vector of the space: a double would drag soft-float into firmware.

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
struct mine : ph::no_bound<scene> {
  constexpr result limit(float desired, const auto& /*state*/) const noexcept { return desired; }
};

ph::local_model model{scene{},
                      ph::following<wall>{},
                      ph::snap<scene>{},
                      ph::spring<scene>{},
                      ph::reduced_energy<scene>{},
                      mine{}};
