// SPDX-License-Identifier: BSD-3-Clause
// The mock Falcon's controller: how it takes a program.
#include "support/catch.hpp"
#include "support/falcon_loop.hpp"
#include "support/scripted_falcon.hpp"

TEST_CASE("the mock takes a program as the real one does, and no other way", "[falcon][mock]") {
  falcon_cable<sim::no_hand<d3>> cable;
  REQUIRE(cable.open());
  const auto image = synthetic_image();
  using stage = mock_falcon<>::processor_type::stage;
  const auto booted = [&cable](std::span<const falcon::byte> with, falcon::firmware_policy how) {
    return falcon::bootloader{cable, with, {.policy = how, .attempts = 2}}.run();
  };
  CHECK(booted({}, falcon::firmware_policy::never_load).how.what == falcon::code::no_program);
  CHECK(cable.peer().processor().where() == stage::idle);

  const auto report = booted(image, falcon::firmware_policy::probe_then_load);
  CHECK(report.how);
  CHECK(report.attempts == 1);
  CHECK(report.echoed == image.size());
  CHECK(report.clear_to_send);
  CHECK(cable.peer().processor().where() == stage::running);
  CHECK(booted({}, falcon::firmware_policy::never_load).how);  // it stays there

  (void)cable.control(falcon::request::modem, falcon::ftdi::dtr_low);
  (void)cable.control(falcon::request::modem, falcon::ftdi::dtr_high);
  CHECK(cable.peer().processor().where() == stage::monitor);  // and DTR throws it out
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
