// SPDX-License-Identifier: BSD-3-Clause
#include "runner/virtual_time.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/runner.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <functional>
#include <stdexcept>

namespace sim = ph::simulation;

namespace {

/// Keeps what it was sent, and goes wrong when it is told to. It speaks no dt of its own.
struct recorder {
  std::vector<double> sent;
  long gone_after = -1;
  bool answers = true;

  ph::device_sample<d1> exchange(const double& force) noexcept {
    sent.push_back(force);
    return {.position = static_cast<double>(sent.size()), .dt = 1e-3, .valid = answers};
  }
  [[nodiscard]] bool unplugged() const noexcept {
    return gone_after >= 0 && static_cast<long>(sent.size()) > gone_after;
  }
};

/// A simulated device that lives in the time of the loop: what it was sent last is held until the next
/// exchange, however long that takes. So a force is held a tick after it was worked out.
template <class Hand, class Clock>
class living_device {
 public:
  living_device(const sim::device_parameters<d1>& p, const Hand& hand, Clock clock)
      : body_(p, hand), watch_(clock) {}

  ph::device_sample<d1> exchange(const double& force) noexcept {
    const double dt = watch_.lap();
    if (!body_.set_period(dt)) return {};
    return body_.exchange(std::exchange(held_, force));
  }
  [[nodiscard]] const auto& body() const noexcept { return body_; }

 private:
  sim::device<d1, Hand> body_;
  ph::basic_stopwatch<Clock> watch_;
  double held_ = 0.0;
};

using pressing = sim::impedance_hand<d1>;
constexpr pressing hand{.stiffness = 300, .damping = 2, .limit = 5, .target = -0.01};

auto late_wall(double longest_tick) {
  ph::local_model wall{d1{},
                       ph::fixed{ph::half_space<d1>{0.0, 1.0, 500.0}},
                       ph::turn_at_once{},
                       ph::damped_spring{.mass = 0.1},
                       ph::reduced_energy{.damping = 0.3},
                       ph::reachable_bound{.mass = 0.1, .hand_force = 5},
                       ph::late_loop_limits<1>{.longest_tick = longest_tick}};
  return wall;
}

static_assert(ph::haptic_device<recorder>);
static_assert(ph::haptic_device<sim::device<d3>>);
static_assert(std::same_as<ph::port_of_device<sim::device<d3>>, d3>);
struct may_throw {
  ph::device_sample<d1> exchange(double);
};
struct no_sample {
  double exchange(double) noexcept;
};
static_assert(!ph::haptic_device<may_throw>);
static_assert(!ph::haptic_device<no_sample>);
static_assert(ph::controller_for<double (*)(const ph::device_sample<d1>&), d1>);
static_assert(!ph::controller_for<double (*)(int*), d1>);

}  // namespace

TEST_CASE("a runner's figures are those of its clock, to the nanosecond", "[runner][threads]") {
  virtual_time time{.overshoots = {microseconds(0), microseconds(0), microseconds(0),
                                   microseconds(100), microseconds(400), microseconds(5200)}};
  recorder device;
  std::vector<ph::wake> seen;
  ph::runner touch{device,
                   [&](const auto& sample, const ph::wake& now) {
                     seen.push_back(now);
                     return -sample.position;
                   },
                   virtual_pace{milliseconds(1), virtual_clock{&time}}};
  REQUIRE(touch.run(6));
  REQUIRE(seen.size() == 6);
  CHECK(seen[0].dt == microseconds(1000));
  CHECK(seen[1].dt == microseconds(1000));
  CHECK(seen[2].dt == microseconds(1100));
  CHECK(seen[3].dt == microseconds(1300));
  CHECK(seen[4].dt == microseconds(5800));
  CHECK(seen[4].late == microseconds(5200));
  CHECK(seen[4].lost == 5);
  CHECK(seen[5].dt == microseconds(1000));
  CHECK(touch.counts().ticks == 6);
  CHECK(touch.counts().late == 1);
  CHECK(touch.counts().lost == 5);
  CHECK(touch.counts().refused == 0);
  CHECK(touch.counts().longest == microseconds(5800));
  CHECK(touch.timing().lengths.count() == 6);
  CHECK(touch.timing().lengths.longest() == microseconds(5800));
  CHECK(touch.timing().lateness.longest() == microseconds(5200));
  CHECK(touch.timing().lateness.percentile(50.0) == nanoseconds(0));
  // zero twice, then what the controller made of each sample, then zero
  CHECK(device.sent == std::vector{0.0, 0.0, -2.0, -3.0, -4.0, -5.0, -6.0, -7.0, 0.0});
  CHECK(touch.ended() == ph::loop_end::stopped);
  const auto* news = touch.take();
  REQUIRE(news != nullptr);
  CHECK(news->sample.position == 8.0);
  CHECK(news->force == -7.0);
  CHECK(news->counts.ticks == 6);
  CHECK(touch.take() == nullptr);
  // and the next run begins anew
  REQUIRE(touch.run(2));
  CHECK(touch.counts().ticks == 2);
  CHECK(touch.counts().lost == 0);
  CHECK(touch.timing().lengths.longest() == microseconds(1000));
}

TEST_CASE("the first sample that a controller sees is a tick long, whenever the loop starts",
          "[runner][threads]") {
  virtual_time time;
  living_device device{{.mass = 0.1, .damping = 0.3}, hand, virtual_clock{&time}};
  std::vector<double> lengths;
  ph::runner touch{device,
                   [&](const auto& sample) {
                     lengths.push_back(sample.dt);
                     return 0.0;
                   },
                   virtual_pace{milliseconds(1), virtual_clock{&time}}};
  for (int n = 0; n < 2; ++n) {
    time.now += std::chrono::seconds(3);
    REQUIRE(touch.run(3));
  }
  CHECK(lengths == std::vector(6, 1e-3));
}

TEST_CASE("a tick is late from half a period on, and no earlier", "[runner][threads]") {
  virtual_time time{.overshoots = {{}, {}, microseconds(500), {}, {}, microseconds(501)}};
  recorder device;
  const auto quiet = [](const auto&) { return 0.0; };
  ph::runner touch{device, quiet, virtual_pace{milliseconds(1), virtual_clock{&time}}};
  REQUIRE(touch.run(1));
  CHECK(touch.counts().late == 0);
  REQUIRE(touch.run(1));
  CHECK(touch.counts().late == 1);
}

TEST_CASE("the ticks that a port calls late are those that a runner measures",
          "[runner][threads]") {
  virtual_time time;
  for (int n = 0; n < 2000; ++n) {
    time.overshoots.push_back(microseconds(n % 97 == 96 ? 1700 : n * 7 % 40));
  }
  living_device device{{.mass = 0.1, .damping = 0.3, .start = 0.005}, hand, virtual_clock{&time}};
  auto wall = late_wall(1.1e-3);
  int late = 0, told = 0;
  double least = 0.0, deepest = 0.0;
  ph::runner touch{device,
                   [&](const auto& sample, const ph::wake& now) {
                     const auto out = wall.tick(sample);
                     late += out.what == ph::event::late_tick;
                     told += now.seconds() > 1.1e-3;
                     least = (std::min)(least, out.energy);
                     deepest = (std::min)(deepest, sample.position);
                     return out.force;
                   },
                   virtual_pace{milliseconds(1), virtual_clock{&time}}};
  REQUIRE(touch.run(2000));
  CHECK(touch.counts().lost == 20);
  CHECK(touch.counts().late == 20);
  CHECK(late == 20);
  CHECK(told == 20);
  CHECK(deepest < -0.003);  // there is a hand, and a wall
  // The offer that covers every tick makes none late.
  const auto offer = ph::offer_longest_tick(touch.timing().lengths, 0.0,
                                            {.mass = 0.1, .damping = 0.3, .force_limit = 9});
  CHECK(offer.longest_tick == 2.694e-3);  // late by 1700 us, after a wake that was late by 6
  time.sleeps = 0;
  living_device fresh{{.mass = 0.1, .damping = 0.3, .start = 0.005}, hand, virtual_clock{&time}};
  auto covered = late_wall(offer.longest_tick);
  int still_late = 0;
  ph::runner again{fresh,
                   [&](const auto& sample) {
                     const auto out = covered.tick(sample);
                     still_late += out.what == ph::event::late_tick;
                     return out.force;
                   },
                   virtual_pace{milliseconds(1), virtual_clock{&time}}};
  REQUIRE(again.run(2000));
  CHECK(again.counts().late == 20);
  CHECK(still_late == 0);
  CHECK(fresh.body().meter().minimum() >= -1e-12);
}

TEST_CASE("a runner in real time, on a device that lives in it", "[runner][threads]") {
  ph::stopwatch watch;
  living_device device{{.mass = 0.1, .damping = 0.3, .start = 0.002}, hand, ph::monotonic_clock{}};
  auto wall = late_wall(0.2);  // whatever this computer does meanwhile
  std::atomic<int> calls{0};
  ph::runner touch{device, [&](const auto& sample) {
                     ++calls;
                     return wall.tick(sample).force;
                   }};
  CHECK(touch.ended() == ph::loop_end::not_yet);
  REQUIRE(touch.start());
  CHECK(touch.running());
  CHECK(touch.start());  // it runs already
  while (calls < 300) std::this_thread::sleep_for(milliseconds(5));
  touch.stop();
  const double took = watch.lap();
  CHECK_FALSE(touch.running());
  CHECK(touch.ended() == ph::loop_end::stopped);
  CHECK(touch.counts().ticks == static_cast<std::uint64_t>(calls));
  // A tick a millisecond and no more, whatever was lost; and the time that the device lived is that.
  CHECK(static_cast<double>(touch.counts().ticks + touch.counts().lost) <= 1e3 * took + 1.0);
  CHECK(device.body().time() > 0.9 * 1e-3 * calls);
  CHECK(device.body().time() <= took);
  CHECK(device.body().meter().minimum() >= -1e-12);
  CHECK(device.body().position() < 0.0);  // the hand has reached the wall
}

TEST_CASE("whatever ends a loop, the last force is zero", "[runner][threads]") {
  recorder device;
  std::atomic<int> calls{0};
  SECTION("stop(), and it starts again") {
    ph::runner touch{device,
                     [&](const auto&) {
                       ++calls;
                       return 3.0;
                     },
                     microseconds(50)};
    for (int n = 0; n < 2; ++n) {
      calls = 0;
      REQUIRE(touch.start());
      while (calls < 20) std::this_thread::yield();
      touch.stop();
      CHECK(device.sent.back() == 0.0);
      CHECK(device.sent[device.sent.size() - 2] == 3.0);
    }
  }
  SECTION("the end of the runner itself") {
    {
      ph::runner touch{device,
                       [&](const auto&) {
                         ++calls;
                         return 3.0;
                       },
                       microseconds(50)};
      REQUIRE(touch.start());
      while (calls < 20) std::this_thread::yield();
    }
    CHECK(device.sent.back() == 0.0);
    CHECK(device.sent[device.sent.size() - 2] == 3.0);
  }
  SECTION("the controller asks for it") {
    std::function<void()> stop;
    ph::runner touch{device,
                     [&](const auto&) {
                       if (++calls == 5) stop();
                       return 3.0;
                     },
                     microseconds(50)};
    stop = [&touch] { touch.request_stop(); };
    REQUIRE(touch.start());
    while (touch.running()) std::this_thread::yield();
    CHECK(calls == 5);
    CHECK(touch.ended() == ph::loop_end::stopped);
    CHECK(device.sent.back() == 0.0);
  }
  SECTION("an unplug, whose zeros nobody hears: it tries three times") {
    device.gone_after = 30;
    ph::runner touch{device, [&](const auto&) { return 3.0; }, microseconds(50)};
    REQUIRE(touch.start());
    while (touch.running()) std::this_thread::yield();
    CHECK(touch.ended() == ph::loop_end::unplugged);
    CHECK(device.sent.size() == 32);
    CHECK(device.sent.back() == 0.0);
    CHECK(touch.start().what == ph::loop_start::code::unplugged);
    CHECK_FALSE(touch.running());
    CHECK(device.sent.size() == 32);
    device.gone_after = -1;
    device.answers = false;
    REQUIRE(touch.run(1));
    CHECK(std::vector(device.sent.end() - 4, device.sent.end()) == std::vector{3.0, 0.0, 0.0, 0.0});
  }
  SECTION("an exception of the controller, which is kept") {
    ph::runner touch{device,
                     [&](const auto&) {
                       if (++calls == 7) throw std::runtime_error("no such wall");
                       return 3.0;
                     },
                     microseconds(50)};
    REQUIRE(touch.start());
    while (touch.running()) std::this_thread::yield();
    CHECK(touch.ended() == ph::loop_end::controller_threw);
    REQUIRE(touch.error() != nullptr);
    CHECK_THROWS_AS(std::rethrow_exception(touch.error()), std::runtime_error);
    CHECK(calls == 7);
    CHECK(device.sent.back() == 0.0);
    CHECK(touch.counts().ticks == 6);
    REQUIRE(touch.start());  // it may start again, and what was thrown is forgotten
    while (calls < 20) std::this_thread::yield();
    touch.stop();
    CHECK(touch.ended() == ph::loop_end::stopped);
    CHECK(touch.error() == nullptr);
  }
}

TEST_CASE("a force that is no number goes out as zero, and is counted", "[runner][threads]") {
  virtual_time time;
  recorder device;
  int n = 0;
  ph::runner touch{device, [&](const auto&) { return ++n % 2 == 0 ? std::nan("") : 2.0; },
                   virtual_pace{milliseconds(1), virtual_clock{&time}}};
  REQUIRE(touch.run(4));
  CHECK(device.sent == std::vector{0.0, 0.0, 2.0, 0.0, 2.0, 0.0, 0.0});
  CHECK(touch.counts().refused == 2);
}

TEST_CASE("a period that is none starts nothing", "[runner][threads]") {
  recorder device;
  ph::runner touch{device, [](const auto&) { return 1.0; }, milliseconds(0)};
  CHECK(touch.start().what == ph::loop_start::code::bad_period);
  CHECK(touch.run(3).what == ph::loop_start::code::bad_period);
  CHECK_FALSE(touch.running());
  CHECK(device.sent.empty());
  CHECK(std::string(ph::to_string(ph::loop_start::code::bad_period)) == "the period is not > 0 ns");
}

TEST_CASE("what the system refuses is said at the start, and the loop runs all the same",
          "[runner][threads]") {
  recorder device;
  std::atomic<int> calls{0};
  int policy = -1;
  ph::runner touch{device,
                   [&](const auto&) {
#if defined(__linux__)
                     if (calls == 0) policy = ::sched_getscheduler(0);
#endif
                     ++calls;
                     return 0.0;
                   },
                   microseconds(100)};
  const auto none = touch.start();
  CHECK(none.granted.complete());
  while (calls < 2) std::this_thread::yield();
  touch.stop();
#if defined(__linux__)
  const int usual = policy;
  calls = 0;
  const auto impossible = touch.start({.priority = 1000});
  CHECK(impossible);
  CHECK(impossible.granted.scheduler.what == ph::grant::refused);
  while (calls < 2) std::this_thread::yield();
  CHECK(touch.start().granted.scheduler.what == ph::grant::refused);  // the same, while it runs
  touch.stop();
  CHECK(policy == usual);
  // Whether this user may is not known; what is said is true.
  calls = 0;
  const auto perhaps = touch.start({.priority = 1});
  while (calls < 2) std::this_thread::yield();
  touch.stop();
  const bool granted = perhaps.granted.scheduler.what == ph::grant::granted;
  CHECK((policy == SCHED_FIFO) == granted);
#endif
}

TEST_CASE("who takes a runner's news sees whole states, the newest first", "[runner][threads]") {
  recorder device;
  device.sent.reserve(100'000);
  ph::runner touch{device, [](const auto& sample) { return 2.0 * sample.position; },
                   microseconds(20)};
  CHECK(touch.take() == nullptr);
  REQUIRE(touch.start());
  std::uint64_t ticks = 0;
  bool whole = true;
  while (ticks < 2000) {
    const auto* news = touch.take();
    if (news == nullptr) continue;
    whole = whole && news->counts.ticks > ticks;
    // tick n gets sample n + 1, sends twice that, and sees sample n + 2
    const auto n = static_cast<double>(news->counts.ticks);
    whole = whole && news->force == 2.0 * (n + 1.0) && news->sample.position == n + 2.0;
    ticks = news->counts.ticks;
  }
  touch.stop();
  CHECK(whole);
}
