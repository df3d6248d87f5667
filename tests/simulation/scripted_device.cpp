// SPDX-License-Identifier: BSD-3-Clause
#include "support/scripted_device.hpp"

#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/device.hpp>

#include <array>
#include <cmath>

namespace sim = ph::simulation;
using namespace simulated;

TEMPLATE_TEST_CASE("scripted_device spoils the chosen ticks and no other", "[simulation][fault]",
                   (ph::space<float, 1>), room) {
  using kind = sample_fault;
  const std::array script{
      scripted_fault{1, kind::nan_position}, scripted_fault{2, kind::infinite_position},
      scripted_fault{3, kind::zero_dt},      scripted_fault{4, kind::negative_dt},
      scripted_fault{5, kind::jump, 0.25},   scripted_fault{6, kind::no_answer},
      scripted_fault{7, kind::nan_held},     scripted_fault{8, kind::nan_dt}};
  sim::device<TestType> sound;
  scripted_device broken{sound, script};
  for (int n = 0; n < 12; ++n) {
    const auto good = sound.exchange(TestType::zero());
    const auto bad = broken.exchange(TestType::zero());
    const auto x = sim::component(bad.position, 0);
    CAPTURE(n);
    CHECK(std::isnan(x) == (n == 1));
    CHECK(std::isinf(x) == (n == 2));
    CHECK((bad.dt == 0) == (n == 3 || n == 6));
    CHECK((bad.dt < 0) == (n == 4));
    CHECK((std::abs(static_cast<double>(x)) > 0.2) == (n == 2 || n == 5));
    CHECK(bad.valid == (n != 6));
    CHECK(std::isnan(sim::component(bad.held, 0)) == (n == 7));
    CHECK(std::isnan(bad.dt) == (n == 8));
    CHECK(good.valid);
    CHECK(good.dt > 0);
  }
  CHECK(broken.device().position() == sound.position());
  CHECK(broken.tick() == 12);
}
