// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Controllers of other authors, for comparison. They compose like any part of the core and need no Eigen.
//
//   force bounds: energy_bounding, tight_energy_bounding, sector_bound, energy_tank, predicting_tank,
//                 two_layer_tank, series_passivity_controller, series_controller_with_damping
//   shapers:      nonlinear_coupling, stiffness_increment, force_augmentation, set_position_modulation,
//                 published_set_position_modulation, reference_energy, reference_energy_with_damping
//   admittance:   parallel_passivity_controller, beside a port
//
// The guarantee of each is in its type. `cmake --workflow --preset controllers` compares their stiffness and cost.

#include <passive_haptics/published/energy_bounding.hpp>
#include <passive_haptics/published/energy_tank.hpp>
#include <passive_haptics/published/parallel_passivity_controller.hpp>
#include <passive_haptics/published/passivity_controller.hpp>
#include <passive_haptics/published/reference_energy.hpp>
#include <passive_haptics/published/sector_bound.hpp>
#include <passive_haptics/published/set_position_modulation.hpp>
#include <passive_haptics/published/stiffness_augmentation.hpp>
