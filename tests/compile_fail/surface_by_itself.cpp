// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: a surface by itself brings no news
//
// Who owns a surface, and whether it ever moves, is for the program to say.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

constexpr ph::half_space<scene> wall{0, 1, 1000};

#ifdef POSITIVE_CONTROL
ph::local_model model{scene{},          ph::fixed{wall},      ph::turn_at_once{},
                      ph::spring{},     ph::reduced_energy{}, ph::strict_bound{},
                      ph::loop_limits{}};
#else
ph::local_model model{scene{},
                      wall,
                      ph::turn_at_once{},
                      ph::spring{},
                      ph::reduced_energy{},
                      ph::strict_bound{},
                      ph::loop_limits{}};
#endif
