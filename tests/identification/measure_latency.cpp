// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/identification/measure_latency.hpp>
#include <passive_haptics/simulation/device.hpp>

using Catch::Matchers::WithinAbs;

namespace {

namespace sim = ph::simulation;
using simulated = sim::device<d1>;

/// A device with something between it and the loop.
struct wrapped {
  simulated device;
  ph::device_sample<d1> last{};
  double commanded = 0.0;
  int ticks = 0;
};
/// A sensor that has something new every `every`-th tick only.
struct repeating : wrapped {
  int every = 2;
  ph::device_sample<d1> exchange(double f) noexcept {
    const auto sample = device.exchange(f);
    if (ticks++ % every == 0) last.position = sample.position;
    last.dt = sample.dt;
    last.valid = true;
    return last;
  }
};
/// A loop whose new force arrives in mid-tick: what is commanded now is held from then on.
struct half_late : wrapped {
  ph::device_sample<d1> exchange(double f) noexcept {
    static_cast<void>(device.exchange(commanded));
    commanded = f;
    return device.exchange(f);
  }
};
/// Every `every`-th sample is lost.
struct losing : wrapped {
  int every = 2;
  bool as_nan = false;
  ph::device_sample<d1> exchange(double f) noexcept {
    commanded = f;
    auto sample = device.exchange(f);
    if (ticks++ % every == 0) {
      if (as_nan) sample.position = std::nan("");
      sample.valid = as_nan;
    }
    return sample;
  }
};
/// Something pulls at it, always.
struct loaded : wrapped {
  double load = 0.0;
  ph::device_sample<d1> exchange(double f) noexcept {
    commanded = f;
    return device.exchange(f + load);
  }
};
/// In an iron fist.
struct held_fast : wrapped {
  ph::device_sample<d1> exchange(double f) noexcept {
    commanded = f;
    return {.position = 0.01, .held = f, .dt = 1e-3, .valid = true};
  }
};

/// A device that is as late as that, on encoder steps that are felt.
simulated device_of(int latency, double quantum = 1e-5, double mass = 0.1, double damping = 0.03,
                    double friction = 0.0, double period = 1e-3) {
  return simulated({.mass = mass,
                    .damping = damping,
                    .friction = friction,
                    .quantum = quantum,
                    .period = period,
                    .latency = latency});
}

}  // namespace

TEST_CASE("measure_latency tells how late a loop is, whatever the device is like", "[latency]") {
  for (int latency = 0; latency <= 3; ++latency) {
    for (const double quantum : {0.0, 10e-6, 60e-6}) {
      for (const double mass : {0.05, 0.25}) {
        for (const double damping : {0.03, 0.5}) {
          for (const double friction : {0.0, 0.05}) {
            INFO(latency << " ticks, q " << quantum << ", m " << mass << ", b " << damping
                         << ", f_c " << friction);
            auto device = device_of(latency, quantum, mass, damping, friction);
            const auto found = ph::measure_latency<d1>(device);
            CHECK(found.problem == nullptr);
            CHECK(found.ticks == latency);
            CHECK_THAT(found.exactly, WithinAbs(latency, 0.1));
            CHECK(found.sensor_ticks == 1);
          }
        }
      }
    }
  }
}

TEST_CASE("measure_latency is not misled by a constant load", "[latency]") {
  for (int latency = 0; latency <= 3; ++latency) {
    for (const double load : {-0.4, 0.1, 0.4, 2.0}) {
      for (const double friction : {0.0, 0.05, 0.2}) {
        CAPTURE(latency, load, friction);
        loaded device{{.device = device_of(latency, 0.0, 0.1, 0.03, friction)}, load};
        const auto found = ph::measure_latency<d1>(device);
        CHECK(found.problem == nullptr);
        CHECK(found.ticks == latency);
        CHECK_THAT(found.exactly, WithinAbs(latency, 0.02));
      }
    }
  }
}

TEST_CASE("measure_latency tells a sensor that is slower than the loop", "[latency]") {
  for (const int every : {2, 3, 4}) {
    for (const int latency : {0, 1, 2, 3}) {
      for (const double quantum : {0.0, 10e-6, 60e-6}) {
        INFO("new every " << every << " ticks, latency " << latency << ", q " << quantum);
        repeating device{{.device = device_of(latency, quantum)}, every};
        const auto found = ph::measure_latency<d1>(device);
        CHECK(found.sensor_ticks == every);
        REQUIRE(found.problem != nullptr);
        CHECK(std::string(found.problem).find("sensor is slower") != std::string::npos);
      }
    }
  }
  repeating control{{.device = device_of(1)}, 1};
  CHECK(ph::measure_latency<d1>(control).problem == nullptr);
}

TEST_CASE("measure_latency tells a slow sensor whatever its phase is, and no other one",
          "[latency]") {
  for (int every = 2; every <= 16; ++every) {
    for (int phase = 0; phase < every; ++phase) {
      for (const int ticks : {500, 4000}) {
        INFO("new every " << every << " ticks, from tick " << phase << " on, in " << ticks);
        repeating device{{.device = device_of(1), .ticks = every - phase}, every};
        const auto found = ph::measure_latency<d1>(device, {.ticks = ticks});
        CHECK(found.sensor_ticks == every);
        CHECK(found.problem != nullptr);
      }
    }
  }
  for (const double quantum : {0.0, 10e-6, 60e-6}) {  // the control: standing still is no period
    for (const double mass : {0.05, 0.5}) {
      for (const double friction : {0.0, 0.2}) {
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
          CAPTURE(quantum, mass, friction, seed);
          auto device = device_of(1, quantum, mass, 0.03, friction);
          CHECK(ph::measure_latency<d1>(device, {.ticks = 500, .seed = seed}).sensor_ticks == 1);
        }
      }
    }
  }
}

TEST_CASE("measure_latency tells a force that changes in mid-tick", "[latency]") {
  for (const int latency : {0, 2}) {  // in half-ticks
    half_late device{{.device = device_of(latency, 0.0, 0.1, 0.03, 0.0, 0.5e-3)}};
    const auto found = ph::measure_latency<d1>(device);
    CHECK_THAT(found.exactly, WithinAbs(0.5 + 0.5 * latency, 0.05));
    REQUIRE(found.problem != nullptr);
    CHECK(std::string(found.problem).find("mid-tick") != std::string::npos);
  }
}

TEST_CASE("measure_latency says so when it has nothing to go by", "[latency]") {
  const auto says = [](const ph::latency_found& found, const char* words) {
    return found.problem != nullptr && std::string(found.problem).find(words) != std::string::npos;
  };
  held_fast held{{.device = device_of(0)}};
  CHECK(says(ph::measure_latency<d1>(held), "let go of the device"));
  for (const bool as_nan : {false, true}) {
    losing device{{.device = device_of(1)}, 2, as_nan};
    CHECK(says(ph::measure_latency<d1>(device), "too few good samples"));
    losing nearly{{.device = device_of(1)}, 97, as_nan};
    const auto found = ph::measure_latency<d1>(nearly);
    CHECK(found.problem == nullptr);
    CHECK(found.ticks == 1);
  }
  auto device = device_of(1);
  for (const ph::latency_parameters& wrong : {ph::latency_parameters{.force = 0.0},
                                              {.force = std::nan("")},
                                              {.ticks = 10},
                                              {.ticks = 2000000},
                                              {.axis = -1},
                                              {.axis = 1}}) {
    CHECK(says(ph::measure_latency<d1>(device, wrong), "out of its range"));
  }
  CHECK(device.time() == 0.0);  // not a tick of it
}

TEST_CASE("measure_latency leaves the device with no force on it", "[latency]") {
  held_fast held{
      {.device = device_of(0)},
  };
  (void)ph::measure_latency<d1>(held, {.force = 3.0});
  CHECK(held.commanded == 0.0);
  losing device{{.device = device_of(0)}, 1};
  (void)ph::measure_latency<d1>(device);
  CHECK(device.commanded == 0.0);
}

TEST_CASE("measure_latency shakes the axis that it is told, by no more than it is told",
          "[latency]") {
  sim::device<d3> device({.mass = 0.1, .damping = 0.03, .latency = 2});
  const auto found = ph::measure_latency<d3>(device, {.force = 0.25, .ticks = 1000, .axis = 1});
  CHECK(found.problem == nullptr);
  CHECK(found.ticks == 2);
  CHECK(device.position()(0) == 0.0);
  CHECK(device.position()(1) != 0.0);
  CHECK(std::abs(device.position()(1)) < 0.05);  // it comes back
  CHECK(found.explained > 0.9);
}
