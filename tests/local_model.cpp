// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

// All members compile in every dimension and both precisions.
template class ph::local_model<d1, ph::fixed<ph::half_space<d1>>, ph::turn_at_once, ph::spring,
                               ph::reduced_energy, ph::strict_bound>;
template class ph::local_model<f1, ph::followed<ph::half_space<f1>>, ph::turn_at_once,
                               ph::damped_spring, ph::reduced_energy, ph::reachable_bound>;
template class ph::local_model<d2, ph::followed<ph::segment<d2>>, ph::turn_limited,
                               ph::shaped<ph::spring, ph::thesis_rule>, ph::reduced_energy,
                               ph::no_bound>;
template class ph::local_model<f3, ph::followed<ph::triangle<f3>>, ph::turn_limited,
                               ph::shaped<ph::damped_spring, ph::force_rate_limit>,
                               ph::basic_reduced_energy<ph::diagonal_damping<3>>, ph::strict_bound,
                               ph::late_loop_limits<2>>;

TEST_CASE("a model is a value: a snapshot replays bit for bit", "[local_model]") {
  const d3::vector up(0, 0, 1);
  ph::local_model model{d3{},
                        ph::followed<ph::half_space<d3>>{},
                        ph::turn_limited{.rate = 4.0},
                        ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 50}},
                        ph::reduced_energy{.damping = 0.03, .loan = 0.02},
                        ph::strict_bound{},
                        thesis_loop};
  static_assert(std::is_trivially_copyable_v<decltype(model)>);
  model.update({{0, 0, 0.001}, up, 1000});
  for (int n = 0; n < 10; ++n) (void)model.tick({0, 1e-4 * n, 0}, 1ms);
  auto copy = model;
  for (int n = 10; n < 200; ++n) {
    if (n % 30 == 0) {
      const ph::half_space<d3> next{{0, 0, 1e-5 * n}, d3::vector(0.01 * n, 0, 1), 900};
      model.update(next);
      copy.update(next);
    }
    const d3::vector x(0, 1e-4 * n, 1e-6 * n);
    const auto a = model.tick(x, 1ms), b = copy.tick(x, 1ms);
    if (!(a.force == b.force) || a.energy != b.energy) FAIL("tick " << n);
  }
  CHECK(model.energy() == copy.energy());
}

TEST_CASE("parts without state cost no bytes", "[local_model][compile-time]") {
  using bare =
      decltype(ph::local_model{d1{}, ph::fixed{wall<d1>(1)}, ph::turn_at_once{}, ph::spring{},
                               ph::no_observer{}, ph::no_bound{}, thesis_loop});
  using strict =
      decltype(ph::local_model{d1{}, ph::fixed{wall<d1>(1)}, ph::turn_at_once{}, ph::spring{},
                               ph::no_observer{}, ph::actuator_limit{}, thesis_loop});
  static_assert(sizeof(strict) == sizeof(bare) + sizeof(double));
  // plane 3, spring 1, limits 4, force, position, blind time, and the flags
  static_assert(sizeof(bare) == sizeof(double) * (3 + 1 + 4 + 1 + 1 + 1) + sizeof(double));
  SUCCEED();
}

TEST_CASE("a model in one dimension ticks in a constant expression",
          "[local_model][compile-time]") {
  constexpr double force = [] {
    ph::local_model model{d1{},
                          ph::fixed{wall<d1>(1000)},
                          ph::turn_at_once{},
                          ph::spring{},
                          thesis_ledger(),
                          ph::strict_bound{},
                          ph::loop_limits{.longest_tick = 1e-3}};
    (void)model.tick(0.0, 1ms);
    return model.tick(1e-3, 1ms).force;
  }();
  static_assert(force < -0.05 && force > -0.07);  // 2b/T of 1 mm
  SUCCEED();
}
