// SPDX-License-Identifier: BSD-3-Clause
// The adversaries that anyone can call: each must be able to hurt what is not bounded, and none may
// draw 1e-12 J from strict_bound while its assumptions hold. Where one of them is dropped, the loss
// must show. The judge is the true port energy. More of it is in full/simulation_challenge.cpp.
#include "attacks/challenged.hpp"

#include <algorithm>

using namespace simulated;

namespace {

/// Strict while on time; books a late tick as if the device had moved evenly and the watchdog had
/// dropped the force at its due instant.
struct even_mover {
  using space_type = d1;
  using constraint_type = ph::half_space<d1>;
  ph::part_at<ph::reduced_energy, d1> ledger = at<d1>(thesis_ledger());
  constraint_type wall{};
  double last = 0.0;
  bool update(constraint_type next) { return wall = next, wall.prepare(); }
  auto tick(const ph::device_sample<d1>& sample) {
    const double share = std::min(1.0, 1e-3 / sample.dt);
    ledger.update(sample.position - last, sample.held * share, sample.dt);
    last = sample.position;
    const double asked = wall.stiffness * std::max(0.0, wall.at(last).depth);
    return ph::tick_result<d1>{
        wall.normal * asked * ledger.damping().affordable(asked, ledger.value(), 1e-3), 0, 0};
  }
};

/// Does nothing with a lost sample, and so books the motion of two ticks with the second one's
/// force.
struct sleeper : std::remove_const_t<decltype(strict<d1>)> {
  using model = std::remove_const_t<decltype(strict<d1>)>;
  sleeper() : model(strict<d1>) {}
  ph::tick_result<d1> last{};
  auto tick(const ph::device_sample<d1>& sample) {
    if (sample.valid) last = model::tick(sample);
    return last;
  }
};

/// Commands 1 N to and fro.
struct shaker {
  using space_type = d1;
  using constraint_type = ph::half_space<d1>;
  double force = 1.0;
  bool update(const constraint_type& /*next*/) { return true; }
  auto tick(const ph::device_sample<d1>& /*sample*/) {
    return ph::tick_result<d1>{force = -force, 0, 0};
  }
};

}  // namespace

TEMPLATE_TEST_CASE("every adversary draws energy from an unbounded wall and none from strict_bound",
                   "[adversaries][law]", d1, d2, d3) {
  survives_all(strict<TestType>, {}, 40);
  for (const sim::verdict& v : sim::challenge_all(unbounded<TestType>, {}, 40)) {
    CAPTURE(to_string(v.by), v.least_energy);
    CHECK_FALSE(passes(v));
    CHECK(v.least_energy < -1e-3);
    CHECK(v.mean_energy < -1e-4);
    CHECK(v.mean_energy >= v.least_energy);
  }
}

TEST_CASE("jitter hurts a bound that was told too short a tick, and no other",
          "[adversaries][law]") {
  CHECK(passes(sim::challenge(strict<d1>, by::jitter, {}, 200)));
  const auto hopeful = model_of<d1>(
      ph::spring{}, ph::strict_bound{},
      ph::loop_limits{.longest_tick = 0.75e-3, .top_speed = 100.0});  // the mean period
  const sim::verdict v = sim::challenge(hopeful, by::jitter, {.watchdog = false}, 200);
  CHECK(v.least_energy < -1e-9);
}

TEST_CASE("strict_bound survives overruns behind a watchdog, and loses without one",
          "[adversaries][law]") {
  for (const by adversary : {by::overruns, by::kitchen_sink}) {
    CHECK(passes(sim::challenge(strict<d1>, adversary, {}, 300)));
    CHECK(passes(sim::challenge(strict<d3>, adversary, {}, 100)));
    const sim::verdict v = sim::challenge(strict<d1>, adversary, {.watchdog = false}, 100);
    CHECK(v.least_energy < -1e-4);
  }
  // the motion is free to happen before the watchdog acts
  CHECK(passes(sim::challenge(even_mover{}, by::greedy, {}, 100)));  // it is strict while on time
  CHECK(sim::challenge(even_mover{}, by::overruns, {}, 100).least_energy < -1e-5);
}

TEST_CASE("strict_bound with the right latency survives every adversary under latency",
          "[adversaries][law]") {
  survives_all(model_of<d1>(ph::spring{}, ph::strict_bound{}, late_loop<2>), {.latency = 2}, 20);
  survives_all(model_of<d2>(ph::spring{}, ph::strict_bound{}, late_loop<5>), {.latency = 5}, 10);
  for (const sim::verdict& v : sim::challenge_all(strict<d1>, {.latency = 2}, 20)) {
    CAPTURE(to_string(v.by), v.least_energy);
    CHECK(v.least_energy < -1e-9);
  }
}

TEST_CASE("news that are made up for smoothly draw nothing", "[adversaries][law]") {
  survives_all(model_of<d1>(ph::eased{ph::spring{}}, ph::strict_bound{}), {}, 20);
  survives_all(model_of<d3>(ph::eased{ph::spring{}}, ph::strict_bound{}), {}, 10);
  const sim::verdict v = sim::challenge(model_of<d1>(ph::eased{ph::spring{}}, ph::no_bound{}),
                                        by::jumping_surface, {}, 20);
  CHECK(v.least_energy < -1e-3);  // the control: it is the bound that promises
}

TEST_CASE("an adversary knows the force that will be held, whatever the latency", "[adversaries]") {
  for (const int latency : {0, 1, 2, 3}) {  // mistaken by a tick, it would pay instead
    CAPTURE(latency);
    const sim::verdict v = sim::challenge(shaker{}, by::greedy, {.latency = latency}, 4);
    CHECK(v.mean_energy < -0.05);
  }
}

TEST_CASE("quantised positions draw energy from strict_bound with the plain ledger (§ 3)",
          "[adversaries]") {
  const sim::circumstances coarse{.quantum = 60e-6};
  const sim::verdict tapped = sim::challenge(strict<d1>, by::nyquist, coarse, 100);
  CHECK(tapped.least_energy < -1e-4);  // some 0.3 mJ
  CHECK(tapped.least_energy > -1e-3);
  // rocking alone spends all the false credit there is, b q²/T a tick, and hardly ever fails to
  const sim::verdict rocked = sim::challenge(strict<d1>, by::rocking, coarse, 100);
  CHECK(rocked.least_energy < -6e-5);
  CHECK(rocked.least_energy > -600 * 30.0 * 60e-6 * 60e-6 * 1.1);
  CHECK(rocked.mean_energy < -3e-5);
  CHECK(sim::challenge(strict<d3>, by::rocking, coarse, 20).least_energy < -1e-4);  // three axes
  CHECK(passes(sim::challenge(strict<d1>, by::rocking, {}, 100)));  // the control: no quantum
}

TEST_CASE("dropouts draw energy from a loop that sleeps through them", "[adversaries][law]") {
  CHECK(sim::challenge(sleeper{}, by::dropouts, {}, 100).least_energy < -1e-6);
  CHECK(passes(sim::challenge(sleeper{}, by::greedy, {}, 100)));
  CHECK(passes(sim::challenge(strict<d1>, by::dropouts, {}, 300)));
}

TEST_CASE("a hand of limited force draws nothing from reachable_bound, unless it was misled",
          "[adversaries][law]") {
  const auto told = [](double mass, double force) {
    return model_of<d1>(ph::spring{}, ph::reachable_bound{.mass = mass, .hand_force = force});
  };
  for (const by adversary : {by::tapping, by::random_tapping}) {
    CAPTURE(to_string(adversary));
    CHECK(passes(sim::challenge(told(0.1, 5.0), adversary, {}, 15)));
    CHECK(sim::challenge(told(1.0, 0.0), adversary, {}, 15).least_energy < -1e-6);
  }
  CHECK(sim::challenge(told(0.1, 5.0), by::nyquist, {}, 10).least_energy < -1e-2);
}

TEST_CASE("a bound that counts on dry friction survives where there is some, and only there",
          "[adversaries][law]") {
  const ph::dual_ledger ledger{.damping = {0.03, 0.2, 0.0}};  // rigid, as the device's is
  const auto model = following_half_space<d1>(ph::spring{}, ledger, ph::strict_bound{});
  survives_all(model, {.friction = 0.2}, 20);
  for (const sim::verdict& v : sim::challenge_all(model, {}, 20)) {
    CAPTURE(to_string(v.by), v.least_energy);
    CHECK(v.least_energy < -1e-6);
  }
}

TEST_CASE("a challenge reaches the actuators through their limit", "[adversaries]") {
  const sim::verdict weak = sim::challenge(unbounded<d1>, by::greedy, {.force_limit = 0.1}, 20);
  const sim::verdict none = sim::challenge(unbounded<d1>, by::greedy, {.force_limit = 0.0}, 20);
  CHECK(weak.least_energy < -1e-6);
  CHECK(weak.least_energy > -600 * 0.1 * 0.1 * 1e-3 / (4 * 0.03));  // lemma L3, every tick
  CHECK(passes(none));
  CHECK(none.largest_force > 1.0);  // it asked
}

TEST_CASE("replay repeats the run of a verdict to the last bit, and shows each tick",
          "[adversaries]") {
  for (const by adversary : sim::all_adversaries) {
    CAPTURE(to_string(adversary));
    const sim::circumstances world{.friction = 0.01, .force_limit = 9.0, .ticks = 300};
    const sim::verdict v = sim::challenge(unbounded<d2>, adversary, world, 10, 1000);
    CHECK(v.worst_seed >= 1000);
    CHECK(v.worst_seed < 1010);
    int ticks = 0, lost = 0;
    double time = -1.0, least = 0.0;
    bool forwards = true;
    const double again =
        sim::replay(unbounded<d2>, adversary, world, v.worst_seed, [&](const auto& now) {
          forwards = forwards && now.tick == ticks && now.time > time;
          time = now.time;
          ++ticks;
          lost += now.sample_lost ? 1 : 0;
          least = std::min(least, now.energy);
        });
    CHECK(again == v.least_energy);
    CHECK(sim::replay(unbounded<d2>, adversary, world, v.worst_seed) == again);
    CHECK(sim::replay(unbounded<d2>, adversary, world, v.worst_seed + 1) != again);
    CHECK(least == again);
    CHECK(forwards);
    CHECK(ticks == 300);
    CHECK((lost > 0) == (adversary == by::dropouts || adversary == by::kitchen_sink));
  }
}
