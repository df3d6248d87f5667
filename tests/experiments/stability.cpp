// SPDX-License-Identifier: BSD-3-Clause
// The stability program: that its verdicts can go wrong, and the worst cells it has found so far.
#include "../bench/stability/parts.hpp"
#include "controllers.hpp"
#include "support/catch.hpp"

namespace {

namespace ph = passive_haptics;
using controllers::controller;
using controllers::d1;
using controllers::f1;
using controllers::named;
using stability::outcome;
using stability::verdict;
using stability::world;

/// A model whose forces are no numbers.
struct mad {
  bool update(const ph::half_space<d1>& /*next*/) { return true; }
  ph::tick_result<d1> tick(const ph::device_sample<d1>& /*sample*/) {
    return {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  }
  const ph::half_space<d1>& local() const { return surface; }
  double energy() const { return 0.0; }
  ph::parameter_fault check() const { return {}; }
  ph::half_space<d1> surface{};
};

}  // namespace

TEST_CASE("the sweep calls a broken promise lost and no number no number", "[stability]") {
  const stability::effort little{3, 300};
  controller liar = named("none");
  const outcome found = stability::judge<d1>(liar, world{}, little);
  CHECK(found.margin < -1e-6);
  CHECK_FALSE(found.stable);
  CHECK(stability::judged(liar, "double", 1, world{}, found).says == verdict::no_claim);
  liar.tag = ph::guarantee::strict;
  CHECK(stability::judged(liar, "double", 1, world{}, found).says == verdict::lost);

  controller insane = liar;
  insane.in<d1>() = [](const controllers::premises&) { return controllers::model<d1>(mad{}); };
  const outcome nonsense = stability::judge<d1>(insane, world{}, little);
  CHECK_FALSE(nonsense.finite);
  CHECK(stability::judged(insane, "double", 1, world{}, nonsense).says == verdict::no_number);

  const controller& honest = named("strict FBA");  // the control
  const outcome kept = stability::judge<d1>(honest, world{}, little);
  CHECK(kept.largest_force > 0.1);
  CHECK(stability::judged(honest, "double", 1, world{}, kept).says == verdict::holds);
}

TEST_CASE("a device without damping is refused, and says so at every tick", "[stability]") {
  world w;
  w.damping = 0.0;
  for (const char* name : {"strict FBA", "reachable", "EBA", "per-axis FBA"}) {
    const controller& c = named(name);
    const outcome found = stability::judge<f1>(c, w, {3, 300});
    CHECK(stability::judged(c, "float", 1, w, found).says == verdict::refused);
    CHECK(found.largest_force == 0.0);
  }
}

TEST_CASE("far from the origin a float loses positions: outside, unless the ledger knows the step",
          "[stability]") {
  world w;
  w.offset = 1e3;
  const auto says = [&w](const char* name) {
    const controller& c = named(name);
    const outcome found = stability::judge<f1>(c, w, {3, 300});
    return stability::judged(c, "float", 1, w, found);
  };
  CHECK(says("strict FBA").why == "position resolution");
  CHECK(says("strict FBA, encoder steps").says == verdict::holds);
}

TEST_CASE("in float, too, strict bounds lose nothing at all where positions are exact",
          "[stability]") {
  for (const char* name : {"strict FBA", "per-axis FBA", "energy tank, worst case",
                           "force rate + strict FBA", "PSPM + strict FBA"}) {
    for (const double K : {1e-3, 1e4, 1e12}) {
      world w;
      w.stiffness = static_cast<double>(static_cast<float>(K));
      const outcome found = stability::judge<f1>(named(name), w, {6, 600});
      INFO(name << ", K " << K);
      CHECK(found.finite);
      CHECK(found.margin >= 0.0);
    }
  }
}

TEST_CASE("numbers at the ends of their range give numbers or refusals", "[stability]") {
  for (const auto& r : stability::try_numbers(controllers::catalogue(), 2000)) {
    INFO(r.controller << ", " << r.scalar << ", " << r.dof << " DOF: " << r.first);
    CHECK(r.not_finite == 0);
    CHECK(r.silent == 0);
    CHECK(r.refused > 0);
  }
  controller insane = named("none");
  insane.in<d1>() = [](const controllers::premises&) { return controllers::model<d1>(mad{}); };
  long caught = 0;
  for (const auto& r : stability::try_numbers({insane}, 1000)) caught += r.not_finite;
  CHECK(caught > 0);  // the control
}

TEST_CASE(
    "a float ledger never overstates the true energy in 10⁵ ticks; rounded to nearest it does",
    "[stability]") {
  double control = 0.0;
  for (const auto& r : stability::soak(100000, 2)) {
    INFO(r.ledger << ", " << r.motion << ", " << r.ticks);
    if (r.ledger.find("control") != std::string::npos) {
      control = std::max(control, r.overstated);
    } else {
      CHECK(r.overstated <= r.unit * r.bank);
      CHECK(r.least_energy >= 0.0);
    }
  }
  CHECK(control > 1e-4);
}

TEST_CASE("slivers are refused with an event or give a unit normal", "[stability]") {
  int refused = 0, accepted = 0;
  for (const auto& r : stability::slivers(50)) {
    INFO(r.scalar << ", " << r.size << " m, aspect " << r.aspect);
    CHECK(r.silent == 0);
    CHECK(r.not_finite == 0);
    CHECK(r.largest_error < 0.5);
    refused += r.tried - r.accepted;
    accepted += r.accepted;
    if (r.aspect <= 1e4) CHECK(r.accepted == r.tried);
  }
  CHECK(refused > 0);
  CHECK(accepted > 0);
}

TEST_CASE("the stability program refuses what it does not understand", "[stability]") {
  CHECK_THROWS_AS(stability::parse({"--soak", "soon"}), std::invalid_argument);
  CHECK_THROWS_AS(stability::parse({"--out"}), std::invalid_argument);
  CHECK_THROWS_AS(stability::parse({"--thorough"}), std::invalid_argument);
  CHECK(stability::parse({"--quick", "--threads", "3"}).threads == 3);
  CHECK(stability::run({"--threads", "0"}, {}) == 2);
}
