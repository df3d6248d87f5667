// SPDX-License-Identifier: BSD-3-Clause
// Shapers that grow stiff, with the strict bound behind them, against adversaries in 1, 2 and 3
// dimensions; and what it is that the bound has to answer for.
#include "published/growing.hpp"

using attacks::conditions;

namespace {

/// Presses `deep` at `speed`, rests, and comes back out a little farther than the surface.
struct press_rest_release {
  double deep = 0.01, speed = 0.01, rest = 1.0;
  double phase = 0.0;
  double next(double depth) noexcept {
    phase += 1e-3;
    const double pressing = deep / speed;
    const double way = phase < pressing          ? -1.0
                       : phase < pressing + rest ? 0.0
                       : depth > -1e-3           ? 1.0
                                                 : 0.0;
    return -way * speed * 1e-3;
  }
};

/// That against a wall of 10 kN/m that stays put; the least port energy [J].
template <class Shaper, class Bound = ph::no_bound>
double pressed(const Shaper& shaper, const Bound& bound = {}) {
  auto model = following_half_space<d1>(ph::shaped{ph::spring{}, shaper}, thesis_ledger(), bound);
  REQUIRE_FALSE(model.check());
  (void)model.update(wall<d1>(1e4));
  press_rest_release motion;
  sim::prescribed_motion<d1> device({.damping = 0.03});
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 3500; ++n) {
    const double force = model.tick(sample).force;
    device.move_to(device.position() + motion.next(device.position()));
    sample = device.exchange(force);
  }
  return device.meter().minimum();
}

/// strict_bound, and whether it ever took anything of what it was asked for. At the very surface,
/// where the worst motion leads, the ledger's margin for rounding is all there is to spend.
struct watched_strict_bound : ph::strict_bound {
  bool* cut = nullptr;

  template <ph::port P>
  class on {
   public:
    constexpr explicit on(const watched_strict_bound& p) noexcept : bound_(p), cut_(p.cut) {}
    [[nodiscard]] constexpr auto limit(const typename P::effort& desired,
                                       const auto& state) const noexcept {
      const auto left = bound_.limit(desired, state);
      if (std::abs(desired) > 1e-3 && left.factor < 1.0 - 1e-9) *cut_ = true;
      return left;
    }

   private:
    ph::part_at<ph::strict_bound, P> bound_;
    bool* cut_;
  };
};

}  // namespace

TEMPLATE_TEST_CASE("shapers that grow stiff obey the laws in the other spaces, too",
                   "[shaper][law]", f2, d3, f3) {
  CHECK(obeys<TestType>(coupling, 1000));
  CHECK(obeys<TestType>(increments, 1000));
  CHECK(obeys<TestType>(offsets, 1000));
}

TEST_CASE("shapers that grow stiff never lose energy to any adversary in 1, 2 and 3 dimensions",
          "[passivity][augmentation]") {
  for (const conditions& when :
       {conditions{.ticks = 500}, conditions{.jitter = true, .longest_tick = 1.5e-3, .ticks = 500},
        conditions{.lost = 0.05, .ticks = 500}, conditions{.jumping = false, .ticks = 500}}) {
    const auto all = [&](const auto& shaper) {
      CHECK(least_of_growing<d1>(shaper, when, 60) >= -1e-12);
      CHECK(least_of_growing<d2>(shaper, when, 30) >= -1e-12);
      CHECK(least_of_growing<d3>(shaper, when, 30) >= -1e-12);
    };
    all(coupling);
    all(increments);
    all(offsets);
  }
  for (const conditions& when :
       {conditions{.ticks = 500}, conditions{.jumping = false, .ticks = 500}}) {
    CHECK(least_of_growing<d1>(unpaid_growth{}, when, 12, ph::no_bound{}) < -1e-3);  // the control
    // and the guard without the strict law: the hold's leak is not its business
    CHECK(least_of_growing<d1>(guard_alone{}, when, 12, ph::no_bound{}) < -1e-6);
  }
}

TEST_CASE("growth that nobody pays for loses energy even where the spring itself is passive",
          "[passivity][augmentation]") {
  // K ≤ 2b/T = 60 N/m and a wall that stays put: only the growth can lose
  const unpaid_growth unpaid{.initial = 20.0, .step = 0.02, .most = 60.0};
  const guard_alone paid{.initial = 20.0, .step = 0.02, .most = 60.0};
  CHECK(pressed(unpaid) < -1e-3);
  CHECK(pressed(paid) >= -1e-12);
  const conditions still{.jumping = false, .ticks = 500};
  const conditions uneven{.jitter = true, .slowest = 1e-3, .jumping = false, .ticks = 500};
  CHECK(least_of_growing<d1>(paid, still, 20, ph::no_bound{}) >= -1e-12);
  CHECK(least_of_growing<d1>(paid, uneven, 20, ph::no_bound{}) >= -1e-12);
  const unpaid_growth constant{.initial = 60.0, .step = 0.02, .most = 60.0};  // no growth
  CHECK(pressed(constant) >= -1e-12);
}

TEST_CASE("up to 2b/T the strict law never cuts what the ledger paid for, and cuts what it did not",
          "[shaper][augmentation]") {
  bool cut = false;
  const watched_strict_bound watched{{}, &cut};
  const conditions still{.jumping = false, .ticks = 3500};
  const guard_alone paid{.initial = 20.0, .step = 0.02, .most = 60.0};
  CHECK(pressed(paid, watched) >= -1e-12);
  CHECK(least_of_growing<d1>(paid, still, 5, watched) >= -1e-12);
  CHECK_FALSE(cut);
  const unpaid_growth unpaid{.initial = 20.0, .step = 0.02, .most = 60.0};
  CHECK(pressed(unpaid, watched) >= -1e-12);
  CHECK(cut);
}
