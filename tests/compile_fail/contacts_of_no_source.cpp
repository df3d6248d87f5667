// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the source does not model source_for
//
// What is composed into contacts asks for force: a law alone knows no surface.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/contacts.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
ph::contacts all{ph::local_contact{ph::followed<wall>{}, ph::turn_at_once{}, ph::spring{}}};
#else
ph::contacts all{ph::spring{}};
#endif
ph::part_at<decltype(all), scene> at_port(all);
