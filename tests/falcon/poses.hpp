// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Poses of the Falcon at random, and what its tests compare them by.
#include "support/catch.hpp"
#include "support/falcon_vectors.hpp"
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ph = passive_haptics;
namespace falcon = passive_haptics::falcon;
using random_source = ph::simulation::random_source;

using room = ph::space<double, 3>;
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The largest difference of a component.
template <class Triple>
double distance(const Triple& a, const Triple& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(double(a[i]) - double(b[i])));
  return most;
}

template <class Kind>
falcon::triple<double, Kind> in_double(const falcon::triple<float, Kind>& a) {
  return {{double(a[0]), double(a[1]), double(a[2])}};
}

inline falcon::point<double> in_workspace(random_source& random) {
  falcon::point<double> p;
  do {
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = falcon::workspace<double>.centre[i] + random.uniform(-0.04, 0.04);
    }
  } while (!falcon::workspace<double>.contains(p));
  return p;
}

template <class Triple>
Triple in_any_direction(random_source& random, double length) {
  const room::vector d = random.direction<room>() * length;
  return {{d[0], d[1], d[2]}};
}
