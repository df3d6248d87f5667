// SPDX-License-Identifier: BSD-3-Clause
// A length of time: what becomes one, what does not, and that a tick is the same however it is told.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/seconds.hpp>

#include <chrono>
#include <ratio>
#include <type_traits>

namespace {

using ph::seconds;

// No number is a length of time, and no length of time is a number.
static_assert(!std::is_convertible_v<double, seconds<double>>);
static_assert(!std::is_convertible_v<seconds<double>, double>);
static_assert(!std::is_convertible_v<int, seconds<float>>);
static_assert(!std::is_convertible_v<seconds<float>, float>);
static_assert(std::is_convertible_v<seconds<double>, seconds<float>>);
static_assert(std::is_convertible_v<std::chrono::nanoseconds, seconds<float>>);

// It costs what the number costs.
static_assert(std::is_trivially_copyable_v<seconds<float>>);
static_assert(sizeof(seconds<float>) == sizeof(float));
static_assert(sizeof(seconds<double>) == sizeof(double));

// What is written decides the scalar; a duration, whatever counts it, is in double.
static_assert(std::same_as<decltype(seconds{1e-3F}), seconds<float>>);
static_assert(std::same_as<decltype(seconds{1e-3}), seconds<double>>);
static_assert(std::same_as<decltype(seconds{1ms}), seconds<double>>);

template <class S>
constexpr S in(seconds<S> time) {
  return time.count();
}
static_assert(in<double>(1ms) == 1e-3 && in<float>(1ms) == 1e-3F);
static_assert(in<double>(1500us) == 1.5e-3 && in<float>(1500us) == 1.5e-3F);
static_assert(in<double>(2min) == 120.0);
static_assert(in<double>(std::chrono::duration<float, std::milli>(0.5F)) == 0.5e-3);
static_assert(in<float>(seconds{1e-3}) == 1e-3F);

TEST_CASE("a tick is the same, whoever counted its seconds", "[base][port]") {
  const auto told = [](auto dt) {
    auto port = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::strict_bound{});
    REQUIRE(port.update(wall<d1>(500)));
    for (int n = 0; n < 20; ++n) (void)port.tick(1e-5 * n, dt);
    return port.tick(1e-4, dt);
  };
  const auto out = told(seconds{1e-3});
  CHECK(out.force < 0.0);
  const auto before = std::chrono::steady_clock::time_point{};
  const auto now = before + 1ms;
  for (const auto& other :
       {told(1ms), told(now - before), told(1000us), told(std::chrono::duration<double>(1e-3))}) {
    CHECK(other.force == out.force);
    CHECK(other.energy == out.energy);
    CHECK(other.what == out.what);
  }
  CHECK(told(2ms).energy != out.energy);  // the control
}

TEST_CASE("a force and a time keep their places in a port of one degree of freedom",
          "[base][port]") {
  auto port = ph::make_strict_guard<d1>(0.1, ph::actuator_limit{9.0}, 2e-3);
  CHECK(port.tick(0.0, 1ms, 0.0).what == ph::event::nominal);
  CHECK(port.tick(1e-5, 1ms, -1e-3).force == -1e-3);
  CHECK(port.tick(2e-5, seconds{1e-3}, -2e-3).force == -2e-3);
  CHECK(port.tick(3e-5, 5ms, -3e-3).what == ph::event::late_tick);
}

}  // namespace
