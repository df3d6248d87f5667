// SPDX-License-Identifier: BSD-3-Clause
// Real loops are never even. A wall stays where it is under jitter, whether the longest tick was stated
// honestly or as the mean; what the second costs in energy is in numbers here.
#include "attacks/challenged.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/motion_estimator/mass_observer.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <random>

using namespace simulated;
using Catch::Matchers::WithinRel;

namespace {

constexpr double mass = 0.1, damping = 0.5, stiffness = 2000.0;
const ph::half_space<d1> plane{0.0, 1.0, stiffness};

/// How a hand of 4 N stands on a wall of 2 kN/m after 1.5 s, and how many ticks were late.
struct pressed {
  double depth = 0.0;  ///< the deepest of 1.5 s [m]
  int late = 0;
};

/// Periods of T (1 ± jitter), measured; positions in steps of `quantum`, if there are any.
template <class Port>
pressed press(Port port, double T, double jitter, double quantum = 0.0) {
  sim::device<d1> device({.mass = mass,
                          .damping = damping,
                          .quantum = quantum,
                          .load = -4.0,
                          .period = T,
                          .start = 0.005});
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> either_way(-1.0, 1.0);
  pressed result;
  auto sample = device.exchange(0.0);
  while (device.time() < 3.0) {
    double force = 0.0;
    ph::event what{};
    if constexpr (requires { port.tick(sample, 0.0); }) {
      const auto out = port.tick(sample, std::max(0.0, -stiffness * sample.position));
      force = out.force;
      what = out.what;
    } else {
      const auto out = port.tick(sample);
      force = out.force;
      what = out.what;
    }
    result.late += what == ph::event::late_tick ? 1 : 0;
    REQUIRE(device.set_period(T * (1.0 + jitter * either_way(random))));
    sample = device.exchange(force);
    if (device.time() > 1.5) result.depth = std::max(result.depth, -device.position());
  }
  return result;
}

/// Every composition that README recommends, each told that longest tick.
template <class Judge>
void for_each_composition(double longest, const Judge& judge) {
  auto touch = ph::make_touch<d1>(
      {.mass = mass, .damping = damping, .force_limit = 9.0, .longest_tick = longest},
      {.force = 5.0});
  touch.update(plane);
  judge("touch", touch, 0.0);

  const ph::loop_limits limits{.longest_tick = longest};
  const ph::reduced_energy ledger{.damping = damping};
  judge("strict",
        ph::local_model{d1{}, ph::fixed{plane}, ph::turn_at_once{}, ph::spring{}, ledger,
                        ph::strict_bound{}, limits},
        0.0);
  judge("encoder",
        ph::local_model{d1{}, ph::fixed{plane}, ph::turn_at_once{}, ph::damped_spring{.mass = mass},
                        ph::quantised_energy{.damping = damping, .quantum = 10e-6, .loan = 1e-4},
                        ph::reachable_bound{.mass = mass, .hand_force = 5.0}, limits,
                        ph::mass_observer{.mass = mass}},
        10e-6);
  judge("force in, force out", ph::make_strict_guard<d1>(damping, ph::actuator_limit{9.0}, longest),
        0.0);

  const ph::local_contact flat{ph::fixed{plane}, ph::turn_at_once{},
                               ph::damped_spring{.mass = mass}};
  const ph::local_contact soft{ph::fixed{ph::half_space<d1>{-0.5, 1.0, 10.0}}, ph::turn_at_once{},
                               ph::damped_spring{.mass = mass}};
  judge("two walls",
        ph::passive_port{d1{}, ph::contacts{flat, soft}, ledger,
                         ph::reachable_bound{.mass = mass, .hand_force = 5.0}, limits},
        0.0);
}

}  // namespace

TEST_CASE("a wall stays where it is under jitter of 0 to 20 %, at 500 Hz, 1 kHz and 4 kHz",
          "[jitter]") {
  for (const double rate : {500.0, 1000.0, 4000.0}) {
    const double T = 1.0 / rate;
    for (const double stated : {1.0, 1.2}) {  // as the mean, and honestly
      for_each_composition(stated * T, [&](const char* name, const auto& port, double quantum) {
        const pressed even = press(port, T, 0.0, quantum);
        CHECK(even.late == 0);
        for (const double jitter : {0.01, 0.05, 0.2}) {
          const pressed uneven = press(port, T, jitter, quantum);
          CAPTURE(name, rate, stated, jitter, even.depth, uneven.depth);
          CHECK_THAT(uneven.depth, WithinRel(even.depth, 0.1));
          CHECK((uneven.late > 500) == (stated < 1.0 + jitter));
        }
      });
    }
  }
}

TEST_CASE("the longest tick stated too short loses by as much as it is too short", "[jitter]") {
  const auto least = [](double truly_longest, const auto& limits) {
    const sim::circumstances world{.longest_tick = truly_longest, .watchdog = false};
    return sim::challenge(model_of<d1>(ph::spring{}, ph::strict_bound{}, limits), by::jitter, world,
                          300)
        .least_energy;
  };
  const ph::loop_limits told{.longest_tick = 1e-3, .top_speed = 100.0};
  CHECK(least(1e-3, told) >= -1e-12);  // the control
  const double one = least(1.01e-3, told), five = least(1.05e-3, told),
               twenty = least(1.2e-3, told);
  CAPTURE(one, five, twenty);
  CHECK((one < -1e-9 && one > -1e-3));
  CHECK(five < one);
  CHECK(twenty < five);

  const ph::learning_loop_limits<> learnt{.longest_tick = 1e-3, .top_speed = 100.0};
  CHECK(least(1.2e-3, learnt) > twenty);  // only until the longest has come
}

TEST_CASE("a stiff wall in a loop that has learned its longest tick does not shake", "[jitter]") {
  const ph::half_space<d1> stiff{0.0, 1.0, 1e5};
  const ph::learning_loop_limits<> limits{.longest_tick = 1e-4};  // and they last 1 ms
  const ph::reachable_bound bound{.mass = mass, .hand_force = 5.0};
  const auto largest_step = [](auto port) {
    sim::device<d1> device({.mass = mass, .damping = 0.03, .load = -3.0, .start = 0.002});
    auto sample = device.exchange(0.0);
    double last = 0.0, step = 0.0;
    for (int n = 0; n < 4000; ++n) {
      const double force = port.tick(sample).force;
      if (n > 2000) step = std::max(step, std::abs(force - last));
      last = force;
      sample = device.exchange(force);
    }
    CHECK_THAT(last, WithinRel(3.0, 1e-2));
    return step;
  };
  CHECK(largest_step(ph::local_model{d1{}, ph::fixed{stiff}, ph::turn_at_once{},
                                     ph::damped_spring{.mass = mass},
                                     ph::reduced_energy{.damping = 0.03}, bound, limits}) < 1e-2);
  ph::passive_port set{
      d1{}, ph::contact_set{ph::proxy_spring{.mass = mass}, {}, ph::slots<ph::half_space<d1>, 1>{}},
      ph::reduced_energy{.damping = 0.03}, bound, limits};
  set.source().update(0, stiff);
  CHECK(largest_step(set) < 1e-2);
}
