// SPDX-License-Identifier: BSD-3-Clause
// What README says of the thesis experiments, asserted on the code that prints it.
#include "../../bench/thesis_experiments/ball.hpp"
#include "../../bench/thesis_experiments/strokes.hpp"
#include "../../bench/thesis_experiments/wall.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

using namespace experiments;
using Catch::Matchers::WithinRel;

namespace {

wall_result run(const std::string& controller, const wall_scene& scene, std::uint64_t seed = 1) {
  for (const auto& c : wall_controllers()) {
    if (c.name == controller) return c.run(scene, seed, nullptr);
  }
  FAIL("no controller " << controller);
  return {};
}

const wall_scene s0{.name = "S0"};
const wall_scene s1{.name = "S1", .yields = true};
const wall_scene s2{.name = "S2", .force_limit = 9.0, .friction = 0.2};

}  // namespace

TEST_CASE("S2: without a bound the device never settles, with the thesis's it does at once",
          "[experiments]") {
  const wall_result none = run("none", s2);
  CHECK(none.peak_to_peak > 5e-3);
  CHECK(std::isnan(none.settle));
  const wall_result thesis = run("thesis", s2);
  CHECK(thesis.peak_to_peak < 0.1e-3);
  CHECK(thesis.settle < 0.4);
}

TEST_CASE("S0 and S1 are within 10 % of the reference table (docs/design/mathematics.md § 5)",
          "[experiments]") {
  CHECK_THAT(run("none", s0).peak_to_peak, WithinRel(65.0e-3, 0.1));
  CHECK_THAT(run("none", s0).port_energy, WithinRel(-2.0, 0.1));
  CHECK_THAT(run("strict", s0).peak_to_peak, WithinRel(93.2e-3, 0.1));
  CHECK_THAT(run("strict", s0).force_error, WithinRel(231.0, 0.1));
  CHECK_THAT(run("thesis", s0).peak_to_peak, WithinRel(1.89e-3, 0.1));
  CHECK_THAT(run("thesis", s0).force_error, WithinRel(0.81, 0.1));
  const auto mean = [](const std::string& controller, double wall_result::*figure) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) sum += run(controller, s1, seed).*figure;
    return sum / 10.0;
  };
  CHECK_THAT(mean("none", &wall_result::peak_to_peak), WithinRel(65.9e-3, 0.1));
  CHECK_THAT(mean("strict", &wall_result::peak_to_peak), WithinRel(90.1e-3, 0.1));
  CHECK_THAT(mean("thesis", &wall_result::peak_to_peak), WithinRel(2.21e-3, 0.1));
  CHECK_THAT(mean("thesis", &wall_result::force_error), WithinRel(0.54, 0.1));
}

TEST_CASE("damped spring + reachable bound settles in all cases of the sweep and loses nothing",
          "[experiments]") {
  for (const double mass : {0.05, 0.1, 0.15, 0.5}) {
    for (const double stiffness : {1e2, 1e3, 1e4, 1e5, 1e6, 1e9}) {
      for (const int kind : {0, 1, 2}) {
        const wall_scene scene{.name = "sweep",
                               .mass = mass,
                               .stiffness = stiffness,
                               .yields = kind > 0,
                               .lags = kind == 1};
        const wall_result r = drop(settling_model(mass), scene, 7);
        INFO(mass << " kg, " << stiffness << " N/m, kind " << kind);
        CHECK(r.last_swing < 0.5e-3);
        CHECK(r.settle < 3.0);
        CHECK(r.port_energy >= -1e-12);
      }
    }
  }
}

TEST_CASE("a stiffness fraction of 0.3 is passive but does not settle the sweep", "[experiments]") {
  int unsettled = 0;
  for (const double mass : {0.05, 0.1, 0.15, 0.5}) {
    for (const double stiffness : {1e2, 1e3, 1e4, 1e5, 1e6, 1e9}) {
      const auto model = wall_model(ph::damped_spring{.mass = mass, .stiffness_fraction = 0.3},
                                    ph::reduced_energy{.damping = 0.03},
                                    ph::reachable_bound{.mass = mass, .hand_force = 5.0});
      const wall_result r = drop(model, {.name = "sweep", .mass = mass, .stiffness = stiffness}, 7);
      unsettled += r.last_swing < 0.5e-3 && r.settle < 3.0 ? 0 : 1;
      CHECK(r.port_energy >= -1e-12);
    }
  }
  CHECK(unsettled > 0);  // damped_spring's header says so
}

TEST_CASE("turn-limited normals keep their rate and end the jumps of the ball", "[experiments]") {
  const scratch_folder folder;
  csv_file csv(folder / "ball.csv", "discarded");
  const ball_result at_once = press(false, 0.5, csv);
  const ball_result limited = press(true, 0.5, csv);
  CHECK(at_once.normal_step >
        100.0 * turning_rate * 1e-3);  // the control: there was something to turn
  CHECK(limited.normal_step <= turning_rate * 1e-3 * (1 + 1e-9));
  CHECK(limited.position_jump <= at_once.position_jump / 10.0);
  csv.close();
}

TEST_CASE("a stroke over an organ keeps contact, with steps a tenth of the bare model's",
          "[experiments]") {
  const stroke_scene scene(read_organ(our_organ, millimetre));
  CHECK(scene.mesh().nodes.size() == 185);
  CHECK(scene.mesh().tetrahedra.size() == 720);
  const auto [reference, bare, passive, touch, lent] = stroke(scene);
  CHECK(passive.contact_lost == 0);
  CHECK(passive.force_step <= bare.force_step / 10.0);
  CHECK(rms_error(passive, reference) < 3.0 * rms_error(bare, reference));
  CHECK(passive.port_energy >= -1e-12);
  CHECK(passive.end_energy > 0.0);  // there was something to lose
  for (const auto* ours : {&touch, &lent}) {
    CHECK(ours->contact_lost == 0);
    CHECK(ours->force_step < 0.02);
    CHECK(rms_error(*ours, reference) < 1.05 * rms_error(bare, reference));
  }
  CHECK(rms_error(lent, reference) < 0.75 * rms_error(bare, reference));
  CHECK(touch.port_energy >= -1e-12);
  CHECK(lent.port_energy >= -loan);
  CHECK(lent.port_energy < -1e-5);  // the control: the loan is drawn
}
