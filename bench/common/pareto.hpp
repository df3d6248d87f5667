// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Pareto front of many points.

#include <algorithm>
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

}  // namespace experiments
