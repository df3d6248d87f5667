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
              if (s.news) cost::retarget_any(state, s.target);
              const auto out = cost::advance(state, cost::position_for<Scene, State>(s.position),
                                             static_cast<typename Scene::scalar>(s.dt));
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
  table shown({"configuration", "scalar", "ns p50", "p99.9", "max", "relative to by hand",
               "instructions", "relative to by hand", "bytes"});
  std::vector<std::string> json;
  for (const pair& p : pairs()) {
    const cost::timing time = p.time(chosen.quick ? 10 : 200);
    double ours = std::nan(""), theirs = ours;
    if (chosen.counts) {
      ours = instructions_per_tick(chosen.program, p.composed.name);
      theirs = instructions_per_tick(chosen.program, p.by_hand.name);
    }
    shown.add({p.scene, p.scalar, format("%.1f", time.p50), format("%.1f", time.p999),
               format("%.0f", time.max), format("%.2f", time.ratio), format("%.1f", ours),
               format("%.3f", ours / theirs), std::to_string(p.composed.bytes)});
    json.push_back(json_object({{"configuration", json_string(p.scene)},
                                {"scalar", json_string(p.scalar)},
                                {"ns_p50", json_number(time.p50)},
                                {"ns_p999", json_number(time.p999)},
                                {"ns_max", json_number(time.max)},
                                {"time_relative_to_by_hand", json_number(time.ratio)},
                                {"instructions", json_number(ours)},
                                {"instructions_relative_to_by_hand", json_number(ours / theirs)},
                                {"state_bytes", std::to_string(p.composed.bytes)}}));
  }
  out.show(shown);
  out.member("by_hand", json_array(json));
}

}  // namespace experiments
