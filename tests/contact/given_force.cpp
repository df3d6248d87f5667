// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using arm = ph::joint_space<double, 3>;

template <class Bound>
auto guard_with(const Bound& bound, const ph::given_force& rule = {}, double loan = 0.0) {
  return ph::passive_port{d1{}, rule, ph::reduced_energy{.damping = 0.03, .loan = loan}, bound,
                          thesis_loop};
}

}  // namespace

TEST_CASE("a given force goes out as the bound leaves it", "[given_force]") {
  auto guard = guard_with(ph::strict_bound{}, {}, 0.01);
  const double f_max = std::sqrt(4 * 30 * 0.01);
  CHECK(guard.tick(0.0, 1ms, 0.5).force == 0.5);
  const auto out = guard.tick(0.0, 1ms, -50.0);
  CHECK_THAT(out.force, WithinRel(-f_max, 1e-9));
  CHECK(out.limited);
  CHECK(out.energy == 0.01);
  CHECK(out.what == ph::event::nominal);
  static_assert(decltype(guard)::passivity == ph::guarantee::strict);
  static_assert(std::is_trivially_copyable_v<decltype(guard)>);
}

TEST_CASE("nothing is given before the first force", "[given_force]") {
  auto guard = guard_with(ph::no_bound{});
  CHECK(guard.tick(0.0, 1ms).what == ph::event::no_target);
  CHECK(guard.tick(0.0, 1ms).force == 0.0);
  CHECK(guard.source().update(2.0));
  CHECK(guard.tick(0.0, 1ms).force == 2.0);
  CHECK(guard.tick(0.0, 1ms).force == 2.0);
  CHECK(guard.source().newest() == 2.0);
  guard.reset();
  CHECK(guard.source().newest() == 0.0);
  CHECK_FALSE(guard.source().update(std::nan("")));
  CHECK(guard.tick(0.0, 1ms).what == ph::event::rejected_target);
  CHECK(guard.tick(0.0, 1ms).what == ph::event::no_target);
}

TEST_CASE("a force that is not renewed fades and says so", "[given_force]") {
  auto guard = guard_with(ph::no_bound{});
  for (int n = 0; n < 500; ++n) {  // the control: one that is
    const auto out = guard.tick(0.0, 1ms, 3.0);
    REQUIRE(out.force == 3.0);
    REQUIRE(out.what == ph::event::nominal);
  }
  double last = 3.0;
  for (int n = 1; n <= 200; ++n) {
    const double age = 1e-3 * n;
    const auto out = guard.tick(0.0, 1ms);
    const double weight = std::max(0.0, std::min(1.0, 1.0 - (age - 0.1) / 0.05));
    CHECK_THAT(out.force, WithinAbs(3.0 * weight, 1e-9));
    CHECK(last - out.force <= 0.06 + 1e-9);  // no step
    if (age < 0.0995) CHECK(out.what == ph::event::nominal);
    if (age > 0.1005) CHECK(out.what == ph::event::stale_target);
    last = out.force;
  }
  CHECK(last == 0.0);
  CHECK(guard.tick(0.0, 1ms, 3.0).force == 3.0);
}

TEST_CASE("a force grows older while samples are bad, too", "[given_force]") {
  auto guard = guard_with(ph::no_bound{});
  (void)guard.tick(0.0, 1ms, 3.0);
  for (int n = 0; n < 300; ++n) CHECK(guard.tick(std::nan(""), 1ms).force == 0.0);
  CHECK(guard.tick(0.0, 1ms).what == ph::event::stale_target);
  CHECK(guard.tick(0.0, 1ms).force == 0.0);
}

TEST_CASE("a force that is no number is refused, and the last good one stays", "[given_force]") {
  const double nan = std::nan("");
  auto guard = guard_with(ph::no_bound{});
  auto out = guard.tick(0.0, 1ms, nan);  // before there was a good one
  CHECK(out.force == 0.0);
  CHECK(out.what == ph::event::rejected_target);
  (void)guard.tick(0.0, 1ms, 2.0);
  for (const double bad : {nan, HUGE_VAL, -HUGE_VAL}) {
    out = guard.tick(0.0, 1ms, bad);
    CHECK(out.force == 2.0);
    CHECK(out.what == ph::event::rejected_target);
  }
  CHECK(guard.tick(0.0, 1ms).what == ph::event::nominal);  // it was said once
  for (int n = 0; n < 200; ++n) out = guard.tick(0.0, 1ms, nan);
  CHECK(out.force == 0.0);  // what is refused renews nothing

  ph::passive_port joints{arm{}, ph::given_force{}, ph::no_observer{}, ph::no_bound{}, thesis_loop};
  (void)joints.tick({0, 0, 0}, 1ms, {1, 2, 3});
  const auto held = joints.tick({0, 0, 0}, 1ms, {5, nan, 5});
  CHECK(held.force == arm::vector(1, 2, 3));
  CHECK(held.what == ph::event::rejected_target);
}

TEST_CASE("a force that is released fades, and no event is made of it", "[given_force][release]") {
  auto guard = guard_with(ph::strict_bound{}, {.stale_after = 0.1, .fade = 0.05}, 1.0);
  (void)guard.tick(0.0, 1ms, 2.0);
  guard.source().release();
  // its tick has come and gone: from the next one on it counts less and less
  for (int n = 1; n <= 60; ++n) {
    const auto out = guard.tick(0.0, 1ms);
    CHECK_THAT(out.force, WithinAbs(2.0 * std::max(0.0, 1.0 - 1e-3 * n / 0.05), 1e-12));
    CHECK(out.what == ph::event::nominal);
    CHECK(out.energy == 1.0);  // the ledger is kept
  }
  CHECK(guard.tick(0.0, 1ms, 2.0).force == 2.0);  // and the next one brings it back
}

TEST_CASE("a release while a force is fading goes on from where it is", "[given_force][release]") {
  auto guard = guard_with(ph::no_bound{}, {.stale_after = 0.01, .fade = 0.05});
  auto out = guard.tick(0.0, 1ms, 2.0);
  while (out.force > 1.1) out = guard.tick(0.0, 1ms);
  CHECK(out.what == ph::event::stale_target);
  guard.source().release();
  const auto next = guard.tick(0.0, 1ms);
  CHECK(next.what == ph::event::nominal);
  CHECK_THAT(out.force - next.force, WithinAbs(0.04, 1e-12));
}

TEST_CASE("a force is given with a sample of the device, too", "[given_force]") {
  auto guard = guard_with(ph::no_bound{});
  const auto out = guard.tick({.position = 0.1, .held = 0.0, .dt = 1e-3, .valid = true}, 2.0);
  CHECK(out.force == 2.0);
  CHECK(guard.tick(ph::device_sample<d1>{}, 3.0).what == ph::event::rejected_sample);
  CHECK(guard.tick({.position = 0.1, .held = 2.0, .dt = 1e-3, .valid = true}).force == 3.0);
}

TEST_CASE("what a force may not be told is refused with its name", "[given_force]") {
  CHECK_FALSE(ph::given_force{}.check());
  CHECK(std::string(ph::given_force{.stale_after = -1}.check().parameter) == "stale_after");
  CHECK(std::string(ph::given_force{.fade = 0.0}.check().parameter) == "fade");
  CHECK(guard_with(ph::no_bound{}, {.fade = std::nan("")}).check());
}
