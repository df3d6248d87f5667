// SPDX-License-Identifier: BSD-3-Clause
// The mock Falcon whole: driver, wire, arms. What runs on it is in wall.cpp and latency.cpp.
#include "support/catch.hpp"
#include "support/falcon_loop.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>

extern "C" bool falcon_tick(unsigned char b, const float force[3], unsigned char out[16]);

namespace {

using sim::random_source;
using namespace std::chrono_literals;

/// Pulls the grip out, pushes it in, and comes to rest in the middle; then still for ever.
struct homing_hand {
  sim::stroke<d3> out{{0, 0, 0.125}, {0, 0, 0.163}, 0.1, 0.4};
  sim::stroke<d3> in{{0, 0, 0.163}, {0, 0, 0.088}, 0.6, 0.5};
  sim::stroke<d3> back{{0, 0, 0.088}, {0.004, -0.006, 0.12}, 1.2, 0.4};

  [[nodiscard]] d3::vector force(double t, const d3::vector& x,
                                 const d3::vector& v) const noexcept {
    const auto& now = t < 0.55 ? out : t < 1.15 ? in : back;
    return 800.0 * (now.position(t) - x) + 15.0 * (now.velocity(t) - v);
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

constexpr mock_parameters ready{.runs = true, .homed = true};

falcon::point<double> truth(const auto& body) {
  return {{body.position()[0], body.position()[1], body.position()[2]}};
}

}  // namespace

TEST_CASE("the mock is homed by hand, and its encoders jump when it is", "[falcon][mock]") {
  using hand = homing_hand;
  falcon_device<hand> device{3500.0, {}, mock_parameters{.runs = true}, hand{}};
  REQUIRE(device.open());
  REQUIRE(device.start());
  CHECK(device.where() == falcon::state::unhomed);
  const auto before = device.line().peer().mechanism().encoder();
  CHECK(before == falcon::leg_words{});  // power-up is its zero

  int forces = 0;
  bool jumped = false;
  falcon::leg_words last{};
  const auto watch = [&](const auto& now) {
    forces += now.sent.motor != falcon::leg_words{};
    const auto shown = device.line().peer().mechanism().encoder();
    jumped = jumped || std::abs(shown[0] - last[0]) > 150;
    last = shown;
    return true;
  };
  REQUIRE(device.home(5s, watch));
  CHECK(device.where() == falcon::state::homed);
  CHECK(jumped);
  CHECK(forces == 0);

  const auto sample = device.exchange(d3::zero());
  REQUIRE(sample.valid);
  CHECK((d3::vector(sample.position) - body_of(device).position()).norm() < 1e-3);
  CHECK_FALSE([&] {  // an unhomed one does not home by waiting
    falcon_device<sim::no_hand<d3>> still{3500.0, {}, mock_parameters{.runs = true}};
    return still.open() && still.start() && still.home(2s);
  }());
}

TEST_CASE("counts in, words out: force and position go through the whole chain", "[falcon][mock]") {
  mock_parameters setup = ready;
  setup.body.damping = 20.0;  // it hardly moves
  falcon_device<sim::no_hand<d3>> device{3500.0, {}, setup};
  REQUIRE(make_ready(device));
  random_source random(22);
  for (int n = 0; n < 200; ++n) {
    const d3::vector f = random.direction<d3>() * 3.0;
    (void)device.exchange(f);
    const auto& arms = device.line().peer().mechanism();
    const auto at = truth(arms.body());
    const auto pushed = falcon::force_from(falcon::rates(at, arms.theta()), arms.torque());
    const auto sample = device.exchange(d3::zero());
    REQUIRE(sample.valid);
    // Half a count of each motor, and the pose as the encoders show it.
    REQUIRE((d3::vector(pushed[0], pushed[1], pushed[2]) - f).norm() < 0.03);
    REQUIRE((d3::vector(sample.held) - f).norm() < 0.03);
    REQUIRE(falcon::norm(truth(arms.body()) - device.latest().position) < 4e-4);
  }
}

TEST_CASE("a force is held from its packet on, and the sample that shows it is the next but one",
          "[falcon][mock]") {
  mock_parameters setup = ready;
  setup.body.damping = 20.0;
  falcon_device<sim::no_hand<d3>> device{3500.0, {}, setup};
  REQUIRE(make_ready(device));
  const d3::vector f(0.0, 0.0, 2.0);
  CHECK(d3::vector(device.exchange(d3::zero()).held).norm() == 0.0);
  CHECK(d3::vector(device.exchange(f).held).norm() == 0.0);  // its packet: begins to be held
  CHECK((d3::vector(device.exchange(d3::zero()).held) - f).norm() < 0.02);  // was held
  CHECK(d3::vector(device.exchange(d3::zero()).held).norm() == 0.0);
}

TEST_CASE("an unplugged mock goes on pushing, a plugged one stops when told", "[falcon][mock]") {
  falcon_device<sim::no_hand<d3>> device{3500.0, {}, ready};
  REQUIRE(make_ready(device));
  (void)device.exchange(d3::vector(0, 0, 2));
  auto& box = device.line().peer();
  const auto held = box.mechanism().words();
  CHECK(held != falcon::leg_words{});
  box.unplug();
  CHECK_FALSE(device.exchange(d3::vector(0, 0, 2)).valid);
  CHECK(device.latest().what == falcon::code::unplugged);
  CHECK(box.mechanism().words() == held);  // nothing can be done from here
  box.plug_in();
  REQUIRE(device.open());
  REQUIRE(device.start());
  CHECK(box.mechanism().words() == falcon::leg_words{});
}

TEST_CASE("the mock repeats itself to the last bit", "[falcon][mock]") {
  const auto run = [] {
    falcon_device<sim::tapping_hand<d3>> device{
        3500.0, {}, ready, sim::tapping_hand<d3>{{0, 0, 0.12}, {0, 0, 1}}};
    REQUIRE(make_ready(device));
    for (int n = 0; n < 300; ++n) (void)device.exchange(d3::vector(0.5, 0.1, n % 5));
    return std::pair(d3::vector(body_of(device).position()), body_of(device).meter().value());
  };
  CHECK((run() == run()));
}

TEST_CASE("the tick for microcontrollers commands what the driver does", "[falcon][mock]") {
  random_source random(23);
  int compared = 0;
  for (int n = 0; n < 2000; ++n) {
    const d3::vector p = d3::vector(0, 0, 0.125) + random.direction<d3>() * 0.03;
    const d3::vector f = random.direction<d3>() * 5.0;
    const auto counts =
        falcon::to_counts(falcon::inverse(falcon::point<double>{{p[0], p[1], p[2]}}).value);
    falcon::from_device reply{.homed = n % 10 == 0 ? falcon::byte(3) : falcon::byte(7)};
    for (std::size_t i = 0; i < 3; ++i) reply.encoder[i] = static_cast<std::int16_t>(counts[i]);
    const float wanted[3] = {float(f[0]), float(f[1]), float(f[2])};
    falcon::packet_bytes out{};
    for (const auto b : falcon::encode(reply)) {
      if (!falcon_tick(b, wanted, out.data())) continue;
      const auto answer = falcon::decode<falcon::to_device>(out);
      REQUIRE(answer);
      falcon::dac_words words{};
      if (reply.is_homed()) {
        const auto pose = falcon::forward(falcon::to_angles<double>(counts));
        const auto tau = falcon::torques_for(pose.rates, falcon::force<double>{{f[0], f[1], f[2]}});
        words = falcon::encode(tau, 3500.0);
      }
      for (std::size_t i = 0; i < 3; ++i) REQUIRE(std::abs(answer->motor[i] - words[i]) <= 1);
      ++compared;
    }
  }
  CHECK(compared == 2000);
}
