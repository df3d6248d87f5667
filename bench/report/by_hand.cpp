// SPDX-License-Identifier: BSD-3-Clause
// The three scenes of bench/cost, composed and by hand, among the other costs.
#include "../cost/paired.hpp"
#include "tables.hpp"

namespace experiments {
namespace {

/// A side of a scene, to be counted: the workload over and over.
template <class Scene, class State>
candidate side(std::string name, const State& fresh) {
  return {std::move(name), sizeof(State), {}, [fresh](long ticks) {
            const auto steps = cost::workload<Scene>();
            State state = fresh;
            double sum = 0.0;
            for (long n = 0; n < ticks; ++n) {
              const cost::step& s = steps[static_cast<std::size_t>(n) % steps.size()];
              if (s.news) cost::update_any(state, s.target);
              const auto out = cost::advance(state, cost::position_for<Scene, State>(s.position),
                                             cost::time_for<Scene, State>(s.dt));
              sum += static_cast<double>(out.depth);
            }
            return sum;
          }};
}

struct pair {
  std::string scene, scalar;
  candidate composed, by_hand;
  cost::timing (*time)(int rounds);
};

template <class Scene>
pair pair_of(const std::string& scalar) {
  const std::string name = std::string(Scene::name) + ", " + scalar;
  return {Scene::name, scalar, side<Scene>(name + ", composed", Scene::composed(cost::ordinary)),
          side<Scene>(name + ", by hand", Scene::by_hand(cost::ordinary)), cost::time_pairs<Scene>};
}

const std::vector<pair>& pairs() {
  static const std::vector<pair> all{
      pair_of<cost::wall<float>>("float"),       pair_of<cost::wall<double>>("double"),
      pair_of<cost::half_space<float>>("float"), pair_of<cost::half_space<double>>("double"),
      pair_of<cost::triangle<float>>("float"),   pair_of<cost::triangle<double>>("double")};
  return all;
}

}  // namespace

std::vector<candidate> by_hand_candidates() {
  std::vector<candidate> all;
  for (const pair& p : pairs()) {
    all.push_back(p.composed);
    all.push_back(p.by_hand);
  }
  return all;
}

void report_by_hand(report& out, const settings& chosen) {
  out.section("Relative to by hand",
              "The scenes of bench/cost, composed and written by hand without templates: the same "
              "bits, so no error between them. Times: blocks of 100 ticks, both sides in turns; "
              "the ratio is the median over the pairs.");
  std::vector<std::string> names;
  for (const auto& c : by_hand_candidates()) names.push_back(c.name);
  const auto counts = instructions_of("by hand", names, chosen);
  std::vector<record> rows;
  for (const pair& p : pairs()) {
    const cost::timing time = p.time(chosen.quick ? 10 : 200);
    const double ours = counts[2 * rows.size()], theirs = counts[2 * rows.size() + 1];
    rows.push_back({{"configuration", p.scene},
                    {"scalar", p.scalar},
                    {"ns p50", time.p50, "%.1f"},
                    {"p99.9", time.p999, "%.1f"},
                    {"max", time.max, "%.0f"},
                    {"time relative to by hand", time.ratio, "%.2f"},
                    {"instructions", ours, "%.1f"},
                    {"instructions relative to by hand", ours / theirs, "%.3f"},
                    {"bytes", p.composed.bytes}});
  }
  out.show(table_of(rows, std::identity{}));
  out.member("by_hand", json_of(rows, std::identity{}));
}

}  // namespace experiments
