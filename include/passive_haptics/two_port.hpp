// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two-port time-domain passivity approach: a hand and an environment that must BOTH be
// protected, joined by a channel that delays, loses, duplicates and reorders. The menu:
//
//   two_port/packet.hpp
//     port_packet      {E_in, payload, number}       what crosses the channel, either way
//   two_port/energy.hpp
//     two_port_energy  E1 = D + E_in_rx − E_out      energy observer of the device port
//   two_port/impedance_side.hpp
//     impedance_side   observer + bound, 1 kHz       displays a force that came over the channel
//   two_port/series_controller.hpp
//     two_port_series_controller   f' = f − α v      the published form; NOT passive when sampled
//   two_port/admittance_side.hpp
//     admittance_side  v' = v − β f, drift paid      moves the tool in the environment
//
//           hand                                                  environment
//             │ Δx, f_held                              f(k), Δp'(k) │
//      ┌──────┴────────┐   {E_in, x} ──▶  channel  ──▶   ┌───────────┴─────┐
//      │ impedance side │                                │ admittance side │
//      └───────────────┘   ◀── channel  ◀── {E_in, f}    └─────────────────┘
//
// Each side keeps one ledger, E1 ≥ 0 at all times, and the sum S [J] of all energy that it has
// promised to the other. With R the largest promise that has arrived and L its initial loan:
//     device:       ∫ b v² dt − Σ f_held·Δx  ≥  E1 + S_d − R_d − L_d
//     environment:             Σ f·Δp'       ≥  E1 + S_e − R_e − L_e
// A promise that arrives was made before and S never falls: R_e ≤ S_d and R_d ≤ S_e whatever the
// channel does. So the sum of both ports is ≥ −(L_d + L_e) for any delay, jitter, loss, duplication
// and reordering. (docs/design/mathematics.md § 2(d); lemmas L1 and L3 keep E1 ≥ 0.)
//
// Published form: Ryu, Artigas, Preusche (2010) and Artigas, Ryu, Preusche, Hirzinger (IROS 2011),
// from memory. The ledgers, the bound before the hold and the share are derived here.
//
// The assumptions are those of the device's bound (b is a lower bound, positions are exact, ticks last up to
// longest_tick or a watchdog drops the force then) and of admittance_side. Both sides have to start together,
// because one that restarts alone could spend the same energy again.

#include <passive_haptics/two_port/admittance_side.hpp>
#include <passive_haptics/two_port/energy.hpp>
#include <passive_haptics/two_port/impedance_side.hpp>
#include <passive_haptics/two_port/packet.hpp>
#include <passive_haptics/two_port/series_controller.hpp>
