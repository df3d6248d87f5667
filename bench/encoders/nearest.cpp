// SPDX-License-Identifier: BSD-3-Clause
// What a bound keeps of a force where axes are damped unequally: one share for all, or the nearest effort that is
// covered. Directions are drawn evenly, and the energy evenly between nothing and what the whole force may cost.
#include "program.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>

namespace encoders {

namespace {

struct nearest_row {
  int axes = 0;
  double ratio = 0.0;        ///< of the largest damping to the smallest
  double share = 0.0;        ///< kept by one share for all, of the length
  double kept = 0.0;         ///< kept by the nearest effort, of the length
  double along = 0.0;        ///< and of that along the force asked for
  double turned = 0.0;       ///< its angle to that [°], mean
  double most_turned = 0.0;  ///< and the largest
};

ex::record record_of(const nearest_row& r) {
  return {{"axes", r.axes},
          {"ratio", r.ratio, "%g"},
          {"share", r.share, "%.3f"},
          {"nearest", r.kept, "%.3f"},
          {"nearest_along", r.along, "%.3f"},
          {"turned_deg", r.turned, "%.1f"},
          {"most_turned_deg", r.most_turned, "%.0f"}};
}

template <int Dof>
nearest_row judge(double ratio) {
  using joints = ph::joint_space<double, Dof>;
  constexpr double T = 1e-3;
  constexpr int draws = 20000;
  sim::random_source random(5);
  ph::diagonal_damping<Dof> stated;
  for (int i = 0; i < Dof; ++i) {
    stated.coefficients[static_cast<std::size_t>(i)] = 0.03 * std::pow(ratio, i / (Dof - 1.0));
  }
  const ph::part_at<ph::diagonal_damping<Dof>, joints> damping(stated);
  nearest_row row{Dof, ratio};
  for (int n = 0; n < draws; ++n) {
    typename joints::effort f;
    for (int i = 0; i < Dof; ++i) {
      const double u = random.uniform(1e-12, 1.0), angle = random.uniform(0.0, 6.283185307179586);
      f(i) = std::sqrt(-2.0 * std::log(u)) * std::cos(angle);
    }
    const double E = damping.worst_outflow(f, T) * random.uniform(0.0, 1.0);
    const auto left = ph::detail::nearest_covered<joints>(damping, f, E, T);
    const double along = left.dot(f) / f.squaredNorm(), kept = left.norm() / f.norm();
    const double angle =
        std::acos(std::min(1.0, along / std::max(kept, 1e-12))) * 57.29577951308232;
    row.share += damping.affordable(f, E, T) / draws;
    row.kept += kept / draws;
    row.along += along / draws;
    row.turned += angle / draws;
    row.most_turned = std::max(row.most_turned, angle);
  }
  return row;
}

}  // namespace

std::vector<std::string> run_nearest(const session& s) {
  std::vector<nearest_row> rows;
  for (const double ratio : {1.0, 3.0, 10.0, 100.0, 1e4}) {
    rows.push_back(judge<3>(ratio));
    rows.push_back(judge<7>(ratio));
  }
  std::vector<std::string> found;
  for (const auto& r : rows) {
    if (r.along < r.share - 1e-6) {
      found.push_back(ex::format("nearest: %g", r.ratio) + " keeps less than one share for all");
    }
  }
  s.out.section("The nearest effort",
                "strict_bound where axes are damped unequally: the length that one share for all "
                "keeps of a force, and what the nearest effort that is covered keeps, along the "
                "force asked for and in all, and by how much it turns.");
  ex::publish(s.out, "nearest", rows);
  return found;
}

}  // namespace encoders
