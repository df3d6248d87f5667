// SPDX-License-Identifier: BSD-3-Clause
// What it costs to believe a sample that is not true: an encoder that is wrong once, and a sensor that
// is slower than the loop. loop_limits::top_speed and watched_loop_limits are there for it.
#include "attacks/challenged.hpp"
#include "support/scripted_device.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>
#include <array>

using namespace simulated;
using Catch::Matchers::WithinRel;

namespace {

template <class Limits>
auto wall_with(const Limits& limits) {
  return ph::local_model{d1{},         ph::fixed{wall<d1>(1e4)}, ph::turn_at_once{},
                         ph::spring{}, thesis_ledger(),          ph::strict_bound{},
                         limits};
}

struct glitch {
  double credit = 0.0;  ///< in the ledger after it [J]
  double least = 0.0;   ///< of the true port energy, when it has been spent [J]
  ph::event what = ph::event::nominal;
};

/// One sample out of place by so much, outside the wall; then 200 000 ticks of a hand that gives way to
/// whatever pushes it.
glitch believed(double jump, double top_speed) {
  auto model = wall_with(ph::loop_limits{.longest_tick = 1e-3, .top_speed = top_speed});
  scripted_device device(sim::prescribed_motion<d1>({.start = -1e-3}),
                         std::array{scripted_fault{1, sample_fault::jump, -jump}});
  glitch found;
  const auto hand = [&](const auto& now) {
    if (now.tick < 3) {
      found.what = ph::worse(found.what, now.out.what);
      found.credit = now.out.energy;
      return;
    }
    const double way = now.force != 0.0 ? now.force * 1e-3 / (2 * 0.03) * 0.3
                                        : (now.position < 1e-3 ? 3e-4 : -3e-4);
    device.device().move_to(now.position + std::clamp(way, -3e-4, 3e-4));
  };
  found.least = sim::run(device, model, 200000, sim::idle, hand).least_energy;
  return found;
}

/// A sensor of 1 kHz in a loop that is so many times as fast, against a hand that gives way.
struct slow_sensor {
  double least = 0.0;   ///< [J]
  int reported = 0;     ///< ticks that say repeated_sample
  double ledger = 0.0;  ///< least of the model's own [J]
};
slow_sensor sampled(int times) {
  const double T = 1e-3 / times;
  auto model = wall_with(ph::watched_loop_limits<>{.longest_tick = T});
  sim::prescribed_motion<d1> device({.period = T, .start = -1e-3});
  sim::greedy_motion<d1> greedy;
  sim::random_source random(1);
  slow_sensor found;
  double shown = 0.0;
  const auto sensor = [&](auto& now) {
    if (now.tick % times == 0) shown = now.sample.position;
    now.sample.position = shown;
  };
  double step = 0.0;
  const auto hand = [&](const auto& now) {
    if (now.tick % times == 0) {
      step = greedy.next({now.position, -1.0, now.position, now.force, T}, random) - now.position;
    }
    device.move_to(now.position + step);
    found.reported += now.out.what == ph::event::repeated_sample ? 1 : 0;
    found.ledger = std::min(found.ledger, now.out.energy);
  };
  found.least = sim::run(device, model, 20000, sensor, hand).least_energy;
  return found;
}

}  // namespace

TEST_CASE("a sensor that is wrong once is not believed beyond top_speed, and gives no credit",
          "[passivity]") {
  const glitch usual = believed(0.09, ph::loop_limits{}.top_speed);  // 90 m/s, if it were true
  CHECK(usual.what == ph::event::rejected_sample);
  CHECK(usual.credit == 0.0);
  CHECK(usual.least == 0.0);
}

TEST_CASE("a wrong sample below top_speed is believed, and 2 b Δx²/T is paid out for it",
          "[passivity]") {
  const glitch trusting = believed(0.09, 100.0);
  CHECK(trusting.what == ph::event::nominal);
  CHECK_THAT(trusting.credit, WithinRel(2 * 0.03 * 0.09 * 0.09 / 1e-3, 1e-6));  // 486 mJ
  CHECK_THAT(trusting.least, WithinRel(-0.486, 1e-3));
  const glitch usual = believed(4.9e-3, ph::loop_limits{}.top_speed);  // what 5 m/s lets through
  CHECK(usual.what == ph::event::nominal);
  CHECK_THAT(usual.least, WithinRel(-1.44e-3, 1e-3));
}

TEST_CASE("a sensor slower than the loop costs energy, and a watched loop says so", "[passivity]") {
  const slow_sensor as_fast = sampled(1);
  CHECK(as_fast.least >= -1e-12);
  CHECK(as_fast.reported == 0);
  struct line {
    int times;
    double least;  ///< in 20 000 ticks [J]
  };
  for (const line& said : {line{2, -0.9e-3}, line{4, -6.8e-3}, line{10, -77e-3}}) {
    const slow_sensor found = sampled(said.times);
    CAPTURE(said.times, found.least, found.reported);
    CHECK(found.least < said.least / 2.0);
    CHECK(found.least > said.least * 2.0);
    CHECK(found.ledger >= 0.0);  // which knows nothing of it
    CHECK(found.reported > 1000);
  }
}

TEST_CASE("a position of few digits is an encoder with steps, and costs what its step is worth",
          "[adversaries]") {
  // One ulp of float: 6e-8 m beside 1 m, 1e-6 m beside 10 m.
  struct line {
    double step;   ///< [m]
    double least;  ///< of any adversary, with the plain ledger [J]
  };
  for (const line& said : {line{6e-8, -0.36e-6}, line{1e-6, -18e-6}}) {
    const auto worst = [&](const auto& observer) {
      const auto model =
          following_half_space<d1>(ph::spring{}, observer, ph::strict_bound{}, thesis_loop);
      double least = 0.0;
      for (const auto& v : sim::challenge_all(model, {.quantum = said.step}, 100)) {
        least = std::min(least, v.least_energy);
      }
      return least;
    };
    const double plain = worst(thesis_ledger());
    CAPTURE(said.step, plain);
    CHECK(plain < said.least / 2.0);
    CHECK(plain > said.least * 2.0);
    CHECK(worst(ph::quantised_energy{.damping = 0.03, .quantum = said.step}) >= -1e-12);
  }
}
