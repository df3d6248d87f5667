// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A clock that a test sets: a sleep ends when it is told to, and late by what the test says.
#include <passive_haptics/runner/pace.hpp>

#include <vector>

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

struct virtual_time {
  nanoseconds now{0};
  std::vector<nanoseconds> overshoots{};  ///< of the sleeps, one after the other; then none
  std::size_t sleeps = 0;
};

struct virtual_clock {
  virtual_time* time;

  [[nodiscard]] nanoseconds now() const noexcept { return time->now; }
  void sleep_until(nanoseconds due) const noexcept {
    const std::size_t n = time->sleeps++;
    const bool told = n < time->overshoots.size();
    time->now = due + (told ? time->overshoots[n] : nanoseconds(0));
  }
};

static_assert(passive_haptics::measuring_clock<virtual_clock>);
static_assert(passive_haptics::pacing_clock<virtual_clock>);
static_assert(!passive_haptics::pacing_clock<passive_haptics::steady_time>);  // which cannot sleep

using virtual_pace = passive_haptics::basic_pace<virtual_clock>;
