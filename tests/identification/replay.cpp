// SPDX-License-Identifier: BSD-3-Clause
// A recording that nobody held judges what a ledger is told: what it bears is never refuted, and more than the
// device takes is.
#include "../bench/replay/synthetic.hpp"
#include "support/catch.hpp"
#include <passive_haptics/identification/replay.hpp>

using namespace replaying;
namespace identification = ph::identification;

namespace {

identification::recorded_device of(const identification::recording& r) {
  return identification::identified(r, identification::statistics_of(r));
}
ph::encoder_device truth_of(const drive& d, double by = 1.0) {
  return {.mass = d.mass,
          .damping = by * d.damping,
          .friction = by * d.friction,
          .presliding = d.presliding,
          .quantum = d.quantum,
          .force_limit = 1000.0};
}
const std::vector<drive>& drives() {
  static const std::vector<drive> all{
      {},
      {.jitter = 0.2, .latency = 1},
      {.quantum = 20e-6},
      {.presliding = 200e-6},
      {.like = sim::friction_kind::three_springs},
      {.like = sim::friction_kind::stribeck},
      {.like = sim::friction_kind::rippled},
      {.mass = 40.0, .damping = 60.0, .friction = 6.0, .quantum = 1e-6, .load = -2.0},
  };
  return all;
}

}  // namespace

TEST_CASE("what a recording bears is below the truth and never refuted by the rest of it",
          "[replay]") {
  for (std::size_t i = 0; i < drives().size(); ++i) {
    CAPTURE(i);
    const drive& d = drives()[i];
    const auto r = recorded(d);
    const auto first = of(r.part(0, r.size() / 2));
    const auto rest = r.part(r.size() / 2, r.size());
    const auto second = of(rest);
    INFO(first.problem);
    REQUIRE(first.problem.empty());
    REQUIRE(second.problem.empty());
    CHECK(first.motion.latency >= d.latency);  // coarse steps may hide a tick
    CHECK(first.motion.latency <= d.latency + 1);
    const auto stated = identification::stated_of(first, {.drift = 0.0});
    CHECK(stated.mass <= d.mass);
    CHECK(stated.mass > 0.93 * d.mass);
    CHECK(stated.damping <= d.damping);
    CHECK(stated.damping > 0.85 * d.damping);
    if (d.like != sim::friction_kind::rippled) CHECK(stated.friction <= d.friction);
    CHECK(stated.friction > 0.85 * d.friction);
    CHECK(stated.presliding >= d.presliding);
    const auto said = identification::replay(rest, stated, identification::hands_off(second));
    CHECK_FALSE(said.refuted());
    CHECK(said.share() > 0.5);
    const auto drifted = identification::stated_of(first);
    CHECK(std::abs(drifted.friction - 0.7 * stated.friction) < 1e-12);
    CHECK(drifted.mass == stated.mass);
  }
}

TEST_CASE("the truth is not refuted, a twentieth more is, and so is the truth where somebody helps",
          "[replay]") {
  for (const drive& d : {drives()[0], drives()[1], drives()[3], drives()[7]}) {
    const auto r = recorded(d, 24.0, 5);
    const identification::hands_off shown(of(r));
    CHECK_FALSE(identification::replay(r, truth_of(d), shown).refuted());
    const auto more = identification::replay(r, truth_of(d, 1.05), shown);
    CHECK(more.refuted());
    CHECK(more.row > 0);
    CHECK(more.share() > 1.0);
  }
  const drive helped{.held = 15.0};
  const auto r = recorded(helped);
  CHECK(of(r).problem.find("somebody holds or pushes it") != std::string::npos);
  CHECK(identification::replay(r, truth_of(helped), identification::hands_off(of(recorded({}))))
            .refuted());
}

TEST_CASE("without the springs' reserve an elastic friction is overstated within its presliding",
          "[replay]") {
  // Nobody holds it, and the motor rocks it within p: nearly all comes back.
  drive d{.presliding = 200e-6, .load = 0.0};
  identification::recording r;
  sim::device<line, sim::no_hand<line>, sim::friction_like> device(
      {.mass = d.mass, .damping = d.damping, .quantum = d.quantum}, {},
      {d.like, d.friction, d.presliding});
  double x = 0.0;
  for (int i = 0; i < 20000; ++i) {
    r.time.push_back(1e-3 * i);
    r.position.push_back(x);
    r.force.push_back(0.9 * d.friction * std::sin(2e-2 * i) * std::min(1.0, i / 2000.0));
    x = device.exchange(r.force.back()).position;
  }
  identification::hands_off shown;
  shown.mass = shown.least_mass = d.mass;
  shown.friction = d.friction;
  CHECK_FALSE(identification::replay(r, truth_of(d), shown).refuted());
  auto rigid = truth_of(d);
  rigid.presliding = 0.0;
  CHECK(identification::replay(r, rigid, shown).refuted());
}

TEST_CASE("a wrong scale, a wrong sign or no motion bears no numbers", "[replay]") {
  auto r = recorded({}, 6.0);
  auto wrong = r;
  for (double& f : wrong.force) f = -f;
  CHECK(of(wrong).problem.find("a scale or a sign is wrong") != std::string::npos);
  wrong = r;
  for (double& x : wrong.position) x *= 1e-3;
  CHECK(of(wrong).problem.find("off by a thousand") != std::string::npos);
  wrong = r;
  for (double& x : wrong.position) x = r.position[0] + 1e-3 * (x - r.position[0]) * 1e-6;
  CHECK_FALSE(of(wrong).problem.empty());
}

TEST_CASE("a description that contradicts itself or the recording is refused before it is tried",
          "[replay]") {
  const auto found = of(recorded({}, 8.0));
  REQUIRE(found.problem.empty());
  CHECK(identification::fault_of_told(truth_of({}), found).empty());
  auto told = truth_of({});
  told.friction = 0.0;
  CHECK(identification::fault_of_told(told, found).find("without friction") != std::string::npos);
  told = truth_of({});
  told.mass = 120.0;
  CHECK(identification::fault_of_told(told, found).find("the whole axis has 95") !=
        std::string::npos);
  told.mass = -1.0;
  CHECK(identification::fault_of_told(told, found).find("mass = -1") != std::string::npos);
}
