// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Any friction of friction.hpp, chosen at run time, for a given level and presliding displacement.
//
//     sim::friction_like{sim::friction_kind::dupont, 0.26, 15e-6}      c = 0.26 N, p = 15 µm
//
// All claim() this level and this displacement but dahl and lugre, which have them and claim nothing.

#include <passive_haptics/simulation/friction_bristle.hpp>
#include <passive_haptics/simulation/friction_elastic.hpp>

#include <array>
#include <concepts>
#include <cstdint>
#include <type_traits>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

enum class friction_kind : std::uint8_t {
  one_spring,     ///< slider_and_spring
  three_springs,  ///< maxwell_slip<3>, of p/2, p and 3p/2
  dupont,         ///< creeps from 0.6 p on
  stribeck,       ///< a static level of 1.5 c, which falls to c with v_s = 5 mm/s
  rippled,        ///< the same, rippling by 30 % every 0.5 mm; its least kinetic level is c
  dahl,           ///< dahl_friction, a control
  lugre,          ///< lugre_friction, a control with stribeck's levels
};

inline constexpr std::array all_friction_kinds{
    friction_kind::one_spring, friction_kind::three_springs, friction_kind::dupont,
    friction_kind::stribeck,   friction_kind::rippled,       friction_kind::dahl,
    friction_kind::lugre};

[[nodiscard]] constexpr const char* to_string(friction_kind kind) noexcept {
  switch (kind) {
    case friction_kind::one_spring:
      return "one spring";
    case friction_kind::three_springs:
      return "three springs";
    case friction_kind::dupont:
      return "Dupont";
    case friction_kind::stribeck:
      return "Stribeck";
    case friction_kind::rippled:
      return "rippled";
    case friction_kind::dahl:
      return "Dahl";
    case friction_kind::lugre:
      return "LuGre";
  }
  return "unknown friction";
}

namespace detail {

/// The result of ask(model) for the model of that kind.
[[nodiscard]] auto ask_friction(friction_kind kind, double c, double p, double start,
                                auto ask) noexcept {
  switch (kind) {
    case friction_kind::three_springs:
      return ask(maxwell_slip<3>{{c / 3.0, c / 3.0, c / 3.0}, {p / 2.0, p, 1.5 * p}, start});
    case friction_kind::dupont:
      return ask(dupont_friction{c, 0.6 * p, p, start});
    case friction_kind::stribeck:
      return ask(stribeck_friction{c, 1.5 * c, 5e-3, p, 0.0, 0.0, start});
    case friction_kind::rippled:
      return ask(stribeck_friction{c / 0.7, 1.5 * c / 0.7, 5e-3, p, 0.3, 0.5e-3, start});
    case friction_kind::dahl:
      return ask(dahl_friction{c, p, start});
    case friction_kind::lugre:
      return ask(lugre_friction{c, 1.5 * c, 5e-3, p, 0.0, start});
    case friction_kind::one_spring:
      break;
  }
  return ask(maxwell_slip<3>{{c, 0.0, 0.0}, {p, p, p}, start});
}

/// The state of one model within a memory that serves all models.
template <class Model>
[[nodiscard]] auto& memory_of(const Model& /*model*/, std::array<double, 3>& any) noexcept {
  if constexpr (std::same_as<typename Model::state, double>) {
    return any[0];
  } else {
    return any;
  }
}

}  // namespace detail

struct friction_like {
  using state = std::array<double, 3>;

  friction_kind kind = friction_kind::one_spring;
  double level = 0.0;       ///< c [N]
  double presliding = 0.0;  ///< p [m]
  double start = 0.0;       ///< deflection at the start, as a share of the largest

  [[nodiscard]] state begin() const noexcept {
    return model([](const auto& m) {
      state z{};
      detail::memory_of(m, z) = m.begin();
      return z;
    });
  }
  friction_work slide(state& z, double from, double way, double time) const noexcept {
    return model([&](const auto& m) { return m.slide(detail::memory_of(m, z), from, way, time); });
  }
  [[nodiscard]] double stiffness() const noexcept {
    return model([](const auto& m) { return m.stiffness(); });
  }
  [[nodiscard]] friction_claim claim() const noexcept {
    return model([](const auto& m) { return m.claim(); });
  }
  [[nodiscard]] parameter_fault check() const noexcept {
    if (const auto fault = detail::friction_fault(level, presliding, start)) return fault;
    return model([](const auto& m) { return m.check(); });
  }

 private:
  template <class Ask>
  [[nodiscard]] std::invoke_result_t<Ask, dahl_friction> model(Ask ask) const noexcept {
    return detail::ask_friction(kind, level, presliding, start, ask);
  }
};

static_assert(friction_model<friction_like>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
