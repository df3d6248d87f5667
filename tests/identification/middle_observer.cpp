// SPDX-License-Identifier: BSD-3-Clause
// middle_observer: where it takes a device to be that goes on, turns, chatters at an edge, rests, or is fast; and the
// wall of a wheel that is felt with it and a crossed ledger, compared with what there is otherwise.
#include "support/catch.hpp"
#include "support/half_told.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/contact/capped.hpp>
#include <passive_haptics/design/stiffness_budget.hpp>
#include <passive_haptics/identification/crossed_step.hpp>
#include <passive_haptics/identification/middle_observer.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>

#include <cmath>
#include <numbers>

namespace sim = ph::simulation;
namespace design = ph::design;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double q = 50e-6;

/// An axis whose encoder is moved step by step.
template <class P>
struct turned_by_hand {
  using scalar = typename P::scalar;
  ph::part_at<ph::middle_observer, P> seen{ph::middle_observer{.quantum = q}};
  int step = 100;
  bool known = false;

  double tick(int to, double dt = 1e-3) {
    const auto at = scalar(to) * scalar(q), way = scalar(to - step) * scalar(q);
    const auto now = seen.estimate(at, known ? way : scalar(0), scalar(0), scalar(dt), known);
    known = true;
    step = to;
    return static_cast<double>(now.position) / q;  // in steps
  }
  double wait(int ticks) {
    double at = 0.0;
    for (int i = 0; i < ticks; ++i) at = tick(step);
    return at;
  }
};

}  // namespace

TEMPLATE_TEST_CASE("middle_observer changes its position at edges only", "[observer][crossed]", d1,
                   f1) {
  const double about = sizeof(typename TestType::scalar) == 4 ? 1e-3 : 1e-9;
  turned_by_hand<TestType> axis;
  CHECK_THAT(axis.tick(100), WithinAbs(100.5, about));
  CHECK_THAT(axis.wait(10), WithinAbs(100.5, about));
  CHECK_THAT(axis.tick(101), WithinAbs(101.0, about));  // the first edge may be a turn
  CHECK_THAT(axis.wait(10), WithinAbs(101.0, about));
  CHECK_THAT(axis.tick(102), WithinAbs(102.5, about));  // it goes on
  CHECK_THAT(axis.wait(50), WithinAbs(102.5, about));
  SECTION("back by one edge and to and fro over it, the force stays") {
    for (int i = 0; i < 20; ++i) {
      CHECK_THAT(axis.tick(i % 2 == 0 ? 101 : 102), WithinAbs(102.0, about));
      CHECK_THAT(axis.wait(7), WithinAbs(102.0, about));
    }
  }
  SECTION("back by two edges it goes on") {
    axis.tick(101);
    axis.wait(10);
    CHECK_THAT(axis.tick(100), WithinAbs(100.5, about));
  }
  SECTION("after a turn it rests at the edge for a while, then in the middle") {
    axis.tick(101);
    CHECK_THAT(axis.wait(95), WithinAbs(102.0, about));
    CHECK_THAT(axis.wait(2000), WithinAbs(101.5, 1e-3));
  }
  SECTION("an edge in every other tick: as edge_observer") {
    ph::part_at<ph::edge_observer, TestType> other(ph::edge_observer{.quantum = q});
    using scalar = typename TestType::scalar;
    static_cast<void>(
        other.estimate(scalar(102) * scalar(q), scalar(0), scalar(0), scalar(1e-3), false));
    turned_by_hand<TestType> fast;
    fast.tick(102);
    for (int i = 1; i < 20; ++i) {
      const int now = 102 + i / 2, before = 102 + (i - 1) / 2;
      const double at = fast.tick(now);
      const auto expected = other.estimate(
          scalar(now) * scalar(q), scalar(now - before) * scalar(q), scalar(0), scalar(1e-3), true);
      if (i > 4) CHECK_THAT(at, WithinAbs(static_cast<double>(expected.position) / q, about));
    }
    CHECK_THAT(fast.wait(5), WithinAbs(fast.step + 0.5, about));
  }
  SECTION("after a lost sample it starts again in the middle") {
    axis.tick(101);
    axis.known = false;
    CHECK_THAT(axis.tick(90), WithinAbs(90.5, about));
  }
}

namespace {

using hand = sim::impedance_hand<d1>;
struct wheel {
  sim::device_preset is = sim::wheel_rotary.at_rim();
  double presliding = 5e-6;
  [[nodiscard]] design::stated_device stated() const { return half_told(is, presliding); }
};
struct felt {
  double least = 1.0;         ///< share of K in the worst second
  double least_energy = 0.0;  ///< [J]
};

/// A wall of stiffness K [N/m], kneaded with 1.1 ± 0.8 N once a second for 40 s, after an approach of 3 mm.
felt knead(const wheel& w, const auto& ledger, const auto& observer, double K, const hand& fingers,
           double offset) {
  const auto d = w.stated();
  ph::local_model wall{
      d1{},
      ph::followed<ph::half_space<d1>>{},
      ph::turn_at_once{},
      ph::capped{ph::eased{ph::damped_spring{.mass = d.mass, .force_limit = d.force_limit}}, K},
      ledger,
      ph::bound_chain{ph::reachable_bound{.mass = d.mass, .hand_force = 5.0 + w.is.friction},
                      ph::actuator_limit{.most = d.force_limit}},
      ph::loop_limits{.longest_tick = 1e-3},
      observer};
  const double surface = offset * d.quantum, start = surface - 3e-3;
  static_cast<void>(wall.update({surface, -1.0, K}));
  auto p = w.is.without_friction<d1>();
  p.start = start;
  sim::device<d1, hand, sim::slider_and_spring> device(p, fingers, w.is.friction_of(w.presliding));
  const double shown = ph::kernels::sampled_stiffness(K, 0.1, d.mass, 1e-3);
  const double per_newton = 1.0 / fingers.stiffness + 1.0 / shown;
  const double approach = (3e-3 + 1.1 * per_newton) / 10e-3, turns = 2.0 * std::numbers::pi;
  felt found;
  double force = 0.0, depth = 0.0;
  const auto lead = [&](const auto& now) {
    const double t = now.tick * 1e-3 - approach;
    const double goal = surface + (1.1 + 0.8 * std::sin(turns * t)) * per_newton;
    const double rate = 0.8 * turns * std::cos(turns * t) * per_newton;
    device.hand().aim(t < 0.0 ? start + 10e-6 * now.tick : goal, t < 0.0 ? 10e-3 : rate,
                      device.time());
  };
  const auto watch = [&](const auto& now) {
    const int tick = now.tick - static_cast<int>(approach * 1e3) - 1000;
    if (tick < 0) return true;
    force -= now.force;
    depth += std::max(0.0, now.position - surface);
    if ((tick + 1) % 1000 != 0) return true;
    found.least = std::min(found.least, depth > 0.0 ? force / depth / shown : 0.0);
    force = depth = 0.0;
    return found.least >= 0.8;
  };
  const int end = static_cast<int>(approach * 1e3) + 41000;
  found.least_energy = sim::run(device, wall, end, sim::idle, lead, watch).least_energy;
  return found;
}

/// The largest of the budget's stiffness times 1, 1.2, 1.44, … that is felt to 0.8, and the least energy of all runs.
double largest(const wheel& w, const auto& ledger, const auto& observer, double& least_energy) {
  const double budget = design::stiffness_budget(w.stated()).stiffness;
  double last = 0.0;
  for (double share = 1.0; share < 4.0; share *= 1.2) {
    for (const hand& fingers : {hand{.stiffness = 60.0, .damping = 2.0, .own_mass = 0.05},
                                hand{.stiffness = 1000.0, .damping = 15.0, .own_mass = 0.3}}) {
      const felt run = knead(w, ledger, observer, share * budget, fingers, 0.53);
      least_energy = std::min(least_energy, run.least_energy);
      if (run.least < 0.8) return last;
    }
    last = share;
  }
  return last;
}

}  // namespace

TEST_CASE("a wheel knows its steps where they are crossed, and lasts on a wall 1.5 times as stiff",
          "[observer][crossed][long]") {
  for (const double presliding : {5e-6, 15e-6}) {
    const wheel w{.presliding = presliding};
    const auto d = w.stated();
    const ph::damping_and_friction damping{d.damping, d.friction, d.presliding};
    const ph::crossed_ledger crossed{
        .damping = damping,
        .quantum = {.quantum = d.quantum, .mass = d.mass, .hand_force = 5.0 + w.is.friction}};
    double least_energy = 0.0;
    const double today = largest(w, ph::dual_ledger{.damping = damping, .quantum = d.quantum},
                                 ph::edge_observer{.quantum = d.quantum}, least_energy);
    const double ledger_alone =
        largest(w, crossed, ph::edge_observer{.quantum = d.quantum}, least_energy);
    const double both =
        largest(w, crossed, ph::middle_observer{.quantum = d.quantum}, least_energy);
    CAPTURE(presliding, today, ledger_alone, both);
    CHECK(today >= 1.0);
    CHECK(ledger_alone >= 1.2 * today);
    CHECK(both >= 1.5 * today);
    CHECK(least_energy >= 0.0);
  }
}
