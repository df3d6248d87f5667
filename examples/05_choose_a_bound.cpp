// SPDX-License-Identifier: BSD-3-Clause
// Choosing a force bound: one motion, five bounds, and the energy each one lets the hand gain.
//
// The motion is the worst there is for a sampled wall: enter by δ in one tick, leave in the next,
// a hundred times. Coming in nothing is held yet, so E1 grows by Bδ²; going out the full Kδ is held
// and E1 changes by Bδ² − Kδ². Per cycle that is −(K − 2B)δ² = −9.94 mJ, and
//   no bound    loses that much every time;
//   thesis      as well: it exempts the way in, and there the force is fixed;
//   reachable   as well, IF the hand is stronger than it was told: to turn 0.1 kg from −1 to +1 m/s
//               within 1 ms takes some 200 N. Told so, it loses nothing;
//   strict      needs to be told nothing of the hand, and loses nothing.
// The price of the promise is the force: what the two safe ones show is all this motion pays for.
//
// A device that talks in packets holds each command a tick late. No bound can know that unless its
// loop says so: late_loop_limits<1>. The last two rows go in for four ticks, and out for four.

#include <passive_haptics/passive_haptics.hpp>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

constexpr double damping = 0.03, dt = 1e-3, delta = 1e-3;  // b of the device [N·s/m], T [s], δ [m]
constexpr ph::loop_limits at_once{.longest_tick = dt};
constexpr ph::late_loop_limits<1> a_tick_late{.longest_tick = dt};

/// `told` is what the model knows of the loop, `late` by how many ticks it truly is late.
void attack(const char* name, const auto& law, const auto& bound, const auto& told, int late = 0) {
  const ph::half_space<scene> surface{.point = 0.0, .normal = 1.0, .stiffness = 1e4};
  const ph::reduced_energy ledger{.damping = damping};
  const ph::followed piece{surface};
  // By hand: one bound after the other.
  ph::local_model wall{scene{}, piece, ph::turn_at_once{}, law, ledger, bound, told};
  double x = 0.0, energy = 0.0, largest = 0.0;
  double next = wall.tick(x, ph::seconds{dt}).force, held = next;
  const int ticks = late == 0 ? 1 : 4;  // in, and as many out
  for (int tick = 0; tick < 200 * ticks; ++tick) {
    const double step = tick % (2 * ticks) < ticks ? -delta : delta;
    energy += damping / dt * step * step - held * step;  // counted from outside
    const double command = wall.tick(x += step, ph::seconds{dt}).force;
    held = late == 0 ? command : std::exchange(next, command);
    largest = std::max(largest, command);
  }
  const double lost = std::max(0.0, -energy) / 100.0;
  std::printf("%-22s %6.3f mJ lost a cycle, largest force %5.2f N\n", name, lost * 1e3, largest);
}

int main() {
  attack("no bound", ph::spring{}, ph::no_bound{}, at_once);
  attack("thesis", ph::shaped{ph::spring{}, ph::thesis_rule{}}, ph::no_bound{}, at_once);
  const ph::reachable_bound weak{.mass = 0.1, .hand_force = 5.0};
  const ph::reachable_bound strong{.mass = 0.1, .hand_force = 250.0};
  attack("reachable, hand 5 N", ph::spring{}, weak, at_once);
  attack("reachable, hand 250 N", ph::spring{}, strong, at_once);
  attack("strict", ph::spring{}, ph::strict_bound{}, at_once);
  attack("strict, late, untold", ph::spring{}, ph::strict_bound{}, at_once, 1);
  attack("strict, late, told", ph::spring{}, ph::strict_bound{}, a_tick_late, 1);
}
