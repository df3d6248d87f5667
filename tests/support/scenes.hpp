// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The spaces that the tests run in, and short ways to compose.
#include <passive_haptics/passive_haptics.hpp>

#include <cmath>
#include <limits>

namespace ph = passive_haptics;

using d1 = ph::space<double, 1>;
using d2 = ph::space<double, 2>;
using d3 = ph::space<double, 3>;
using f1 = ph::space<float, 1>;
using f2 = ph::space<float, 2>;
using f3 = ph::space<float, 3>;

/// A device as in the thesis: b = 0.03 N·s/m, T = 1 ms, so B = 30 N/m.
template <class Space>
constexpr auto thesis_ledger() {
  return ph::reduced_energy<Space>{.damping = typename Space::scalar(0.03)};
}

/// A model of a surface that the environment moves, everything else as given.
template <class Space, class Contact, class Observer, class Bound>
constexpr auto following_half_space(const Contact& contact, const Observer& observer,
                                    const Bound& bound, ph::loop_limits<Space> limits = {}) {
  return ph::local_model{
      Space{}, ph::following<ph::half_space<Space>>{}, ph::snap<Space>{}, contact, observer, bound,
      limits};
}

/// The wall of the thesis: surface at 0, object at x > 0, n = −1.
template <class Space>
constexpr ph::half_space<Space> wall(typename Space::scalar stiffness) {
  return {typename Space::scalar(0), typename Space::scalar(-1), stiffness};
}
