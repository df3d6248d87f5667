// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the observer does not model energy_observer_for
//
// value() must return the scalar of the space, not something that converts to it.

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
struct mine : ph::no_observer<scene> {
  constexpr result value() const noexcept { return 0; }
};

ph::local_model model{scene{}, ph::following<wall>{}, ph::snap<scene>{}, ph::spring<scene>{},
                      mine{},  ph::no_bound<scene>{}};
