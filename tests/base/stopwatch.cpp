// SPDX-License-Identifier: BSD-3-Clause
// A stopwatch, on a clock that the test sets.
#include "support/catch.hpp"
#include <passive_haptics/base/stopwatch.hpp>

namespace ph = passive_haptics;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

namespace {

struct set_clock {
  nanoseconds* time;
  [[nodiscard]] nanoseconds now() const noexcept { return *time; }
};

}  // namespace

TEST_CASE("the computer's own time goes on", "[stopwatch]") {
  const nanoseconds before = ph::steady_time::now();
  nanoseconds after = before;
  for (long n = 0; n < 100'000'000 && after == before; ++n) after = ph::steady_time::now();
  CHECK(after > before);
  ph::stopwatch watch;
  CHECK(watch.lap() >= 0.0);
}

TEST_CASE("a stopwatch measures from lap to lap", "[stopwatch]") {
  nanoseconds time = milliseconds(7);
  ph::basic_stopwatch watch{set_clock{&time}};
  time += microseconds(1500);
  CHECK(watch.lap() == 1.5e-3);
  CHECK(watch.lap() == 0.0);
  time += microseconds(500);
  CHECK(watch.lap() == 0.5e-3);
}

TEST_CASE("the first lap after a beginning may be stated, since nothing was held before it",
          "[stopwatch]") {
  nanoseconds time = milliseconds(7);
  ph::basic_stopwatch watch{set_clock{&time}};
  time += milliseconds(300);
  CHECK(watch.lap(1e-3) == 1e-3);
  time += milliseconds(2);
  CHECK(watch.lap(1e-3) == 2e-3);
  watch.reset();
  time += milliseconds(300);
  CHECK(watch.lap(1e-3) == 1e-3);
  time += milliseconds(2);
  watch.reset();
  time += milliseconds(3);
  CHECK(watch.lap() == 3e-3);
}
