// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force bounds: how much of the desired force the ledger allows. The menu:
//
//   bounds/force_bounding.hpp
//     strict_bound      |f| ≤ √(4 B E1), every tick           passive, always; soft: ≤ 2b/T N/m
//   bounds/thesis.hpp
//     thesis_bound      the same, when leaving or on updates  stiff and quick; NOT passive
//   bounds/reachable.hpp
//     reachable_bound   the next tick's work ≤ E1             stiff and passive, where the mass and
//                                                             the largest hand force are known
//   bounds/limits.hpp
//     actuator_limit    |f| ≤ what the motors give            always, with motors
//     force_rate_limit  the surface moves at ≤ r/K m/s        no jumps at updates
//     no_bound          f = f*                                for comparison
//   bounds/chain.hpp
//     bound_chain       one after the other

#include <passive_haptics/bounds/chain.hpp>
#include <passive_haptics/bounds/force_bounding.hpp>
#include <passive_haptics/bounds/limits.hpp>
#include <passive_haptics/bounds/reachable.hpp>
#include <passive_haptics/bounds/thesis.hpp>
