// SPDX-License-Identifier: BSD-3-Clause
// Motors that hold more for a while than for ever: the mean square is never above the continuous force's.
#include "force_bound/upkeep.hpp"
#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/thermal_limit.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr ph::thermal_limit touch{.peak = 3.3, .continuous = 0.88, .time_constant = 2.0};

/// Its own account of the winding, from what is let through.
struct winding {
  double time_constant = 2.0, mean_square = 0.0;
  void hold(double f, double dt) {
    mean_square += (f * f - mean_square) * dt / (time_constant + dt);
  }
};

}  // namespace

TEST_CASE("thermal_limit obeys the laws of bounds that reduce", "[bound][law]") {
  CHECK(broken_laws<d1, f1, f3>(touch).empty());
  CHECK(broken_laws<d1>(ph::thermal_limit{.peak = 3.0, .continuous = 3.0}).empty());
}

TEST_CASE("a motor gives its peak when it is cold and its continuous force for ever", "[bound]") {
  auto limit = at<d1>(touch);
  situation<d1> now;
  winding copper;
  double first_less = 0.0, least = 9.0, biggest_drop = 0.0, last = 3.3;
  for (int n = 0; n < 20000; ++n) {
    const double f = allowed(limit, 5.0, now);
    copper.hold(f, 1e-3);
    REQUIRE(copper.mean_square <= 0.88 * 0.88 * (1 + 1e-12));
    if (first_less == 0.0 && f < 3.3) first_less = n * 1e-3;
    biggest_drop = std::max(biggest_drop, last - f);
    last = f;
    least = std::min(least, f);
  }
  CHECK(first_less > 0.05);  // (0.88/3.3)² of the winding's time is 0.14 s
  CHECK_THAT(last, WithinRel(0.88, 1e-3));
  CHECK(least >= 0.88);
  CHECK(biggest_drop < 0.1);  // eased down, not dropped
  CHECK_THAT(limit.warmth(), WithinAbs(1.0, 1e-2));
  for (int n = 0; n < 10000; ++n) (void)allowed(limit, 0.0, now);
  CHECK(allowed(limit, 5.0, now) == 3.3);  // it has cooled
}

TEST_CASE("a winding is never warmer than it may be, whatever is asked and however ticks vary",
          "[bound]") {
  ph::laws::samples random(3);
  for (const double tau : {1e-4, 0.01, 1.0}) {  // shorter than a tick, too
    auto limit = at<d1>(ph::thermal_limit{.peak = 9.0, .continuous = 2.0, .time_constant = tau});
    winding copper{tau};
    situation<d1> now;
    double hottest = 0.0, last = 0.0;
    for (int n = 0; n < 20000; ++n) {
      now.dt = 1e-3 * (0.1 + 0.45 * (1 + random.number<double>()));  // up to the longest
      copper.hold(last, now.dt);
      hottest = std::max(hottest, copper.mean_square);
      last = allowed(limit, random.number<double>() > -0.5 ? 9.0 : 0.5, now);
    }
    CAPTURE(tau);
    CHECK(hottest <= 4.0 * (1 + 1e-9));
    CHECK(hottest > 3.5);  // and what may be used is
  }
}

TEST_CASE("a motor that holds its peak for ever is an actuator_limit", "[bound]") {
  for (const double continuous : {5.0, std::numeric_limits<double>::infinity()}) {
    auto limit = at<d3>(ph::thermal_limit{.peak = 5.0, .continuous = continuous});
    const situation<d3> now;
    for (int n = 0; n < 1000; ++n) {
      REQUIRE((allowed(limit, d3::vector(6, 0, 8), now) - d3::vector(3, 0, 4)).norm() < 1e-15);
    }
    CHECK(limit.warmth() == 0.0);
  }
}

TEST_CASE("a motor that may hold nothing leaves a force of zero as it is", "[bound]") {
  const situation<d1> now;
  for (const ph::thermal_limit& p :
       {ph::thermal_limit{.peak = 0.0, .continuous = 1.0}, ph::thermal_limit{.peak = 0.0},
        ph::thermal_limit{.peak = 1.0, .time_constant = 1.0}}) {
    REQUIRE(refused(p).empty());
    auto none = at<d1>(p);
    CHECK(none.limit(0.0, now.port()).factor == 1.0);
    CHECK(none.limit(1.0, now.port()).factor == 0.0);
    CHECK(none.warmth() == 0.0);
  }
}

TEST_CASE("a reset makes a winding cold", "[bound]") {
  auto limit = at<d1>(touch);
  const situation<d1> now;
  for (int n = 0; n < 1000; ++n) (void)allowed(limit, 5.0, now);
  CHECK(limit.warmth() > 0.9);
  CHECK(allowed(limit, 5.0, now) < 1.0);
  limit.reset();
  CHECK(limit.warmth() == 0.0);
  CHECK(allowed(limit, 5.0, now) == 3.3);
}

TEST_CASE("a winding cools in the air, where nothing is asked of it", "[bound]") {
  const auto holds_again = [](const auto& bound) {
    ph::local_model wall{d1{},
                         ph::fixed{ph::half_space<d1>{0.0, 1.0, 1e3}},
                         ph::turn_at_once{},
                         ph::spring{},
                         ph::no_observer{},
                         bound,
                         ph::loop_limits{.longest_tick = 1e-3}};
    double force = 0.0;
    const auto stay = [&](double x, int ticks) {
      for (int n = 0; n < ticks; ++n) force = wall.tick(x, ph::seconds{1e-3}).force;
      return force;
    };
    CHECK(stay(-0.004, 1) == 3.3);
    CHECK(stay(-0.004, 5000) < 0.95);
    CHECK(stay(0.001, 1) == 0.0);
    CHECK(stay(-0.004, 1) < 1.1);  // still warm
    CHECK(stay(0.001, 20000) == 0.0);
    return stay(-0.004, 1);
  };
  CHECK(holds_again(touch) == 3.3);
  CHECK(holds_again(ph::bound_chain{ph::actuator_limit{.most = 9.0}, touch}) == 3.3);
}

TEST_CASE("a winding that is warmer than a new limit allows cools down to it", "[bound]") {
  ph::thermal_limit motors{.peak = 9.0, .continuous = 2.0, .time_constant = 0.1};
  auto limit = at<d1>(motors);
  const situation<d1> now;
  for (int n = 0; n < 2000; ++n) (void)allowed(limit, 9.0, now);
  CHECK_THAT(limit.warmth(), WithinAbs(1.0, 1e-3));
  motors.continuous = 1.0;
  limit.set(motors);
  CHECK_THAT(limit.warmth(), WithinAbs(4.0, 1e-2));
  double before = limit.warmth();
  for (int n = 0; n < 2000; ++n) {
    (void)allowed(limit, 9.0, now);
    CHECK(limit.warmth() <= before);
    before = limit.warmth();
  }
  CHECK_THAT(limit.warmth(), WithinAbs(1.0, 1e-3));
  CHECK_THAT(allowed(limit, 9.0, now), WithinRel(1.0, 1e-3));
}

TEST_CASE("thermal_limit takes new parameters and refuses bad ones by name", "[bound]") {
  const ph::thermal_limit first{.peak = 0.5, .continuous = 0.2, .time_constant = 0.05};
  const ph::thermal_limit weaker{.peak = 0.1, .continuous = 0.05, .time_constant = 0.05};
  const ph::thermal_limit none{.peak = -1.0};
  const ph::bound_chain chain{ph::strict_bound{}, first};
  check_upkeep(following_half_space<d1>(ph::spring{}, thesis_ledger(), chain), first, weaker, none);
  CHECK(refused(none) == "peak");
  CHECK(refused(ph::thermal_limit{.peak = 1.0, .continuous = std::nan("")}) == "continuous");
  CHECK(refused(ph::thermal_limit{.peak = 1.0, .continuous = 0.5}) == "time_constant");
  CHECK(refused(ph::thermal_limit{.peak = 1.0, .continuous = 1.0}).empty());
}
