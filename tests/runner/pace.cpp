// SPDX-License-Identifier: BSD-3-Clause
#include "runner/virtual_time.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

namespace {

constexpr milliseconds T{1};

/// The wakes of a loop whose every tick takes `work`.
std::vector<ph::wake> wakes(virtual_time& time, int n, nanoseconds work = nanoseconds(0)) {
  virtual_pace pace{T, virtual_clock{&time}};
  std::vector<ph::wake> all;
  pace.begin();
  for (int i = 0; i < n; ++i) {
    time.now += work;
    all.push_back(pace.next());
  }
  return all;
}

}  // namespace

TEST_CASE("a pace keeps its grid, however long a tick takes within its period", "[runner]") {
  virtual_time time{.now = microseconds(123)};
  for (const ph::wake& w : wakes(time, 10, microseconds(900))) {
    CHECK(w.dt == T);
    CHECK(w.late == nanoseconds(0));
    CHECK(w.lost == 0);
  }
  CHECK(time.now == microseconds(123) + 10 * T);
  CHECK(time.sleeps == 10);
}

TEST_CASE("a wake that is a little late is measured and leaves the grid where it is", "[runner]") {
  virtual_time time{.overshoots = {microseconds(0), microseconds(250), microseconds(0)}};
  const auto w = wakes(time, 4);
  CHECK(w[0].dt == T);
  CHECK(w[1].dt == T + microseconds(250));
  CHECK(w[1].late == microseconds(250));
  CHECK(w[1].seconds() == 1.25e-3);
  CHECK(w[2].dt == T - microseconds(250));
  CHECK(w[2].late == nanoseconds(0));
  CHECK(time.now == 4 * T);  // on the grid: no drift
}

TEST_CASE("periods that are lost are given up, and the grid begins anew", "[runner]") {
  virtual_time time{.overshoots = {microseconds(3400)}};
  const auto w = wakes(time, 5);
  CHECK(w[0].dt == T + microseconds(3400));
  CHECK(w[0].late == microseconds(3400));
  CHECK(w[0].lost == 3);
  for (int i = 1; i < 5; ++i) {
    CHECK(w[static_cast<std::size_t>(i)].dt == T);  // no tick that is short, to catch up
    CHECK(w[static_cast<std::size_t>(i)].lost == 0);
  }
  CHECK(time.now == T + microseconds(3400) + 4 * T);
  // Late by a whole period is the first that counts as one lost, by a nanosecond less is none.
  virtual_time whole{.overshoots = {T}}, less{.overshoots = {T - nanoseconds(1)}};
  CHECK(wakes(whole, 1)[0].lost == 1);
  CHECK(wakes(less, 1)[0].lost == 0);
}

TEST_CASE("a tick that takes longer than its period is followed at once by the next", "[runner]") {
  virtual_time time;
  const auto w = wakes(time, 20, microseconds(1200));
  std::uint64_t lost = 0;
  for (const ph::wake& each : w) {
    CHECK(each.dt >= microseconds(1200));
    CHECK(each.dt <= microseconds(1200));
    lost += each.lost;
  }
  CHECK(time.sleeps == 0);
  CHECK(lost == 4);  // 24 periods, 20 ticks
}

TEST_CASE("the computer's own clock goes on, and a sleep ends no earlier than it is due",
          "[runner]") {
  ph::monotonic_clock clock;
  const nanoseconds due = clock.now() + milliseconds(3);
  clock.sleep_until(due);
  CHECK(clock.now() >= due);
  const nanoseconds before = clock.now();
  clock.sleep_until(before - milliseconds(5000));  // what is over is not waited for
  CHECK(clock.now() - before < milliseconds(4500));
}
