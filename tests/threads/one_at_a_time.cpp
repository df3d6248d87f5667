// SPDX-License-Identifier: BSD-3-Clause
// Compiled twice, as a debug build and with NDEBUG (ONE_AT_A_TIME_RELEASE): two threads in one port are found, and
// in a release nothing is there to find them.
#ifdef ONE_AT_A_TIME_RELEASE
#ifndef NDEBUG
#define NDEBUG
#endif
#else
#undef NDEBUG
#endif
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/exchange.hpp>
#include <passive_haptics/compositions.hpp>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <functional>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <type_traits>
#include <unistd.h>
#include <vector>

namespace {

using scene = ph::space<double, 1>;

std::atomic<bool> inside{false}, may_leave{false};

/// A source that waits in the middle of a tick, where it is told to.
struct waits {
  bool long_tick = false;

  using result_type = ph::port_result<scene>;
  static constexpr bool asks_for_numbers = true;
  struct request {
    double wanted;
    bool nothing;
  };
  template <bool>
  request ask(const auto& /*motion*/, const auto& /*state*/, ph::event& /*what*/) const noexcept {
    if (long_tick) {
      inside = true;
      while (!may_leave) std::this_thread::yield();
    }
    return {0.0, false};
  }
  result_type answered(const request& /*r*/, const result_type& port) const noexcept {
    return port;
  }
  result_type refused(const result_type& port, double /*dt*/) const noexcept { return port; }
};
static_assert(ph::source_for<waits, scene>);

using port = ph::passive_port<scene, waits, ph::reduced_energy, ph::strict_bound>;
port make_port(bool long_tick) {
  return {scene{}, waits{long_tick}, ph::reduced_energy{.damping = 0.03}, ph::strict_bound{},
          ph::loop_limits{.longest_tick = 1e-3}};
}
constexpr ph::seconds tick_length{1e-3};

/// What a process says that does this, and whether it came to an end by itself.
struct ending {
  bool aborted = false;
  std::string said;
};
ending after(const std::function<void()>& work) {
  int pipe_ends[2];
  REQUIRE(pipe(pipe_ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);  // Catch's would tell a story
    dup2(pipe_ends[1], STDERR_FILENO);
    work();
    _exit(0);
  }
  close(pipe_ends[1]);
  ending result;
  char text[256];
  for (ssize_t n = 0; (n = read(pipe_ends[0], text, sizeof text)) > 0;) {
    result.said.append(text, static_cast<std::size_t>(n));
  }
  close(pipe_ends[0]);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  result.aborted = WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
  return result;
}

/// A tick that has begun and is not over, in a thread of its own, while `meanwhile` happens.
void during_a_tick(port& device, const std::function<void()>& meanwhile) {
  std::thread first([&] { (void)device.tick(0.0, tick_length); });
  while (!inside) std::this_thread::yield();
  meanwhile();
  may_leave = true;
  first.join();
}

#ifdef ONE_AT_A_TIME_RELEASE
constexpr bool looks = false;
#else
constexpr bool looks = true;
#endif

void check_found(const std::function<void(port&)>& meanwhile) {
  const ending together = after([&] {
    port device = make_port(true);
    during_a_tick(device, [&] { meanwhile(device); });
  });
  INFO(together.said);
  CHECK(together.aborted == looks);
  CHECK((together.said.find("two threads call one port at once") != std::string::npos) == looks);
}

}  // namespace

TEST_CASE("two threads in one port are found by a debug build, and by no release", "[threads]") {
  SECTION("both tick") {
    check_found([](port& device) {
      if (!looks) may_leave = true;  // a release lets both through
      (void)device.tick(0.0, tick_length);
    });
  }
  SECTION("both tick with samples") {
    check_found([](port& device) {
      if (!looks) may_leave = true;
      (void)device.tick(ph::device_sample<scene>{.position = 0.0, .dt = 1e-3, .valid = true});
    });
  }
  SECTION("one sets parameters") {
    check_found([](port& device) { (void)device.set(ph::reduced_energy{.damping = 0.02}); });
  }
  SECTION("one resets") {
    check_found([](port& device) { device.reset(); });
  }
}

TEST_CASE("threads that tick one port in turns, or each its own, are not found", "[threads]") {
  const ending in_turns = after([] {
    port device = make_port(false);
    for (int n = 0; n < 100; ++n) std::thread([&] { (void)device.tick(0.0, tick_length); }).join();
  });
  INFO(in_turns.said);
  CHECK_FALSE(in_turns.aborted);

  const ending side_by_side = after([] {
    port one = make_port(true), other = make_port(false);
    during_a_tick(one, [&] { (void)other.tick(0.0, tick_length); });
  });
  INFO(side_by_side.said);
  CHECK_FALSE(side_by_side.aborted);
}

TEST_CASE("news of a surface during the call of another thread are found", "[threads]") {
  // The first call never ends here: a port whose tick is on its way looks like that to all others.
  using model = ph::touch<scene>;
  class stuck : public model {
   public:
    stuck()
        : model(ph::make_touch<scene>({.mass = 0.1, .damping = 0.03, .force_limit = 9.0},
                                      {.force = 5.0})) {}
    void news_meanwhile() {
      [[maybe_unused]] const auto on_its_way = this->one_call();
      (void)update({0.0, 1.0, 1000.0});
    }
    void release_meanwhile() {
      [[maybe_unused]] const auto on_its_way = this->one_call();
      release();
    }
  };
  CHECK(after([] { stuck().news_meanwhile(); }).aborted == looks);
  CHECK(after([] { stuck().release_meanwhile(); }).aborted == looks);
  CHECK_FALSE(after([] {
                stuck alone;
                (void)alone.update({0.0, 1.0, 1000.0});
                (void)alone.tick(0.0, tick_length);
                alone.release();
              }).aborted);
}

TEST_CASE("a port that looks is no larger, stays copyable, and ticks in constant expressions",
          "[threads]") {
  // What both builds of this file agree on: objects of either may share a port.
  using wall = ph::local_model<scene, ph::fixed<ph::half_space<scene>>, ph::turn_at_once,
                               ph::spring, ph::reduced_energy, ph::strict_bound>;
  CHECK(sizeof(wall) == 120);
  CHECK(std::is_trivially_copyable_v<port>);
  constexpr double pressed = [] {
    ph::passive_port own{scene{}, ph::given_force{},
                         ph::reduced_energy{.damping = 0.03, .loan = 1.0}, ph::strict_bound{},
                         ph::loop_limits{.longest_tick = 1e-3}};
    (void)own.tick(0.0, tick_length, 0.0);
    return own.tick(0.0, tick_length, 1.0).force;
  }();
  CHECK(pressed == 1.0);
}

TEST_CASE("the newest result is read by a second thread, whole", "[threads]") {
  using space3 = ph::space<double, 3>;
  auto touch = ph::make_touch<space3>(
      {.mass = 0.1, .damping = 0.3, .force_limit = 9.0, .longest_tick = 1e-3}, {.force = 5.0});
  struct shown {
    std::size_t tick;
    space3::coordinates force;  // [N]
    double depth;               // [m]
  };
  ph::exchange<shown> newest;
  std::vector<shown> all(20000), read;
  std::atomic<bool> over{false};
  std::thread haptic([&] {
    (void)touch.update({{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1000.0});
    for (std::size_t n = 0; n < all.size(); ++n) {
      const auto r =
          touch.tick({0.0, 0.0, 1e-3 * std::sin(0.01 * static_cast<double>(n))}, tick_length);
      all[n] = {n, r.force, r.depth};
      newest.publish(all[n]);
      if (n % 100 == 0) std::this_thread::yield();
    }
    over = true;
  });
  for (bool last = false; !last;) {
    last = over;
    if (const shown* seen = newest.take()) read.push_back(*seen);
  }
  haptic.join();
  REQUIRE_FALSE(read.empty());
  CHECK(read.back().tick == all.size() - 1);
  int torn = 0;
  for (const shown& one : read) {
    const shown& sent = all[one.tick];
    if (one.depth != sent.depth || one.force.values != sent.force.values) ++torn;
  }
  CHECK(torn == 0);
}
