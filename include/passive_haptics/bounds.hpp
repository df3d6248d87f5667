// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force bounds: how much of the desired force the ledger allows. The menu:
//
//   bounds/force_bounding.hpp
//     strict_bound      |f| ≤ √(4 B E1), every tick           passive, always; soft: ≤ 2b/T N/m
//     memoryless_bound  the same without a bank               no bursts, no drift
//     per_axis_bound    one ledger for each axis              axes that must not share energy
//   bounds/energy_bounding.hpp
//     energy_bounding, tight_energy_bounding                  EBA: a window around the last force
//   bounds/sector.hpp
//     sector_bound      the slope of the force                one axis; clockwise loops only
//   bounds/thesis.hpp
//     thesis_bound      the same, when leaving or on updates  stiff and quick; NOT passive
//   bounds/reachable.hpp
//     reachable_bound   the next tick's work ≤ E1             stiff and passive, where the mass and
//                                                             the largest hand force are known
//   bounds/late_reachable.hpp
//     late_reachable_bound  the same, commands a tick late    devices that talk in packets
//   bounds/energy_tank.hpp
//     energy_tank, two_layer_tank                             strict by the worst outflow, not by the
//                                                             predicted one
//   bounds/set_position.hpp
//     set_position_modulation  the jump of the surface        PSPM: for what moves; passive for
//                                                             K ≤ 2b/T, conditional
//   bounds/passivity_controller.hpp
//     series_passivity_controller, parallel_…                 PO/PC: transparent; NOT passive
//   bounds/augmentation.hpp
//     nonlinear_coupling, stiffness_increment,                stiffer as the bank allows
//     force_augmentation
//   bounds/limits.hpp
//     actuator_limit    |f| ≤ what the motors give            always, with motors
//     force_rate_limit  the surface moves at ≤ r/K m/s        no jumps at updates
//     no_bound          f = f*                                for comparison
//   bounds/chain.hpp
//     bound_chain       one after the other

#include <passive_haptics/bounds/augmentation.hpp>
#include <passive_haptics/bounds/chain.hpp>
#include <passive_haptics/bounds/energy_bounding.hpp>
#include <passive_haptics/bounds/energy_tank.hpp>
#include <passive_haptics/bounds/force_bounding.hpp>
#include <passive_haptics/bounds/late_reachable.hpp>
#include <passive_haptics/bounds/limits.hpp>
#include <passive_haptics/bounds/passivity_controller.hpp>
#include <passive_haptics/bounds/reachable.hpp>
#include <passive_haptics/bounds/sector.hpp>
#include <passive_haptics/bounds/set_position.hpp>
#include <passive_haptics/bounds/thesis.hpp>
