// SPDX-License-Identifier: BSD-3-Clause
// A haptic knob on a bare Cortex-M4F, whole: an end stop that the main loop moves 30 times a
// second, felt 10 000 times a second in a timer interrupt. Angles in rad, torques in N·m, so the
// library's newtons per metre are N·m per rad and its kilograms kg·m².

#include "board.hpp"
#include <passive_haptics/firmware.hpp>

namespace ph = passive_haptics;
using scene = ph::hardware_space<float, 1>;  // refuses to be computed in software
using stop = ph::half_space<scene>;

constexpr double inertia = 1e-5, damping = 1e-4;  // of the knob, lower bounds
constexpr double period = 1e-4;                   // s

// A constant expression: no code runs before run(), and the compiler checks the parameters, which
// are doubles, and turns them into the floats that the interrupt computes with.
// By hand: in 5 kB, with data that go stale; make_touch has a ledger that forgives besides.
constexpr ph::local_model at_rest{
    scene{},
    ph::followed<stop>{{.stale_after = 0.1, .fade = 0.05}},  // main loop dead: fade out
    ph::turn_at_once{},
    ph::damped_spring{.mass = inertia},
    ph::reduced_energy{.damping = damping},
    ph::bound_chain{ph::reachable_bound{.mass = inertia, .hand_force = 0.05},
                    ph::actuator_limit{.most = 0.1}},
    ph::loop_limits{.longest_tick = 1.1 * period, .top_speed = 500.0}};
static_assert(!at_rest.check());

static constinit auto knob = at_rest;
static ph::exchange<stop> inbox;  // main loop -> interrupt, wait-free

static struct {
  unsigned ticks, touching, faults;
  float largest_torque, least_energy;
} volatile journal;

// The tick. Everything it has to say about a bad sample or a dead main loop is in out.what.
extern "C" void SysTick_Handler() {
  if (const stop* news = inbox.take()) knob.update(*news);
  const auto out = knob.tick(board::angle(), ph::seconds{period});
  board::torque(out.force);

  journal.ticks = journal.ticks + 1;
  if (out.depth > 0) journal.touching = journal.touching + 1;
  if (out.what >= ph::event::rejected_sample) journal.faults = journal.faults + 1;
  if (out.force > journal.largest_torque) journal.largest_torque = out.force;
  if (out.energy < journal.least_energy) journal.least_energy = out.energy;
}

// A crash: motor off, then whatever the product does; here it tells the debugger and stops.
extern "C" [[noreturn]] void Fault_Handler() {
  board::torque(0.0F);
  board::say("fault\n");
  board::stop(1);
}

int run() {
  board::start_timer(10000);
  for (unsigned update = 0; journal.ticks < 10000; ++update) {  // one second
    const float angle = update % 2 == 0 ? 0.0F : -0.05F;
    inbox.publish({.point = angle, .normal = 1.0F, .stiffness = 2.0F});
    for (const unsigned until = (update + 1) * 333; journal.ticks < until;) board::sleep();
  }
  board::stop_timer();
  board::say("ticks", journal.ticks);
  board::say("of them touching the stop", journal.touching);
  board::say("faults", journal.faults);
  board::say("largest torque, mN·m", static_cast<unsigned>(journal.largest_torque * 1e3F));
  board::say(journal.least_energy < 0 ? "energy fell below zero\n" : "energy never below zero\n");
  return 0;
}
