// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/simulation/channel.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;

namespace {

struct traffic {
  int arrived = 0, overtaken = 0, twice = 0;
  double earliest = 1.0, latest = 0.0;
};

traffic send_many(const sim::channel_parameters& p, int packets = 10000) {
  struct stamped {
    int number = 0;
    double sent = 0.0;
  };
  sim::channel<stamped> link(p, 4);
  std::vector<int> seen(static_cast<std::size_t>(packets) + 1);
  traffic t;
  int newest = 0;
  for (int n = 1; n <= packets + 1000; ++n) {
    const double now = n * 1e-3;
    if (n <= packets) link.send({n, now}, now);
    while (const auto* got = link.take(now)) {
      ++t.arrived;
      t.overtaken += got->number < newest ? 1 : 0;
      newest = std::max(newest, got->number);
      t.twice += ++seen[static_cast<std::size_t>(got->number)] == 2 ? 1 : 0;
      t.earliest = std::min(t.earliest, now - got->sent);
      t.latest = std::max(t.latest, now - got->sent);
    }
  }
  return t;
}

constexpr bool constant_delay() {
  sim::channel<int, 4> link({.delay = 2.0});
  link.send(1, 0.0);
  link.send(2, 1.0);
  if (link.take(1.5) != nullptr) return false;
  const int* first = link.take(2.5);
  return first != nullptr && *first == 1 && link.take(2.5) == nullptr && *link.take(3.0) == 2;
}
static_assert(constant_delay());

}  // namespace

TEST_CASE("channel delays, loses, duplicates and reorders as it is told", "[two_port]") {
  const auto perfect = send_many({.delay = 0.1});
  CHECK(perfect.arrived == 10000);
  CHECK(perfect.overtaken + perfect.twice == 0);
  CHECK_THAT(perfect.earliest, WithinAbs(0.1, 1.1e-3));  // polled every millisecond
  CHECK_THAT(perfect.latest, WithinAbs(0.1, 1.1e-3));

  const auto shaken = send_many({.delay = 0.1, .jitter = 0.2});
  CHECK(shaken.arrived == 10000);
  CHECK(shaken.overtaken > 5000);
  CHECK(shaken.earliest < 0.102);
  CHECK(shaken.latest > 0.298);
  CHECK(shaken.latest < 0.302);
  CHECK(send_many({.delay = 0.1, .jitter = 0.2, .in_order = true}).overtaken == 0);

  CHECK_THAT(send_many({.loss = 0.3}).arrived, WithinAbs(7000, 200));
  CHECK(send_many({.loss = 1.0}).arrived == 0);
  CHECK_THAT(send_many({.duplication = 0.3}).twice, WithinAbs(3000, 200));
}

TEST_CASE("channel loses what does not fit, and everything with parameters out of range",
          "[two_port]") {
  sim::channel<int, 4> full({.delay = 1.0});
  for (int i = 0; i < 6; ++i) full.send(i, 0.0);
  CHECK(full.in_flight() == 4);
  CHECK(full.lost() == 2);
  const double nan = std::nan("");
  for (const sim::channel_parameters& p : {sim::channel_parameters{.delay = -1.0},
                                           {.delay = nan},
                                           {.jitter = nan},
                                           {.loss = 1.1},
                                           {.loss = nan},
                                           {.duplication = -0.1}}) {
    CHECK(p.check());
    sim::channel<int, 4> broken(p);
    broken.send(1, 0.0);
    CHECK(broken.take(1e9) == nullptr);
  }
  CHECK_FALSE(sim::channel_parameters{}.check());
}
