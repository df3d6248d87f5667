// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "two_port/sides.hpp"

#include <array>
#include <limits>

using namespace two_ends;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("both sides refuse parameters that are out of range, and then do nothing", "[two_port]") {
  const auto broken = [](const ph::two_port_energy& observer) {
    auto side = side_of(observer);
    side.receive({0.0, 1, 2.0});
    CHECK(side.check());
    return side.tick(0.0, 1ms);
  };
  CHECK(broken({.damping = 0.0}).what == ph::event::rejected_parameters);
  CHECK(broken({.damping = 1.0, .share = 1.1, .loan = 1.0}).force == 0.0);
  CHECK(broken({.damping = 1.0, .cap = -1.0}).force == 0.0);
  CHECK(broken({.damping = 1.0, .loan = -1.0}).force == 0.0);

  const double nan = std::nan(""), endless = std::numeric_limits<double>::infinity();
  for (const ph::admittance_parameters& p : {ph::admittance_parameters{.stiffness = -1.0},
                                             {.drift_rate = nan},
                                             {.top_speed = 0.0},
                                             {.loan = endless},
                                             {.cap = -1.0}}) {
    ph::admittance_side<d1> side(p);
    CHECK(side.check());
    side.receive({1.0, 1, 0.1});
    const auto out = side.step(0.0, 1ms);
    CHECK(out.displacement == 0.0);
    CHECK(out.what == ph::event::rejected_parameters);
  }
  CHECK_FALSE(ph::admittance_side<d1>{}.check());
  CHECK(ph::two_port_series_controller<d1>{{.min_speed = -1.0}}.check());
  CHECK(ph::two_port_series_controller<d1>{{.max_gain = -1.0}}.check());
  CHECK_FALSE(ph::two_port_series_controller<d1>{}.check());
}

namespace {

/// What a step makes of a motion wanted under a force.
template <class Space>
constexpr auto step_of(const ph::admittance_parameters& p, const vector_of<Space>& wanted,
                       const vector_of<Space>& force) {
  ph::admittance_side<Space> side(p);
  side.receive({0.0, 1, wanted});
  return side.step(force, 1ms);
}
static_assert(step_of<d1>({}, 1e-3, 0.0).displacement == 1e-3);             // free
static_assert(step_of<d1>({}, 1e-3, 5.0).displacement == 1e-3);             // with the force
static_assert(std::abs(step_of<d1>({}, 1e-3, -5.0).displacement) < 1e-17);  // against it: unpaid
static_assert(std::abs(step_of<d1>({.loan = 2e-3}, 1e-3, -5.0).displacement - 4e-4) < 1e-17);
static_assert(step_of<d1>({.top_speed = 0.5}, 1e-3, 0.0).displacement == 5e-4);

}  // namespace

TEST_CASE("admittance_side lets in exactly what was promised, and cuts only along the force",
          "[two_port]") {
  sim::random_source random(9);
  int cut = 0;
  for (int n = 0; n < 10000; ++n) {
    const double length = random.uniform(0.0, 1e-2), exponent = random.uniform(-140.0, 3.0);
    const d3::vector wanted = random.direction<d3>() * length;
    const d3::vector force = random.direction<d3>() * std::pow(10.0, exponent);
    const double credit = random.chance(0.3) ? 0.0 : random.uniform(0.0, 1e-2);
    const auto out = step_of<d3>({.loan = credit}, wanted, force);
    const double outflow = -force.dot(out.displacement);
    REQUIRE(outflow <= credit);
    REQUIRE(out.energy >= 0.0);
    const double asked = -force.dot(wanted);
    if (asked > credit) {
      ++cut;
      REQUIRE_THAT(outflow, WithinAbs(credit, 1e-14 * force.norm()));
      REQUIRE(out.limited);
      const d3::vector u = force.normalized(), change = out.displacement - wanted;
      REQUIRE((change - u * u.dot(change)).norm() <= 1e-17);
    } else {
      REQUIRE(out.displacement == wanted);
    }
  }
  CHECK(cut > 1000);
  CHECK(step_of<d1>({}, 1e-3, -1e-200).displacement == 0.0);  // its square is zero
}

TEST_CASE("admittance_side told no stiffness leaks K Δp²/2 a step into a continuous wall",
          "[two_port][passivity]") {
  const double K = 1e4, step = 1e-4;
  const int steps = 10;
  const auto sum_of_ports = [&](const ph::admittance_parameters& p) {
    ph::admittance_side<d1> side(p);
    sim::random_source random(1);
    moving_wall<d1> world{.stiffness = K, .restless = 0.0};
    world.normal = -1.0;
    double paid = 0.0, sum = 0.0;
    for (int n = 1; n <= steps; ++n) {  // a hand that pays f(n)·Δx(n) for each step it makes
      paid += world.force() * -step;
      side.receive({paid, static_cast<std::uint64_t>(n), step * n});
      sum += world.move(side.step(world.force(), 1ms).displacement, 1e-3, random);
    }
    return sum + paid;
  };
  CHECK_THAT(sum_of_ports({}), WithinAbs(-steps * K * step * step / 2, 1e-12));
  CHECK(sum_of_ports({.stiffness = K}) >= -1e-12);
  CHECK(sum_of_ports({.stiffness = K, .loan = 1e-4}) < -1e-5);           // the loan is spent,
  CHECK(sum_of_ports({.stiffness = K, .loan = 1e-4}) >= -1e-4 - 1e-12);  // and no more
}

TEST_CASE("a stiffness makes free motion cost K Δp²/2, which settle() gives back", "[two_port]") {
  const auto way = [](bool settles) {
    ph::admittance_side<d1> side({.stiffness = 1e3, .loan = 1e-3});
    for (std::uint64_t n = 1; n <= 1000; ++n) {
      side.receive({0.0, n, 1e-3 * static_cast<double>(n)});
      (void)side.step(0.0, 1ms);
      if (settles) side.settle(0.0);
    }
    return std::array{side.position(), side.energy()};
  };
  CHECK_THAT(way(true)[0], WithinRel(1.0, 1e-12));
  CHECK_THAT(way(true)[1], WithinRel(1e-3, 1e-12));
  CHECK(way(false)[0] < 0.1);
  CHECK(way(false)[1] < 1e-5);
}

TEST_CASE("a force that is no number, or no time, moves nothing, and the next step makes up for it",
          "[two_port]") {
  ph::admittance_side<d1> side;
  CHECK(side.step(0.0, 1ms).what == ph::event::no_target);
  side.receive({0.0, 1, 1e-3});
  side.receive({0.0, 2, std::nan("")});
  side.receive({0.0, 1, 5e-3});  // there already
  CHECK(side.step(std::nan(""), 1ms).what == ph::event::rejected_sample);
  CHECK(side.step(0.0, 0s).displacement == 0.0);
  const auto out = side.step(0.0, 1ms);
  CHECK(out.what == ph::event::nominal);
  CHECK(out.displacement == 1e-3);
  CHECK(side.packet(4.0).payload == 4.0);
  CHECK(side.packet(4.0).number == 2);
}

// ---- any space ---------------------------------------------------------------------------------
