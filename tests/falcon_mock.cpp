// SPDX-License-Identifier: BSD-3-Clause
// The mock Falcon itself: its wire, its arms, its energy. What runs on it is in falcon_wall.cpp.
#include "support/catch.hpp"
#include "support/falcon_loop.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>
#include <iostream>

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
  [[nodiscard]] ph::parameter_fault<double> check() const noexcept { return {}; }
};

constexpr falcon::mock_parameters ready{.runs = true, .homed = true};

falcon::leg_words random_words(random_source& random) {
  falcon::leg_words words{};
  for (auto& word : words) word = static_cast<std::int16_t>(random.uniform(-4095, 4095));
  return words;
}

falcon::point<double> truth(const auto& body) {
  return {{body.position()[0], body.position()[1], body.position()[2]}};
}

}  // namespace

TEST_CASE("every pose that the mock's arms can take is a good one", "[falcon][mock]") {
  const falcon::mock_parameters mock;
  CHECK_FALSE(mock.check());
  double worst = 0.0, steep = 0.0;
  const auto& [low, high] = std::pair(d3::vector(mock.body.lower), d3::vector(mock.body.upper));
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      for (int k = 0; k <= 20; ++k) {
        const d3::vector part = d3::vector(i, j, k) / 20.0;
        const d3::vector p = low + part.cwiseProduct(high - low);
        const falcon::point<double> exact{{p[0], p[1], p[2]}};
        const auto theta = falcon::inverse(exact);
        REQUIRE(theta);
        const auto pose =
            falcon::forward(falcon::to_angles<double>(falcon::to_counts(theta.value)));
        REQUIRE(pose);
        worst = std::max(worst, falcon::norm(pose.position - exact));
        steep = std::max(steep, pose.condition);
      }
    }
  }
  std::cout << "mock's box: counts show the grip to " << worst << " m, cond (Frobenius) " << steep
            << '\n';
  CHECK(worst < 2e-4);
}

TEST_CASE("one count of every leg is less than the quantum that the ledger is told",
          "[falcon][mock]") {
  double most = 0.0;
  const auto& ball = falcon::workspace<double>;
  for (double x = -0.04; x <= 0.04; x += 0.002) {
    for (double y = -0.04; y <= 0.04; y += 0.002) {
      for (double z = -0.04; z <= 0.04; z += 0.002) {
        const auto p = ball.centre + falcon::point<double>{{x, y, z}};
        if (!ball.contains(p)) continue;
        const auto J = falcon::jacobian(falcon::rates(p, falcon::inverse(p).value));
        for (const auto& row : J.row) {
          const double sum = std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]);
          most = std::max(most, sum * falcon::angle_per_count<double>);
        }
      }
    }
  }
  std::cout << "one count of every leg moves the grip by up to " << most << " m along an axis\n";
  CHECK(most <= falcon_quantum);
  CHECK(most > 0.99 * falcon_quantum);
}

TEST_CASE("the mock's energy meter books what its motors do", "[falcon][mock]") {
  random_source random(21);
  double worst = 0.0, work = 0.0;
  for (int run = 0; run < 10; ++run) {
    falcon::mock_parameters setup = ready;
    setup.body.start = {0.001 * run, -0.002 * run, 0.125};
    setup.body.friction = run % 2 == 0 ? 0.0 : 0.2;
    falcon::mock_mechanism<sim::impedance_hand<d3>> arms(
        setup, {.stiffness = 400.0, .damping = 3.0, .target = {0, 0, 0.12}});
    for (int n = 0; n < 500; ++n) {
      if (n % 7 == 0) arms.hold(random_words(random));
      arms.elapse(random.uniform(1e-4, 2e-3));
    }
    worst = std::max(worst, std::abs(arms.motor_work() - arms.body().meter().total().actuator));
    work += std::abs(arms.motor_work());
    CHECK(std::abs(arms.body().residual()) < 1e-12);
  }
  std::cout << "motors' work against the meter: " << worst << " J of " << work << " J\n";
  CHECK(worst < 1e-12);
  CHECK(work > 0.1);
}

TEST_CASE("the mock takes a program as the real one does, and no other way", "[falcon][mock]") {
  falcon_cable<sim::no_hand<d3>> cable;
  REQUIRE(cable.open());
  const auto image = synthetic_image();
  using stage = falcon::mock<>::processor_type::stage;
  const auto booted = [&cable](std::span<const falcon::byte> with, falcon::firmware_policy how) {
    return falcon::bootloader{cable, with, {.policy = how, .attempts = 2}}.run();
  };
  CHECK(booted({}, falcon::firmware_policy::never_load).how.what == falcon::code::no_program);
  CHECK(cable.far().processor().where() == stage::idle);

  const auto report = booted(image, falcon::firmware_policy::probe_then_load);
  CHECK(report.how);
  CHECK(report.attempts == 1);
  CHECK(report.echoed == image.size());
  CHECK(report.clear_to_send);
  CHECK(cable.far().processor().where() == stage::running);
  CHECK(booted({}, falcon::firmware_policy::never_load).how);  // it stays there

  (void)cable.control(falcon::request::modem, falcon::ftdi::dtr_low);
  (void)cable.control(falcon::request::modem, falcon::ftdi::dtr_high);
  CHECK(cable.far().processor().where() == stage::monitor);  // and DTR throws it out
  CHECK(booted({}, falcon::firmware_policy::never_load).how.what == falcon::code::no_program);
}

TEST_CASE("the mock's loader reads a boot stream to its end and not beyond", "[falcon][mock]") {
  using state = falcon::mock_loader::state;
  const auto image = synthetic_image();
  falcon::mock_loader loader;
  for (std::size_t i = 0; i + 1 < image.size(); ++i)
    REQUIRE(loader.push(image[i]) == state::loading);
  CHECK(loader.push(image.back()) == state::loaded);

  falcon::mock_loader wrong;
  (void)wrong.push(0xAB);
  CHECK(wrong.push(0x08) == state::refused);
  for (const auto b : image) CHECK(wrong.push(b) == state::refused);
}

TEST_CASE("the mock is homed by hand, and its encoders jump when it is", "[falcon][mock]") {
  using hand = homing_hand;
  falcon_device<hand> device{3500.0, {}, falcon::mock_parameters{.runs = true}, hand{}};
  REQUIRE(device.open());
  REQUIRE(device.boot({}).how);
  CHECK(device.where() == falcon::state::unhomed);
  const auto before = device.line().far().mechanism().encoder();
  CHECK(before == falcon::leg_words{});  // power-up is its zero

  int forces = 0;
  bool jumped = false;
  falcon::leg_words last{};
  const auto watch = [&](const auto& now) {
    forces += now.sent.motor != falcon::leg_words{};
    const auto shown = device.line().far().mechanism().encoder();
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
    falcon_device<sim::no_hand<d3>> still{3500.0, {}, falcon::mock_parameters{.runs = true}};
    return still.open() && still.boot({}).how && still.home(2s);
  }());
}

TEST_CASE("counts in, words out: force and position go through the whole chain", "[falcon][mock]") {
  falcon::mock_parameters setup = ready;
  setup.body.damping = 20.0;  // it hardly moves
  falcon_device<sim::no_hand<d3>> device{3500.0, {}, setup};
  REQUIRE(make_ready(device));
  random_source random(22);
  for (int n = 0; n < 200; ++n) {
    const d3::vector f = random.direction<d3>() * 3.0;
    (void)device.exchange(f);
    const auto& arms = device.line().far().mechanism();
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
  falcon::mock_parameters setup = ready;
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
  auto& far = device.line().far();
  const auto held = far.mechanism().words();
  CHECK(held != falcon::leg_words{});
  far.unplug();
  CHECK_FALSE(device.exchange(d3::vector(0, 0, 2)).valid);
  CHECK(device.latest().what == falcon::code::unplugged);
  CHECK(far.mechanism().words() == held);  // nothing can be done from here
  far.plug_in();
  REQUIRE(device.open());
  REQUIRE(device.boot({}).how);
  CHECK(far.mechanism().words() == falcon::leg_words{});
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

TEST_CASE("a bad parameter of the mock is named", "[falcon][mock]") {
  CHECK(std::string(falcon::mock_parameters{.gain = 0.0}.check().parameter) == "gain");
  CHECK(std::string(falcon::mock_parameters{.out_angle = -1.0}.check().parameter) == "out_angle");
}
