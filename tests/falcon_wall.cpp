// SPDX-License-Identifier: BSD-3-Clause
// The wall experiment through the mock Falcon: counts, words, saturation, packets one tick late.
// The judge is the true port energy of the mock's body.
#include "support/catch.hpp"
#include "support/falcon_loop.hpp"
#include <passive_haptics/environment/spring_wall.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using sim::random_source;

constexpr double quantum = falcon_quantum;
constexpr double motors = 8.0;  // [N], settings::force_limit

/// Holds the grip's weight until it lets go.
struct letting_go {
  double weight = 0.0;   ///< [N]
  double release = 0.2;  ///< [s]
  [[nodiscard]] d3::vector force(double t, const d3::vector& /*x*/,
                                 const d3::vector& /*v*/) const noexcept {
    return {0.0, 0.0, t < release ? weight : 0.0};
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault<double> check() const noexcept { return {}; }
};

/// Taps through a surface, and every now and then does something else.
struct restless_hand {
  sim::tapping_hand<d3> tap{};
  std::uint64_t seed = 1;
  double part = 0.5;  ///< of the time it taps

  [[nodiscard]] d3::vector force(double t, const d3::vector& x,
                                 const d3::vector& v) const noexcept {
    random_source random(seed * 1000003 + static_cast<std::uint64_t>(t / 0.013));
    if (random.chance(part)) return tap.force(t, x, v);
    const d3::vector home = 400.0 * (d3::vector(tap.surface) - x);
    return sim::clamp_norm<d3>(home + random.direction<d3>() * tap.limit, tap.limit);
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault<double> check() const noexcept { return tap.check(); }
};

/// A mock whose answers get lost now and then.
template <class Hand>
struct lossy_mock : falcon::mock<Hand> {
  random_source random;
  double part;  ///< of the answers that are lost
  int lost = 0;

  lossy_mock(const falcon::mock_parameters& setup, const Hand& hand, double lose,
             std::uint64_t seed)
      : falcon::mock<Hand>(setup, hand), random(seed), part(lose) {}
  std::size_t transmit(std::span<falcon::byte> into) noexcept {
    const std::size_t sent = falcon::mock<Hand>::transmit(into);
    if (sent <= falcon::ftdi::status_size || !random.chance(part)) return sent;
    ++lost;
    return 0;
  }
};

template <class Contact, class Observer, class Bound, class Motion = ph::last_difference<d3>>
auto composed(const Contact& contact, const Observer& observer, const Bound& bound,
              const Motion& motion = {}, double longest_tick = 1e-3) {
  return ph::local_model{d3{},
                         ph::following<ph::half_space<d3>>{},
                         ph::snap<d3>{},
                         contact,
                         observer,
                         bound,
                         ph::loop_limits<d3>{.longest_tick = longest_tick},
                         motion};
}

constexpr ph::reduced_energy<d3> plain(double b) {
  return {.damping = b};
}
constexpr ph::quantised_energy<d3> sure(double b) {
  return {.damping = b, .quantum = quantum};
}

/// damped_spring, mass_observer and quantised_energy, as the README recommends for encoders.
template <class Bound>
auto recommended(double b, double mass, const Bound& bound) {
  return composed(ph::damped_spring<d3>{.mass = mass, .force_limit = motors}, sure(b), bound,
                  ph::mass_observer<d3>{.mass = mass, .quantum = quantum});
}

struct outcome {
  double least = 0.0;    ///< true port energy since forces were allowed [J]
  double deepest = 0.0;  ///< [m]
  double swing = 0.0;    ///< peak to peak of the last second [m]
  double force = 0.0;    ///< largest commanded [N]
  bool valid = true;     ///< every sample
};

/// Runs a model against a surface at height z that `surface(n, force)` moves [m].
template <class Hand, class Surface>
outcome run(auto model, falcon_device<Hand>& device, double z, const d3::vector& normal, double K,
            int ticks, const Surface& surface) {
  outcome seen;
  double low = 1.0, high = -1.0, offset = 0.0;
  const double start = body_of(device).meter().value();
  model.retarget({d3::vector(0.0, 0.0, z), normal, K});
  d3::vector force = d3::zero();
  for (int n = 0; n < ticks; ++n) {
    const double next = surface(n, force.norm());
    if (next != offset) {
      offset = next;
      model.retarget({d3::vector(d3::vector(0.0, 0.0, z) + normal * offset), normal, K});
    }
    const auto sample = device.exchange(force);
    seen.valid = seen.valid && sample.valid;
    force = model.tick(sample).force;
    const auto& body = body_of(device);
    seen.least = std::min(seen.least, body.meter().value() - start);
    const double height = normal.dot(body.position() - d3::vector(0.0, 0.0, z)) - offset;
    seen.deepest = std::max(seen.deepest, -height);
    seen.force = std::max(seen.force, force.norm());
    if (n >= ticks - 1000) {
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  seen.swing = high - low;
  return seen;
}

falcon::settings<double> eager() {
  return {.ramp = 1e-3};
}

/// The drop of the core's experiments: 61 mm onto 10 kN/m, left alone for 6 s.
outcome drop(auto model, double mass, double b, double friction, bool yields) {
  falcon::mock_parameters mock{.runs = true, .homed = true};
  mock.body.mass = mass;
  mock.body.damping = b;
  mock.body.friction = friction;
  mock.body.start = {0.0, 0.0, 0.160};
  mock.body.load = {0.0, 0.0, -9.81 * mass};
  falcon_device<letting_go> device{3500.0, eager(), mock, letting_go{9.81 * mass}};
  REQUIRE(make_ready(device));
  const ph::environment::spring_wall springs({2e4, 2e4});
  sim::update_schedule schedule(3);
  sim::one_update_late<double> late(0.0);
  double now = 0.0;
  return run(model, device, 0.099, d3::vector(0, 0, 1), 1e4, 6000, [&](int n, double force) {
    if (yields && schedule.due(n * 1e-3)) now = late(-springs.surface(force));
    return now;
  });
}

/// A hand of 5 N against a surface that jumps by up to 1 mm; worst of several hands.
outcome tapped(auto model, double mass, double b, int seeds) {
  outcome worst;
  for (int seed = 1; seed <= seeds; ++seed) {
    falcon::mock_parameters mock{.runs = true, .homed = true};
    mock.body.mass = mass;
    mock.body.damping = b;
    mock.body.start = {0.003, -0.004, 0.122};
    random_source random(static_cast<std::uint64_t>(seed));
    const d3::vector normal = (d3::vector(0, 0, 1) + 0.7 * random.direction<d3>()).normalized();
    const double K = random.uniform(1e3, 2e4);
    const restless_hand hand{.tap = {{0, 0, 0.12}, normal, 5.0},
                             .seed = static_cast<std::uint64_t>(seed),
                             .part = seed % 3 == 0 ? 1.0 : 0.6};
    falcon_device<restless_hand> device{3500.0, eager(), mock, hand};
    REQUIRE(make_ready(device));
    double offset = 0.0;
    const outcome seen = run(model, device, 0.12, normal, K, 2000, [&](int n, double /*force*/) {
      if (seed % 2 == 0 && n % 40 == 0) offset = random.uniform(-1e-3, 1e-3);
      return offset;
    });
    worst.least = std::min(worst.least, seen.least);
    worst.deepest = std::max(worst.deepest, seen.deepest);
    worst.force = std::max(worst.force, seen.force);
    worst.valid = worst.valid && seen.valid;
  }
  return worst;
}

void print(const char* scene, const char* name, const outcome& o) {
  std::printf("%-22s %-38s %10.2e %8.2f %8.3f %8.2f\n", scene, name, o.least, o.deepest * 1e3,
              o.swing * 1e3, o.force);
}
void print_heading() {
  std::printf("%-22s %-38s %10s %8s %8s %8s\n", "scene", "controller", "least E/J", "deep/mm",
              "swing/mm", "most/N");
}

}  // namespace

TEST_CASE("the wall experiment through the mock Falcon loses nothing", "[falcon][wall]") {
  print_heading();
  for (const double b : {0.03, 0.3}) {
    for (const double friction : {0.0, 0.2}) {
      for (const bool yields : {false, true}) {
        if (yields && friction > 0.0) continue;
        const double m = 0.1;
        const double other = 9.81 * m + friction;
        char scene[64];
        std::snprintf(scene, sizeof scene, "%s b=%.2f fc=%.1f", yields ? "S1" : "S0", b, friction);
        const auto judge = [&](const char* name, const auto& model) {
          const outcome seen = drop(model, m, b, friction, yields);
          print(scene, name, seen);
          CHECK(seen.valid);
          return seen;
        };
        const ph::spring<d3> spring;
        CHECK(judge("none", composed(spring, plain(b), ph::no_bound<d3>{})).least < -1e-3);
        const auto strict =
            judge("strict, latency form", composed(spring, sure(b), ph::strict_bound<d3, 1>{}));
        CHECK(strict.least >= -1e-12);
        const ph::late_reachable_bound<d3> reachable{.mass = m, .hand_force = other};
        CHECK(judge("late reachable", composed(spring, sure(b), reachable)).least >= -1e-12);
        const ph::reachable_bound<d3> prompt{.mass = m, .hand_force = other};
        CHECK(judge("reachable, without", composed(spring, sure(b), prompt)).least < -1e-4);
        const auto best = judge("recommended, latency form", recommended(b, m, reachable));
        CHECK(best.least >= -1e-12);
        CHECK(best.deepest < 0.012);
        CHECK(best.swing < 5e-4);
      }
    }
  }
}

TEST_CASE("hands on the mock Falcon get nothing out of the latency forms, and something without",
          "[falcon][wall][law]") {
  print_heading();
  double strict_without = 0.0, recommended_without = 0.0;
  for (const double b : {0.03, 0.3}) {
    const double m = 0.1;
    char scene[64];
    std::snprintf(scene, sizeof scene, "hands b=%.2f", b);
    const auto judge = [&](const char* name, const auto& model, int seeds = 20) {
      const outcome seen = tapped(model, m, b, seeds);
      print(scene, name, seen);
      CHECK(seen.valid);
      return seen.least;
    };
    const ph::spring<d3> spring;
    const ph::strict_bound<d3, 1> strict;
    const ph::strict_bound<d3> at_once;
    const ph::late_reachable_bound<d3> reachable{.mass = m, .hand_force = 5.0};
    const ph::reachable_bound<d3> prompt{.mass = m, .hand_force = 5.0};
    CHECK(judge("none", composed(spring, plain(b), ph::no_bound<d3>{}), 6) < -0.1);
    CHECK(judge("strict, latency form", composed(spring, sure(b), strict)) >= -1e-12);
    CHECK(judge("late reachable", composed(spring, sure(b), reachable)) >= -1e-12);
    CHECK(judge("recommended, latency form", recommended(b, m, reachable), 30) >= -1e-12);

    CHECK(judge("strict, without, plain ledger", composed(spring, plain(b), at_once)) < -1e-4);
    CHECK(judge("reachable, without", composed(spring, sure(b), prompt)) < -1e-4);
    strict_without =
        std::min(strict_without, judge("strict, without", composed(spring, sure(b), at_once)));
    recommended_without =
        std::min(recommended_without, judge("recommended, without", recommended(b, m, prompt), 30));
  }
  CHECK(strict_without < -1e-5);
  CHECK(recommended_without < -1e-5);
}

TEST_CASE("the ledger on the mock Falcon never exceeds the truth, whatever the host's jitter",
          "[falcon][wall]") {
  const auto overstated = [](const auto& ledger, bool by_reply, std::uint64_t seed) {
    falcon::mock_parameters mock{.runs = true, .homed = true};
    mock.body.damping = 0.3;
    const restless_hand hand{.tap = {{0, 0, 0.12}, {0, 0, 1}, 15.0}, .seed = seed, .part = 0.3};
    falcon_device<restless_hand> device{3500.0, eager(), mock, hand};
    REQUIRE(make_ready(device));
    auto model = composed(ph::spring<d3>{}, ledger, ph::strict_bound<d3, 1>{}, {}, 2e-3);
    model.retarget({d3::vector(0, 0, 0.12), d3::vector(0, 0, 1), 5e3});
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
      falcon::mock_parameters mock{.runs = true, .homed = true};
      mock.body.damping = b;
      mock.body.start = {0.003, -0.004, 0.122};
      const hand_type hand{.tap = {{0, 0, 0.12}, {0, 0, 1}, 5.0}, .seed = seed, .part = 0.6};
      falcon::settings<double> setup{.ramp = 1e-3, .settle = 5};
      setup.reply = std::chrono::microseconds(static_cast<std::int64_t>(wait * 1e6));
      device_type device{3500.0, setup, mock, hand, 0.05, seed};
      REQUIRE(device.open());
      REQUIRE(device.boot({}).how);
      REQUIRE(device.home(std::chrono::seconds(2)));
      auto model = composed(ph::spring<d3>{}, sure(b), bound, {}, longest_tick);
      model.retarget({d3::vector(0, 0, 0.12), d3::vector(0, 0, 1), 1e4});
      const auto& meter = device.line().far().mechanism().body().meter();
      const double start = meter.value();
      d3::vector force = d3::zero();
      for (int n = 0; n < 2000; ++n) {
        force = model.tick(device.exchange(force)).force;
        worst = std::min(worst, meter.value() - start);
      }
      lost += device.line().far().lost;
    }
    return worst;
  };
  const ph::late_reachable_bound<d3> reachable{.mass = 0.1, .hand_force = 5.0};
  const double covered = least(reachable, wait);
  const double strictly = least(ph::strict_bound<d3, 1>{}, wait);
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
  const auto shown = [](const auto& bound, int latency) {
    auto model = following_half_space<d1>(ph::spring<d1>{}, thesis_ledger<d1>(), bound);
    model.retarget(wall<d1>(1e4));
    sim::prescribed_motion<d1> device({.damping = 0.03, .latency = latency});
    auto sample = device.exchange(0.0);
    for (int n = 1; n <= 2000; ++n) {
      device.move_to(5e-6 * n);
      sample = device.exchange(model.tick(sample).force);
    }
    return -sample.held / device.position();
  };
  const double at_once = shown(ph::strict_bound<d1>{}, 0);
  const double later = shown(ph::strict_bound<d1, 1>{}, 1);
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
  const auto landed = [](const auto& bound, int latency, double b) {
    const double m = 0.1;
    auto model = ph::local_model{d1{},
                                 ph::following<ph::half_space<d1>>{},
                                 ph::snap<d1>{},
                                 ph::damped_spring<d1>{.mass = m, .force_limit = motors},
                                 ph::quantised_energy<d1>{.damping = b, .quantum = quantum},
                                 bound,
                                 ph::loop_limits<d1>{},
                                 ph::mass_observer<d1>{.mass = m, .quantum = quantum}};
    model.retarget(wall<d1>(1e4));
    sim::device<d1> device({.mass = m,
                            .damping = b,
                            .force_limit = motors,
                            .quantum = quantum,
                            .load = 9.81 * m,
                            .start = -0.061,
                            .latency = latency});
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
    const auto now = landed(ph::reachable_bound<d1>{.mass = 0.1, .hand_force = 0.981}, 0, b);
    const auto late = landed(ph::late_reachable_bound<d1>{.mass = 0.1, .hand_force = 0.981}, 1, b);
    for (const auto& [name, l] : {std::pair("at once", now), std::pair("a tick late", late)}) {
      std::printf(
          "recommended, b=%.2f, %-12s deepest %.2f mm, settled after %.3f s, then %.3f mm, "
          "least %.1e J\n",
          b, name, l.deepest * 1e3, l.settle, l.swing * 1e3, l.least);
    }
    CHECK(now.least >= -1e-12);
    CHECK(late.least >= -1e-12);
    CHECK(late.deepest < 1.2 * now.deepest);
    CHECK(late.settle < 6.0);
  }
}
