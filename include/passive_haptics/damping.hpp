// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The physical damping of the device: what every guarantee is paid with.
//
//   isotropic_damping   one b for all directions                       the usual case
//   diagonal_damping    b per axis, in the frame it was identified in  unequal joints or axes
//
// Not offered: a full matrix (rotate into its principal axes), a pose-dependent one (use its lower
// bound). All guarantees scale with b, so use a LOWER bound of the identified value, say half.

#include <passive_haptics/event.hpp>
#include <passive_haptics/kernels.hpp>

namespace passive_haptics::inline v0 {

/// b·I. Converts from the plain number, so `.damping = 0.03` reads as it should.
template <class Space>
struct isotropic_damping {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  scalar coefficient{};  ///< b [N·s/m], > 0

  constexpr isotropic_damping() noexcept = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number with a name
  constexpr isotropic_damping(scalar b) noexcept : coefficient(b) {}

  /// Δxᵀ (b/dt) Δx [J], never more than the damper took in a tick of length dt. (2.4, lemma L1)
  [[nodiscard]] constexpr scalar dissipated(const vector& displacement, scalar dt) const noexcept {
    return coefficient * Space::dot(displacement, displacement) / dt;
  }
  /// ¼ fᵀ (b/T)⁻¹ f [J], the most energy f can hand out in a tick of length T. (2.14, lemma L3)
  [[nodiscard]] constexpr scalar worst_outflow(const vector& force, scalar T) const noexcept {
    return T * Space::dot(force, force) / (scalar(4) * coefficient);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (coefficient > scalar(0) && kernels::is_finite(coefficient)) return {};
    return {"damping", coefficient, "finite and > 0 N·s/m"};
  }
};

/// diag(b₁ … b_Dof).
template <class Space>
struct diagonal_damping {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  typename Space::coordinates coefficients{};  ///< b per axis [N·s/m], each > 0

  [[nodiscard]] constexpr scalar dissipated(const vector& displacement, scalar dt) const noexcept {
    return Space::weighted_square(coefficients, displacement) / dt;
  }
  [[nodiscard]] constexpr scalar worst_outflow(const vector& force, scalar T) const noexcept {
    return T * Space::inversely_weighted_square(coefficients, force) / scalar(4);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    const scalar least = Space::smallest(coefficients);
    if (least > scalar(0) && Space::is_finite(coefficients)) return {};
    return {"damping", least, "every axis finite and > 0 N·s/m"};
  }
};

}  // namespace passive_haptics::inline v0
