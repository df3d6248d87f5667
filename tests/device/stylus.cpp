// SPDX-License-Identifier: BSD-3-Clause
// Six are sensed, three are pushed: a stylus whose tip is turned into a wall (docs/design/six_dof.md).
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/device/stylus.hpp>
#include <passive_haptics/laws.hpp>

using Catch::Matchers::WithinAbs;

namespace {

using pen = ph::stylus<double>;
using vec3 = pen::vector;
constexpr double T = 1e-3, b = 0.03, stiffness = 1000.0, depth = 3e-3, length = 0.1;

/// A stylus whose tip is `length` along its own x, over a floor at z = 0 that pushes the tip up.
struct pumped {
  double least = 0.0;      ///< true energy at the gimbal [J]
  double strongest = 0.0;  ///< force [N]
};

/// Turned into the floor, lifted, turned away, brought back: so many times, each stroke 200 ticks.
template <class Bound>
[[nodiscard]] pumped pump(const Bound& bound, int cycles, double loan = 0.0) {
  ph::passive_port port{pen{}, ph::given_force{}, ph::reduced_energy{.damping = b, .loan = loan},
                        bound, ph::loop_limits{.longest_tick = T}};
  pumped out;
  double energy = loan, height = -depth, angle = 1.2;
  vec3 held = vec3::Zero();
  const auto step = [&](double to_height, double to_angle) {
    const double up = to_height - height;
    energy += b * up * up / T - held(2) * up;
    height = to_height;
    angle = to_angle;
    const pen::pose x{vec3(0, 0, height), ph::rotation::exp<double>(vec3(0, -angle, 0))};
    const vec3 tip = pen::place(x) + ph::rotation::rotate(x.orientation, vec3(length, 0, 0));
    const double pushed = std::max(0.0, -tip(2));
    held = port.tick(x, ph::seconds{T}, vec3(0, 0, stiffness * pushed)).force;
    out.least = std::min(out.least, energy);
    out.strongest = std::max(out.strongest, held(2));
  };
  for (int cycle = 0; cycle < cycles; ++cycle) {
    for (int k = 1; k <= 200; ++k) step(-depth, 1.2 * (1 - k / 200.0));
    for (int k = 1; k <= 200; ++k) step(-depth * (1 - k / 200.0), 0.0);
    for (int k = 1; k <= 200; ++k) step(0.0, 1.2 * k / 200.0);
    for (int k = 1; k <= 200; ++k) step(-depth * (k / 200.0), 1.2);
  }
  return out;
}

}  // namespace

TEST_CASE("a stylus obeys the laws of a point, with the parts of a point", "[stylus]") {
  CHECK(ph::laws::all<ph::isotropic_damping, pen>(b));
  CHECK(ph::laws::all<ph::reduced_energy, pen>({.damping = b}));
  CHECK(ph::laws::all<ph::dual_ledger, pen>(
      {.damping = {.coefficient = b, .coulomb = 0.1, .presliding = 1e-5}, .quantum = 5e-5}));
  CHECK(ph::laws::all<ph::strict_bound, pen>());
  CHECK(ph::laws::all<ph::memoryless_bound, pen>());
  CHECK(ph::laws::all<ph::reachable_bound, pen>({.mass = 0.1, .hand_force = 5.0}));
  CHECK(ph::laws::all<ph::actuator_limit, pen>({.most = 3.0}));
}

TEST_CASE("a stylus is where its gimbal is, however it is turned", "[stylus]") {
  const pen::pose from{{1, 2, 3}, {}}, to{{1, 2, 3.5}, {0, 1, 0, 0}};
  CHECK(pen::between(from, to) == vec3(0, 0, 0.5));
  CHECK(pen::place(pen::moved(from, vec3(0, 0, 1))) == vec3(1, 2, 4));
  CHECK(pen::moved(to, vec3(0, 0, 1)).orientation.x == 1.0);
  CHECK(pen::squared(vec3(1, 2, 2)) == 9.0);
}

TEST_CASE("nobody pumps energy out of a stylus by turning it, unless nothing bounds it",
          "[stylus]") {
  const ph::reachable_bound reach{.mass = 0.1, .hand_force = 5.0};
  CHECK(pump(ph::strict_bound{}, 20).least >= -1e-12);
  CHECK(pump(reach, 20).least >= -1e-12);
  // The control: K D²/2 = 4.5 mJ a cycle.
  CHECK_THAT(pump(ph::no_bound{}, 20).least, WithinAbs(-0.090, 0.002));
  CHECK(pump(ph::no_bound{}, 1).strongest > 2.9);
  // What a loan pays for is felt; what nobody has paid for is not.
  CHECK(pump(ph::strict_bound{}, 1).strongest < 0.1);
  const auto lent = pump(reach, 1, 5e-3);
  CHECK(lent.strongest > 2.9);
  CHECK(lent.least >= 0.0);
}
