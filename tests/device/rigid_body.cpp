// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/device/rigid_body.hpp>
#include <passive_haptics/device/stylus.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/port/passive_port.hpp>

#include <chrono>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
namespace ph = passive_haptics;
using namespace std::chrono_literals;

namespace {

using body = ph::rigid_body<double>;
using pen = ph::stylus<double>;
using vec3 = body::triple;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

static_assert(ph::port<body> && ph::port<pen> && ph::port<ph::rigid_body<float>>);
static_assert(std::is_trivially_copyable_v<body::pose>);
static_assert(sizeof(ph::device_sample<body>) ==
              sizeof(body::pose) + sizeof(body::coordinates) + 2 * sizeof(double));

[[nodiscard]] body::pose at(const vec3& p, const vec3& turn) {
  return {p, ph::rotation::exp<double>(turn)};
}

/// A port that lets everything pass, so that only its guard is asked.
template <class P>
[[nodiscard]] auto guarded(const ph::loop_limits& limits) {
  return ph::passive_port{P{}, ph::given_force{}, ph::no_observer{}, ph::no_bound{}, limits};
}

}  // namespace

TEST_CASE(
    "a rigid body's motion is (Δp, θ) in the world frame, whatever the sign of its quaternion",
    "[rigid_body]") {
  const body::pose from = at({0.1, 0.2, 0.3}, {0.4, -0.5, 0.6});
  const body::motion by = body::join({1e-3, -2e-3, 3e-3}, {0.01, 0.02, -0.03});
  body::pose to = body::moved(from, by);
  CHECK((body::between(from, to) - by).norm() < 1e-15);
  to.orientation = {-to.orientation.w, -to.orientation.x, -to.orientation.y, -to.orientation.z};
  CHECK((body::between(from, to) - by).norm() < 1e-15);
  CHECK(body::between(from, from) == body::zero());

  const auto drifted = [](ph::quaternion<double> q, double s) {
    return ph::quaternion<double>{q.w * s, q.x * s, q.y * s, q.z * s};
  };
  to.orientation = drifted(to.orientation, 1.0008);
  CHECK((body::between(from, to) - by).norm() < 1e-15);

  const body::effort w = body::join({1, 2, 3}, {0.1, 0.2, 0.3});
  CHECK_THAT(body::work(w, by).joules, WithinAbs(6e-3 - 4e-3, 1e-17));
  CHECK(body::linear(w) == vec3(1, 2, 3));
  CHECK(body::angular(w) == vec3(0.1, 0.2, 0.3));
}

TEST_CASE("a radian counts as 0.1 m for the guard, and what is no number stays none",
          "[rigid_body]") {
  CHECK(body::squared(body::join({3, 4, 0}, {0, 0, 1})) == 25.0);
  CHECK_THAT(body::squared(body::join({0, 0, 0.1}, {0, 2, 0})), WithinRel(0.04));
  CHECK(std::isnan(body::squared(body::join({not_a_number, 0, 0}, {0, 9, 0}))));
  CHECK(std::isnan(body::squared(body::join({1, 0, 0}, {0, not_a_number, 0}))));
}

TEST_CASE("of a motion from or to what is no rotation the way is known and the turn is no number",
          "[rigid_body]") {
  const body::pose right{{1, 2, 3}, {1, 0, 0, 0}}, wrong{{2, 4, 7}, {0.5, 0, 0, 0}};
  const auto turn_is_none = [](const body::motion& m) {
    const body::triple turn = body::angular(m);
    return std::isnan(turn(0)) && std::isnan(turn(1)) && std::isnan(turn(2));
  };
  for (const body::motion& m : {body::between(right, wrong), body::between(wrong, right)}) {
    CHECK(body::linear(m).cwiseAbs() == body::triple(1, 2, 4));
    CHECK(turn_is_none(m));
  }
  CHECK(turn_is_none(body::between(wrong, wrong)));
}

TEMPLATE_TEST_CASE("a pose that is no rotation is refused, the first sample too", "[rigid_body]",
                   body, pen) {
  using P = TestType;
  const typename P::effort wanted = P::zero();
  const auto tilted = at({0, 0, 0}, {0, 0, 0.3});
  for (const auto& bad :
       {ph::quaternion<double>{0.5, 0, 0, 0}, ph::quaternion<double>{0, 0, 0, 0},
        ph::quaternion<double>{1, not_a_number, 0, 0}, ph::quaternion<double>{1, 1, 0, 0}}) {
    auto device = guarded<P>({.longest_tick = 1e-3});
    const typename P::pose wrong{{0, 0, 0}, bad};
    CHECK(device.tick(wrong, 1ms, wanted).what == ph::event::rejected_sample);
    CHECK_FALSE(device.has_position());
    CHECK(device.tick(tilted, 1ms, wanted).what == ph::event::nominal);
    CHECK(device.tick(wrong, 1ms, wanted).what == ph::event::rejected_sample);
    CHECK(device.tick(tilted, 1ms, wanted).what == ph::event::nominal);
  }
  for (const double lost : {not_a_number, std::numeric_limits<double>::infinity()}) {
    auto device = guarded<P>({.longest_tick = 1e-3});
    const typename P::pose nowhere{{0, lost, 0}, {}};
    CHECK(device.tick(nowhere, 1ms, wanted).what == ph::event::rejected_sample);
  }
}

TEST_CASE("a loop that trusts its samples gets over a pose that is no rotation", "[rigid_body]") {
  ph::passive_port device{body{}, ph::given_force{}, ph::no_observer{}, ph::no_bound{},
                          ph::trusted_loop_limits<>{.longest_tick = 1e-3}};
  const body::effort push = body::join({1, 0, 0}, {0, 0, 0});
  CHECK(device.tick({}, 1ms, push).force == push);
  static_cast<void>(device.tick({{0, 0, 0}, {0.2, 0, 0, 0}}, 1ms, push));
  static_cast<void>(device.tick({}, 1ms, push));
  CHECK(device.tick({}, 1ms, push).force == push);
}

TEST_CASE("the guard knows a body's place and how fast it turns", "[rigid_body]") {
  auto device = guarded<body>({.longest_tick = 1e-3, .top_speed = 5.0, .workspace = 0.5});
  const body::effort wanted = body::zero();
  CHECK(device.tick(at({0.4, 0, 0}, {0, 0, 0}), 1ms, wanted).what == ph::event::nominal);
  CHECK(device.tick(at({0.4, 0, 0}, {0, 0.049, 0}), 1ms, wanted).what == ph::event::nominal);
  CHECK(device.tick(at({0.4, 0, 0}, {0, 0.10, 0}), 1ms, wanted).what == ph::event::rejected_sample);
  auto other = guarded<body>({.longest_tick = 1e-3, .workspace = 0.5});
  CHECK(other.tick(at({0.6, 0, 0}, {0, 0, 0}), 1ms, wanted).what == ph::event::outside_workspace);
}
