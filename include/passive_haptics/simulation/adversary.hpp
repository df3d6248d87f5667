// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Adversaries: motions, hands and surfaces that try to draw energy out of a controller at its port.
// challenge.hpp exposes a model to all of them in one call; search.hpp tunes one for the largest loss. L and §
// refer to docs/design/mathematics.md, A to audit.md.
//
//   adversary_motions.hpp   velocity sources, for prescribed_motion: no force can stop them
//     nyquist_motion        in by δ, out by δ: gains (K − 2b/T) δ² [J] in two ticks on an unbounded wall (A5)
//     random_walk           any direction at any speed up to a limit, near the surface
//     greedy_motion         presses, then leaves by the worst Δx of the proof (L3)
//     rocking_motion        rocks across an encoder step for false credit, then is greedy (§ 3)
//     restless_motion       all of these in turn, and multiples of the worst Δx
//   adversary_encoders.hpp  motions smaller than the device can see or its friction resists
//     in_step_motion        in phase with the force, inside an encoder step or a presliding displacement
//     worst_step_motion     presses, then leaves by the cheapest of a dozen steps
//     dither_motion         2 a forward, a back, with a ≤ p, before a wall that it leaves as greedy_motion does
//   adversary_hands.hpp     force-limited, for the exact device
//     striking_hand         taps the surface, or pushes with the force that its caller sets
//   adversary_worlds.hpp    surfaces, clocks and sensors
//     jumping_surface       the surface moves by up to ±2 mm every 20-50 ms
//     switching_stiffness   K low, K high, K low, ... every 20-50 ms
//     erratic_surface       jumps, any normal (the opposite one too) and any stiffness, at random
//     erratic_clock         periods of 0.5 to 1 longest ticks, and overruns of 2 to 20
//     erratic_sensor        samples that never arrive, one or several in a row
//     noisy_sensor          positions with a bounded error, random or in phase with the force
//
//     motion.move_to(adversary.next({x, normal, depth, force, dt, b}, random));
//     sample = motion.exchange(force);

#include <passive_haptics/simulation/adversary_encoders.hpp>
#include <passive_haptics/simulation/adversary_hands.hpp>
#include <passive_haptics/simulation/adversary_motions.hpp>
#include <passive_haptics/simulation/adversary_worlds.hpp>
