// SPDX-License-Identifier: BSD-3-Clause
// Every policy of the library under every law of its role, in 1, 2 and 3 dimensions, float and
// double, and at compile time where there is no Eigen in it. Each law also rejects a policy that
// breaks it.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>

namespace laws = ph::laws;

namespace {

template <class S>
constexpr bool observers_obey() {
  using scalar = typename S::scalar;
  constexpr scalar b = scalar(0.03);
  using kept = ph::reduced_energy<S, ph::isotropic_damping<S>, ph::compensated_sum<scalar>>;
  return laws::never_overstates<S>(ph::reduced_energy<S>{.damping = b}) &&
         laws::never_overstates<S>(kept{.damping = b}) &&
         laws::never_overstates<S>(ph::reduced_energy<S>{.damping = b, .cap = scalar(1e-5)}) &&
         laws::never_overstates<S>(
             ph::reduced_energy<S>{.damping = b, .reset_after = scalar(0.002)}) &&
         laws::forfeit_never_credits<S>(ph::reduced_energy<S>{.damping = b}) &&
         laws::forfeit_never_credits<S>(kept{.damping = b});
}

template <class S>
constexpr bool bounds_obey(int ticks) {
  using scalar = typename S::scalar;
  const auto reduces = [ticks](auto bound) {
    return laws::scales_down<S>(bound, ticks) && laws::adds_nothing_to_zero<S>(bound, ticks);
  };
  const ph::reachable_bound<S> reachable{.mass = scalar(0.1), .hand_force = scalar(5)};
  const ph::actuator_limit<S> motors{.most = scalar(5)};
  const ph::force_rate_limit<S> rate{.rate = scalar(100)};
  using strict = ph::strict_bound<S>;
  using tank = ph::energy_tank<S>;
  using foreseen = ph::energy_tank<S, ph::tank_outflow::predicted>;
  using gate = ph::set_position_modulation<S>;
  return reduces(ph::no_bound<S>{}) && reduces(strict{}) && reduces(ph::thesis_bound<S>{}) &&
         reduces(reachable) && reduces(motors) && reduces(ph::bound_chain{strict{}, motors}) &&
         reduces(tank{}) && reduces(foreseen{}) && reduces(gate{}) &&
         laws::spends_at_most_the_ledger<S>(strict{}, ticks) &&
         laws::spends_at_most_the_ledger<S>(ph::strict_bound<S, 2>{}, ticks) &&
         laws::spends_at_most_the_ledger<S>(ph::bound_chain{rate, strict{}, motors}, ticks) &&
         laws::spends_at_most_the_ledger<S>(ph::bound_chain{ph::thesis_bound<S>{}, strict{}},
                                            ticks) &&
         laws::spends_at_most_the_ledger<S>(tank{}, ticks) &&
         laws::spends_at_most_the_ledger<S>(ph::bound_chain{gate{}, strict{}}, ticks) &&
         // the controls: what is not tagged strict does spend more
         !laws::spends_at_most_the_ledger<S>(ph::no_bound<S>{}, ticks) &&
         !laws::spends_at_most_the_ledger<S>(ph::thesis_bound<S>{}, ticks) &&
         !laws::spends_at_most_the_ledger<S>(reachable, ticks) &&
         !laws::spends_at_most_the_ledger<S>(foreseen{}, ticks) &&
         !laws::spends_at_most_the_ledger<S>(ph::bound_chain{strict{}, rate}, ticks);
}

template <class S>
constexpr bool normals_obey() {
  using scalar = typename S::scalar;
  return laws::turns_at_most<S>(ph::rotate_limited<S>{.rate = scalar(50)}, scalar(50)) &&
         laws::turns_at_most<S>(ph::snap<S>{}, scalar(3200));
}

template <class S>
constexpr bool contacts_obey() {
  return laws::presses_outwards<S>(ph::spring<S>{}) &&
         laws::presses_outwards<S>(ph::damped_spring<S>{.mass = typename S::scalar(0.1)}) &&
         laws::presses_outwards<S>(ph::virtual_coupling<S>{.stiffness = typename S::scalar(2000),
                                                           .damping = typename S::scalar(0.02)});
}

static_assert(observers_obey<d1>() && observers_obey<f1>());
static_assert(bounds_obey<d1>(60));  // clang counts the steps
static_assert(bounds_obey<f1>(60));
static_assert(normals_obey<d1>() && normals_obey<f1>());
static_assert(contacts_obey<d1>() && contacts_obey<f1>());
static_assert(laws::measures_depth<d1>(ph::half_space<d1>{0.5, -3.0, 100.0}));

/// Liars, one for each law.
struct generous : ph::reduced_energy<d1> {
  constexpr bool update(double dx, double held, double dt) noexcept {
    return ph::reduced_energy<d1>::update(2 * dx, held, dt);
  }
};
struct forgiving : ph::reduced_energy<d1> {
  constexpr void forfeit(double /*held*/, double /*T*/) noexcept { energy = 1.0; }
};
struct pushy : ph::no_bound<d1> {
  [[nodiscard]] constexpr double limit(double f, const auto& /*state*/) const noexcept {
    return 1.1 * f - 1e-3;
  }
};
struct hasty {
  template <class V, class S>
  V step(const V& from, const V& to, S dt) const noexcept {
    return ph::rotate_limited<d3>{.rate = 60}.step(from, to, dt);
  }
};
struct lazy {
  template <class V, class S>
  V step(const V& from, const V& /*to*/, S /*dt*/) const noexcept {
    return from;
  }
};
struct sticky : ph::spring<d1> {
  [[nodiscard]] constexpr double force(double d, double v) const noexcept {
    return ph::spring<d1>::force(d + 1e-3, v);
  }
};
struct tilted : ph::half_space<d1> {
  [[nodiscard]] constexpr double depth(double x) const noexcept {
    return 1.01 * ph::half_space<d1>::depth(x);
  }
};

static_assert(!laws::never_overstates<d1>(generous{{.damping = 0.03}}));
static_assert(!laws::forfeit_never_credits<d1>(forgiving{{.damping = 0.03}}));
static_assert(!laws::scales_down<d1>(pushy{}));
static_assert(!laws::adds_nothing_to_zero<d1>(pushy{}));
static_assert(!laws::presses_outwards<d1>(sticky{}));
static_assert(!laws::measures_depth<d1>(tilted{{0.5, -3.0, 100.0}}));

}  // namespace

TEMPLATE_TEST_CASE("every policy obeys the laws of its role", "[law]", d1, f1, d2, f2, d3, f3) {
  CHECK(observers_obey<TestType>());
  CHECK(bounds_obey<TestType>(1000));
  CHECK(normals_obey<TestType>());
  CHECK(contacts_obey<TestType>());
}

TEST_CASE("every constraint measures depth", "[law]") {
  CHECK(laws::measures_depth<d2>(ph::half_space<d2>{{1, 2}, {1, 1}, 100}));
  CHECK(laws::measures_depth<f3>(ph::half_space<f3>{{1, 2, 3}, {1, 1, 1}, 100}));
  CHECK(laws::measures_depth<d2>(ph::segment<d2>{.a = {1, 0}, .b = {0, 1}, .stiffness = 100}));
  CHECK(laws::measures_depth<d3>(
      ph::triangle<d3>{.a = {1, 0, 0}, .b = {0, 1, 1}, .c = {1, 3, 0}, .stiffness = 100}));
  CHECK(laws::measures_depth<f3>(
      ph::triangle<f3>{.a = {1, 0, 0}, .b = {0, 1, 1}, .c = {1, 3, 0}, .stiffness = 100}));
}

TEST_CASE("the law of rotation rejects one too fast and one that never arrives", "[law]") {
  CHECK_FALSE(laws::turns_at_most<d3>(hasty{}, 50.0));
  CHECK_FALSE(laws::turns_at_most<d3>(lazy{}, 50.0));
  CHECK(laws::turns_at_most<d3>(hasty{}, 60.0));
}
