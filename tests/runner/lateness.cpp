// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/runner/lateness.hpp>

#include <random>
#include <string>
#include <vector>

using std::chrono::microseconds;
using std::chrono::nanoseconds;

namespace {

/// Lengths from 1 ns to a minute, as many in each octave.
std::vector<nanoseconds> lengths(int n, unsigned seed) {
  std::mt19937_64 any(seed);
  std::vector<nanoseconds> all;
  for (int i = 0; i < n; ++i) {
    const double octave = std::uniform_real_distribution<double>(0.0, 35.8)(any);
    all.push_back(nanoseconds(static_cast<std::int64_t>(std::exp2(octave))));
  }
  return all;
}

template <class Lengths>
ph::duration_histogram histogram(const Lengths& all) {
  ph::duration_histogram h;
  for (const nanoseconds length : all) h.book(length);
  return h;
}

std::uint64_t longer_than(const std::vector<nanoseconds>& all, nanoseconds bound) {
  return static_cast<std::uint64_t>(
      std::count_if(all.begin(), all.end(), [&](nanoseconds x) { return x > bound; }));
}

/// A loop of 1 ms: ten ticks in 60000 take 3 ms, one takes 9.
std::vector<nanoseconds> usual_loop() {
  std::vector<nanoseconds> all(60000, microseconds(1000));
  for (std::size_t i = 0; i < 10; ++i) all[6000 * i] = microseconds(3000);
  all[500] = microseconds(9000);
  return all;
}

constexpr ph::design::stated_device viscous{.mass = 1000.0, .damping = 0.3, .force_limit = 9.0};

}  // namespace

TEST_CASE("percentiles are those of the sorted lengths, no less and at most 1/64 more",
          "[runner]") {
  for (const int n : {1, 2, 7, 100, 5000}) {
    auto all = lengths(n, static_cast<unsigned>(n));
    const auto h = histogram(all);
    std::sort(all.begin(), all.end());
    CHECK(h.count() == static_cast<std::uint64_t>(n));
    CHECK(h.longest() == all.back());
    bool good = true;
    for (const double p : {0.0, 0.5, 10.0, 50.0, 90.0, 99.0, 99.9, 100.0}) {
      const auto k = static_cast<std::size_t>(std::ceil(p / 100.0 * n));
      const nanoseconds exact = all[k > 0 ? k - 1 : 0];
      const nanoseconds found = h.percentile(p);
      good = good && found >= exact && found <= exact + exact / 64;
    }
    CHECK(good);
    CHECK(h.percentile(100.0) == all.back());
    CHECK(h.percentile(1e9) == all.back());
  }
}

TEST_CASE("every length is in the bucket that it belongs to", "[runner]") {
  std::vector<std::int64_t> edges{0, 1, 63, 64, 65, 127, 128, 129, 130, 255, 256, 257, 1000000};
  for (int bits = 9; bits < 36; ++bits) {
    for (const int off : {-1, 0, 1}) edges.push_back((std::int64_t(1) << bits) + off);
  }
  for (const std::int64_t n : edges) {
    // One that is longer stands beside it, so that the bucket answers and not the longest.
    const auto h = histogram(std::vector{nanoseconds(n), nanoseconds(4 * n + 1000)});
    const std::int64_t found = h.percentile(50.0).count();
    INFO(n);
    CHECK(found >= n);
    CHECK(found <= n + n / 64);
  }
}

TEST_CASE("what is longer than a minute or shorter than nothing is counted, too", "[runner]") {
  const nanoseconds ages = std::chrono::hours(3);
  const auto h = histogram(std::vector{nanoseconds(-5), nanoseconds(100), ages});
  CHECK(h.count() == 3);
  CHECK(h.percentile(1.0) == nanoseconds(0));
  CHECK(h.percentile(50.0) == nanoseconds(100));
  CHECK(h.longest() == ages);
  CHECK(h.percentile(100.0) == ages);
  CHECK(ph::duration_histogram{}.percentile(50.0) == nanoseconds(0));
  CHECK(ph::duration_histogram{}.all_but(0.1).longer == 0);
}

TEST_CASE("no more ticks than were allowed are longer than the longest_tick that is offered",
          "[runner]") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto all = lengths(20000, seed);
    const auto h = histogram(all);
    for (const double share : {0.0, 1e-5, 1e-4, 1e-3, 0.1, 0.5, 1.0}) {
      const auto bound = h.all_but(share);
      CHECK(bound.longer == longer_than(all, bound.length));
      CHECK(static_cast<double>(bound.longer) <= share * 20000.0);
      // and a bound that is 2 % shorter would be exceeded too often: it is the least
      if (share < 1.0) {
        const auto shorter = nanoseconds(bound.length.count() * 98 / 100 - 1);
        CHECK(static_cast<double>(longer_than(all, shorter)) > share * 20000.0);
      }
    }
  }
}

TEST_CASE("a longest_tick is offered with the stiffness that it leaves", "[runner]") {
  const auto h = histogram(usual_loop());
  const auto every = ph::offer_longest_tick(h, 0.0, viscous);
  CHECK(every.longest_tick == 9e-3);
  CHECK(every.longer == 0);
  CHECK(every.wall.stiffness == Approx(2.0 * 0.3 / 9e-3));
  const auto most = ph::offer_longest_tick(h, 1e-4, viscous);
  CHECK(most.longest_tick >= 3e-3);
  CHECK(most.longest_tick <= 3e-3 * 65 / 64);
  CHECK(most.longer == 1);
  const auto usual = ph::offer_longest_tick(h, 1e-3, viscous);
  CHECK(usual.longer == 11);
  CHECK(usual.longest_tick <= 1e-3 * 65 / 64);
  CHECK(usual.wall.stiffness == Approx(600.0).epsilon(0.02));
  // Where steps and friction are stated, the budget says what binds.
  const ph::design::stated_device encoder{.mass = 0.045,
                                          .damping = 0.05,
                                          .friction = 0.13,
                                          .presliding = 15e-6,
                                          .quantum = 55e-6,
                                          .force_limit = 3.3};
  auto told = encoder;
  told.longest_tick = every.longest_tick;
  const auto budget = ph::design::stiffness_budget(told);
  const auto offered = ph::offer_longest_tick(h, 0.0, encoder).wall;
  CHECK(offered.stiffness == budget.stiffness);
  CHECK(offered.binding == budget.binding);
  CHECK(offered.stiffness > 0.0);
}

TEST_CASE("a share of which too few ticks were measured is called so", "[runner]") {
  const auto h = histogram(usual_loop());  // 60000
  CHECK(ph::offer_longest_tick(h, 1e-4, viscous).enough());
  CHECK(ph::offer_longest_tick(h, 5.1e-5, viscous).enough());
  CHECK_FALSE(ph::offer_longest_tick(h, 4.9e-5, viscous).enough());
  CHECK_FALSE(ph::offer_longest_tick(h, 0.0, viscous).enough());
  CHECK(ph::offer_longest_tick(h, 1e-5, viscous).needed() == 300000);
}

TEST_CASE("an offer says in a sentence what it is", "[runner]") {
  const auto h = histogram(usual_loop());
  std::array<char, 200> text{};
  const auto said = [&](double share) {
    return std::string(ph::describe(ph::offer_longest_tick(h, share, viscous), text));
  };
  CHECK(said(0.0) ==
        "longest_tick 9.000 ms: 0 of 60000 ticks were longer; a wall of 67 N/m remains (slow "
        "kneading); a longer one may still come");
  CHECK(said(1e-5) ==
        "longest_tick 9.000 ms: 0 of 60000 ticks were longer; a wall of 67 N/m remains (slow "
        "kneading); a share of 1e-05 needs 300000 ticks");
  CHECK(said(1e-4).find("1 of 60000 ticks were longer") != std::string::npos);
  CHECK(said(1e-4).find("needs") == std::string::npos);
  const auto nothing = ph::offer_longest_tick({}, 1e-4, viscous);
  CHECK(std::string(ph::describe(nothing, text)) == "no tick was measured: run the loop first");
  CHECK(nothing.wall.stiffness == 0.0);
  std::array<char, 12> little{};
  CHECK(std::string(ph::describe(ph::offer_longest_tick(h, 0.0, viscous), little)) ==
        "longest_tic");
  CHECK(std::string(ph::describe(nothing, std::span<char>())).empty());
}

TEST_CASE("a loop's timing is a table of percentiles", "[runner]") {
  ph::loop_timing timing;
  for (const nanoseconds length : usual_loop()) {
    timing.lengths.book(length);
    timing.lateness.book(length - microseconds(1000));
  }
  std::array<char, 400> text{};
  CHECK(std::string(ph::describe(timing, text)) ==
        "60000 ticks   50 %     99 %     99.9 %   worst\n"
        "late [ms]    0.000    0.000    0.000    8.000\n"
        "long [ms]    1.008    1.008    1.008    9.000");
}
