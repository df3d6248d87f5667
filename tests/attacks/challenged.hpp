// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Compositions for the tests of challenge.hpp and search.hpp.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/simulation/challenge.hpp>

namespace sim = ph::simulation;

// The adversaries are compiled once for each space: challenged.cpp.
extern template sim::detail::run_outcome sim::detail::attack(const sim::subject<d1>&,
                                                             sim::adversary,
                                                             const sim::circumstances&,
                                                             std::uint64_t, const spectator<d1>&);
extern template sim::detail::run_outcome sim::detail::attack(const sim::subject<d2>&,
                                                             sim::adversary,
                                                             const sim::circumstances&,
                                                             std::uint64_t, const spectator<d2>&);
extern template sim::detail::run_outcome sim::detail::attack(const sim::subject<d3>&,
                                                             sim::adversary,
                                                             const sim::circumstances&,
                                                             std::uint64_t, const spectator<d3>&);

namespace simulated {

using by = sim::adversary;

template <class Space, class Law, class Bound, class Limits = ph::loop_limits>
auto model_of(const Law& law, const Bound& bound, const Limits& limits = thesis_loop) {
  return ph::local_model{Space{},
                         ph::followed<ph::half_space<Space>>{},
                         ph::turn_limited{.rate = 4},
                         law,
                         thesis_ledger<Space>(),
                         bound,
                         limits};
}

template <class Space>
const auto strict = model_of<Space>(ph::spring{}, ph::strict_bound{});
template <class Space>
const auto unbounded = model_of<Space>(ph::spring{}, ph::no_bound{});
/// The thesis's own rule, with nothing behind it.
template <class Space>
const auto thesis = model_of<Space>(ph::shaped{ph::spring{}, ph::thesis_rule{}}, ph::no_bound{});

/// A loop whose commands are held `k` ticks late.
template <int k>
constexpr ph::late_loop_limits<k> late_loop{
    .longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};

/// Checks that a model survives every adversary and has pushed.
inline void survives(const auto& verdicts, double accepted_loss = 1e-12) {
  for (const sim::verdict& v : verdicts) {
    CAPTURE(to_string(v.by), v.least_energy, v.worst_seed);
    CHECK(passes(v, accepted_loss));
    CHECK(v.largest_force > 1e-3);
  }
}
inline void survives_all(const auto& model, const sim::circumstances& world, int runs,
                         double accepted_loss = 1e-12) {
  const auto verdicts = sim::challenge_all(model, world, runs);
  survives(verdicts, accepted_loss);
  for (const sim::verdict& v : verdicts) CHECK(v.runs == runs);
}

}  // namespace simulated
