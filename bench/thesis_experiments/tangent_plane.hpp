// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "volume.hpp"
#include <passive_haptics/environment/deformable_body.hpp>

namespace experiments {

/// The plane that the local model gets from a contact.
inline ph::half_space<volume> tangent_plane(const env::surface_contact& contact) {
  return {contact.point, contact.normal, contact.stiffness};
}

}  // namespace experiments
