// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/runner/realtime.hpp>

#include <array>
#include <string>

namespace {

using ph::grant;

/// A system that refuses what it is told to refuse, and counts.
struct scripted_system {
  static constexpr bool supported = true;
  int scheduler = 0, memory = 0, core = 0;
  int asked = 0, priority = 0, pinned = -1;

  int schedule(int p) noexcept {
    ++asked;
    priority = p;
    return scheduler;
  }
  int lock_memory() noexcept {
    ++asked;
    return memory;
  }
  int pin(int c) noexcept {
    ++asked;
    pinned = c;
    return core;
  }
};

struct another_system : scripted_system {
  static constexpr bool supported = false;
};

constexpr ph::realtime_request everything{.priority = 80, .lock_memory = true, .core = 1};

std::string said(const ph::realtime_report& report) {
  std::array<char, 600> text{};
  return ph::describe(report, text);
}

}  // namespace

TEST_CASE("what is granted is granted, and nothing is said", "[runner]") {
  scripted_system system;
  const auto report = ph::become_realtime(everything, system);
  CHECK(system.asked == 3);
  CHECK(system.priority == 80);
  CHECK(system.pinned == 1);
  CHECK(report.scheduler.what == grant::granted);
  CHECK(report.memory.what == grant::granted);
  CHECK(report.core.what == grant::granted);
  CHECK(report.complete());
  CHECK(said(report).empty());
}

TEST_CASE("what is not asked for is not done", "[runner]") {
  scripted_system system{.scheduler = EPERM, .memory = EPERM, .core = EINVAL};
  const auto report = ph::become_realtime({}, system);
  CHECK(system.asked == 0);
  CHECK(report.scheduler.what == grant::not_asked);
  CHECK(report.complete());
  CHECK(said(report).empty());
  CHECK(ph::become_realtime({.core = 0}, system).core.what == grant::refused);  // 0 is a core
}

TEST_CASE("each refusal says which, why, and what to do; the others are granted all the same",
          "[runner]") {
  SECTION("priority") {
    scripted_system system{.scheduler = EPERM};
    const auto report = ph::become_realtime(everything, system);
    CHECK(system.asked == 3);
    CHECK_FALSE(report.complete());
    CHECK(report.memory.what == grant::granted);
    CHECK(said(report) ==
          "priority: refused, not permitted (1): give the user rtprio: a line '@realtime - rtprio "
          "90' in /etc/security/limits.d, and log in again");
  }
  SECTION("a priority that is none") {
    scripted_system system{.scheduler = EINVAL};
    CHECK(said(ph::become_realtime({.priority = 1000}, system)).find("1 to 99") !=
          std::string::npos);
  }
  SECTION("memory") {
    scripted_system system{.memory = ENOMEM};
    const auto report = ph::become_realtime(everything, system);
    CHECK_FALSE(report.complete());
    CHECK(said(report).find("memory: refused, over the limit of this user") == 0);
    CHECK(said(report).find("memlock") != std::string::npos);
  }
  SECTION("core") {
    scripted_system system{.core = EINVAL};
    const auto report = ph::become_realtime(everything, system);
    CHECK_FALSE(report.complete());
    CHECK(report.scheduler.what == grant::granted);
    CHECK(said(report).find("core: refused, out of range") == 0);
  }
  SECTION("all, a line each, cut off where there is no room") {
    scripted_system system{.scheduler = EPERM, .memory = EPERM, .core = 5};
    const auto report = ph::become_realtime(everything, system);
    const std::string all = said(report);
    CHECK(std::count(all.begin(), all.end(), '\n') == 2);
    CHECK(all.find("core: refused, error (5)") != std::string::npos);
    for (std::size_t n : {1U, 2U, 40U, 140U, 141U, 142U, 200U}) {
      std::array<char, 256> text{};
      text.fill('!');
      CHECK(ph::describe(report, std::span<char>(text.data(), n)) ==
            all.substr(0, (std::min)(n - 1, all.size())));
      CHECK(text[n] == '!');
    }
    CHECK(std::string(ph::describe(report, std::span<char>())).empty());
  }
}

TEST_CASE("where the library asks nothing of the system, it says so", "[runner]") {
  another_system system;
  const auto report = ph::become_realtime(everything, system);
  CHECK(system.asked == 0);
  CHECK(report.scheduler.what == grant::unsupported);
  CHECK_FALSE(report.complete());
  CHECK(said(report).find("priority: not asked") == 0);
}

#if defined(__linux__)
TEST_CASE("Linux refuses a priority and a core that there cannot be", "[runner]") {
  const auto report = ph::become_realtime({.priority = 1000, .core = 100000});
  CHECK(report.scheduler.what == grant::refused);
  CHECK(report.scheduler.error == EINVAL);
  CHECK(report.core.what == grant::refused);
  CHECK(report.core.error == EINVAL);
  CHECK(report.memory.what == grant::not_asked);
}
#endif
