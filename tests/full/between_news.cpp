// SPDX-License-Identifier: BSD-3-Clause
// What is felt between news: surfaces that say how they move, that stop, turn round and lie; and a damper that brakes
// what swings.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/quiet.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr ph::exact_device device{.mass = 0.1, .damping = 0.03, .force_limit = 9.0};
constexpr ph::known_hand hand{.force = 5.0};
constexpr ph::damped_spring damper{.mass = 0.1};
constexpr double K = 1000.0;

template <class Law>
auto touching(const Law& law) {
  return ph::local_model{d1{},
                         ph::followed<ph::half_space<d1>>{},
                         ph::turn_at_once{},
                         law,
                         thesis_ledger(),
                         ph::no_bound{},
                         thesis_loop};
}

struct felt {
  double rms = 0.0, largest_step = 0.0, most = 0.0;
};
/// A device held 2 mm below 0, news every `each` ticks and `late` ticks old when they come.
felt held(const auto& height, const auto& speed, int each, int late, bool tells) {
  auto model = touching(ph::eased{damper});
  felt result;
  double last = 0.0;
  for (int n = 0; n < 6000; ++n) {
    const double made = 1e-3 * (n - late);
    if (n >= late && (n - late) % each == 0) {
      const ph::half_space<d1> plane{height(made), 1.0, K};
      if (tells) {
        REQUIRE(model.update(plane, {.velocity = speed(made), .age = 1e-3 * late}));
      } else {
        REQUIRE(model.update(plane));
      }
    }
    const double force = model.tick(-2e-3, 1ms).force;
    if (n >= 1000) {
      const double off = force - K * std::max(0.0, 2e-3 + height(1e-3 * n));
      result.rms += off * off / 5000;
      result.largest_step = std::max(result.largest_step, std::abs(force - last));
      result.most = std::max(result.most, force);
    }
    last = force;
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

}  // namespace

TEST_CASE("a surface that says how fast it moves, and how old that is, is felt where it is by now",
          "[contact]") {
  const double w = GENERATE(4.0, 6.9);  // [1/s]
  const auto height = [w](double t) { return 1e-3 * std::sin(w * t); };
  const auto speed = [w](double t) { return 1e-3 * w * std::cos(w * t); };
  for (const int each : {10, 17, 33, 100}) {
    for (const int late : {0, 20, 50}) {
      CAPTURE(each, late);
      double bare = 0.0;  // what is taken as it comes
      for (int n = 1000; n < 6000; ++n) {
        const double made = 1e-3 * ((n - late) / each * each),
                     off = height(made) - height(1e-3 * n);
        bare += K * K * off * off / 5000;
      }
      bare = std::sqrt(bare);
      const felt told = held(height, speed, each, late, true);
      CHECK(told.rms < 0.35 * bare);
      CHECK(told.largest_step < 1e-3 * K * w * 1e-3 + 0.02);
      if (late == 50)
        CHECK(held(height, speed, each, late, false).rms > 0.5 * bare);  // the control
    }
  }
}

TEST_CASE("a surface that heaves fast is felt nearer to where it is than where it was told",
          "[contact]") {
  const double w = GENERATE(12.6, 25.1);  // [1/s]
  const auto height = [w](double t) { return 1.5e-3 * std::sin(w * t); };
  for (const int each : {10, 17, 33}) {
    if (w * each > 500.0) continue;  // of less than 12 news a period bare is as near
    CAPTURE(w, each);
    double bare = 0.0, step = 0.0;
    for (int n = 1000; n < 6000; ++n) {
      const auto told = [&](int k) { return height(1e-3 * (k / each * each)); };
      const double off = K * (told(n) - height(1e-3 * n));
      bare += off * off / 5000;
      step = std::max(step, K * std::abs(told(n) - told(n - 1)));
    }
    const felt eased = held(
        height, [](double) { return 0.0; }, each, 0, false);
    CHECK(eased.rms < 0.75 * std::sqrt(bare));
    CHECK(eased.largest_step < K * 1.5e-3 * w * 1e-3 + 0.1 * step);  // the truth's own, and a tenth
  }
}

TEST_CASE("one bad update costs no truth later", "[contact][fault]") {
  const double bad = GENERATE(5e-3, -1e-3, 1.0);  // [m]
  const bool lasts = GENERATE(false, true);
  const auto rms = [](bool jumps, double by, bool stays) {
    auto model = touching(ph::eased{damper});
    double sum = 0.0;
    for (int n = 0; n < 6000; ++n) {
      const double height = 1e-3 * std::sin(6.9e-3 * n);
      const bool off = jumps && (stays ? n >= 3003 : n == 3003);
      if (n % 33 == 0) REQUIRE(model.update({height + (off ? by : 0.0), 1.0, K}));
      const double force = model.tick(-3e-3 + (off && stays ? by : 0.0), 1ms).force;
      if (n > 4000) sum += std::pow(force - K * (3e-3 + height), 2) / 2000;
    }
    return std::sqrt(sum);
  };
  CHECK(rms(true, bad, lasts) < 1.1 * rms(false, bad, lasts));
}

TEST_CASE("a surface that stops or turns round is not thrown further than it can have gone",
          "[contact]") {
  const bool turns = GENERATE(false, true);
  const auto height = [turns](double t) {  // 10 mm/s, until 2 s
    return t < 2.0 ? 5e-3 * t : turns ? 10e-3 - 5e-3 * (t - 2.0) : 10e-3;
  };
  const auto speed = [turns](double t) { return t < 2.0 ? 5e-3 : turns ? -5e-3 : 0.0; };
  for (const int late : {0, 50}) {
    const felt told = held(height, speed, 33, late, true);
    const double known_late = 5e-3 * (0.034 + 1e-3 * late);
    CHECK(told.most < K * (12e-3 + known_late) + 1e-9);
    CHECK(told.largest_step < 0.03);
  }
}

TEST_CASE("a speed that is a lie is doubted after two news", "[contact]") {
  for (const double lie : {1.0, -1.0, 1e6, -1e300}) {
    auto model = touching(ph::eased{damper});
    double most = 0.0, least = 1e9;
    for (int n = 0; n < 3000; ++n) {
      if (n % 33 == 0) REQUIRE(model.update({0.0, 1.0, K}, {.velocity = lie, .age = 0.01}));
      const double force = model.tick(-2e-3, 1ms).force;
      if (n > 1000) most = std::max(most, force), least = std::min(least, force);
    }
    CHECK_THAT(most, WithinAbs(2.0, 1e-6));
    CHECK_THAT(least, WithinAbs(2.0, 1e-6));
  }
}

TEST_CASE("news that are no numbers, from the future or from the past are refused with an event",
          "[contact][fault]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  auto model = ph::make_touch<d1>(device, hand);
  const ph::half_space<d1> plane{0.0, 1.0, K};
  REQUIRE(model.update(plane, {.velocity = 0.0, .age = 0.02}));
  for (int n = 0; n < 10; ++n) (void)model.tick(1e-3, 1ms);
  for (const double v : {infinity, -infinity, nan}) {
    CHECK_FALSE(model.update({1.0, 1.0, K}, {.velocity = v}));
    CHECK(model.tick(1e-3, 1ms).what == ph::event::rejected_target);
    CHECK(model.tick(1e-3, 1ms).what == ph::event::nominal);
  }
  for (const double age :
       {-1e-3, nan, infinity, 0.1}) {  // the last of them is older than the first news
    CHECK_FALSE(model.update({1.0, 1.0, K}, {.velocity = 0.0, .age = age}));
    CHECK(model.tick(1e-3, 1ms).force == 0.0);
  }
  CHECK(model.update(plane, {.velocity = 0.0, .age = 0.02}));
  CHECK_FALSE(model.update(plane, {.velocity = 0.0, .age = 0.03}));  // overtaken
}

TEST_CASE("random worlds that jump, lie, drop and overtake neither step, nor draw, nor break",
          "[contact]") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    sim::random_source random(seed);
    auto touch = ph::make_touch<d1>(device, hand);
    auto wanted = touching(ph::eased{damper});  // no bound, so that every step of it is seen
    sim::prescribed_motion<d1> moved({.damping = 0.03, .period = 1e-3, .start = 4e-3});
    struct letter {
      double made, arrives, height, speed;
    };
    std::deque<letter> under_way;
    double height = 0.0, speed = 0.0, last = 0.0, largest = 0.0, next = 0.0, at = 4e-3;
    auto sample = moved.exchange(0.0);
    for (int n = 0; n < 12000; ++n) {
      const double t = 1e-3 * n;
      if (random.chance(0.003)) speed = random.uniform(-0.01, 0.01);  // turns round, or stops
      if (random.chance(0.001)) speed = 0.0;
      height = std::clamp(height + 1e-3 * speed, -2e-3, 2e-3);
      if (t >= next) {
        next = t + random.uniform(0.005, 0.12);
        const double told = random.chance(0.2) ? random.uniform(-0.1, 0.1) : speed;
        if (!random.chance(0.2))
          under_way.push_back({t, t + random.uniform(0.0, 0.06), height, told});
      }
      for (auto& l : under_way) {
        if (l.arrives > t) continue;
        const ph::half_space<d1> plane{l.height, 1.0, 800.0};
        (void)touch.update(plane, {.velocity = l.speed, .age = t - l.made});
        (void)wanted.update(plane, {.velocity = l.speed, .age = t - l.made});
        l.made = -1.0;
      }
      std::erase_if(under_way, [](const letter& l) { return l.made < 0.0; });
      const double force = touch.tick(sample).force;
      REQUIRE(std::isfinite(force));
      REQUIRE(force <= 9.0);
      // A device at 4 mm/s moves a spring of 800 N/m by 0.0032 N a tick, and the damper by little more.
      const double asked = wanted.tick(sample).force;
      if (n > 1000) largest = std::max(largest, std::abs(asked - last));
      last = asked;
      at = n < 500 ? 4e-3 - 6.5e-3 * n / 500.0 : -2.5e-3 + 6e-4 * std::sin(6.0 * (t - 0.5));
      moved.move_to(at);
      sample = moved.exchange(force);
    }
    CHECK(moved.meter().minimum() >= -1e-12);
    CHECK(largest < 0.09);  // (K|u| + R_most) dt and the 0.0032 N, K|u| ≤ 2 R_usual of a lie
  }
}

TEST_CASE("a hand that moves a device in a contact is not braked, and what swings comes to rest",
          "[contact]") {
  const auto braked = [](const auto& law, double w) {
    auto model = touching(law);
    REQUIRE(model.update({0.0, 1.0, K}));
    double rms = 0.0;
    for (int n = 0; n < 4000; ++n) {
      const double t = 1e-3 * n, x = -2e-3 + 1e-3 * std::sin(w * t);
      const double off = model.tick(x, 1ms).force + K * x;
      if (n >= 2000) rms += off * off / 2000;
    }
    return std::sqrt(rms);
  };
  CHECK(braked(ph::eased{damper}, 6.3) < 1e-9);
  CHECK(braked(damper, 6.3) > 0.05);  // the control
  CHECK_THAT(braked(ph::eased{damper}, 63.0), WithinRel(braked(damper, 63.0), 0.05));

  const auto settles = [](const auto& touch_of) {  // the slowest of some masses and walls [s]
    double slowest = 0.0;
    for (const double mass : {0.05, 0.2, 0.8}) {
      for (const double wall : {300.0, 3e3, 3e4}) {
        for (const double told : {0.3, 1.0}) {
          auto touch = touch_of(mass * told);
          (void)touch.update({0.0, 1.0, wall});
          sim::device<d1, sim::constant_hand<d1>> falls(
              {.mass = mass, .damping = 0.02, .start = 0.03}, {.push = -2.0, .limit = 2.0});
          sim::quiet_judge<d1> judge;
          auto sample = falls.exchange(0.0);
          double last = falls.position();
          const double normal = 1.0;
          for (int n = 0; n < 6000; ++n) {
            const double force = touch.tick(sample).force;
            sample = falls.exchange(force);
            judge.add(force, (falls.position() - last) / 1e-3, 1e-3, {&normal, 1});
            last = falls.position();
          }
          CHECK(falls.meter().minimum() >= -1e-12);
          slowest = judge.since() >= slowest ? judge.since() : judge.quiet() ? slowest : 1e9;
        }
      }
    }
    return slowest;
  };
  CHECK(settles([](double mass) {
          return ph::make_touch<d1>({.mass = mass, .damping = 0.01, .force_limit = 9.0},
                                    ph::known_hand{.force = 25.0});
        }) < 2.5);
  CHECK(settles([](double mass) {  // the control: nothing is damped
          return ph::local_model{
              d1{},
              ph::followed<ph::half_space<d1>>{},
              ph::turn_at_once{},
              ph::eased{ph::damped_spring{.mass = mass, .damping_ratio = 0.0, .force_limit = 9.0}},
              ph::reduced_energy{.damping = 0.01},
              ph::reachable_bound{.mass = mass, .hand_force = 25.0},
              ph::loop_limits{.longest_tick = 1e-3}};
        }) > 5.0);
}

TEST_CASE("a quadric can be followed: a ball that breathes, stroked fast, told ten times a second",
          "[contact]") {
  const auto rms = [](auto model, auto surface) {
    double sum = 0.0;
    for (int n = 0; n < 4000; ++n) {
      const double t = 1e-3 * n, angle = 0.35 * std::sin(5.0 * t),
                   r = 0.04 + 1e-3 * std::sin(4.4 * t);
      const d3::vector out(std::sin(angle), 0.0, std::cos(angle));
      if (n % 100 == 0) {
        REQUIRE(model.update(surface(r, out),
                             {.velocity = d3::vector(4.4e-3 * std::cos(4.4 * t) * out)}));
      }
      const d3::vector off =
          model.tick(d3::vector(0.0375 * out), 1ms).force - K * (r - 0.0375) * out;
      if (n >= 1000) sum += off.squaredNorm() / 3000;
    }
    return std::sqrt(sum);
  };
  const auto model = [](auto supply) {
    return ph::local_model{d3{},
                           supply,
                           ph::turn_limited{.rate = 2.0},
                           ph::eased{ph::spring{}},
                           thesis_ledger(),
                           ph::no_bound{},
                           thesis_loop};
  };
  const auto told = [&](double of_the_truth) {
    return rms(model(ph::followed<ph::quadric<d3>>{}), [=](double r, const auto& out) {
      return ph::quadric<d3>{.point = d3::vector(r * out),
                             .normal = out,
                             .curvature = of_the_truth / r,
                             .cross_curvature = of_the_truth / r,
                             .stiffness = K,
                             .thickness = 0.01};
    });
  };
  const double bent = told(1.0);
  const double seen = rms(model(ph::followed<ph::half_space<d3>>{}), [](double r, const auto& out) {
    return ph::half_space<d3>{d3::vector(r * out), out, K};
  });
  CHECK(bent < 0.05);
  CHECK(seen < 3.0 * bent);       // by its planes (bending.hpp)
  CHECK(told(0.0) > 4.0 * bent);  // the control
}
