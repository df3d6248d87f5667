// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Dry friction that is elastic before it slips.
// Real friction first gives way by a presliding displacement p of some micrometres, like a spring, and hands the
// stored energy back. A controller that credits c|Δx| [J] for motions within p credits energy that was not lost.
//
//     sim::device<scene, sim::no_hand<scene>, sim::slider_and_spring> touch{{.mass = 0.045}, {},
//                                            {.level = {0.26}, .presliding = {15e-6}}};
//
//   coulomb_friction     rigid, with c = device_parameters::friction [N]: the default, and exact
//   friction_elastic.hpp: these keep the points of reversal in their state, and claim() c and p
//     slider_and_spring    a spring c/p in series with a slider c (Prandtl, elasto-plastic)
//     maxwell_slip<n>      n of them side by side (Iwan; Al-Bender and others, 2005)
//     dupont_friction      one bristle that begins to creep at a share of p (Dupont and others, 2002)
//     stribeck_friction    static and kinetic level, and a level that ripples along the way
//   friction_bristle.hpp: these have no memory of reversals, and claim nothing: under a dither of 2 a forward, a back
//   they take as little as c/3 [J] for each metre gained
//     dahl_friction        dF/dx = (c/p) (1 − (F/c) sgn ẋ)                       (Dahl, 1968)
//     lugre_friction       the same with a Stribeck curve and a bristle damper   (Canudas and others, 1995)
//   friction_axis.hpp      moves a mass against them in short steps that lose no energy
//   friction_kind.hpp      any of them, chosen at run time, for a given c and p
//
// Each is a plain struct of numbers and acts on every axis by itself, as device_parameters::friction does.

#include <passive_haptics/simulation/friction_axis.hpp>
#include <passive_haptics/simulation/friction_bristle.hpp>
#include <passive_haptics/simulation/friction_elastic.hpp>
#include <passive_haptics/simulation/friction_kind.hpp>
#include <passive_haptics/simulation/friction_model.hpp>
