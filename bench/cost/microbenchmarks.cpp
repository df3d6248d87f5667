// SPDX-License-Identifier: BSD-3-Clause
// What a tick costs on your machine, by Catch2's own clock: microbenchmarks "[wall]".
// Each benchmark is one tick of the workload after the other on one model.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#define CATCH_CONFIG_MAIN
#define CATCH_CONFIG_ENABLE_BENCHMARKING
#include <catch2/catch.hpp>
#endif

#include "workload.hpp"

#include <string>

namespace {

template <class Scene, class State>
void benchmark(const char* side, State state) {
  const auto steps = cost::workload<Scene>();
  std::size_t n = 0;
  BENCHMARK(std::string(Scene::name) + ", " + side) {
    const cost::step& s = steps[n];
    n = n + 1 < steps.size() ? n + 1 : 0;
    if (s.news) cost::update_any(state, s.target);
    return cost::advance(state, cost::position_for<Scene, State>(s.position),
                         cost::time_for<Scene, State>(s.dt));
  };
}

template <class Scene>
void both() {
  benchmark<Scene>("composed", Scene::composed(cost::ordinary));
  benchmark<Scene>("by hand", Scene::by_hand(cost::ordinary));
}

}  // namespace

TEST_CASE("a tick of the wall", "[wall]") {
  both<cost::wall<float>>();
  both<cost::wall<double>>();
}
TEST_CASE("a tick of the half-space", "[half_space]") {
  both<cost::half_space<float>>();
  both<cost::half_space<double>>();
}
TEST_CASE("a tick of the triangle", "[triangle]") {
  both<cost::triangle<float>>();
  both<cost::triangle<double>>();
}
