// SPDX-License-Identifier: BSD-3-Clause
// A force that somebody adds behind the port, a spring effect here, is outside the promise. A device
// that reports what it held makes it seen.
#include "simulation/attacks.hpp"
#include "support/catch.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/challenge.hpp>

using namespace simulated;

namespace {

constexpr auto no_news = [](auto& /*loop*/, const auto& /*surface*/) { return true; };

/// A port that is asked for 1 N, and a spring to x = 0 that is added to what it answers.
struct with_an_effect {
  using space_type = d1;
  ph::strict_guard<d1, ph::actuator_limit> port =
      ph::make_strict_guard<d1>(0.03, ph::actuator_limit{1e3}, 1e-3);
  double spring = 0.0;  ///< [N/m]
  bool reports_held = false;
  int* debts = nullptr;

  double tick(const ph::device_sample<d1>& sample) {
    const auto out = reports_held ? port.tick(sample, 1.0)
                                  : port.tick(sample.position, ph::seconds{sample.dt}, 1.0);
    *debts += out.what == ph::event::debt ? 1 : 0;
    return out.force - spring * sample.position;
  }
};

struct seen {
  double least_energy;  ///< [J]
  int debts;
};
seen nyquist(double spring, bool reports_held) {
  int debts = 0;
  const with_an_effect loop{.spring = spring, .reports_held = reports_held, .debts = &debts};
  const auto v = sim::challenge(loop, sim::adversary::nyquist, {}, 10, 1, no_news);
  return {v.least_energy, debts};
}

}  // namespace

TEST_CASE("a force added behind the port loses, and is seen where the device reports what it held",
          "[adversaries]") {
  const seen silent = nyquist(500.0, false), told = nyquist(500.0, true);
  CHECK_THAT(silent.least_energy, Catch::Matchers::WithinRel(-0.15, 0.5));
  CHECK(silent.debts == 0);
  CHECK_THAT(told.least_energy, Catch::Matchers::WithinRel(-0.15, 0.5));
  CHECK(told.debts > 1000);
  for (const bool reports : {false, true}) {  // the control: nothing is added
    const seen alone = nyquist(0.0, reports);
    CHECK(alone.least_energy >= -1e-12);
    CHECK(alone.debts == 0);
  }
}
