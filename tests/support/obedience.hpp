// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tries policies under the laws of their role (passive_haptics/laws.hpp).
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>

#include <string>

namespace laws = ph::laws;

/// The role in which a policy is tried. A policy that models no role breaks no law.
enum class role { damping, inertia, observer, bound, normals, contact_law, constraint, surface };

template <role Role, class Policy, class Port>
constexpr bool models() {
  using enum role;
  if constexpr (Role == damping) return ph::damping_for<Policy, Port>;
  if constexpr (Role == inertia) return ph::inertia_for<Policy, Port>;
  if constexpr (Role == observer) return ph::energy_observer_for<Policy, Port>;
  if constexpr (Role == bound) return ph::force_bound_for<Policy, Port>;
  if constexpr (Role == normals) return ph::normal_interpolation_for<Policy, Port>;
  if constexpr (Role == contact_law) return ph::contact_law_for<Policy, Port>;
  if constexpr (Role == constraint) return ph::constraint_for<Policy, Port>;
  if constexpr (Role == surface) return ph::surface_for<Policy, Port>;
}

/// The law that a policy breaks, or "none" if it obeys all.
template <role Role, class Port, class Policy>
constexpr const char* broken_by(const Policy& policy) {
  static_assert(models<Role, Policy, Port>());
  const auto all = laws::all<Policy, Port>(policy);
  return all ? "none" : all.broken;
}
template <role Role, class Port, class... Policies>
constexpr bool obeys(const Policies&... policies) {
  static_assert((models<Role, Policies, Port>() && ...));
  return (bool(laws::all<Policies, Port>(policies)) && ...);
}
template <role Role, class Port>
void obey(const auto&... policies) {
  const auto check = [](const char* law) { CHECK(std::string(law) == "none"); };
  (check(broken_by<Role, Port>(policies)), ...);
}

/// A damping with another number for every axis.
template <class Port, int N = Port::dof>
constexpr ph::diagonal_damping<N> every_axis() {
  ph::diagonal_damping<N> d;
  for (std::size_t i = 0; i < N; ++i) d.coefficients[i] = 0.01 * static_cast<double>(i + 1);
  return d;
}
template <class Port, int N = Port::dof>
constexpr ph::diagonal_damping_and_friction<N> every_friction() {
  ph::diagonal_damping_and_friction<N> d{.coefficients = every_axis<Port>().coefficients};
  for (std::size_t i = 0; i < N; ++i) {
    d.coulomb[i] = 0.05 * static_cast<double>(i);  // none on the first
    d.presliding[i] = 1e-5 / static_cast<double>(i + 1);
  }
  return d;
}
template <class Port, int N = Port::dof>
constexpr ph::encoder_steps<N> every_step() {
  ph::encoder_steps<N> q;
  for (std::size_t i = 0; i < N; ++i) q.widths[i] = 1e-5 * static_cast<double>(i);
  return q;
}
template <class Port, int N = Port::dof>
constexpr ph::diagonal_inertia<N> every_mass() {
  ph::diagonal_inertia<N> m;
  for (std::size_t i = 0; i < N; ++i) m.masses[i] = 0.05 * static_cast<double>(i + 1);
  return m;
}
template <class Port, int N = Port::dof>
constexpr ph::motor_limits<N> every_motor() {
  ph::motor_limits<N> f;
  for (std::size_t i = 0; i < N; ++i) f.most[i] = static_cast<double>(i) + 1.0;
  return f;
}
