// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/published/energy_bounding.hpp>
#include <passive_haptics/published/energy_tank.hpp>
#include <passive_haptics/published/passivity_controller.hpp>
#include <passive_haptics/published/reference_energy.hpp>
#include <passive_haptics/published/sector_bound.hpp>
#include <passive_haptics/published/set_position_modulation.hpp>
#include <passive_haptics/published/stiffness_augmentation.hpp>
#include <passive_haptics/two_port/energy.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
using ph::detail::number;

template <class S>
bool same(S a, S b) {
  return a == b && std::signbit(a) == std::signbit(b);
}

/// A part gives back the numbers it was made with, and those that it takes later.
template <class Port = d1, class Part>
void gives_back(const Part& first, const Part& other) {
  const auto numbers = [](const Part& p) {
    return std::bit_cast<std::array<double, sizeof(Part) / sizeof(double)>>(p);
  };
  REQUIRE_FALSE(first.check());
  REQUIRE_FALSE(other.check());
  ph::part_at<Part, Port> part(first);
  CHECK((numbers(part.parameters()) == numbers(first)));
  ph::detail::take<Part, Port>(part, other);
  CHECK((numbers(part.parameters()) == numbers(other)));
}

}  // namespace

TEST_CASE("every part gives its parameters back, and those that it takes later", "[parameter]") {
  gives_back(ph::isotropic_damping{1}, {2});
  gives_back<d2>(ph::diagonal_damping<2>{{1, 2}}, {{3, 4}});
  gives_back(ph::damping_and_friction{1, 2, 3}, {4, 5, 6});
  gives_back<d2>(ph::diagonal_damping_and_friction<2>{{1, 2}, {3, 4}, {5, 6}},
                 {{7, 8}, {9, 10}, {11, 12}});
  gives_back<d2>(ph::encoder_steps<2>{{1, 2}}, {{3, 4}});
  gives_back(ph::dual_ledger{.damping = {1, 2, 3}, .quantum = 4, .loan = 5, .cap = 6, .window = 7},
             {.damping = {8, 9, 10}, .quantum = 11, .loan = 12, .cap = 13, .window = 14});
  gives_back(ph::isotropic_inertia{1}, {2});
  gives_back<d2>(ph::diagonal_inertia<2>{{1, 2}}, {{3, 4}});
  gives_back(ph::loop_limits{1, 2, 3, 4}, {5, 6, 7, 8});
  gives_back(ph::freshness{1, 2}, {3, 4});
  gives_back(ph::mass_observer{1, 2}, {3, 4});
  gives_back(ph::reduced_energy{1, 2}, {3, 4});
  gives_back(ph::capped_energy{1, 2, 3, 4}, {5, 6, 7, 8});
  gives_back(ph::quantised_energy{1, 2, 3, 4, 5}, {6, 7, 8, 9, 10});
  gives_back(ph::two_port_energy{1, 0.5, 3, 4}, {5, 0.25, 7, 8});
  gives_back(ph::actuator_limit{1}, {2});
  gives_back<d2>(ph::motor_limits<2>{{1, 2}}, {{3, 4}});
  gives_back(ph::per_axis_bound{1}, {2});
  gives_back(ph::reachable_bound{1, 2}, {3, 4});
  gives_back(ph::reachable_work_bound<1>{{{1}}, 2}, {{{3}}, 4});
  gives_back(ph::energy_bounding{1, 2}, {3, 4});
  gives_back(ph::tight_energy_bounding{1}, {2});
  gives_back(ph::sector_bound{1}, {2});
  gives_back(ph::energy_tank{1}, {2});
  gives_back(ph::two_layer_tank{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12});
  gives_back(ph::series_passivity_controller{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12});
  gives_back(ph::given_force{1, 2}, {3, 4});
  gives_back(ph::damped_spring{1, 0.25, 3, 0.5, 5}, {6, 0.125, 8, 0.375, 10});
  gives_back(ph::virtual_coupling{1, 2}, {3, 4});
  gives_back(ph::turn_limited{1}, {2});
  gives_back(ph::force_rate_limit{1}, {2});
  gives_back(ph::nonlinear_coupling{1, 2, 3}, {4, 5, 6});
  gives_back(ph::stiffness_increment{1, 2, 3}, {4, 5, 6});
  gives_back(ph::force_augmentation{1, 2}, {3, 4});
  gives_back(ph::set_position_modulation{1, 2, 3}, {4, 5, 6});
  gives_back(ph::reference_energy{{1, 2, 3, 4, 5, 6}, 0.5}, {{7, 8, 9, 10, 11, 12}, 0.25});
}

TEST_CASE("a settled_force gives its parameters back, of which one is no number", "[parameter]") {
  const auto agrees = [](const ph::settled_force& a, const ph::settled_force& b) {
    return a.mass == b.mass && a.damping_fraction == b.damping_fraction && a.lead == b.lead &&
           a.slide_fraction == b.slide_fraction && a.turn_time == b.turn_time &&
           a.force_limit == b.force_limit && a.stale_after == b.stale_after && a.fade == b.fade &&
           a.softens == b.softens;
  };
  const ph::settled_force first{1, 0.5, 3, 0.0625, 5, 6, 7, 8, false};
  const ph::settled_force other{9, 0.25, 4, 0.03125, 10, 11, 12, 13, true};
  ph::part_at<ph::settled_force, d1> part(first);
  CHECK(agrees(part.parameters(), first));
  part.set(other);
  CHECK(agrees(part.parameters(), other));
}

TEST_CASE("a parameter that is finite and not zero is so in float, too", "[parameter]") {
  using limits = std::numeric_limits<float>;
  static_assert(number<float>(0.03) == 0.03F);
  static_assert(number<float>(1e300) == limits::max());
  static_assert(number<float>(-1e300) == -limits::max());
  static_assert(number<float>(1e-300) == limits::min());
  static_assert(number<float>(-1e-300) == -limits::min());
  CHECK(number<float>(1e-40) == limits::min());  // a subnormal float would do, and be slow
  CHECK(number<float>(double(limits::max())) == limits::max());
  CHECK(number<float>(double(limits::min())) == limits::min());
  CHECK(same(number<float>(0.0), 0.0F));
  CHECK(same(number<float>(-0.0), -0.0F));
  static_assert(static_cast<float>(1e-300) == 0.0F);  // the control: what the language does
}

TEST_CASE("a parameter that is no number, or infinite, stays what it is", "[parameter]") {
  CHECK(std::isnan(number<float>(std::nan(""))));
  CHECK(number<float>(infinite) == std::numeric_limits<float>::infinity());
  CHECK(number<float>(-infinite) == -std::numeric_limits<float>::infinity());
  CHECK(std::isnan(number<double>(std::nan(""))));
  CHECK(number<double>(infinite) == infinite);
}

TEST_CASE("a parameter is itself in double and wider", "[parameter]") {
  for (const double x : {0.0, 1e-300, -1e300, 0.1, 5e-324}) {
    CHECK(same(number<double>(x), x));
    CHECK(same(static_cast<double>(number<long double>(x)), x));
  }
}

TEST_CASE("what check() has passed is still in its range at a port of floats", "[parameter]") {
  const auto sound = [](const auto& part) {
    using parameters = std::remove_cvref_t<decltype(part)>;
    REQUIRE_FALSE(part.check());
    return !ph::part_at<parameters, f1>(part).parameters().check();
  };
  for (const double x : {1e-300, 1e-45, 0.1, 1e39, 1e300}) {
    CHECK(sound(ph::isotropic_damping{x}));
    CHECK(sound(ph::diagonal_damping<1>{{x}}));
    CHECK(sound(ph::damping_and_friction{x, x, x}));
    CHECK(sound(ph::diagonal_damping_and_friction<1>{{x}, {x}, {x}}));
    CHECK(sound(ph::encoder_steps<1>{{x}}));
    CHECK(sound(ph::isotropic_inertia{x}));
    CHECK(sound(ph::reduced_energy{.damping = x, .loan = x}));
    CHECK(sound(ph::quantised_energy{.damping = x, .quantum = x, .window = x}));
    CHECK(sound(ph::reachable_bound{.mass = x, .hand_force = x}));
    CHECK(sound(ph::actuator_limit{.most = x}));
    CHECK(sound(ph::turn_limited{.rate = x}));
    CHECK(sound(ph::damped_spring{.mass = x, .force_limit = infinite}));
    CHECK(sound(ph::virtual_coupling{.stiffness = x, .damping = x}));
    CHECK(sound(ph::force_rate_limit{.rate = x}));
    CHECK(sound(ph::mass_observer{.mass = x, .quantum = x}));
    CHECK(sound(ph::freshness{.stale_after = x, .fade = x}));
    CHECK(sound(ph::loop_limits{.longest_tick = x, .top_speed = x}));
  }
}

TEST_CASE("a fault is true when there is one, and names parameter, value and remedy",
          "[parameter]") {
  constexpr auto fault = ph::reachable_bound{.mass = -0.5, .hand_force = 5.0}.check();
  static_assert(fault);
  CHECK(std::string(fault.parameter) == "mass");
  CHECK(fault.value == -0.5);
  CHECK(std::string(fault.remedy) == "finite and > 0 kg");
  static_assert(!ph::reachable_bound{.mass = 0.5, .hand_force = 5.0}.check());
  static_assert(!ph::parameter_fault{});
}
