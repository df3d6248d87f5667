// SPDX-License-Identifier: BSD-3-Clause
// A surface that moves out against a hand at rest works on it: the ledger pays, or the surface stops before it is empty.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/hand.hpp>

#include <algorithm>
#include <cmath>

namespace {

/// The largest step [N] in 4 s and how many ticks of it were cut, where a hand of k [N/m] rests on a plane of K [N/m] that
/// then heaves by `way` [m] 1.1 times a second, and is told `each` so many ticks.
struct pushed {
  double step = 0.0, least = 0.0;
  int cut = 0;
};
template <class Port>
pushed push(Port port, double K, double k, double way, int each) {
  namespace sim = ph::simulation;
  sim::device<d1, sim::impedance_hand<d1>> device{
      {.mass = 0.1, .damping = 0.05, .start = 0.003},
      {.stiffness = k, .damping = k < 200.0 ? 1.0 : 6.0, .target = -1.0 / k}};
  pushed out;
  double last = 0.0;
  auto sample = device.exchange(0.0);
  for (int n = 1; n < 5000; ++n) {
    const double heaved = n < 1000 ? 0.0 : way * std::sin(6.911504e-3 * (n - 1000));
    if (n % each == 1) {
      if constexpr (requires { port.update({heaved, 1.0, K}); }) {
        REQUIRE(port.update({heaved, 1.0, K}));
      } else {
        REQUIRE(port.source().update(0, {heaved, 1.0, K}));
      }
    }
    const auto felt = port.tick(sample);
    if (n > 1000) {
      out.step = std::max(out.step, std::abs(felt.force - last));
      out.cut += felt.limited ? 1 : 0;
    }
    last = felt.force;
    sample = device.exchange(last);
  }
  out.least = device.meter().minimum();
  return out;
}

}  // namespace

TEST_CASE("a surface that pushes a hand stops before the ledger is used up", "[contact]") {
  ph::laws::samples random(11);
  double eased = 0.0, stepping = 0.0, least = 0.0;
  int cut = 0, cut_of_a_set = 0, ticks = 0;
  for (int i = 0; i < 40; ++i) {
    const auto between = [&](double a, double b) {
      return a * std::pow(b / a, 0.5 + 0.5 * random.number<double>());
    };
    const double K = between(300.0, 8000.0), k = i % 2 == 0 ? 100.0 : 400.0;
    const double way = between(2e-3, 15e-3);
    const int each = int(between(10.0, 100.0));
    constexpr ph::exact_device device{
        .mass = 0.1, .damping = 0.03, .force_limit = 9.0, .longest_tick = 1.1e-3};
    constexpr ph::known_hand hand{.force = 8.0};
    const pushed touch = push(ph::make_touch<d1>(device, hand), K, k, way, each);
    const pushed set = push(ph::make_contacts<d1>(device, hand, ph::slots<ph::half_space<d1>, 1>{}),
                            K, k, way, each);
    const pushed plain =
        push(ph::local_model{d1{}, ph::followed<ph::half_space<d1>>{}, ph::turn_at_once{},
                             ph::damped_spring{.mass = 0.1}, ph::reduced_energy{.damping = 0.03},
                             ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 8.0},
                                             ph::actuator_limit{.most = 9.0}},
                             ph::loop_limits{.longest_tick = 1.1e-3}},
             K, k, way, each);
    eased += touch.step / 40;
    stepping += plain.step / 40;
    least = std::min({least, touch.least, set.least});
    cut += touch.cut;
    cut_of_a_set += set.cut;
    ticks += 3999;
  }
  CAPTURE(eased, stepping, cut, cut_of_a_set, ticks);
  CHECK(eased < 0.4);     // [N]
  CHECK(stepping > 1.0);  // the control: news that are not eased
  CHECK(cut < ticks / 5);
  CHECK(cut_of_a_set < ticks / 5);
  CHECK(least == 0.0);
}

TEST_CASE("a surface that heaves against a stiff hand is as true as without a ledger",
          "[contact]") {
  // A finger stands 3 mm deep in a plane that heaves by 2 mm at 4 Hz and is told 100 times a second.
  constexpr ph::exact_device device{
      .mass = 0.1, .damping = 0.03, .force_limit = 20.0, .longest_tick = 1.1e-3};
  const auto off = [](auto port) {
    double sum = 0.0;
    for (int n = 0; n < 6000; ++n) {
      const auto heaved = [&](int k) { return 0.002 * std::sin(0.02513 * std::max(k - 1000, 0)); };
      if (n % 10 == 0) REQUIRE(port.update({heaved(n), 1.0, 1000.0}));
      const double x = -0.003 + std::max(0.02 - 4e-5 * n, 0.0);
      const double f = port.tick(x, ph::seconds{1e-3}).force;
      if (n > 2000) sum += std::pow(f - 1000.0 * std::max(heaved(n) - x, 0.0), 2) / 3999;
    }
    return std::sqrt(sum);
  };
  constexpr ph::known_hand hand{.force = 15.0};
  const double eased = off(ph::make_touch<d1>(device, hand));
  const double unbounded =
      off(ph::local_model{d1{}, ph::followed<ph::half_space<d1>>{}, ph::turn_limited{.rate = 2.0},
                          ph::eased{ph::damped_spring{.mass = 0.1}}, ph::no_observer{},
                          ph::no_bound{}, ph::loop_limits{.longest_tick = 1.1e-3}});
  CAPTURE(eased, unbounded);
  CHECK(eased < 1.01 * unbounded);
}
