// SPDX-License-Identifier: BSD-3-Clause
// A device is held still and only the world moves: what steps then is the news.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/compositions.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using eased_damper = ph::eased<ph::damped_spring>;
static_assert(ph::contact_law_for<eased_damper, d1> && ph::contact_law_for<eased_damper, f3>);
static_assert(ph::contact_law_for<ph::capped<eased_damper>, d1>);

constexpr ph::damped_spring damper{.mass = 0.1};

/// Unbounded, so that every step of a wanted force is felt.
template <class Surface = ph::half_space<d1>, class Law>
auto touching(const Law& law, const ph::freshness& rule = {}) {
  return ph::local_model{typename Surface::space_type{},
                         ph::followed<Surface>{rule},
                         ph::turn_limited{.rate = 2.0},
                         law,
                         thesis_ledger(),
                         ph::no_bound{},
                         thesis_loop};
}

struct felt {
  double largest_step = 0.0;  ///< [N] in a tick
  double rms = 0.0;           ///< off the truth [N]
  double last = 0.0;          ///< [N]
};

/// For 8 s, of which the first does not count: the surface is `height`(t) [m] and `stiffness`(t) [N/m], the
/// device `depth` [m] below 0, and every `each` ticks it is told.
template <class Law>
felt held(const Law& law, double depth, const auto& height, const auto& stiffness,
          const auto& told) {
  auto model = touching(law);
  felt result;
  for (int n = 0; n < 8000; ++n) {
    const double t = 1e-3 * n;
    if (told(n)) REQUIRE(model.update({height(t), 1.0, stiffness(t)}));
    const double force = model.tick(-depth, 1ms).force;
    const double truth = stiffness(t) * std::max(0.0, depth + height(t));
    if (n >= 1000) {
      result.largest_step = std::max(result.largest_step, std::abs(force - result.last));
      result.rms += (force - truth) * (force - truth) / 7000;
    }
    result.last = force;
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

const auto at_30_hz = [](int n) { return n % 33 == 0; };
constexpr auto always(double value) {
  return [value](double) { return value; };
}

}  // namespace

TEST_CASE("news of a surface that heaves do not step, and nothing of it is lost", "[contact]") {
  const auto heaving = [](double t) { return 1e-3 * std::sin(6.911504 * t); };  // 1.1 Hz
  const felt smooth = held(ph::eased{damper}, 2e-3, heaving, always(2000.0), at_30_hz);
  const felt stepping = held(damper, 2e-3, heaving, always(2000.0), at_30_hz);  // the control
  CHECK(stepping.largest_step > 0.45);
  CHECK(smooth.largest_step < 0.02);  // the surface itself moves by 0.014 N a tick
  CHECK(smooth.rms < 0.4 * stepping.rms);

  // Each third is told, at random: 33 ms to some 400 ms
  const auto dropping = [](int n) { return n % 33 == 0 && (n / 33 * 7919) % 31 < 10; };
  const felt patient = held(ph::eased{damper}, 2e-3, heaving, always(2000.0), dropping);
  const felt startled = held(damper, 2e-3, heaving, always(2000.0), dropping);
  CHECK(startled.largest_step > 1.0);
  CHECK(patient.largest_step < 0.02);
  CHECK(patient.rms < 1.2 * startled.rms);

  ph::laws::samples random(5);
  int next = 0;
  const auto late = [&](int n) {  // 20 to 300 ms
    if (n < next) return false;
    next = n + 160 + int(140 * random.number<double>());
    return true;
  };
  const felt calm = held(ph::eased{damper}, 2e-3, heaving, always(2000.0), late);
  CHECK(calm.largest_step < 0.02);
  const ph::news_pace hasty{.usual_force_rate = 50.0};  // the control
  CHECK(held(ph::eased{damper, hasty}, 2e-3, heaving, always(2000.0), dropping).largest_step >
        0.03);
}

TEST_CASE("news that come at once because those before were late do not step either", "[contact]") {
  // Every other one comes 1 ms before the next.
  const auto heaving = [](int n) { return 1e-3 * std::sin(6.911504e-3 * n); };  // 1.1 Hz
  for (const int period : {100, 33, 17, 10}) {
    const auto told_late = [&](const auto& law) {
      auto model = touching(law);
      felt result;
      for (int n = 0; n < 8000; ++n) {
        const int odd = n % (2 * period);
        const bool both = odd == period - 1 || odd == period;
        if (both) {
          REQUIRE(model.update({heaving(odd == period ? n : n - period + 1), 1.0, 2000.0}));
        }
        const double force = model.tick(-2e-3, 1ms).force;
        const double truth = 2000.0 * (2e-3 + heaving(n));
        if (n >= 2000) {
          result.largest_step = std::max(result.largest_step, std::abs(force - result.last));
          result.rms += (force - truth) * (force - truth) / 6000;
        }
        result.last = force;
      }
      result.rms = std::sqrt(result.rms);
      return result;
    };
    const felt smooth = told_late(ph::eased{damper});
    const felt stepping = told_late(damper);  // the control
    INFO(period << " ms: " << smooth.largest_step << " N, off by " << smooth.rms << " of "
                << stepping.rms << " N");
    CHECK(smooth.largest_step < 0.02);  // 0.13 to 0.49 N by the time since the last ones alone
    CHECK(smooth.rms < (period == 100 ? 1.25 : 0.8) * stepping.rms);
  }
}

TEST_CASE("a surface that moves fast is followed through the noise of frequent news", "[contact]") {
  // Heard one by one these tell more of their noise than of the way between them, and nothing was foreseen.
  const auto heaving = [](int n) { return 15e-3 * std::sin(5.0265482e-3 * n); };  // 0.8 Hz, 75 mm/s
  for (const int period : {1, 3}) {
    for (const double noise : {0.0, 20e-6, 170e-6}) {
      const auto told_noisily = [&](const auto& law) {
        auto model = touching(law);
        ph::laws::samples random(3);
        double rms = 0.0;
        for (int n = 0; n < 6000; ++n) {
          const double off = noise * random.number<double>();
          if (n % period == 0) REQUIRE(model.update({heaving(n) + off, 1.0, 1000.0}));
          const double force = model.tick(-20e-3, 1ms).force;
          const double truth = 1000.0 * (20e-3 + heaving(n));
          if (n >= 1000) rms += (force - truth) * (force - truth) / 5000;
        }
        return std::sqrt(rms);
      };
      const double smooth = told_noisily(ph::eased{damper}), stepping = told_noisily(damper);
      CAPTURE(period, noise, smooth, stepping);
      CHECK(smooth < 1.5 * stepping + 0.005);
    }
  }
}

TEST_CASE("news of uneven instants are followed as even ones are", "[contact]") {
  const auto heaving = [](double t) { return 1e-3 * std::sin(6.911504 * t); };  // 1.1 Hz
  const auto in_pairs = [](int n) { return n % 31 < 2; };                       // 1 and 30 ms apart
  const felt even = held(ph::eased{damper}, 2e-3, heaving, always(2000.0), at_30_hz);
  const felt uneven = held(ph::eased{damper}, 2e-3, heaving, always(2000.0), in_pairs);
  INFO("even: off by " << even.rms << ", in pairs " << uneven.rms << " N");
  CHECK(uneven.largest_step < 0.02);
  CHECK(uneven.rms < 1.5 * even.rms);  // 5 times where the later one counts as half of 30 ms
}

TEST_CASE("frequent news are followed without delay unless they are noisy", "[contact]") {
  // 15 mm/s to and fro for half a second each, with rests; heard as one of 7.5 ms it was off by 0.05 N.
  const auto moves = [](double t) {
    const double u = std::fmod(t, 2.0);
    return 0.012 * (std::clamp(u - 0.5, 0.0, 0.5) - std::clamp(u - 1.5, 0.0, 0.5));
  };
  const auto each_ms = [](int) { return true; };
  CHECK(held(ph::eased{damper}, 2e-3, moves, always(2000.0), each_ms).rms < 0.01);
}

TEST_CASE("what is told of a surface is shown within a second", "[contact]") {
  const double K = GENERATE(500.0, 2000.0, 8000.0);
  const auto off = [&](const auto& height, const auto& stiffness) {
    auto model = touching(ph::eased{damper});
    double shown = 0.0;
    for (int n = 0; n < 1033; ++n) {
      const double t = 1e-3 * n - 0.033;
      if (at_30_hz(n)) REQUIRE(model.update({height(t), 1.0, stiffness(t)}));
      shown = model.tick(-1e-3, 1ms).force;
    }
    return std::abs(shown / (K * (1e-3 + height(1.0))) - 1.0);
  };
  CHECK(off([](double t) { return t < 0.0 ? -5e-3 : 1e-3; }, always(K)) < 0.02);
  CHECK(off(always(0.0), [K](double t) { return t < 0.0 ? 100.0 : K; }) < 0.02);
  CHECK(off([](double t) { return t < 0.0 ? 2e-3 : 0.0; }, always(K)) < 0.02);
}

TEST_CASE("what appears under a device, jumps or changes its stiffness grows at a limited rate",
          "[contact]") {
  const double K = GENERATE(500.0, 2000.0, 8000.0);
  const auto jump = [&](const auto& law) {
    return held(
        law, 1e-3, [](double t) { return t < 4.0 ? 0.0 : 1e-3; }, always(K), at_30_hz);
  };
  const auto appear = [&](const auto& law) {
    return held(
        law, 1e-3, [](double t) { return t < 4.0 ? -5e-3 : 1e-3; }, always(K), at_30_hz);
  };
  const auto stiffen = [&](const auto& law) {
    return held(
        law, 1e-3, always(0.0), [K](double t) { return t < 4.0 ? K : 300.0; }, at_30_hz);
  };
  const ph::eased smooth{damper};
  CHECK(jump(smooth).largest_step < 0.021);
  CHECK(appear(smooth).largest_step < 0.021);
  CHECK(stiffen(smooth).largest_step < 0.021);
  CHECK_THAT(jump(smooth).last, WithinRel(2e-3 * K, 1e-9));
  CHECK_THAT(appear(smooth).last, WithinRel(2e-3 * K, 1e-9));
  CHECK_THAT(stiffen(smooth).last, WithinRel(0.3, 1e-9));
  CHECK(jump(damper).largest_step > 0.9e-3 * K);  // the controls
  CHECK(appear(damper).largest_step > 1.9e-3 * K);
  CHECK(stiffen(damper).largest_step > 0.9e-3 * (K - 300.0));
}

TEST_CASE("what vanishes or grows stale under a device fades at a limited rate, and comes back so",
          "[contact]") {
  const bool silent = GENERATE(false, true);
  const auto largest_step = [silent](const auto& law) {
    auto model = touching(law, {.stale_after = silent ? 0.1 : 1e3});
    REQUIRE(model.update({0.0, 1.0, 4000.0}));
    double last = 0.0, step = 0.0, least = 1e9;
    for (int n = 0; n < 4000; ++n) {
      const bool told = n < 1000 || n >= 2000;
      if (told && n % 33 == 0) REQUIRE(model.update({0.0, 1.0, 4000.0}));
      if (!told && !silent) model.source().release();
      const double force = model.tick(-2e-3, 1ms).force;
      if (n > 500) step = std::max(step, std::abs(force - last));
      if (n > 500) least = std::min(least, force);
      last = force;
    }
    CHECK(least == 0.0);
    CHECK_THAT(last, WithinRel(8.0, 1e-9));
    return step;
  };
  CHECK(largest_step(ph::eased{damper}) < 0.051);
  CHECK(largest_step(damper) > 7.0);  // the control
}

TEST_CASE(
    "where nothing is pressed news count at once, and where there are none an eased spring is the "
    "spring",
    "[contact]") {
  auto smooth = touching(ph::eased{ph::spring{}});
  auto plain = touching(ph::spring{});
  for (int n = 0; n < 3000; ++n) {
    const double height = n < 1000 ? 0.0 : 2e-3;  // moved in the air
    if (n == 0 || (n >= 1000 && n % 33 == 0)) {
      REQUIRE(smooth.update({height, 1.0, 2000.0}));
      REQUIRE(plain.update({height, 1.0, 2000.0}));
    }
    const double x = 1.5e-3 - 2.5e-3 * std::sin(0.01 * n) + (n < 1000 ? 0.0 : 2e-3);
    REQUIRE(smooth.tick(x, 1ms).force == plain.tick(x, 1ms).force);
  }
}

TEST_CASE("a surface that moved and falls silent is felt where it is", "[contact]") {
  const auto rising = [](double t) { return 5e-3 * std::min(t, 2.0); };
  const auto until_it_stops = [](int n) { return n % 33 == 0 && n <= 2000; };
  const felt end = held(ph::eased{damper}, 1e-3, rising, always(500.0), until_it_stops);
  CHECK_THAT(end.last, WithinRel(500.0 * (1e-3 + rising(1.98)), 1e-9));
  CHECK(end.largest_step < 2.2 * 500.0 * 5e-6);
}

TEST_CASE("a sphere that beats under a device that slides does not step either", "[contact]") {
  const auto largest_step = [](const auto& law) {
    auto model = touching<ph::sphere<d3>>(law);
    double step = 0.0;
    d3::vector last = d3::zero();
    for (int n = 0; n < 3000; ++n) {
      const double t = 1e-3 * n, angle = 0.8 * t;
      if (n % 33 == 0) {
        REQUIRE(model.update(
            {.centre = {0, 0, 0}, .radius = 0.05 + 1e-3 * std::sin(7.0 * t), .stiffness = 1000.0}));
      }
      const d3::vector x = 0.047 * d3::vector(std::cos(angle), 0.0, std::sin(angle));
      const d3::vector force = model.tick(x, 1ms).force;
      if (n > 500) step = std::max(step, (force - last).norm());
      last = force;
    }
    return step;
  };
  CHECK(largest_step(ph::eased{damper}) < 0.02);
  CHECK(largest_step(damper) > 0.2);  // the control
}

TEST_CASE("a normal that news go on turning is felt as it is by now, not as it was told",
          "[contact]") {
  // A sphere that breathes, told as its tangent planes, under a device that slides to and fro
  const auto stroked = [](const auto& law, const auto& normals, double hertz, int each) {
    ph::local_model model{d3{},
                          ph::followed<ph::half_space<d3>>{},
                          normals,
                          law,
                          thesis_ledger(),
                          ph::no_bound{},
                          thesis_loop};
    felt result;
    d3::vector last = d3::zero();
    const int ticks = 4000;
    for (int n = 0; n < ticks; ++n) {
      const double t = 1e-3 * n, angle = 0.35 * std::sin(6.283 * hertz * t);
      const double radius = 0.04 + 1e-3 * std::sin(4.4 * t);
      const d3::vector out(std::sin(angle), 0.0, std::cos(angle));
      const d3::vector on = radius * out, x = 0.037 * out;
      if (n % each == 0) REQUIRE(model.update({on, out, 1000.0}));
      const d3::vector force = model.tick(x, 1ms).force;
      const d3::vector truth = 1000.0 * (radius - 0.037) * out;
      if (n >= 1000) {
        result.rms += (force - truth).squaredNorm() / (ticks - 1000);
        result.largest_step = std::max(result.largest_step, (force - last).norm());
      }
      last = force;
    }
    result.rms = std::sqrt(result.rms);
    return result;
  };
  const ph::turn_limited turning{.rate = 2.0};
  for (const double hertz : {0.4, 0.8}) {
    for (const int each : {10, 33}) {
      CAPTURE(hertz, each);
      const felt smooth = stroked(ph::eased{ph::spring{}}, turning, hertz, each);
      const felt bare = stroked(ph::spring{}, ph::turn_at_once{}, hertz, each);
      CHECK(smooth.rms < 0.12 * bare.rms);
      CHECK(smooth.largest_step < 0.02);
      CHECK(bare.largest_step > 0.03);
      // The control: news that are not taken on are late by the time between them, turned or not.
      const ph::eased late{ph::spring{}, ph::news_pace{.ahead = 0.0}};
      CHECK(stroked(late, turning, hertz, each).rms > 0.5 * bare.rms);
    }
  }
}

TEST_CASE("a wall that answers the force itself comes to rest before a device that stands",
          "[contact]") {
  // It yields by force/K, `late` updates late, so that F(n+1) = K x - F(n - late) would never end.
  constexpr double K = 800.0, rest = 0.5 * K * 2e-3;
  for (const std::size_t late : {0u, 1u, 2u}) {
    for (const double uneven : {0.0, 8.0, 16.0}) {  // [ms]
      CAPTURE(late, uneven);
      ph::laws::samples random(1);
      auto model = touching(ph::eased{damper});
      std::array<double, 4> past{};
      double force = 0.0, least = K, most = 0.0;
      for (int n = 0, next = 0; n < 6000; ++n) {
        if (n == next) {
          next += 33 + int(uneven * random.number<double>());
          std::rotate(past.begin(), past.end() - 1, past.end());
          past[0] = force / K;
          REQUIRE(model.update({-past[late], 1.0, K}));
        }
        force = model.tick(1e-3 - 3e-3 * std::min(1.0, n / 500.0), 1ms).force;
        if (n < 5000) continue;
        least = std::min(least, force);
        most = std::max(most, force);
      }
      CHECK(most - least < 0.02);
      CHECK_THAT(force, WithinRel(rest, 0.02));
    }
  }
}

TEST_CASE("a wall that moves to and fro is followed sooner by a device that moves a quarter as far",
          "[contact]") {
  // It rises by 1 mm and falls again, so that nothing comes of what is expected.
  const auto since_it_fell = [](double sideways) {
    auto model = touching<ph::half_space<d3>>(ph::eased{ph::spring{}});
    std::array<double, 2> force{};  // when it falls, and 30 ms later
    for (int n = 0; n <= 430; ++n) {
      const double height = n / 100 % 2 == 0 ? 0.0 : 1e-3;
      if (n % 100 == 0) REQUIRE(model.update({{0, 0, height}, {0, 0, 1}, 200.0}));
      force[n <= 400 ? 0 : 1] =
          model.tick(d3::vector(n / 100 * sideways, 0, -4e-3), 1ms).force.norm();
    }
    return force[1] - force[0];
  };
  CHECK_THAT(since_it_fell(0.2e-3), WithinAbs(0.0, 0.04));
  CHECK(since_it_fell(0.3e-3) < -0.08);
}

TEST_CASE("eased forgets at a reset, and changes live", "[contact]") {
  auto model = touching(ph::eased{damper});
  REQUIRE(model.update({0.0, 1.0, 1000.0}));
  for (int n = 0; n < 100; ++n) (void)model.tick(1e-3, 1ms);
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(1.0, 1e-12));
  REQUIRE(model.update({1e-3, 1.0, 1000.0}));
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(1.0, 1e-9));
  CHECK(model.tick(-1e-3, 1ms).force < 1.06);
  model.reset();
  REQUIRE(model.update({1e-3, 1.0, 1000.0}));
  (void)model.tick(2e-3, 1ms);
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(2.0, 1e-9));

  REQUIRE_FALSE(model.set(
      ph::news_pace{.least_force_rate = 1e6, .usual_force_rate = 1e6, .most_force_rate = 1e9}));
  REQUIRE(model.update({2e-3, 1.0, 1000.0}));
  (void)model.tick(-1e-3, 1ms);
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(3.0, 1e-9));
  REQUIRE_FALSE(model.set(ph::damped_spring{.mass = 0.01}));
  CHECK(model.law().stiffness() == 1000.0);
  CHECK(model.law().parameters().law.mass == 0.01);
  REQUIRE_FALSE(model.set(ph::eased{ph::damped_spring{.mass = 0.02}, {.ahead = 0.05}}));
  CHECK(model.law().parameters().law.mass == 0.02);
  CHECK(model.law().parameters().pace.ahead == 0.05);

  const auto refused = [](const ph::news_pace& pace) {
    const auto fault = ph::eased{damper, pace}.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({}).empty());
  CHECK(refused({.least_force_rate = 0.0}) == "least_force_rate");
  CHECK(refused({.usual_force_rate = 1.0}) == "usual_force_rate");
  CHECK(refused({.most_force_rate = 1.0}) == "most_force_rate");
  CHECK(refused({.ahead = std::numeric_limits<double>::quiet_NaN()}) == "ahead");
  CHECK(std::string(ph::eased{ph::damped_spring{}}.check().parameter) == "mass");
}

TEST_CASE("no news make an eased force that is no number", "[contact][fault]") {
  auto model = touching(ph::eased{damper});
  const double largest = std::numeric_limits<double>::max();
  for (const double height : {0.0, 1.0, largest, -largest, 1e-3, largest, 1.0}) {
    for (const double K : {1e-300, 1000.0, largest}) {
      (void)model.update({height, 1.0, K});
      for (int n = 0; n < 3; ++n) CHECK(std::isfinite(model.tick(-1e-3, 1ms).force));
    }
  }
  REQUIRE(model.update({0.0, 1.0, 1000.0}));
  for (int n = 0; n < 100; ++n) (void)model.tick(1e-3, 1ms);
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(1.0, 1e-9));
}

TEST_CASE("a surface that stops is not believed to go on for longer than news take", "[contact]") {
  auto model = touching(ph::eased{damper});
  double most = 0.0;
  for (int n = 0; n < 2000; ++n) {  // 10 mm/s, told every 10 ms, till 1 s
    if (n % 10 == 0 && n <= 1000) REQUIRE(model.update({1e-5 * n, 1.0, 500.0}));
    most = std::max(most, model.tick(-1e-3, 1ms).force);
  }
  CHECK(most < 500.0 * (11e-3 + 1.5e-4));
  CHECK(most > 500.0 * (11e-3 + 0.5e-4));  // the control: it is believed for some time
}

TEST_CASE("a surface that goes on is believed through twice the time that it is believed ahead",
          "[contact]") {
  constexpr double dt = 0x1p-10;  // so that times are exact
  const ph::news_pace::at<double> pace({.ahead = 8 * dt});
  ph::lag<double> lag;
  for (int news = 0; news < 40; ++news) {  // 1 mm in 8 ticks, and nothing to make up for
    for (int n = 0; n < 8; ++n) lag.grow_older(dt);
    lag.hear(2e-3, 2e-3, 1e-3, 1e-3, pace);
  }
  const auto shown_after = [&lag](int ticks) {
    for (int n = 0; n < ticks; ++n) {
      lag.grow_older(dt);
      lag.follow(dt);
    }
    return -lag.offset();
  };
  const double half = shown_after(4), whole = shown_after(4);
  CHECK_THAT(whole, WithinRel(1e-3, 0.01));
  CHECK_THAT(half, WithinRel(0.5 * whole, 1e-9));
  CHECK(shown_after(9) == whole);  // it waits for 16; in the 17th it turns round
  CHECK(shown_after(1) < 0.999 * whole);
}

TEST_CASE("a lag begins with what is not felt of a surface yet", "[contact]") {
  const ph::news_pace::at<double> pace(ph::news_pace{});
  const auto begun = [&pace](double own, double now) {
    ph::lag<double> lag;
    lag.grow_older(0.01);
    lag.hear(own, now, 0.0, 1e-3, pace);
    CHECK(lag.settled() == (lag.offset() == 0.0));
    const double offset = lag.offset();
    lag.let_go();
    CHECK(lag.settled());
    lag.follow(1e-3);
    CHECK(lag.offset() == 0.0);
    return offset;
  };
  CHECK(begun(2e-3, 5e-3) == 3e-3);
  CHECK(begun(2e-3, -1e-3) == -3e-3);  // it has gone, and is still felt
  CHECK(begun(-1e-3, 2e-3) == 2e-3);   // it has come
  CHECK(begun(0.0, -2e-3) == 0.0);
  CHECK(begun(-1e-3, -2e-3) == 0.0);
  CHECK(begun(1e-3, std::numeric_limits<double>::infinity()) == 0.0);
}

TEST_CASE(
    "a lag is made up for within a third of the time that news take, as calmly as they let it",
    "[contact]") {
  // On 1000 N/m: least 5 mm/s, usual 19.5 mm/s, most 50 mm/s, of news that take 0.1 s.
  const ph::news_pace::at<double> pace(ph::news_pace{});
  const auto speed = [&pace](double lag, double u, double w = 0.0, double P = 0.1) {
    const auto of = [&](double sign) { return pace.speed_for(sign * lag, P, sign * u, w, 1e-3); };
    CHECK(of(-1.0) == of(1.0));
    return of(1.0);
  };
  CHECK_THAT(speed(0.1e-3, 0.0), WithinRel(5e-3, 1e-12));
  CHECK_THAT(speed(0.5e-3, 0.0), WithinRel(3 * 0.5e-3 / 0.1, 1e-12));
  CHECK_THAT(speed(1e-3, 0.0), WithinRel(19.5e-3, 1e-12));
  CHECK_THAT(speed(30e-3, 0.0), WithinRel(30e-3 / 0.8, 1e-12));
  CHECK_THAT(speed(0.1, 0.0), WithinRel(50e-3, 1e-12));
  CHECK_THAT(speed(1e-3, 12e-3), WithinRel(19.5e-3 - 12e-3, 1e-12));  // u does its part
  CHECK_THAT(speed(1e-3, -12e-3), WithinRel(19.5e-3, 1e-12));
  CHECK_THAT(speed(2e-3, 30e-3), WithinRel(40e-3 - 30e-3, 1e-12));  // and 4/3 of it is usual
  CHECK_THAT(speed(2e-3, -30e-3), WithinRel(40e-3, 1e-12));
  CHECK_THAT(speed(2e-3, 5e-3, 19e-3), WithinRel(19.5e-3 - 5e-3, 1e-12));
  CHECK_THAT(speed(2e-3, 5e-3, 20e-3), WithinRel(40e-3 - 5e-3, 1e-12));  // a w that is felt, twice
  CHECK_THAT(speed(2e-3, 0.0, 20e-3, 0.01), WithinRel(40e-3, 1e-12));
  CHECK_THAT(speed(2e-3, 0.0, 20e-3, 1e-3), WithinRel(22e-3, 1e-12));  // each ms hardly more than w
}

TEST_CASE("news that take longer count at once, and sooner ones little by little", "[contact]") {
  const ph::news_pace::at<double> pace(ph::news_pace{});
  ph::lag<double> lag;
  const auto P = [&](double seconds) {  // of the speed with which 0.6 mm are made up for
    lag.grow_older(seconds);
    lag.hear(1e-3, 1.6e-3, 0.0, 1e-3, pace);
    lag.follow(1e-3);
    return 3 * 0.6e-3 * 1e-3 / (0.6e-3 - lag.offset());
  };
  CHECK_THAT(P(0.1), WithinRel(0.3 - 0.2 / 8, 1e-9));
  CHECK_THAT(P(0.1), WithinRel(0.275 - 0.175 / 8, 1e-9));
  CHECK_THAT(P(0.28), WithinRel(0.28, 1e-9));
  CHECK_THAT(P(10.0), WithinRel(0.3, 1e-9));
  for (int n = 0; n < 1000 && !lag.settled(); ++n) lag.follow(1e-3);
  CHECK(lag.settled());
  CHECK(lag.offset() == 0.0);
}

/// Told what a surface has moved each 0.1 s, the speed [m/s] with which it is believed to go on.
struct told_each_tenth {
  ph::news_pace::at<double> pace{ph::news_pace{}};
  ph::lag<double> lag{};

  /// Which may be stated, too; then the own surface is ahead by `lead` [m] already.
  double operator()(double moved, const ph::lag<double>::account& told = {}, double lead = 0.0) {
    lag.grow_older(0.1);
    lag.hear(1e-3 + lead, 1e-3, moved, 1e-3, pace, told);
    lag.follow(1e-3);
    CHECK(lag.settled() == (lag.offset() == 0.0));
    return (-lag.offset() - lead) / 1e-3;
  }
};

TEST_CASE("a surface is believed to go on no more than twice as fast as before, if it is not back",
          "[contact]") {
  told_each_tenth goes_on;
  for (int n = 0; n < 2; ++n) CHECK(goes_on(1e-3) == 0.0);  // it may have jumped
  for (const double moved : {3e-3, 2e-3, 9e-3, 9e-3, 9e-3, 30e-3, 30e-3, 30e-3}) {
    const double on = goes_on(moved);
    INFO("moved by " << moved);
    CHECK(on > 0.0);
    CHECK(on <= moved / 0.1 * (1.0 + 1e-9));
  }
  told_each_tenth comes_back;
  for (int n = 0; n < 2; ++n) CHECK(comes_back(-1e-3) == 0.0);
  for (int n = 0; n < 12; ++n) (void)comes_back(-3e-3);
  CHECK_THAT(comes_back(-3e-3), WithinRel(-0.03, 0.03));
  told_each_tenth once;
  CHECK(once(1e-3) == 0.0);
  CHECK(once(-1e-3) == 0.0);
}

TEST_CASE("a surface is believed to go on as far as its speeds agree", "[contact]") {
  ph::going_on<double> speeds;
  const auto next = [](auto& one, double v) {
    one.hear(v);
    return one.next();
  };
  CHECK(next(speeds, 2.0) == 0.0);
  CHECK(next(speeds, 2.0) == 0.0);
  CHECK_FALSE(speeds.is_steady());
  for (int n = 0; n < 20; ++n) speeds.hear(2.0);
  CHECK(speeds.is_steady());
  CHECK(speeds.fastest() == 2.0);
  CHECK_THAT(next(speeds, 2.0), WithinRel(2.0, 0.01));
  CHECK(std::abs(next(speeds, -100.0)) <= 4.0);  // −4 is believed
  CHECK(speeds.last() == 100.0);
  CHECK(speeds.fastest() == 0.0);
  told_each_tenth goes_on;
  for (int n = 0; n < 20; ++n) (void)goes_on(2e-3);
  CHECK_THAT(goes_on(2e-3), WithinRel(0.02, 1e-2));
  ph::laws::samples random(3);
  double believed = 0.0, told = 0.0;  // of what never goes on little is believed
  for (int n = 0; n < 400; ++n) {
    const double moved = 2e-3 * random.number<double>(), on = goes_on(moved);
    if (n < 20) continue;
    believed += on * on;
    told += moved * moved / 0.01;
  }
  CHECK(believed < 0.15 * told);
  for (int n = 0; n < 40; ++n) (void)goes_on(2e-3);
  CHECK_THAT(goes_on(2e-3), WithinRel(0.02, 1e-2));  // and it is believed again
}

TEST_CASE(
    "a stated speed is believed as far as the surface moves, until it is wrong twice in a row",
    "[contact]") {
  const auto of = [](double speed) { return ph::lag<double>::account{speed, 0.0, true}; };
  const auto is = [](double speed) { return WithinRel(speed, 1e-9); };
  told_each_tenth steady;
  CHECK(steady(5e-3) == 0.0);
  CHECK_THAT(steady(5e-3, of(0.05)), is(0.05));
  CHECK_THAT(steady(5e-3, of(0.2)), is(0.1 + 0.05 * 0.01));  // twice what it moved, and it grows
  told_each_tenth stands;
  CHECK_THAT(stands(0.0, of(0.03)), is(0.0195));  // what is not felt on 1000 N/m
  told_each_tenth turns;
  CHECK_THAT(turns(2e-3, of(0.02)), is(0.02));
  CHECK_THAT(turns(3e-3, of(0.04)), is(0.04 + 0.2 * 1e-3));  // what it gained in 0.1 s, it gains
  CHECK_THAT(turns(-3e-3, of(-0.06)), is(-0.06 - 0.06 / 0.08 * 1e-3));  // wrong for the first time
  CHECK(turns(3e-3, of(0.05)) == 0.0);
  CHECK(turns(-6e-3, of(-0.05)) == 0.0);
  CHECK_THAT(turns(-5e-3, of(-0.05)), is(-0.05 - 0.5e-3));
  told_each_tenth more;
  for (int n = 0; n < 12; ++n) (void)more(-10e-3, of(-0.05));
  CHECK_THAT(more(-10e-3, of(-0.05)), is(-0.05 - 0.0195));  // of the rest no more than that
  told_each_tenth slows;
  CHECK_THAT(slows(-5e-3, of(-0.05)), is(-0.05));
  CHECK_THAT(slows(2e-3, of(0.02)), is(0.02 + 0.05 / 0.08 * 1e-3));
  told_each_tenth begins;
  CHECK_THAT(begins(0.02, of(0.2)), is(0.05));  // 50 N/s, because it may be a jump
  CHECK_THAT(begins(0.02, of(0.2)), is(0.2 + 0.15 / 0.1 * 1e-3));
}

TEST_CASE("a surface with a stated speed is where it is by now, not where it was told",
          "[contact]") {
  const auto of = [](double speed, double age) {
    return ph::lag<double>::account{speed, age, true};
  };
  told_each_tenth gains;
  CHECK_THAT(gains(2e-3, of(0.02, 0.02), 0.4e-3), WithinRel(0.02, 1e-9));
  CHECK_THAT(gains(3e-3, of(0.04, 0.02), 0.84e-3), WithinRel(0.044 + 0.2 * 1e-3, 1e-9));
  told_each_tenth much;  // by no more than its speed in the age and the 0.08 s ahead
  CHECK_THAT(much(-4e-3, of(-0.04, 0.02), -0.8e-3), WithinRel(-0.04, 1e-9));
  CHECK_THAT(much(6e-3, of(0.1, 0.02), 2.2e-3), WithinRel(0.12 + 1e-3, 1e-9));
  told_each_tenth old;  // no more than 0.1 s count
  CHECK_THAT(old(2e-3, of(0.04, 0.5), 4e-3), WithinRel(0.04, 1e-9));

  const ph::news_pace::at<double> pace({.ahead = 0.0625});
  ph::lag<double> lag;
  CHECK(lag.between(0.0) == ph::kernels::rounding<double>());
  lag.grow_older(0.5);
  CHECK(lag.between(0.0) == 0.5);
  CHECK(lag.between(0.25) == 0.25);
  CHECK(lag.between(0.375) == 0.25);
  CHECK(lag.follows(0.5, 0.0));
  CHECK(lag.follows(0.75, 0.25));
  CHECK_FALSE(lag.follows(0.75, 0.125));
  lag.hear(1e-3, 1e-3, 1e-3, 1e-3, pace, of(0.001, 0.0625));
  lag.grow_older(0.03125);
  CHECK(lag.taking_on());
  CHECK(lag.taken_on() == 0.09375);
  lag.grow_older(0.03125);
  CHECK_FALSE(lag.taking_on());
  lag.grow_older(0.03125);
  CHECK(lag.taken_on() == 0.125);
  CHECK(lag.between(0.03125) == 0.125);
  CHECK(lag.follows(0.15625, 0.0));
  lag.grow_older(0.0625);
  CHECK(lag.silent());
  CHECK(lag.taken_on() == 0.0);
}

TEST_CASE("a stated motion is used if it is a number and no older than never", "[contact]") {
  using motion = ph::surface_motion<d1>;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  CHECK(motion{}.is_usable());
  CHECK(motion{.velocity = 0.5, .age = 0.1}.is_usable());
  CHECK_FALSE(motion{.age = -0.1}.is_usable());
  CHECK_FALSE(motion{.age = infinite}.is_usable());
  CHECK_FALSE(motion{.velocity = infinite}.is_usable());
}

TEST_CASE("a normal is believed to turn on no more than twice as fast as before, and not back",
          "[contact]") {
  const d3::vector up(0.0, 0.0, 1.0), side(0.1, 0.0, -0.1);
  ph::turning<d3> turns;
  const auto is_turned = [&turns, &up](double time, const d3::vector& wanted) {
    return (turns.turned(up, time) - wanted.normalized()).norm() < 1e-12;
  };
  turns.hear(side, 0.1);
  CHECK(turns.still());
  turns.hear(side * 2.0, 0.1);
  CHECK_FALSE(turns.still());
  CHECK(is_turned(0.25, {0.5, 0.0, 0.5}));
  turns.hear(side * 6.0, 0.1);
  CHECK(is_turned(0.125, {0.5, 0.0, 0.5}));
  turns.hear(side * -1.0, 0.1);
  CHECK(turns.still());
  CHECK(is_turned(0.25, up));
  turns.hear(d3::vector(0.0, 0.0, -0.1), 0.1);
  turns.hear(d3::vector(0.0, 0.0, -0.1), 0.1);
  CHECK(is_turned(1.0, up));  // to no direction at all
  turns.stop();
  CHECK(turns.still());
  CHECK(ph::turning<d1>{}.still());
}

TEST_CASE("a device comes to rest on a wall that yields to the force of the news before",
          "[contact]") {
  // 0.5 kg on 300 N/m that gives way by as much as the depth, told each 20 to 50 ms.
  constexpr ph::exact_device device{
      .mass = 0.5, .damping = 0.06, .force_limit = 50.0, .longest_tick = 1e-3};
  auto model = ph::make_touch<d1>(device, {.force = 6.0});
  ph::laws::samples random(11);
  double x = -0.061, v = 0.0, force = 0.0, answer = 0.0, fastest = 0.0;
  for (int n = 0, next = 0; n < 10000; ++n) {
    if (n == next) {
      REQUIRE(model.update({std::exchange(answer, force / 300.0), -1.0, 300.0}));
      next += 35 + static_cast<int>(15.0 * random.number<double>());
    }
    force = -model.tick(x, 1ms).force;
    v += (9.81 - force / 0.5 - 0.12 * v) * 1e-3;
    x += v * 1e-3;
    if (n >= 8000) fastest = std::max(fastest, std::abs(v));
  }
  CHECK_THAT(x, WithinAbs(2.0 * 9.81 * 0.5 / 300.0, 1e-4));
  CHECK(fastest < 1e-3);
}

TEST_CASE("what is damped is a swing, and neither a speed that stays nor one that jumps once",
          "[contact]") {
  ph::swing<double> swing;
  CHECK(swing.damped(0.1, 60.0, 1e-3) == 0.1);  // a contact begins with a damper
  for (int n = 0; n < 1000; ++n) (void)swing.damped(0.1, 60.0, 1e-3);
  CHECK(swing.damped(0.1, 60.0, 1e-3) < 1e-9);
  CHECK(swing.damped(0.104, 60.0, 1e-3) < 1e-9);  // 4 m/s² for a millisecond
  double damped = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double now = swing.damped(0.1 * std::sin(0.04 * n), 60.0, 1e-3);  // 40/s
    if (n >= 500) damped = std::max(damped, now);
  }
  CHECK_THAT(damped, WithinAbs(0.1 * 40.0 / std::hypot(40.0, 22.0 / 3.0), 3e-4));

  auto law = at<d1>(ph::eased{damper});
  for (int n = 0; n < 1000; ++n) (void)law.swinging(0.1, 1e-3);
  law.let_go();
  CHECK(law.swinging(0.1, 1e-3) == 0.1);  // the next contact begins anew
}

TEST_CASE("how much of a swing is damped goes by how long its halves last", "[contact]") {
  const auto share_of = [](double Omega, double natural) {  // the largest of a speed of 1 m/s
    ph::swing<double> swing;
    double most = 0.0;
    for (int n = 0; n < 6000; ++n) {
      const double now = swing.damped(std::sin(Omega * 1e-3 * n), natural, 1e-3);
      if (n >= 4000) most = std::max(most, now);
    }
    return most;
  };
  for (const double natural : {14.0, 30.0, 44.0, 300.0}) {
    const double W = std::min(22.0, natural / 2.0);
    for (const double q : {0.2, 0.3, 0.5, 0.9, 1.1, 4.0}) {
      const double Omega = W * std::sqrt(q), passes = Omega / std::hypot(Omega, W / 3.0);
      CAPTURE(natural, q);
      const double g = std::clamp((q - 0.25) * 4.0 / 3.0, 0.0, 1.0);
      CHECK(share_of(Omega, natural) < passes * g + 0.015);
      // The peak of a half that lasts longer than 0.1 s has faded, and 2p is less than the swing.
      if (Omega > 20.0) CHECK(share_of(Omega, natural) > passes * g - 0.015);
    }
  }
}

TEST_CASE("a hand to and fro is not damped, whatever the noise of its samples, and a swing is",
          "[contact]") {
  // Positions of an amplitude of 1 mm and with noise, at Ω: what is damped of the speed, the largest [m/s]
  const auto damped = [](double W, double noise, auto& swing) {
    ph::laws::samples random(3);
    double most = 0.0, last = 0.0;
    for (int n = 0; n < 4000; ++n) {
      const double x = 1e-3 * std::sin(W * 1e-3 * n) + noise * random.number<double>() / 2.0;
      const double now = swing.damped((x - last) / 1e-3, 60.0, 1e-3);
      last = x;
      if (n >= 1000) most = std::max(most, std::abs(now));
    }
    return most;
  };
  for (const double W : {3.0, 6.0, 10.5}) {
    ph::swing<double> exact, noisy;
    CAPTURE(W);
    CHECK(damped(W, 0.0, exact) < 1e-12);
    CHECK(damped(W, 1e-6, noisy) < 4e-3);  // speeds of the noise are up to 1 mm/s
  }
  for (const double W : {22.5, 40.0, 100.0}) {
    ph::swing<double> exact, noisy;
    CAPTURE(W);
    CHECK(damped(W, 0.0, exact) > 0.92e-3 * W);
    CHECK(damped(W, 1e-6, noisy) > 0.92e-3 * W);
  }
  // A swing on top of a hand's motion, whose speed it never turns round, is found within a second
  ph::swing<double> swing;
  double most = 0.0;
  for (int n = 0; n < 3000; ++n) {
    const double hand = 0.05 + 0.02 * std::sin(0.003 * n), on_top = 0.015 * std::sin(0.06 * n);
    const double now = swing.damped(hand + on_top, 60.0, 1e-3);
    if (n >= 1000) most = std::max(most, now);
  }
  CHECK(most > 0.014);
  CHECK(most < 0.025);  // and the hand's own 0.07 m/s are not damped
  // What is faster than twice the half before is not of that swing, but a hand's
  swing.stop();
  for (int n = 0; n < 1020; ++n) most = swing.damped(1e-3 * std::sin(0.06 * n), 60.0, 1e-3);
  for (int n = 0; n < 40; ++n) most = swing.damped(0.1, 60.0, 1e-3);
  CHECK(most < 2e-3);
  CHECK(most > 1e-3);
}

namespace {

/// What is damped, a second time: how long each half lasts, from the equations of contacts.md § 6.
struct told_swing {
  double mean = 0.0, half = 0.0, before = 0.0, peak = 0.0, share = 1.0;
  double most = ph::kernels::largest<double>();

  double damped(double v, double natural, double dt) {
    const double W = std::min(22.0, natural / 2.0), h = v - mean;
    mean += h * std::min(dt * W / 3.0, 1.0);
    half += dt;
    if (h * peak < 0.0 && std::abs(h) > std::abs(peak) / 4.0) {  // it comes back
      before = std::exchange(half, 0.0);
      most = 2.0 * std::abs(peak);
      peak = h;
    } else if (std::abs(h) > std::abs(peak)) {
      peak = h;
    } else {
      peak *= 1.0 - std::min(dt / 0.1, 1.0);
    }
    const double lasts = std::max(half, before), q = std::pow(std::acos(-1.0) / (W * lasts), 2);
    const double g = lasts > 0.0 ? std::clamp(4.0 / 3.0 * (q - 0.25), 0.0, 1.0) : 1.0;
    share += (g - share) * std::min(dt / 0.02, 1.0);
    if (h * v <= 0.0) return 0.0;
    return std::copysign(std::min({std::abs(h), std::abs(v), most}), v) * share;
  }
};

}  // namespace

TEST_CASE("what is damped of any motion is told tick by tick by the halves so far", "[contact]") {
  ph::laws::samples random(5);
  const std::array<double, 6> ticks{0.0, 1e-3, 4e-3, 0.015, 0.05, 0.2};
  double some = 0.0;
  for (int run = 0; run < 60; ++run) {
    ph::swing<double> swing;
    told_swing told;
    const double natural = run % 3 == 0 ? 10.0 : run % 3 == 1 ? 40.0 : 100.0;
    const int lasts = 1 + run % 50;
    double v = 0.0;
    for (int n = 0; n < 400; ++n) {
      if (n % lasts == 0 || run % 7 == 0) v = random.number<double>();
      const double dt = run % 5 == 0 ? ticks[static_cast<std::size_t>(n) % ticks.size()] : 1e-3;
      const double now = swing.damped(v, natural, dt);
      REQUIRE_THAT(now, WithinAbs(told.damped(v, natural, dt), 1e-12));
      some += std::abs(now) > 0.01 && std::abs(now) < 0.99 * std::abs(v) ? 1.0 : 0.0;
    }
    swing.stop();
    CHECK(swing.damped(3.0, natural, 1e-3) == 3.0);
  }
  CHECK(some > 1000.0);
}

TEST_CASE("two news between two ticks are one", "[contact]") {
  auto model = touching(ph::eased{damper});
  REQUIRE(model.update({0.0, 1.0, 1000.0}));
  (void)model.tick(1e-3, 1ms);
  (void)model.tick(-1e-3, 1ms);
  REQUIRE(model.update({5e-3, 1.0, 1000.0}));
  REQUIRE(model.update({6e-3, 1.0, 2000.0}));
  CHECK_THAT(model.tick(-1e-3, 1ms).force, WithinRel(1.0, 1e-9));
}

TEST_CASE(
    "the wall of a slider that is told on its other side is not met with the force of the first",
    "[contact]") {
  const auto pressed = [](double other) {
    auto model = touching(ph::eased{damper});
    REQUIRE(model.update({0.0, 1.0, 1000.0}));
    double force = model.tick(1e-3, 1ms).force;
    for (int n = 0; n < 200; ++n) force = model.tick(-2e-3, 1ms).force;
    CHECK_THAT(force, WithinRel(2.0, 1e-9));
    REQUIRE(model.update({other, -1.0, 1000.0}));
    return model;
  };
  auto beyond = pressed(2e-3);  // which is not touched
  for (int n = 0; n < 200; ++n) CHECK(beyond.tick(-2e-3, 1ms).force == 0.0);
  auto over = pressed(-3e-3);  // which is 1 mm deep
  double last = 0.0;
  for (int n = 0; n < 200; ++n) {
    const double force = over.tick(-2e-3, 1ms).force;
    CHECK(force <= 0.0);
    CHECK(last - force <= 0.05 + 1e-12);
    last = force;
  }
  CHECK_THAT(last, WithinRel(-1.0, 1e-9));
}

TEST_CASE("a small ball that is told to be softer does not turn its force round", "[contact]") {
  using ball = ph::sphere<d3>;
  auto model = touching<ball>(ph::eased{ph::damped_spring{.mass = 1.0}});
  d3::vector x(0, 0, 1e-4), last = d3::zero();
  REQUIRE(model.update(ball{{0, 0, -3e-3}, 3e-3, 5000.0}));
  for (int n = 0; n < 400; ++n) {
    if (n < 110) x(2) -= 1e-5;
    // 5 N that a ball of 400 N/m has 12.5 mm deep, four times its radius
    if (n == 200) REQUIRE(model.update(ball{{0, 0, -3e-3}, 3e-3, 400.0}));
    const d3::vector force = model.tick(x, 1ms).force;
    if (n > 110) REQUIRE((force - last).norm() <= 0.05 + 1e-9);
    last = force;
  }
  CHECK(last(2) > 0.3);
}

TEST_CASE("a thin body that is told to be softer and elsewhere does not turn its force at once",
          "[contact]") {
  using thin = ph::quadric<d3>;
  auto model = touching<thin>(ph::eased{ph::damped_spring{.mass = 1.0}});
  const auto told = [](const d3::coordinates& p, const d3::coordinates& n, double K) {
    return thin{.point = p, .normal = n, .stiffness = K, .thickness = 3e-3};
  };
  d3::vector x(0, 0, 1e-4), last = d3::zero();
  REQUIRE(model.update(told({0, 0, 0}, {0, 0, 1}, 5000.0)));
  for (int n = 0; n < 400; ++n) {
    if (n < 110) x(2) -= 1e-5;
    // 5 N is 10 mm of 500 N/m; the body lies to the side of the device now, which does not touch it
    if (n == 200) REQUIRE(model.update(told({-1e-3, 0, 0}, {1, 0, 0.1}, 500.0)));
    const d3::vector force = model.tick(x, 1ms).force;
    if (n > 110) REQUIRE((force - last).norm() <= 0.05 + 1e-9);
    last = force;
  }
}

TEST_CASE("news of a contact that fades begin with the force that there is", "[contact]") {
  auto model = touching(ph::eased{damper});
  REQUIRE(model.update({0.0, 1.0, 500.0}));
  (void)model.tick(1e-3, 1ms);
  (void)model.tick(-2e-3, 1ms);
  model.source().release();
  double force = 1.0;
  for (int n = 0; n < 25; ++n) force = model.tick(-2e-3, 1ms).force;
  CHECK(force < 0.6);
  REQUIRE(model.update({0.0, 1.0, 500.0}));
  CHECK_THAT(model.tick(-2e-3, 1ms).force, WithinAbs(force, 0.051));
}

TEST_CASE("the local model is where its force says, while it follows", "[contact]") {
  auto model = touching(ph::eased{damper});
  REQUIRE(model.update({0.0, 1.0, 1000.0}));
  (void)model.tick(1e-3, 1ms);
  (void)model.tick(-1e-3, 1ms);
  REQUIRE(model.update({2e-3, 1.0, 1000.0}));
  for (int n = 0; n < 20; ++n) {
    const auto out = model.tick(-1e-3, 1ms);
    REQUIRE(out.depth < 3e-3);
    CHECK_THAT(out.force, WithinRel(1000.0 * out.depth, 1e-9));
    CHECK_THAT(model.local().at(-1e-3).depth, WithinRel(out.depth, 1e-9));
  }
}

TEST_CASE("what has been let go is met at once, whatever it lagged by", "[contact]") {
  auto model = touching(ph::eased{damper});
  REQUIRE(model.update({-1.0, 1.0, 1000.0}));
  (void)model.tick(0.0, 1ms);
  REQUIRE(model.update({2e-3, 1.0, 1000.0}));  // appears 2 mm above the device
  CHECK(model.tick(0.0, 1ms).force == 0.0);
  CHECK(model.tick(0.0, 1ms).force < 0.11);
  CHECK(model.tick(3e-3, 1ms).force == 0.0);
  CHECK_THAT(model.tick(0.0, 1ms).force, WithinRel(2.0, 1e-9));
}

TEST_CASE("a triangle that comes over a device is not taken for one that was there", "[contact]") {
  ph::local_model model{d3{},
                        ph::followed<ph::triangle<d3>>{},
                        ph::turn_at_once{},
                        ph::eased{damper},
                        thesis_ledger(),
                        ph::no_bound{},
                        thesis_loop};
  const d3::vector here(0.005, 0.005, -2e-3);
  const auto at_x = [](double x) {
    return ph::triangle<d3>{
        .a = {x, 0, 0}, .b = {x + 0.02, 0, 0}, .c = {x, 0.02, 0}, .stiffness = 1000};
  };
  REQUIRE(model.update(at_x(1.0)));
  for (int n = 0; n < 5; ++n) CHECK(model.tick(here, 1ms).force == d3::zero());
  REQUIRE(model.update(at_x(0.0)));
  CHECK(model.tick(here, 1ms).force.norm() < 0.051);
  for (int n = 0; n < 400; ++n) (void)model.tick(here, 1ms);
  CHECK_THAT(model.tick(here, 1ms).force.norm(), WithinRel(2.0, 1e-9));
}

TEST_CASE("news go on for no longer because samples are lost", "[contact]") {
  const auto felt = [](int lost) {
    auto model = touching(ph::eased{damper});
    for (int n = 0; n < 331; ++n) {  // rises by 10 mm/s, and is told so at 30 Hz
      if (n % 33 == 0) REQUIRE(model.update({1e-5 * n, 1.0, 1000.0}));
      (void)model.tick(-1e-3, 1ms);
    }
    for (int n = 0; n < lost; ++n) (void)model.tick(std::nan(""), 1ms);
    const double before = model.tick(-1e-3, 1ms).force;
    double after = before;
    for (int n = 0; n < 20; ++n) after = model.tick(-1e-3, 1ms).force;
    return after - before;
  };
  CHECK(felt(0) > 0.1);
  CHECK(felt(100) < 0.01);  // it has been told nothing for so long that it may have stopped
}

TEST_CASE("what was stated of a surface is forgotten at a reset and with what is refused",
          "[contact]") {
  auto model = touching(ph::eased{damper}, {.stale_after = 10.0});
  const ph::surface_motion<d1> rising{.velocity = 0.05, .age = 0.02};
  for (const bool reset : {true, false}) {
    REQUIRE(model.update({0.0, 1.0, 1000.0}, rising));
    if (reset) model.reset();
    REQUIRE(model.update({0.0, 1.0, 1000.0}));  // as a world that states no motion
    (void)model.tick(1e-3, 1ms);
    double last = 0.0;
    for (int n = 0; n < 30; ++n) last = model.tick(-1e-3, 1ms).force;
    CHECK_THAT(last, WithinRel(1.0, 1e-12));
  }
}

TEST_CASE("a contact that begins anew is damped from the first tick on", "[contact]") {
  // A hand that moves for half a second at one speed is not damped any more; the next contact is.
  auto law = at<d1>(ph::eased{damper});
  law.adopt(1000.0, 1e-3, 0);
  for (int n = 0; n < 500; ++n) (void)law.swinging(0.02, 1e-3);
  CHECK(law.swinging(0.02, 1e-3) < 0.002);
  law.let_go();
  CHECK(law.swinging(0.02, 1e-3) == 0.02);
}

namespace {

/// A contact with an eased law a second time, as its rules say (lag.hpp, docs/design/contacts.md § 6): the depth in what
/// follows the news, the normal that turns towards theirs, and what each leaves for the next tick.
template <class Surface>
struct plainly {
  using motion = ph::surface_motion<d3>;
  static constexpr double T = 1e-3;
  ph::freshness rule;
  ph::news_pace pace{};
  double rate;  // of the normal [rad/s]
  ph::part_at<eased_damper, d3> law;
  ph::lag<double> lag{};
  ph::turning<d3> turn{};
  Surface newest{}, before{}, own{};  // what is followed, the same a tick ago, and where it is felt
  motion told{};
  d3::vector heard_at = d3::zero();
  bool heard = false, gone = false, news = false, refused = false, beside = false;
  bool together = true;  // what is felt is the newest
  double age = 0.0, last_weight = 0.0;

  [[nodiscard]] double weight() const {
    if (!heard) return 0.0;
    const double fades = gone ? age : std::max(0.0, age - rule.stale_after);
    return std::max(0.0, 1.0 - fades / rule.fade);
  }
  bool update(Surface next, const motion* how = nullptr) {
    const bool younger = how && (news ? how->age <= told.age + T : lag.follows(how->age, T));
    if (how && (!how->is_usable() || (heard && !younger))) {
      refused = true;
      return false;
    }
    if (!news) before = newest;
    told = {};
    if (!next.prepare()) {
      refused = true;
      return false;
    }
    if (!heard) own = next;
    together = !heard;
    newest = next;
    heard = news = true;
    gone = false;
    age = 0.0;
    if (how) told = *how;
    return true;
  }
  void release() {
    if (!heard || gone) return;
    age = (1.0 - weight()) * rule.fade;
    gone = true;
  }
  void lose(double dt) {
    lag.grow_older(dt);
    age += dt;
  }
  void vanish() {  // without forces what there is is news
    news = heard;
    last_weight = 0.0;
  }
  void hear(const d3::vector& x, double depth) {
    const auto was = before.at(x);
    const bool known = last_weight > 0.0 && was.covered();
    const auto law_before = law;
    law.adopt(newest.stiffness, T, 0);
    double felt = known ? was.depth - lag.offset() : 0.0;
    if (felt > 0.0 && (last_weight != 1.0 || law.stiffness() != law_before.stiffness())) {
      felt = law.depth(last_weight * law_before.force(felt, 0.0), 0.0);  // keeps its force
    }
    const d3::vector outward = newest.at(x).outward();
    turn.hear(known ? d3::vector(outward - was.outward()) : d3::zero(), lag.between(told.age));
    lag.hear(felt, depth, known ? depth - was.depth : 0.0, law.depth(1.0, 0.0), law.pace(),
             {told.velocity ? outward.dot(d3::vector(*told.velocity)) : 0.0, told.age,
              told.velocity.has_value(), (x - heard_at).norm()});
    heard_at = x;
    told = {};
  }
  /// The force [N], at most `most` [N], and the depth that is felt [m].
  std::pair<d3::vector, double> tick(const d3::vector& x, const d3::vector& v, double dt,
                                     double most) {
    const auto here = newest.at(x);
    const d3::vector goal = here.outward();
    double depth = here.depth;
    lag.grow_older(dt);
    if (news || !lag.settled() || !turn.still()) {
      if (!lag.settled()) lag.follow(dt);
      if (lag.silent()) turn.stop();
      if (news) hear(x, here.depth);
      depth = here.depth - lag.offset();
      if (depth <= 0.0 && here.depth <= 0.0) {
        turn.stop();
        lag.let_go();
        depth = here.depth;
      }
    }
    if (!news) age += dt;
    double present = weight();
    if (const double whole = law.force(depth, 0.0); heard && present < 1.0 && whole > 0.0) {
      present = std::max(present, last_weight - pace.most_force_rate * dt / whole);
    }
    const bool behind = present > 0.0 && depth > 0.0, touched = behind && here.covered();
    bool in_own = touched && !std::exchange(beside, behind && !touched);
    if (!together) in_own = own.at(x).depth > 0.0 && own.at(x).covered();
    in_own = in_own && last_weight > 0.0;

    d3::vector normal = goal;
    if (in_own && !together) {
      d3::vector from = own.at(x).outward();
      if (lag.taking_on()) from = turn.turned(from, dt);
      const double pressed = law.force(depth, 0.0), calm = 0.5 * pace.usual_force_rate * dt;
      const double angle = std::max(rate * dt, pressed > 2.0 * calm ? calm / pressed : 0.5);
      const auto limited = at<d3>(ph::turn_limited{.rate = 1.0});
      normal = limited.step_by(from, turn.turned(goal, lag.taken_on()), angle);
    }
    double force = 0.0, felt = 0.0, speed = v.dot(normal);
    if (touched) {
      speed = law.swinging(speed, dt);
      force = present * law.force(depth, speed);
      felt = depth;
    } else {
      law.let_go();
    }
    const bool cut = force > most;
    if (cut) felt = law.depth(force = most, speed);
    const bool follows = touched && (!lag.settled() || !turn.still() || normal != goal);
    if (cut || follows) {
      own = (in_own ? own : newest).toward(newest, x, normal, felt);
      together = false;
    } else {
      own = newest;
      together = true;
    }
    news = refused = false;
    last_weight = present;
    return {normal * force, felt};
  }
};

/// Tries a contact against its twin under a device that presses and leaves, and a world that heaves, tilts, jumps,
/// stiffens, falls silent and states its motion, now and then wrongly. `shape`(height, normal, K) is its surface. On a
/// grid it stands on whole steps of 2⁻¹² m, and so does the device.
template <class Surface>
int tries(unsigned seed, const auto& bound, double most, bool on_grid, const auto& shape) {
  ph::laws::samples random(seed);
  const auto some = [&](double size) { return size * random.number<double>(); };
  const ph::freshness rule{.stale_after = 0.06, .fade = 0.03};
  const double rate = seed % 3 == 0 ? 1000.0 : 2.0, soft = seed % 4 == 0 ? 0.02 : 1.0;
  const ph::eased law{ph::damped_spring{.mass = 0.1, .force_limit = seed % 2 == 0 ? 3.0 : 1e9}};
  ph::local_model model{d3{},       ph::followed<Surface>{rule}, ph::turn_limited{.rate = rate},
                        law,        ph::no_observer{},           bound,
                        thesis_loop};
  plainly<Surface> twin{.rule = rule, .rate = rate, .law = at<d3>(law)};
  d3::vector x(0, 0, 0.001), last = x;
  bool seen = false;
  double K = 800.0, jump = 0.0;
  int pressed = 0;
  const auto step = [&](double z) { return on_grid ? 0x1p-12 * std::round(z * 0x1p12) : z; };
  for (int n = 0; n < 1500; ++n) {
    const double t = 1e-3 * n;
    CAPTURE(seed, on_grid, n);
    const int every = n % 500 < 300 ? 33 : 90;
    if (n % 1122 == 1121) {
      model.reset();
      twin = {.rule = rule, .rate = rate, .law = twin.law};
      twin.law.let_go();
      seen = false;
    }
    for (int again = 0; again < (n % every == 0 ? 1 + n / every % 2 : 0); ++again) {
      if (n / every % 5 == 4) K = 1500.0 + some(1200.0);
      if (n / every % 7 == 6) jump = some(1e-3);
      const double w = 9.0, height = step(jump + 1e-3 * std::sin(w * t));
      d3::vector tilted(0.3 * std::sin(3.0 * t), 0.2 * std::cos(2.0 * t) + some(0.01), 1.0);
      if (n / every % 6 == 5) tilted += random.vector<d3>() * 0.9;
      if (on_grid) tilted = d3::vector(0, 0, 1);
      const Surface next =
          shape(height, tilted, n / every % 11 == 10 && again == 0 ? 0.0 : soft * K);
      double age = 0.02 + some(0.02);
      if (again == 1) age = twin.told.age + 0.5e-3 * (n / every % 4);
      if (n / every % 13 >= 11) age = n / every % 13 == 12 ? std::nan("") : 0.2;
      const ph::surface_motion<d3> how{
          .velocity = n / every % 3 == 0 ? std::optional<d3::coordinates>{}
                                         : d3::coordinates(some(0.01), 0.0, 9e-3 * std::cos(w * t)),
          .age = age};
      if ((n / every + again) % 4 == 3) {
        REQUIRE(model.update(next) == twin.update(next));
      } else {
        REQUIRE(model.update(next, how) == twin.update(next, &how));
      }
    }
    if (n % 230 == 229) {
      model.source().release();
      twin.release();
    }
    const double dt = n % 9 == 8 ? 0.7e-3 : 1e-3;
    if (n % 101 > 97) {
      (void)model.tick(d3::vector::Constant(std::nan("")), ph::seconds{dt});
      twin.lose(dt);
      seen = false;
      continue;
    }
    if (n % 283 == 282) {
      model.enable_forces(false);
      (void)model.tick(x, ph::seconds{dt});
      twin.lose(dt);
      twin.vanish();
      model.enable_forces(true);
      twin.vanish();
      seen = false;
      continue;
    }
    x = d3::vector(2e-3 * std::sin(5.0 * t), 2e-3 * std::cos(4.0 * t),
                   0.5e-3 - 2e-3 * std::sin(n % 600 < 300 ? 20.0 * t : 1.0)) +
        random.vector<d3>() * 2e-6;
    x(2) = step(x(2));
    const auto out = model.tick(x, ph::seconds{dt});
    const d3::vector v = seen ? d3::vector((x - last) / dt) : d3::zero();
    const bool refused = twin.refused;
    const auto [force, depth] = twin.tick(x, v, dt, most);
    CAPTURE(out.force, force, depth);
    REQUIRE((d3::vector(out.force) - force).norm() <= 1e-9);
    REQUIRE_THAT(out.depth, WithinAbs(depth, 1e-12));
    const bool stale = twin.heard && !twin.gone && twin.age > rule.stale_after;
    CHECK(out.what == (stale         ? ph::event::stale_target
                       : refused     ? ph::event::rejected_target
                       : !twin.heard ? ph::event::no_target
                                     : ph::event::nominal));
    REQUIRE((d3::vector(model.local().at(x).outward()) - twin.own.at(x).outward()).norm() <= 1e-9);
    REQUIRE_THAT(model.local().at(x).depth, WithinAbs(twin.own.at(x).depth, 1e-12));
    const auto here = twin.newest.at(x);
    if (const auto e = model.explain(); force.norm() > 0.0 && force.norm() < 0.9 * most) {
      const bool touched = twin.weight() > 0.0 && here.depth > 0.0 && here.covered();
      const bool all = touched && e.force > 0.95 * twin.law.stiffness() * here.depth;
      const bool lags = !twin.lag.settled() || !twin.turn.still();
      CHECK(e.now == (!touched || all       ? ph::softened_by::nothing
                      : twin.weight() < 1.0 ? ph::softened_by::silence
                      : lags                ? ph::softened_by::news
                                            : ph::softened_by::nothing));
    }
    pressed += force.norm() > 0.1 * soft ? 1 : 0;
    last = x;
    seen = true;
  }
  return pressed;
}

}  // namespace

TEST_CASE("an eased contact is what its rules say, whatever is told of its surface", "[contact]") {
  const auto plane = [](double height, const d3::vector& n, double K) {
    return ph::half_space<d3>{{0, 0, height}, n, K};
  };
  const auto triangle = [](double height, const d3::vector& n, double K) {
    const auto corner = [&](double x, double y) -> d3::coordinates {
      return {x, y, height - (n(0) * x + n(1) * y) / n(2)};
    };
    return ph::triangle<d3>{
        .a = corner(-2e-3, -2e-3), .b = corner(4e-3, 0), .c = corner(-2e-3, 3e-3), .stiffness = K};
  };
  const ph::thermal_limit cool{
      .peak = 1e9, .continuous = 1e9, .time_constant = 1.0};  // has a state
  for (unsigned seed = 1; seed < 7; ++seed) {
    for (const bool on_grid : {false, true}) {
      const ph::actuator_limit weak{.most = 1.0};
      CHECK(tries<ph::half_space<d3>>(seed, weak, 1.0, on_grid, plane) > 200);
      CHECK(tries<ph::half_space<d3>>(seed, cool, 1e9, on_grid, plane) > 200);
      CHECK(tries<ph::triangle<d3>>(seed, cool, 1e9, on_grid, triangle) > 100);
    }
  }
}
