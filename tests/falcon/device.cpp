// SPDX-License-Identifier: BSD-3-Clause
// The Falcon's device: its states and its gate for forces.
#include "falcon/bench.hpp"

#include <string>

using Catch::Matchers::WithinAbs;

namespace {

using single_grip = falcon::device<falcon::in_memory_transport<scripted_falcon>, f3>;

static_assert(ph::haptic_device_for<grip, d3>);
static_assert(ph::haptic_device_for<single_grip, f3>);
static_assert(std::is_trivially_copyable_v<grip::reading_type>);

}  // namespace

TEST_CASE("the Falcon goes through its states, and each call says what it lacks",
          "[falcon][device]") {
  grip device{k};
  scripted_falcon& box = device.line().peer();
  CHECK(device.where() == state::closed);
  CHECK_FALSE(device.exchange(push).valid);
  CHECK(device.latest().what == code::not_open);
  CHECK(falcon::boot(device, {}).how.what == code::not_open);
  CHECK(device.home(std::chrono::seconds(1)).what == code::not_open);
  CHECK(device.close());

  REQUIRE(device.open());
  CHECK(device.where() == state::open);
  CHECK_FALSE(device.exchange(push).valid);
  const auto image = synthetic_image();
  std::vector<falcon::boot_step> steps;
  bool booting = true;
  const auto report =
      falcon::boot(device, image, {}, [&](falcon::boot_step s, std::size_t, std::size_t) {
        booting = booting && device.where() == state::booting;
        if (steps.empty() || steps.back() != s) steps.push_back(s);
        return true;
      });
  REQUIRE(report.how);
  CHECK(booting);
  using falcon::boot_step;
  CHECK(steps == std::vector{boot_step::probe, boot_step::hello, boot_step::loader,
                             boot_step::image, boot_step::program});
  CHECK(device.where() == state::unhomed);

  CHECK(device.home(std::chrono::milliseconds(100)).what == code::homing_timeout);
  CHECK(device.latest().what == code::not_homed);
  CHECK(box.last.light == falcon::lamps::red);
  box.homed = 7;
  CHECK(device.home(std::chrono::milliseconds(500)));
  CHECK(device.where() == state::homed);
  CHECK(device.exchange(push).valid);
  CHECK(box.last.light == falcon::lamps::green);
  CHECK(device.close());
  CHECK(device.where() == state::closed);
}

TEST_CASE("a Falcon that runs a program already needs no boot", "[falcon][device]") {
  grip device{k};
  CHECK(device.start().what == code::not_open);
  REQUIRE(device.open());
  CHECK(device.start({.questions = 3}).what == code::no_program);
  CHECK(device.where() == state::open);
  constexpr auto silence =
      falcon::packet_link<falcon::in_memory_transport<scripted_falcon>>::silence;
  CHECK(device.line().now() == 3 * falcon::probing{}.reply + 2 * silence);
  device.line().peer().now = scripted_falcon::mode::running;
  CHECK(device.start());
  CHECK(device.where() == state::unhomed);
  CHECK(device.line().peer().loads == 0);
}

TEST_CASE("a boot that fails leaves the Falcon open, for another try", "[falcon][device]") {
  grip device{k};
  REQUIRE(device.open());
  CHECK(falcon::boot(device, {}).how.what == code::image_missing);
  CHECK(device.where() == state::open);
  const auto image = synthetic_image();
  CHECK(falcon::boot(device, image).how);
  CHECK(device.where() == state::unhomed);
}

TEST_CASE("the Falcon tells where it is", "[falcon][device]") {
  falcon_bench b;
  b.box.encoder = {-300, 200, -100};
  for (int n = 0; n < 60; ++n) (void)b.exchange(d3::zero());
  const auto sample = b.exchange(d3::zero());
  REQUIRE(sample.valid);
  // falcon.md § 3.8, from an implementation that is independent of this one
  CHECK_THAT(sample.position[0], WithinAbs(-0.0150144419, 1e-8));
  CHECK_THAT(sample.position[1], WithinAbs(0.0104620264, 1e-8));
  CHECK_THAT(sample.position[2], WithinAbs(0.1298365120, 1e-8));
  CHECK_THAT(sample.dt, WithinAbs(1e-3, 2e-4));

  falcon_bench shifted(7, {.origin = falcon::workspace<double>.centre});
  for (int n = 0; n < 60; ++n) (void)shifted.exchange(d3::zero());
  CHECK_THAT(shifted.exchange(d3::zero()).position[2], WithinAbs(0.1346024284 - 0.125, 1e-8));
}

TEST_CASE("no force before homing, and then a ramp", "[falcon][device]") {
  falcon_bench b(0);
  for (int n = 0; n < 200; ++n) {
    CHECK_FALSE(b.exchange().valid);
    if (b.box.last.motor != nothing) FAIL(n);
  }
  b.box.homed = 5;  // two legs are not enough
  for (int n = 0; n < 200; ++n) (void)b.exchange();
  CHECK(b.device.where() == state::unhomed);
  CHECK(b.box.last.motor == nothing);

  b.box.homed = 7;
  int last = 0, first_force = -1, full = -1;
  for (int n = 0; n < 800; ++n) {
    const bool valid = b.exchange().valid;
    const int word = std::abs(b.box.last.motor[0]);
    if (word > 0 && first_force < 0) first_force = n;
    if (b.device.latest().strength >= 1.0 && full < 0) full = n;
    if (word > 0 && !valid) FAIL("a force without a position at " << n);
    if (word < last || word > last + 10) FAIL("from " << last << " to " << word << " at " << n);
    last = word;
  }
  CHECK(first_force > 50);
  CHECK(full > 540);
  CHECK(full < 560);
  // on the axis at count 0: words −k τ of falcon.md § 3.8, by superposition
  const std::array<double, 3> tau{.0193043 + 0.5 * .0639972 + 2 * .0249384,
                                  -.0650753 - 0.5 * .0152805 + 2 * .0249384,
                                  .0457710 - 0.5 * .0487166 + 2 * .0249384};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK_THAT(static_cast<double>(b.box.last.motor[i]), WithinAbs(-k * tau[i], 0.51));
  }
}

TEST_CASE("the force held is that of the words of the packet before", "[falcon][device]") {
  falcon_bench b;
  b.warm_up();
  for (const double newton : {0.0, 1.0, 2.0, 3.0, 0.5}) {
    const auto before = b.device.latest().sent.motor;
    const auto sample = b.exchange({0, 0, newton});
    // z force on the axis: all torques are 0.0249384 N·m per newton
    const double expected = -(before[0] + before[1] + before[2]) / 3.0 / k / 0.0249384;
    CHECK_THAT(sample.held[2], WithinAbs(expected, 1e-3));
  }
}

TEST_CASE("forces are limited in norm, then in words, and never wrap", "[falcon][device]") {
  const d3::vector direction = d3::vector(1.0, 2.0, -1.5).normalized();
  const auto words_at = [&direction](double newton, double gain, double limit) {
    grip device(gain, {.force_limit = limit});
    device.line().peer().now = scripted_falcon::mode::running;
    device.line().peer().homed = 7;
    REQUIRE(device.open());
    REQUIRE(device.start());
    for (int n = 0; n < 700; ++n) (void)device.exchange(newton * direction);
    return device.line().peer().last.motor;
  };
  CHECK(words_at(1e9, k, 8.0) == words_at(8.0, k, 8.0));
  CHECK(words_at(1e300, k, 8.0) == words_at(8.0, k, 8.0));
  CHECK(words_at(7.0, k, 8.0) != words_at(8.0, k, 8.0));
  // a gain at which 1000 N would be 100 times the range: one factor for all three
  const auto huge = words_at(1e3, 1e4, 1e6), one = words_at(1.0, 1e4, 1e6);
  int largest = 0;
  for (const int word : huge) largest = std::max(largest, std::abs(word));
  CHECK(largest == falcon::largest_word);
  for (std::size_t i = 1; i < 3; ++i) {
    CHECK_THAT(double(huge[i]) / huge[0], WithinAbs(double(one[i]) / one[0], 5e-3));
  }
}

TEST_CASE("closing and destroying leave the motors at zero", "[falcon][device]") {
  SECTION("close") {
    falcon_bench b;
    b.warm_up();
    CHECK(b.device.close());
    CHECK(b.box.last.motor == nothing);
    CHECK_FALSE(b.exchange().valid);
  }
  SECTION("close says when the cable is out") {
    falcon_bench b;
    b.warm_up();
    b.box.plugged = false;
    (void)b.exchange();
    CHECK(b.device.close().what == code::unplugged);
    CHECK(b.device.where() == state::closed);
    CHECK(b.device.close());  // there is nothing left to close
  }
  SECTION("close says when nobody confirms it") {
    falcon_bench b;
    b.warm_up();
    b.box.on_reply = [](scripted_falcon&, auto& bytes) { bytes.clear(); };
    CHECK(b.device.close().what == code::timeout);
    CHECK(b.box.last.motor == nothing);
  }
  SECTION("destruction") {
    struct witness : scripted_falcon {
      falcon::dac_words* seen;
      explicit witness(falcon::dac_words* s) : seen(s) {}
      void receive(std::span<const falcon::byte> bytes) {
        scripted_falcon::receive(bytes);
        *seen = last.motor;
      }
    };
    falcon::dac_words seen{};
    {
      falcon::device<falcon::in_memory_transport<witness>> device{k, {}, &seen};
      device.line().peer().now = scripted_falcon::mode::running;
      device.line().peer().homed = 7;
      REQUIRE(device.open());
      REQUIRE(device.start());
      for (int n = 0; n < 700; ++n) (void)device.exchange(push);
      CHECK(seen != nothing);
    }
    CHECK(seen == nothing);
  }
}

TEST_CASE("homing can be watched and cancelled, lamps can be your own", "[falcon][device]") {
  falcon_bench b(0);
  int seen = 0;
  CHECK(b.device
            .home(std::chrono::seconds(1),
                  [&seen](const auto& now) {
                    CHECK(now.what == code::not_homed);
                    return ++seen < 5;
                  })
            .what == code::cancelled);
  CHECK(seen == 5);
  b.device.light(falcon::lamps::blue | falcon::lamps::red);
  (void)b.exchange();
  CHECK(b.box.last.light == (falcon::lamps::blue | falcon::lamps::red));
  b.device.light(std::nullopt);
  (void)b.exchange();
  CHECK(b.box.last.light == falcon::lamps::red);
}

TEST_CASE("in single precision the Falcon commands the same, within a count", "[falcon][device]") {
  falcon_bench b;
  single_grip single{falcon::cautious_gain<float>};
  auto& box = single.line().peer();
  box.now = scripted_falcon::mode::running;
  box.homed = 7;
  REQUIRE(single.open());
  REQUIRE(single.start());
  double apart = 0.0;
  for (int n = 0; n < 1500; ++n) {
    box.encoder =
        b.box.encoder = {static_cast<std::int16_t>(n / 5), 30, static_cast<std::int16_t>(-n / 9)};
    const auto fine = b.exchange();
    const auto coarse = single.exchange(push.cast<float>());
    REQUIRE(fine.valid == coarse.valid);
    for (std::size_t i = 0; i < 3; ++i) {
      apart = std::max(apart, std::abs(fine.position[i] - double(coarse.position[i])));
      if (std::abs(box.last.motor[i] - b.box.last.motor[i]) > 1) FAIL(n);
    }
  }
  CHECK(box.last.motor != nothing);
  CHECK(apart < 1e-6);  // m
  CHECK(apart > 0.0);
}

TEST_CASE("a local model takes the Falcon as it is", "[falcon][device]") {
  falcon_bench b(0);
  ph::local_model wall{d3{},
                       ph::fixed{ph::half_space<d3>{{0, 0, 0.14}, {0, 0, 1}, 800.0}},
                       ph::turn_at_once{},
                       ph::spring{},
                       ph::reduced_energy{.damping = 1.0, .loan = 0.02},
                       ph::strict_bound{},
                       ph::late_loop_limits<1>{.longest_tick = 1e-3, .top_speed = 100.0}};
  d3::vector force = d3::zero();
  double pressed = 0.0;
  for (int n = 0; n < 1500; ++n) {
    if (n == 100) b.box.homed = 7;
    if (n > 100 && n < 700) b.box.encoder[0] = static_cast<std::int16_t>(n % 3);
    const auto out = wall.tick(b.exchange(force));
    if (n < 149) CHECK(out.what == ph::event::rejected_sample);
    CHECK(out.energy >= 0.0);
    force = out.force;
    pressed = std::max(pressed, force(2));
  }
  CHECK(pressed > 1.0);
  CHECK(b.device.where() == state::homed);
}
