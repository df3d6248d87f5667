// SPDX-License-Identifier: BSD-3-Clause
// The loop through the mock Falcon: which tick, how long, and what a tick of latency costs.
#include "falcon/wall.hpp"
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <vector>

namespace {

/// A mock whose answers get lost now and then.
template <class Hand>
struct lossy_mock : mock_falcon<Hand> {
  random_source random;
  double part;  ///< of the answers that are lost
  int lost = 0;

  lossy_mock(const mock_parameters& setup, const Hand& hand, double lose, std::uint64_t seed)
      : mock_falcon<Hand>(setup, hand), random(seed), part(lose) {}
  std::size_t transmit(std::span<falcon::byte> into) noexcept {
    const std::size_t sent = mock_falcon<Hand>::transmit(into);
    if (sent <= falcon::ftdi::status_size || !random.chance(part)) return sent;
    ++lost;
    return 0;
  }
};

}  // namespace

TEST_CASE("the ledger on the mock Falcon never exceeds the truth, whatever the host's jitter",
          "[falcon][wall]") {
  const auto overstated = [](const auto& ledger, bool by_reply, std::uint64_t seed) {
    mock_parameters mock{.runs = true, .homed = true};
    mock.body.damping = 0.3;
    const restless_hand hand{.tap = {{0, 0, 0.12}, {0, 0, 1}, 15.0}, .seed = seed, .part = 0.3};
    falcon_device<restless_hand> device{3500.0, eager(), mock, hand};
    REQUIRE(make_ready(device));
    auto model = composed(ph::spring{}, ledger, ph::strict_bound{}, ticks_of(2e-3));
    model.update({d3::vector(0, 0, 0.12), d3::vector(0, 0, 1), 5e3});
    random_source random(seed);
    d3::vector force = d3::zero();
    double start = 0.0, most = -1.0;
    auto before = device.latest().stamp;
    for (int n = 0; n < 3000; ++n) {
      const auto pause = static_cast<std::int64_t>(random.uniform(0.0, 1e6));
      if (random.chance(0.5)) device.line().pass(falcon::nanoseconds(pause));
      const double now = body_of(device).meter().value();  // as the encoders are read
      auto sample = device.exchange(force);
      if (by_reply)
        sample.dt = std::chrono::duration<double>(device.latest().stamp - before).count();
      before = device.latest().stamp;
      const auto out = model.tick(sample);
      force = out.force;
      if (n == 0) start = now;
      most = std::max(most, out.energy - (now - start));
    }
    return most;
  };
  double surely = -1.0, exact = -1.0, wrong = -1.0, plainly_wrong = -1.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    surely = std::max(surely, overstated(sure(0.3), false, seed));
    exact = std::max(exact, overstated(plain(0.3), false, seed));
    wrong = std::max(wrong, overstated(sure(0.3), true, seed));
    plainly_wrong = std::max(plainly_wrong, overstated(plain(0.3), true, seed));
  }
  std::printf(
      "ledger above the truth: %.1e J (quantised), %.1e J (plain); with dt from reply to "
      "reply %.1e and %.1e J\n",
      surely, exact, wrong, plainly_wrong);
  CHECK(surely <= 1e-12);
  CHECK(exact < 1e-3);          // steps of the encoders, no more
  CHECK(plainly_wrong > 1e-2);  // the control: the ticks of the replies are not those of the counts
}

TEST_CASE("a lost answer is covered if longest_tick covers the wait for it", "[falcon][wall]") {
  using hand_type = restless_hand;
  using device_type = falcon::device<falcon::in_memory_transport<lossy_mock<hand_type>>, d3>;
  constexpr double b = 0.3, wait = 5e-3;
  int lost = 0;
  const auto least = [&lost](const auto& bound, double longest_tick) {
    double worst = 0.0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      mock_parameters mock{.runs = true, .homed = true};
      mock.body.damping = b;
      mock.body.start = {0.003, -0.004, 0.122};
      const hand_type hand{.tap = {{0, 0, 0.12}, {0, 0, 1}, 5.0}, .seed = seed, .part = 0.6};
      falcon::settings<double> setup{.ramp = 1e-3, .settle = 5};
      setup.reply = std::chrono::microseconds(static_cast<std::int64_t>(wait * 1e6));
      device_type device{3500.0, setup, mock, hand, 0.05, seed};
      REQUIRE(device.open());
      REQUIRE(device.start());
      REQUIRE(device.home(std::chrono::seconds(2)));
      auto model = composed(ph::spring{}, sure(b), bound, ticks_of(longest_tick));
      model.update({d3::vector(0, 0, 0.12), d3::vector(0, 0, 1), 1e4});
      const auto& meter = device.line().peer().mechanism().body().meter();
      const double start = meter.value();
      d3::vector force = d3::zero();
      for (int n = 0; n < 2000; ++n) {
        force = model.tick(device.exchange(force)).force;
        worst = std::min(worst, meter.value() - start);
      }
      lost += device.line().peer().lost;
    }
    return worst;
  };
  const ph::reachable_bound reachable{.mass = 0.1, .hand_force = 5.0};
  const double covered = least(reachable, wait);
  const double strictly = least(ph::strict_bound{}, wait);
  const double uncovered = least(reachable, 1e-3);
  std::printf(
      "5 %% of the answers lost (%d), 5 ms waited for each: %.1e J, strict %.1e J; told ticks "
      "of 1 ms %.1e J\n",
      lost, covered, strictly, uncovered);
  CHECK(lost > 1000);
  CHECK(covered >= -1e-12);
  CHECK(strictly >= -1e-12);
  CHECK(uncovered < -1e-3);  // the control
}

TEST_CASE("what one tick of latency costs", "[falcon][wall]") {
  // Pressed slowly from an empty ledger, on exact positions: the spring that can be shown.
  const auto shown = [](const auto& limits) {
    auto model =
        following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::strict_bound{}, limits);
    model.update(wall<d1>(1e4));
    sim::prescribed_motion<d1> device({.damping = 0.03, .latency = limits.latency});
    auto sample = device.exchange(0.0);
    for (int n = 1; n <= 2000; ++n) {
      device.move_to(5e-6 * n);
      sample = device.exchange(model.tick(sample).force);
    }
    return -sample.held / device.position();
  };
  const double at_once = shown(untold);
  const double later = shown(told);
  std::printf("strict_bound shows %.1f N/m at once, %.1f N/m a tick late (2b/T = 60)\n", at_once,
              later);
  CHECK(at_once < 61.0);
  CHECK(at_once > 57.0);
  CHECK(later < 0.55 * at_once);
  CHECK(later > 0.45 * at_once);

  // The recommended one, dropped: with the encoders' steps, at once and a tick late.
  struct landing {
    double deepest, swing, settle, least;
  };
  const auto landed = [](const auto& limits, double b) {
    const double m = 0.1;
    ph::local_model model{d1{},
                          ph::followed<ph::half_space<d1>>{},
                          ph::turn_at_once{},
                          ph::damped_spring{.mass = m, .force_limit = motors},
                          sure(b),
                          ph::reachable_bound{.mass = m, .hand_force = 0.981},
                          limits,
                          ph::mass_observer{.mass = m, .quantum = quantum}};
    model.update(wall<d1>(1e4));
    sim::device<d1> device({.mass = m,
                            .damping = b,
                            .force_limit = motors,
                            .quantum = quantum,
                            .load = 9.81 * m,
                            .start = -0.061,
                            .latency = limits.latency});
    auto sample = device.exchange(0.0);
    std::vector<double> x;
    for (int n = 0; n < 6000; ++n) {
      sample = device.exchange(model.tick(sample).force);
      x.push_back(device.position());
    }
    const auto [low, high] = std::minmax_element(x.end() - 1000, x.end());
    std::size_t first = x.size();
    while (first > 0 && std::abs(x[first - 1] - x.back()) < 0.5e-3) --first;
    return landing{*std::max_element(x.begin(), x.end()), *high - *low,
                   static_cast<double>(first) * 1e-3, device.meter().minimum()};
  };
  for (const double b : {0.03, 0.3}) {
    const auto now = landed(untold, b);
    const auto late = landed(told, b);
    for (const auto& [name, l] : {std::pair("at once", now), std::pair("a tick late", late)}) {
      std::printf(
          "recommended, b=%.2f, %-12s deepest %.2f mm, settled after %.3f s, then %.3f mm, "
          "least %.1e J\n",
          b, name, l.deepest * 1e3, l.settle, l.swing * 1e3, l.least);
    }
    CHECK(now.least >= -1e-12);
    CHECK(late.least >= -1e-12);
    CHECK(late.deepest < 1.25 * now.deepest);  // softer, so that a fall on it is caught
    CHECK(late.settle < 6.0);
  }
}
