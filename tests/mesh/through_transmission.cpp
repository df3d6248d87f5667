// SPDX-License-Identifier: BSD-3-Clause
// A mesh felt through a cable that gives: told of it no joule comes out and what holds still is quiet.
#include "mesh/shapes.hpp"
#include <passive_haptics/mesh/through_transmission.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>

using namespace meshes;

namespace {

constexpr ph::exact_device arm{.mass = 0.1, .damping = 0.05, .force_limit = 9.0, .longest_tick = T};
constexpr ph::known_hand person{.force = 5.0};

struct outcome {
  double least = 0.0, deepest = 0.0;  // [J], [m]
  bool quiet = false;
};
/// A hand that switches between two forces on 0.1 kg, of which 0.03 kg are the rotor's, and then holds still for 6 s.
outcome knead(auto port, const ph::mesh::surface& plate, double push, int period) {
  REQUIRE(port.source().touch(plate));
  sim::compliant_parameters<scene> p;
  p.share = 0.3;
  p.mode = 90.0;
  p.start = vector(0.003, 0.002, 0.003);
  sim::compliant_device<scene, sim::impedance_hand<scene>> dev(p, {.limit = 5.0});
  sim::quiet_judge<scene> judge;
  vector f = vector::Zero();
  outcome seen;
  for (int n = 0; n < 10000; ++n) {
    const bool kneads = n < 4000;
    dev.hand().stiffness = kneads ? 1e5 : 100.0;  // at its limit at once
    dev.hand().damping = kneads ? 0.0 : 1.0;
    dev.hand().target = vector(0.003, 0.002, kneads && n / period % 2 == 1 ? 1.0 : -push / 100.0);
    const vector before = dev.position();
    const auto sample = dev.exchange(f);
    f = port.tick(sample).force;
    if (n == 4000) judge.news();
    const vector up = vector::UnitZ();
    judge.add(f, (dev.position() - before) / T, T, std::span(&up, f.norm() > 0.0 ? 1 : 0));
    seen.deepest = std::max(seen.deepest, 0.0015 - dev.position().z());
  }
  seen.least = dev.minimum();
  seen.quiet = judge.settling() <= 5.0;
  port.source().let_go();
  return seen;
}

}  // namespace

TEST_CASE("a mesh that is felt through a cable gives out nothing, and rests", "[mesh][compliant]") {
  const body b = plate();
  const ph::mesh::surface s(b.triangles, b.nodes);
  const ph::chain_transmission<2> cable{ph::two_masses(0.1, 0.3, 90.0, 0.03, 0.1)};
  const ph::observed_transmission belt{
      .rotor = 0.03, .slew = ph::slew_of(cable.device, 5.0, 9.0, 0.5), .damping_above = 0.13};
  const ph::mesh_contact shape{.stiffness = 2000.0}, stiff{.stiffness = 9000.0};
  double lost = 0.0;
  for (const int period : {5, 15, 60}) {
    const auto held = [&](auto port) {
      REQUIRE_FALSE(port.check());
      const outcome seen = knead(port, s, 3.0, period);
      INFO("every " << period << " ms: " << seen.least << " J, " << seen.deepest << " m");
      CHECK(seen.least >= -1e-9);
      CHECK(seen.quiet);
    };
    held(ph::make_mesh_touch<scene>(arm, ph::any_transmission{.rotor = 0.03}, person, stiff));
    held(ph::make_mesh_touch<scene>(arm, belt, person, shape));
    held(ph::make_mesh_touch<scene>(arm, cable, person, shape));
    lost =
        std::min(lost, knead(ph::make_mesh_touch<scene>(arm, person, stiff), s, 3.0, period).least);
  }
  CHECK(lost < -1e-3);  // told that all of it moves with the encoder
  const auto loud = ph::make_mesh_touch<scene>(arm, ph::any_transmission{}, person, stiff);
  CHECK_FALSE(knead(loud, s, 3.0, 5).quiet);  // its spring is designed for all of it
  auto heavy = belt;
  heavy.rotor = 0.3;
  CHECK(std::string(ph::make_mesh_touch<scene>(arm, heavy, person).check().parameter) == "mass");
}
