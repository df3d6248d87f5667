// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Pareto front of many points.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace experiments {

/// The points (cost, error) than which no other is better in both, sorted by cost: their places in the list.
[[nodiscard]] inline std::vector<std::size_t> pareto_front(
    const std::vector<std::pair<double, double>>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(points[i].second < least)) continue;
    least = points[i].second;
    front.push_back(i);
  }
  return front;
}

/// The same of points of three quantities and more, than which no other is as good in all and better in one: their
/// places in the list, as they stand there, the first of those that are alike.
template <std::size_t N>
[[nodiscard]] std::vector<std::size_t> pareto_front(
    const std::vector<std::array<double, N>>& points) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool beaten = false;
    for (std::size_t k = 0; k < points.size() && !beaten; ++k) {
      bool as_good = k != i && (k < i || points[k] != points[i]);
      for (std::size_t n = 0; n < N; ++n) as_good = as_good && points[k][n] <= points[i][n];
      beaten = as_good;
    }
    if (!beaten) front.push_back(i);
  }
  return front;
}

}  // namespace experiments
