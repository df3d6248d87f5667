// SPDX-License-Identifier: BSD-3-Clause
// A million honest ticks are not refuted, and devices that are not as stated are, on seeds of their own:
// `cmake --build --preset faults --target run_watch` has ten million, and the table.
#include "../../bench/watch/sessions.hpp"
#include "support/catch.hpp"

using namespace watching;

TEST_CASE("no honest session is refuted, whatever the device and the hand", "[watched][long]") {
  long ticks = 0;
  for (std::uint64_t i = 0; i < 370; ++i) {
    const std::uint64_t number = 77 * 1000003 + i;
    const truth w = i % 3 == 0 ? drawn(number) : named(number % names, number);
    const result r = session(w, {.reported = i % 2 == 0}, 3.0);
    CAPTURE(w.name, number, w.latency, w.quantum, w.friction);
    CHECK(r.refuted == 0);
    // No sample is doubted that is not too fast.
    if (r.refused > 0) {
      CHECK(r.refused == session<ph::trusted_hand>(w, {.reported = i % 2 == 0}, 3.0).refused);
    }
    ticks += r.ticks;
  }
  CHECK(ticks > 1000000);
}

TEST_CASE("what is not as stated is mostly found, and loses less", "[watched][long]") {
  const auto tried = [](const untruth& how, int* found, double* lost, double* lost_watched) {
    for (std::uint64_t i = 0; i < 40; ++i) {
      truth w = drawn(78 * 1000003 + i);
      untruth told = how;
      if (how.kind == lie::compliant) {
        dice g(i);
        told.share = between(g, 0.1, 0.8);
        w.stated_mass = 1.0;
        w.friction = w.quantum = w.on_it.own = 0.0;
      }
      const result r = session(w, told, 2.0);
      *found += r.found >= 0.0;
      *lost_watched += r.lost;
      *lost += session<ph::trusted_hand>(w, told, 2.0).lost;
    }
  };
  struct expected {
    untruth how;
    int at_least;
    double saves;  ///< of what is lost without
  };
  for (const auto& [how, at_least, saves] :
       {expected{{lie::sign}, 20, 2.0}, expected{{lie::sign, 0.0, 0.5, true}, 34, 20.0},
        expected{{lie::latency, 1.0, 0.5, true}, 30, 0.0},
        expected{{lie::latency, 3.0, 0.5, true}, 30, 3.0},
        expected{{lie::stronger_hand, 3.0}, 12, 0.0}, expected{{lie::compliant, 120.0}, 12, 3.0}}) {
    int found = 0;
    double lost = 0.0, lost_watched = 0.0;
    tried(how, &found, &lost, &lost_watched);
    CAPTURE(static_cast<int>(how.kind), how.amount, found, lost, lost_watched);
    CHECK(found >= at_least);
    CHECK(lost >= saves * lost_watched);
  }
}
